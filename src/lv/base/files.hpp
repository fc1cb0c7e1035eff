#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// Files and folders as people have them: with links, pipes, and places that may not be read.
namespace lv {

/// Why a file cannot be read, as a sentence without its name: it is absent, a folder, a pipe, a
/// device, a link that leads nowhere, or not permitted. Empty if it can. Never opens what it asks
/// about, so it never waits.
[[nodiscard]] std::string unreadable(const std::filesystem::path& file);

/// Throws InputError with the reason unless a file can be read.
void require_readable(const std::filesystem::path& file, const std::string& remedy);

/// So many bytes of a file, by which its format is known; fewer if it is shorter, none if it cannot
/// be read.
[[nodiscard]] std::string first_bytes(const std::filesystem::path& file, std::size_t count);

/// A file or folder that is not used, and why.
struct LeftOut {
  std::filesystem::path place;
  std::string reason;
};

/// The files of a folder.
struct FolderFiles {
  std::vector<std::filesystem::path> files;  ///< that can be read, sorted
  std::vector<LeftOut> left_out;             ///< all others
};

/// The files of a folder, and of the folders below it if asked for. Links are followed; a folder
/// that is reached twice is read once. Throws InputError if there is no such folder or it may not
/// be read.
[[nodiscard]] FolderFiles files_in(const std::filesystem::path& folder, bool below);

/// A sentence for each reason why something was left out, with the number of files and the first.
[[nodiscard]] std::vector<std::string> summary(const std::vector<LeftOut>& left_out);

}  // namespace lv
