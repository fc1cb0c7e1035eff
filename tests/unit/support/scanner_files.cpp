#include "support/scanner_files.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace lv::test {
namespace {

template <class Number>
void put(std::string& bytes, Number value) {
  char raw[sizeof(Number)];
  std::memcpy(raw, &value, sizeof(Number));
  bytes.append(raw, sizeof(Number));
}

void tag(std::string& bytes, int group, int element, const char* vr) {
  put(bytes, static_cast<std::uint16_t>(group));
  put(bytes, static_cast<std::uint16_t>(element));
  bytes += vr;
}

/// A short text element, padded to even length.
void text(std::string& bytes, int group, int element, const char* vr, std::string value) {
  if (value.size() % 2 == 1)
    value += std::string(vr) == "UI" ? '\0' : ' ';
  tag(bytes, group, element, vr);
  put(bytes, static_cast<std::uint16_t>(value.size()));
  bytes += value;
}

void number(std::string& bytes, int group, int element, int value) {
  tag(bytes, group, element, "US");
  put(bytes, std::uint16_t{2});
  put(bytes, static_cast<std::uint16_t>(value));
}

/// The preamble and what says how the rest is written.
std::string dicom_meta(const char* storage, const DicomSpec& s, const char* syntax) {
  std::string meta;
  text(meta, 2, 2, "UI", storage);
  text(meta, 2, 3, "UI", s.instance_uid);
  text(meta, 2, 0x10, "UI", syntax);
  std::string bytes(128, '\0');
  bytes += "DICM";
  tag(bytes, 2, 0, "UL");
  put(bytes, std::uint16_t{4});
  put(bytes, static_cast<std::uint32_t>(meta.size()));
  return bytes + meta;
}

constexpr const char* classic_storage = "1.2.840.10008.5.1.4.1.1.4";
constexpr const char* enhanced_storage = "1.2.840.10008.5.1.4.1.1.4.1";
constexpr const char* little_endian = "1.2.840.10008.1.2.1";

std::string dicom_begin(const char* storage, const DicomSpec& s) {
  std::string bytes;
  text(bytes, 8, 8, "CS", "ORIGINAL\\PRIMARY\\" + s.kind);
  text(bytes, 8, 0x16, "UI", storage);
  text(bytes, 8, 0x18, "UI", s.instance_uid);
  text(bytes, 8, 0x60, "CS", "MR");
  text(bytes, 8, 0x103e, "LO", s.description);
  if (!s.patient.empty())
    text(bytes, 0x10, 0x20, "LO", s.patient);
  return bytes;
}

void series(std::string& bytes, const DicomSpec& s) {
  text(bytes, 0x20, 0x0d, "UI", "1.2.3");
  text(bytes, 0x20, 0x0e, "UI", s.series_uid);
  text(bytes, 0x20, 0x11, "IS", fmt::format("{}", s.series_number));
  if (s.numbered)
    text(bytes, 0x20, 0x13, "IS", fmt::format("{}", s.instance));
}

void position(std::string& bytes, const image::Plane& plane) {
  const Vec3& o = plane.origin;
  text(bytes, 0x20, 0x32, "DS", fmt::format("{:.6f}\\{:.6f}\\{:.6f}", o.x(), o.y(), o.z()));
}

void orientation(std::string& bytes, const image::Plane& plane) {
  const Vec3& r = plane.along_row;
  const Vec3& c = plane.along_column;
  text(bytes, 0x20, 0x37, "DS",
       fmt::format("{:.8f}\\{:.8f}\\{:.8f}\\{:.8f}\\{:.8f}\\{:.8f}", r.x(), r.y(), r.z(), c.x(),
                   c.y(), c.z()));
}

void spacing(std::string& bytes, const image::Plane& plane) {
  text(bytes, 0x28, 0x30, "DS", fmt::format("{}\\{}", plane.spacing_j, plane.spacing_i));
}

void pixel_format(std::string& bytes) {
  number(bytes, 0x28, 0x100, 16);
  number(bytes, 0x28, 0x101, 16);
  number(bytes, 0x28, 0x102, 15);
  number(bytes, 0x28, 0x103, 0);
}

void pixels(std::string& bytes, const std::vector<std::uint16_t>& values) {
  tag(bytes, 0x7fe0, 0x10, "OW");
  put(bytes, std::uint16_t{0});
  put(bytes, static_cast<std::uint32_t>(2 * values.size()));
  for (const std::uint16_t value : values)
    put(bytes, value);
}

/// A sequence of items.
void sequence(std::string& bytes, int group, int element, const std::vector<std::string>& items) {
  std::string content;
  for (const std::string& item : items) {
    put(content, std::uint16_t{0xfffe});
    put(content, std::uint16_t{0xe000});
    put(content, static_cast<std::uint32_t>(item.size()));
    content += item;
  }
  tag(bytes, group, element, "SQ");
  put(bytes, std::uint16_t{0});
  put(bytes, static_cast<std::uint32_t>(content.size()));
  bytes += content;
}

/// What an enhanced file says of one of its frames.
std::string frame_groups(const DicomSpec& s) {
  std::string delay;
  tag(delay, 0x20, 0x9153, "FD");
  put(delay, std::uint16_t{8});
  put(delay, s.trigger_ms.value_or(0.0));
  std::string place, direction, measures, bytes;
  position(place, s.plane);
  orientation(direction, s.plane);
  spacing(measures, s.plane);
  std::string kind;
  text(kind, 8, 0x9007, "CS", "ORIGINAL\\PRIMARY\\" + s.kind);
  if (!s.component.empty())
    text(kind, 8, 0x9208, "CS", s.component);
  if (s.trigger_ms)
    sequence(bytes, 0x18, 0x9118, {delay});
  sequence(bytes, 0x18, 0x9226, {kind});
  sequence(bytes, 0x20, 0x9113, {place});
  sequence(bytes, 0x20, 0x9116, {direction});
  sequence(bytes, 0x28, 0x9110, {measures});
  return bytes;
}

}  // namespace

namespace {

/// What follows the meta elements of a classic file.
std::string classic_elements(const DicomSpec& s) {
  std::string bytes = dicom_begin(classic_storage, s);
  text(bytes, 0x18, 0x50, "DS", "8");
  if (s.trigger_ms)
    text(bytes, 0x18, 0x1060, "DS", fmt::format("{}", *s.trigger_ms));
  text(bytes, 0x18, 0x1062, "IS", fmt::format("{}", s.rr_ms));
  if (s.phases > 0)
    text(bytes, 0x18, 0x1090, "IS", fmt::format("{}", s.phases));
  series(bytes, s);
  position(bytes, s.plane);
  orientation(bytes, s.plane);
  number(bytes, 0x28, 2, 1);
  text(bytes, 0x28, 4, "CS", s.photometric);
  number(bytes, 0x28, 0x10, s.plane.rows);
  number(bytes, 0x28, 0x11, s.plane.columns);
  spacing(bytes, s.plane);
  pixel_format(bytes);
  text(bytes, 0x28, 0x1052, "DS", fmt::format("{}", s.intercept));
  text(bytes, 0x28, 0x1053, "DS", fmt::format("{}", s.slope));
  pixels(bytes, s.pixels);
  return bytes;
}

/// Elements of explicit VR without sequences, their numbers turned round.
std::string turned(const std::string& elements) {
  std::string bytes = elements;
  const auto turn = [&](std::size_t at, std::size_t n) {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + n));
  };
  for (std::size_t at = 0; at < elements.size();) {
    const bool wide = elements.compare(at + 4, 2, "OW") == 0;
    const bool shorts = wide || elements.compare(at + 4, 2, "US") == 0;
    std::uint32_t length = 0;
    std::memcpy(&length, elements.data() + at + (wide ? 8 : 6), wide ? 4 : 2);
    turn(at, 2);
    turn(at + 2, 2);
    turn(at + (wide ? 8 : 6), wide ? 4 : 2);
    at += wide ? 12 : 8;
    for (std::size_t i = 0; shorts && i < length; i += 2)
      turn(at + i, 2);
    at += length;
  }
  return bytes;
}

std::string deflated(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string packed(bytes.size() + 100, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out + stream.total_out % 2);
  deflateEnd(&stream);
  return packed;
}

}  // namespace

std::string dicom_bytes(const DicomSpec& s) {
  return dicom_meta(classic_storage, s, little_endian) + classic_elements(s);
}

std::string big_endian_dicom_bytes(const DicomSpec& s) {
  return dicom_meta(classic_storage, s, "1.2.840.10008.1.2.2") + turned(classic_elements(s));
}

std::string deflated_dicom_bytes(const DicomSpec& s) {
  return dicom_meta(classic_storage, s, "1.2.840.10008.1.2.1.99") + deflated(classic_elements(s));
}

std::string enhanced_dicom_bytes(const std::vector<DicomSpec>& frames) {
  const DicomSpec& first = frames.front();
  std::string bytes = dicom_meta(enhanced_storage, first, little_endian);
  bytes += dicom_begin(enhanced_storage, first);
  series(bytes, first);
  number(bytes, 0x28, 2, 1);
  text(bytes, 0x28, 4, "CS", "MONOCHROME2");
  text(bytes, 0x28, 8, "IS", fmt::format("{}", frames.size()));
  number(bytes, 0x28, 0x10, first.plane.rows);
  number(bytes, 0x28, 0x11, first.plane.columns);
  pixel_format(bytes);
  std::vector<std::string> groups;
  std::vector<std::uint16_t> values;
  for (const DicomSpec& frame : frames) {
    groups.push_back(frame_groups(frame));
    values.insert(values.end(), frame.pixels.begin(), frame.pixels.end());
  }
  sequence(bytes, 0x5200, 0x9230, groups);
  pixels(bytes, values);
  return bytes;
}

namespace {

/// The NIfTI-1 standard's method 2: a quaternion, and -1 for axes of the other handedness.
template <class Set>
void set_qform(const NiftiSpec& s, const Set& set) {
  Mat3 axes;
  for (int d = 0; d < 3; ++d) {
    for (int e = 0; e < 3; ++e)
      axes(d, e) = s.sform[d][e];
    set(268 + 4 * d, static_cast<float>(s.sform[d][3]));
  }
  axes.colwise().normalize();
  const bool mirrored = axes.determinant() < 0.0;
  if (mirrored)
    axes.col(2) *= -1.0;
  Eigen::Quaterniond q(axes);
  if (q.w() < 0.0)
    q.coeffs() *= -1.0;
  set(76, mirrored ? -1.0F : 1.0F);
  set(256, static_cast<float>(q.x()));
  set(260, static_cast<float>(q.y()));
  set(264, static_cast<float>(q.z()));
}

}  // namespace

namespace {

/// A header of NIfTI-1 as NIfTI-2 has it: its numbers wider and elsewhere.
std::string second_version(const std::string& first) {
  std::string head(540, '\0');
  const auto set = [&](std::size_t at, auto value) {
    std::memcpy(head.data() + at, &value, sizeof(value));
  };
  const auto get = [&](std::size_t at, auto value) {
    std::memcpy(&value, first.data() + at, sizeof(value));
    return value;
  };
  const auto widen = [&](std::size_t from, std::size_t to, int count) {
    for (int i = 0; i < count; ++i)
      set(to + 8 * i, static_cast<double>(get(from + 4 * i, float{})));
  };
  set(0, std::int32_t{540});
  head.replace(4, 8, std::string("n+2\0\r\n\032\n", 8));
  set(12, get(70, std::int16_t{}));
  set(14, get(72, std::int16_t{}));
  for (int d = 0; d < 8; ++d)
    set(16 + 8 * d, static_cast<std::int64_t>(get(40 + 2 * d, std::int16_t{})));
  widen(76, 104, 8);  // pixdim
  set(168, std::int64_t{544});
  widen(112, 176, 2);  // slope, intercept
  set(344, static_cast<std::int32_t>(get(252, std::int16_t{})));
  set(348, static_cast<std::int32_t>(get(254, std::int16_t{})));
  widen(256, 352, 6);   // the qform
  widen(280, 400, 12);  // the sform
  set(500, static_cast<std::int32_t>(first[123]));
  return head;
}

}  // namespace

std::string nifti_bytes(const NiftiSpec& s) {
  std::string head(348, '\0');
  const auto set = [&](std::size_t at, auto value) {
    std::memcpy(head.data() + at, &value, sizeof(value));
  };
  set(0, std::int32_t{348});
  set(40, static_cast<std::int16_t>(s.size[3] > 1 ? 4 : 3));
  for (int d = 0; d < 4; ++d)
    set(42 + 2 * d, static_cast<std::int16_t>(s.size[d]));
  for (int d = 4; d < 7; ++d)
    set(42 + 2 * d, std::int16_t{1});
  set(70, static_cast<std::int16_t>(s.floating ? 16 : 2));
  set(72, static_cast<std::int16_t>(s.floating ? 32 : 8));
  set(76, 1.0F);  // qfac
  if (s.same_qform)
    set_qform(s, set);
  for (int d = 0; d < 3; ++d) {
    double square = 0.0;
    for (int e = 0; e < 3; ++e)
      square += s.sform[e][d] * s.sform[e][d];
    set(80 + 4 * d, static_cast<float>(s.pixdim ? (*s.pixdim)[d] : std::sqrt(square)));
  }
  set(92, static_cast<float>(s.time_step));
  set(108, 352.0F);
  set(112, s.slope);
  set(116, s.intercept);
  head[123] = static_cast<char>(s.units);
  set(252, static_cast<std::int16_t>(s.qform_code));
  set(254, static_cast<std::int16_t>(s.sform_code));
  for (int d = 0; d < 3; ++d)
    for (int e = 0; e < 4; ++e)
      set(280 + 16 * d + 4 * e, static_cast<float>(s.sform[d][e]));
  head.replace(344, 4, std::string("n+1\0", 4));
  std::string bytes = (s.version == 2 ? second_version(head) : head) + std::string(4, '\0');
  for (const double value : s.values)
    if (s.floating)
      put(bytes, static_cast<float>(value));
    else
      put(bytes, static_cast<std::uint8_t>(value));
  return bytes;
}

NiftiSpec label_map(const std::array<int, 3>& size, const Mat3& directions, const Vec3& spacing,
                    const Vec3& origin, const std::function<int(const Vec3&)>& label) {
  NiftiSpec s;
  s.size = {size[0], size[1], size[2], 1};
  const Mat3 axes = directions * spacing.asDiagonal();
  const Vec3 to_ras(-1.0, -1.0, 1.0);
  for (int d = 0; d < 3; ++d) {
    for (int e = 0; e < 3; ++e)
      s.sform[d][e] = to_ras[d] * axes(d, e);
    s.sform[d][3] = to_ras[d] * origin[d];
  }
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        s.values.push_back(label(origin + axes * Vec3(i, j, k)));
  return s;
}

}  // namespace lv::test
