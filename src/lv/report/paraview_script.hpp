#pragma once

#include "lv/drawing/orientation.hpp"

#include <filesystem>
#include <string>

namespace lv::report {

/// A script for ParaView that opens the wall and the blood of a case with colours and a time axis,
/// the wall cut open in the four-chamber view with letters for its walls and a bar of 20 mm. A list
/// `views` of three cameras is left for the user. `series` is the folder with wall.pvd and
/// blood.pvd, relative to the script's.
[[nodiscard]] std::string paraview_script(const std::filesystem::path& series,
                                          const drawing::Orientation& orientation);

}  // namespace lv::report
