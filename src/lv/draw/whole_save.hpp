#pragma once

#include <filesystem>

namespace lv::draw {

/// Files of a folder that change all at once, even for a process that is killed: they are written
/// to FOLDER/saving, which then becomes FOLDER/saved, from where they are moved to their places. An
/// empty file stands for one that is to be removed. A disk that is full leaves what was there.

/// FOLDER/saving, empty; what a process that was killed left of it is gone.
[[nodiscard]] std::filesystem::path begin_save(const std::filesystem::path& folder);

/// Moves what was written there to its places.
void finish_save(const std::filesystem::path& folder);

/// Goes on with a move that was cut off, if there is one.
void finish_interrupted_save(const std::filesystem::path& folder);

}  // namespace lv::draw
