#include "lv/proposal/what_file.hpp"

#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/image/nifti.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace lv::proposal {
namespace {

/// Bytes that stand in files of a kind: at a place, or anywhere in the first kilobyte.
struct Mark {
  static constexpr std::size_t anywhere = std::string_view::npos;
  std::size_t at;
  std::string_view bytes;
  const char* kind;
};

using namespace std::string_view_literals;

constexpr std::array marks{
    Mark{0, "\x89PNG"sv, "a PNG picture, which does not say how it lies in space"},
    Mark{0, "\xff\xd8\xff"sv, "a JPEG picture, which does not say how it lies in space"},
    Mark{0, "II*\0"sv, "a TIFF picture, which does not say how it lies in space"},
    Mark{0, "MM\0*"sv, "a TIFF picture, which does not say how it lies in space"},
    Mark{0, "GIF8"sv, "a GIF picture, which does not say how it lies in space"},
    Mark{0, "%PDF"sv, "a PDF document"},
    Mark{0, "PK\x03\x04"sv, "a zip archive: unpack it"},
    Mark{0, "7z\xbc\xaf"sv, "a 7z archive: unpack it"},
    Mark{0,
         "\xfd"
         "7zXZ"sv,
         "packed by xz: unpack it"},
    Mark{0, "BZh"sv, "packed by bzip2: unpack it"},
    Mark{0, "\x1f\x8b"sv, "packed by gzip: unpack it"},
    Mark{257, "ustar"sv, "a tar archive: unpack it"},
    Mark{0, "\x89HDF"sv, "HDF5, which is not read"},
    Mark{Mark::anywhere, "STRUCTURED_POINTS"sv, "a VTK image (infarct.labels.file)"},
    Mark{Mark::anywhere, "ImageData"sv, "a VTK image (infarct.labels.file)"},
    Mark{Mark::anywhere, "POLYDATA"sv, "a VTK surface (infarct.surface.file)"},
    Mark{Mark::anywhere, "PolyData"sv, "a VTK surface (infarct.surface.file)"},
    Mark{Mark::anywhere, "UNSTRUCTURED_GRID"sv, "a VTK mesh (anatomy.mesh.file)"},
    Mark{Mark::anywhere, "UnstructuredGrid"sv, "a VTK mesh (anatomy.mesh.file)"},
    Mark{0, "$MeshFormat"sv, "a Gmsh mesh (anatomy.mesh.file)"},
    Mark{0, "ply"sv, "a PLY surface (infarct.surface.file)"},
    Mark{Mark::anywhere, "contour type"sv, "a list of guide points (anatomy.guide_points.file)"},
    Mark{Mark::anywhere, "x_mm"sv, "a table of contours (anatomy.contours.short_axis, long_axis)"},
};

constexpr std::size_t telling = 1024;  // bytes at a file's beginning

bool is_text(std::string_view bytes) {
  return std::none_of(bytes.begin(), bytes.end(), [](unsigned char c) {
    return c == 0x7f || (c < 0x20 && std::isspace(c) == 0);
  });
}

}  // namespace

std::string what_is(const std::filesystem::path& file) {
  const std::string begin = first_bytes(file, telling);
  if (begin.empty())
    return "an empty file";
  if (image::holds_nifti(file))
    return "NIfTI whose name does not say so: name it .nii or .nii.gz";
  for (const Mark& mark : marks)
    if (mark.at == Mark::anywhere
            ? begin.find(mark.bytes) != std::string::npos
            : begin.compare(std::min(mark.at, begin.size()), mark.bytes.size(), mark.bytes) == 0)
      return mark.kind;
  if (ending_of(file) == ".csv")
    return "a table";
  return is_text(begin) ? "text of an unknown kind" : "of an unknown kind";
}

bool begins_as_text(const std::filesystem::path& file) {
  return is_text(first_bytes(file, telling));
}

}  // namespace lv::proposal
