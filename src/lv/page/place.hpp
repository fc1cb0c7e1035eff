#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lv::page {

/// Throws InputError where a page would take the place of something else, or has none: an existing
/// file that does not begin as a page of this program (an empty one is taken), a folder, a pipe or
/// a device, a folder that is not there. Asked before the work is done that the page shows.
void require_place(const std::filesystem::path& file);

/// An element of a page's head that tells of which work folders it is, as they lie on the disk.
[[nodiscard]] std::string runs_element(const std::vector<std::filesystem::path>& works);

/// Throws InputError where a page of other runs, or of a version that did not say of which it is,
/// stands: asked for a name that nobody chose.
void require_same_runs(const std::filesystem::path& file,
                       const std::vector<std::filesystem::path>& works);

}  // namespace lv::page
