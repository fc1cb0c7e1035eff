#pragma once

#include <filesystem>

namespace lv::page {

/// Throws InputError where a page would take the place of something else, or has none: an existing
/// file that does not begin as a page of this program (an empty one is taken), a folder, a pipe or
/// a device, a folder that is not there. Asked before the work is done that the page shows.
void require_place(const std::filesystem::path& file);

}  // namespace lv::page
