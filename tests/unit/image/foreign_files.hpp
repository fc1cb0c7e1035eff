#pragma once

#include "lv/base/tensor.hpp"

#include "support/archive_bytes.hpp"
#include "support/temporary_folder.hpp"
#include <fmt/format.h>
#include <minizip/zip.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// Files as other programs write them, byte by byte.
namespace lv::test {

/// Little-endian bytes of a number.
template <class Number>
std::string bytes_as(Number value) {
  return {reinterpret_cast<const char*>(&value), sizeof(Number)};
}

/// A DICOM element (explicit VR, little endian).
inline std::string element(std::uint16_t group, std::uint16_t tag, const std::string& vr,
                           std::string value) {
  if (value.size() % 2 != 0)
    value += vr == "UI" || vr == "OB" ? '\0' : ' ';
  const bool wide = vr == "SQ" || vr == "OB" || vr == "OW";
  return bytes_as(group) + bytes_as(tag) + vr +
         (wide ? std::string(2, '\0') + bytes_as(static_cast<std::uint32_t>(value.size()))
               : bytes_as(static_cast<std::uint16_t>(value.size()))) +
         value;
}

/// A sequence of items, each made of elements.
inline std::string sequence(std::uint16_t group, std::uint16_t tag,
                            const std::vector<std::string>& items) {
  std::string value;
  for (const std::string& item : items)
    value += bytes_as(std::uint16_t{0xfffe}) + bytes_as(std::uint16_t{0xe000}) +
             bytes_as(static_cast<std::uint32_t>(item.size())) + item;
  return element(group, tag, "SQ", value);
}

/// A DICOM file of these elements.
inline std::string dicom_file(const std::string& sop_class, const std::string& elements) {
  const std::string meta = element(2, 1, "OB", std::string("\0\1", 2)) +
                           element(2, 2, "UI", sop_class) + element(2, 3, "UI", "1.2.3.9") +
                           element(2, 0x10, "UI", "1.2.840.10008.1.2.1");
  return std::string(128, '\0') + "DICM" +
         element(2, 0, "UL", bytes_as(static_cast<std::uint32_t>(meta.size()))) + meta + elements;
}

/// Text of points "x\y\z" round a circle in a plane.
inline std::string circle_text(const Vec3& centre, const Vec3& a, const Vec3& b, double radius,
                               int count = 24) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const Vec3 x = centre + radius * (std::cos(2.0 * M_PI * i / count) * a +
                                      std::sin(2.0 * M_PI * i / count) * b);
    text += fmt::format("{}{:.6f}\\{:.6f}\\{:.6f}", text.empty() ? "" : "\\", x.x(), x.y(), x.z());
  }
  return text;
}

/// A structure set: for each name a circle of its radius on each of three slices; with `uid` the
/// images they were drawn on are 1.2.3.4.1 and so on.
inline std::string rt_structures_bytes(const std::vector<std::pair<std::string, double>>& rois,
                                       const Mat3& axes = Mat3::Identity(), bool uid = false) {
  std::vector<std::string> names;
  std::vector<std::string> regions;
  for (const auto& [name, radius] : rois) {
    const auto number = fmt::format("{}", names.size() + 7);
    names.push_back(element(0x3006, 0x22, "IS", number) + element(0x3006, 0x26, "LO", name));
    std::vector<std::string> contours;
    for (int s = 0; s < 3; ++s) {
      const Vec3 centre = Vec3(10, -20, 30) + 8.0 * s * axes.col(2);
      const std::string image =
          uid ? sequence(0x3006, 0x16,
                         {element(8, 0x1155, "UI", fmt::format("1.2.3.4.{}.1", s + 1))})
              : "";
      contours.push_back(
          image + element(0x3006, 0x42, "CS", "CLOSED_PLANAR") +
          element(0x3006, 0x50, "DS", circle_text(centre, axes.col(0), axes.col(1), radius)));
    }
    contours.push_back(element(0x3006, 0x42, "CS", "POINT") +
                       element(0x3006, 0x50, "DS", "1\\2\\3"));
    regions.push_back(sequence(0x3006, 0x40, contours) + element(0x3006, 0x84, "IS", number));
  }
  return dicom_file("1.2.840.10008.5.1.4.1.1.481.3", element(8, 0x60, "CS", "RTSTRUCT") +
                                                         sequence(0x3006, 0x20, names) +
                                                         sequence(0x3006, 0x39, regions));
}

/// A segmentation of 5 x 3 pixels a frame, whose bits are not aligned to bytes: segment 1 shows
/// pixel p of slice s where p = s, s = 0, 2 and 3; segment 2 pixels 0 and 4 of slice 0.
inline std::string segmentation_bytes(const Mat3& axes = Mat3::Identity()) {
  struct Frame {
    int segment, slice;
    std::vector<int> pixels;
  };
  const std::vector<Frame> frames{{1, 0, {0}}, {1, 2, {2}}, {1, 3, {3}}, {2, 0, {0, 4}}};
  constexpr int pixels = 15;
  std::string bits((frames.size() * pixels + 7) / 8, '\0');
  std::vector<std::string> groups;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (const int p : frames[f].pixels) {
      const std::size_t at = f * pixels + static_cast<std::size_t>(p);
      bits[at / 8] = static_cast<char>(bits[at / 8] | (1 << (at % 8)));
    }
    const Vec3 x = Vec3(10, -20, 30) + 8.0 * frames[f].slice * axes.col(2);
    groups.push_back(
        sequence(0x20, 0x9113,
                 {element(0x20, 0x32, "DS",
                          fmt::format("{:.8f}\\{:.8f}\\{:.8f}", x.x(), x.y(), x.z()))}) +
        sequence(
            0x62, 0xa,
            {element(0x62, 0xb, "US", bytes_as(static_cast<std::uint16_t>(frames[f].segment)))}));
  }
  const Vec3 r = axes.col(0);
  const Vec3 c = axes.col(1);
  const std::string shared =
      sequence(0x20, 0x9116,
               {element(0x20, 0x37, "DS",
                        fmt::format("{:.8f}\\{:.8f}\\{:.8f}\\{:.8f}\\{:.8f}\\{:.8f}", r.x(), r.y(),
                                    r.z(), c.x(), c.y(), c.z()))}) +
      sequence(0x28, 0x9110,
               {element(0x18, 0x50, "DS", "8") + element(0x28, 0x30, "DS", "1.5\\1.25")});
  const auto segment = [](int number, const std::string& label) {
    return element(0x62, 4, "US", bytes_as(static_cast<std::uint16_t>(number))) +
           element(0x62, 5, "LO", label);
  };
  return dicom_file("1.2.840.10008.5.1.4.1.1.66.4",
                    element(8, 0x60, "CS", "SEG") + element(0x28, 8, "IS", "4") +
                        element(0x28, 0x10, "US", bytes_as(std::uint16_t{3})) +
                        element(0x28, 0x11, "US", bytes_as(std::uint16_t{5})) +
                        element(0x28, 0x100, "US", bytes_as(std::uint16_t{1})) +
                        element(0x62, 1, "CS", "BINARY") +
                        sequence(0x62, 2, {segment(1, "LV blood"), segment(2, "Scar")}) +
                        sequence(0x5200, 0x9229, {shared}) + sequence(0x5200, 0x9230, groups) +
                        element(0x7fe0, 0x10, "OB", bits));
}

/// A zip archive of files, stored or packed, by name.
inline std::string zip_bytes(const std::vector<std::pair<std::string, std::string>>& files) {
  const TemporaryFolder folder;
  const std::string name = (folder / "x.zip").string();
  const zipFile zip = zipOpen64(name.c_str(), APPEND_STATUS_CREATE);
  for (const auto& [file, bytes] : files) {
    zipOpenNewFileInZip(zip, file.c_str(), nullptr, nullptr, 0, nullptr, 0, nullptr,
                        bytes.size() > 100 ? Z_DEFLATED : 0, Z_DEFAULT_COMPRESSION);
    zipWriteInFileInZip(zip, bytes.data(), static_cast<unsigned>(bytes.size()));
    zipCloseFileInZip(zip);
  }
  zipClose(zip, nullptr);
  return bytes_of(folder / "x.zip");
}

/// A cvi42 workspace with a circle of the radius, in pixels, on images 1.2.3.4.1.1 to 1.2.3.4.3.1
/// for each name.
inline std::string cvi42_text(const std::vector<std::pair<std::string, double>>& contours,
                              int factor = 4) {
  std::string images;
  for (int s = 1; s <= 3; ++s) {
    std::string drawn;
    for (const auto& [name, radius] : contours) {
      std::string points;
      for (int i = 0; i < 24; ++i)
        points +=
            fmt::format("<List:item><Point:x>{}</Point:x><Point:y>{}</Point:y></List:item>\n",
                        std::lround(factor * (32.0 + radius * std::cos(2.0 * M_PI * i / 24))),
                        std::lround(factor * (30.0 + radius * std::sin(2.0 * M_PI * i / 24))));
      drawn += fmt::format(
          "<Hash:item Hash:key=\"{}\"><Hash:item Hash:key=\"Points\">{}</Hash:item>"
          "<Hash:item Hash:key=\"SubpixelResolution\">{}</Hash:item></Hash:item>\n",
          name, points, factor);
    }
    images += fmt::format(
        "<Hash:item Hash:key=\"1.2.3.4.{}.1\"><Hash:item Hash:key=\"Contours\">{}</Hash:item>"
        "</Hash:item>\n",
        s, drawn);
  }
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<Workspace xmlns:Hash=\"http://www.circlecvi.com/cvi42/Workspace/"
      "Hash/\" xmlns:List=\"http://www.circlecvi.com/cvi42/Workspace/List/\" "
      "xmlns:Point=\"http://www.circlecvi.com/cvi42/Workspace/Point/\">\n<Hash:item "
      "Hash:key=\"StudyMapStates\"><List:item><Hash:item Hash:key=\"StudyUid\">1.2</Hash:item>"
      "<Hash:item Hash:key=\"ImageStates\">{}</Hash:item></List:item></Hash:item>\n</Workspace>\n",
      images);
}

/// An NRRD file of bytes.
inline std::string nrrd_bytes(const std::string& fields, const std::string& values) {
  return "NRRD0004\ntype: unsigned char\nencoding: raw\n" + fields + "\n\n" + values;
}

}  // namespace lv::test
