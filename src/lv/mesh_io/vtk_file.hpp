#pragma once

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/trial.hpp"
#include "lv/mesh_io/vtk_messages.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>

class vtkCellArray;

namespace lv::mesh_io {

/// What VTK makes of a file: `read` runs a reader and returns its output. VTK takes a file's word
/// for how much it holds, so it is tried first. Throws InputError with what VTK has to say.
template <class Read>
auto read_by_vtk(const std::string& file, const Read& read) {
  check_encoding(file);
  const VtkMessages messages;
  check_survives(file, [&] { static_cast<void>(read()); });
  auto data = read();
  if (const std::string message = messages.first(); !message.empty())
    throw InputError(file, fmt::format("cannot be read: {}", message),
                     "The file seems to be truncated or damaged");
  return data;
}

/// Throws InputError unless the lists of cells in a legacy file (.vtk before version 5) have the
/// lengths that their headings say: VTK writes beyond its memory where they have not.
void check_legacy_cells(const std::string& file);

/// Throws InputError unless all cells stand on points that there are: VTK does not ask.
void check_cells(const std::string& file, vtkCellArray* cells, std::int64_t points);

}  // namespace lv::mesh_io
