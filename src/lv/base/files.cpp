#include "lv/base/files.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <set>
#include <system_error>
#include <utility>

namespace lv {
namespace {

namespace fs = std::filesystem;

std::string in_words(const std::error_code& error) {
  if (error == std::errc::too_many_symbolic_link_levels)
    return "the link leads to itself";
  if (error == std::errc::permission_denied)
    return "cannot be read: permission denied";
  return "cannot be read: " + error.message();
}

/// Collects the files of folders, each once.
class Walk {
 public:
  explicit Walk(bool below) : below_(below) {}

  FolderFiles all(const fs::path& folder) {
    read(folder);
    while (!linked_.empty())
      read(std::exchange(linked_, {}));
    std::sort(found_.files.begin(), found_.files.end());
    return std::move(found_);
  }

 private:
  void read(const std::vector<fs::path>& folders) {
    for (const fs::path& folder : folders)
      read(folder);
  }

  void read(const fs::path& folder) {
    std::error_code failed;
    const fs::path real = fs::canonical(folder, failed);
    if (!failed && !seen_.insert(real).second) {
      found_.left_out.push_back({folder, "it is a link to a folder that is read already"});
      return;
    }
    std::vector<fs::path> entries;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed))
      entries.push_back(at->path());
    if (failed)
      found_.left_out.push_back({folder, in_words(failed)});
    std::sort(entries.begin(), entries.end());
    for (const fs::path& entry : entries)
      take(entry);
  }

  void take(const fs::path& entry) {
    std::error_code failed;
    if (!fs::is_directory(entry, failed)) {
      if (std::string reason = unreadable(entry); reason.empty())
        found_.files.push_back(entry);
      else
        found_.left_out.push_back({entry, std::move(reason)});
    } else if (below_) {
      if (fs::is_symlink(entry, failed))
        linked_.push_back(entry);  // last, so that folders go by their own names
      else
        read(entry);
    }
  }

  bool below_;
  FolderFiles found_;
  std::vector<fs::path> linked_;
  std::set<fs::path> seen_;
};

}  // namespace

std::string unreadable(const fs::path& file) {
  std::error_code failed;
  switch (fs::status(file, failed).type()) {
    case fs::file_type::regular:
      return access(file.c_str(), R_OK) == 0
                 ? ""
                 : in_words(std::error_code(errno, std::generic_category()));
    case fs::file_type::not_found:
      return fs::is_symlink(fs::symlink_status(file, failed))
                 ? "the link leads nowhere: fetch the file that it stands for"
                 : "there is no such file";
    case fs::file_type::directory:
      return "it is a folder";
    case fs::file_type::fifo:
      return "it is a pipe, not a file";
    case fs::file_type::socket:
      return "it is a socket, not a file";
    case fs::file_type::block:
    case fs::file_type::character:
      return "it is a device, not a file";
    default:
      return in_words(failed);
  }
}

void require_readable(const fs::path& file, const std::string& remedy) {
  if (const std::string reason = unreadable(file); !reason.empty())
    throw InputError(file.string(), reason, remedy);
}

std::string first_bytes(const std::filesystem::path& file, std::size_t count) {
  std::string bytes(count, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

FolderFiles files_in(const fs::path& folder, bool below) {
  std::error_code failed;
  if (!fs::is_directory(folder, failed)) {
    const std::string reason = unreadable(folder);
    throw InputError(
        folder.string(),
        reason.empty() || reason == "there is no such file" ? "there is no such folder" : reason,
        "Name a folder");
  }
  fs::directory_iterator readable(folder, failed);
  if (failed)
    throw InputError(folder.string(), "the folder " + in_words(failed),
                     "Give it the right to be read");
  return Walk(below).all(folder);
}

std::vector<std::string> summary(const std::vector<LeftOut>& left_out) {
  constexpr std::size_t most = 10;  // sentences
  std::vector<std::pair<const LeftOut*, int>> reasons;
  for (const LeftOut& item : left_out) {
    const auto known = std::find_if(reasons.begin(), reasons.end(),
                                    [&](const auto& r) { return r.first->reason == item.reason; });
    if (known == reasons.end())
      reasons.emplace_back(&item, 1);
    else
      ++known->second;
  }
  std::vector<std::string> sentences;
  int told = 0;
  for (const auto& [first, count] : reasons) {
    if (sentences.size() == most)
      break;
    told += count;
    sentences.push_back(
        count == 1 ? fmt::format("{} is left out: {}", first->place.string(), first->reason)
                   : fmt::format("{} files are left out, the first {}: {}", count,
                                 first->place.string(), first->reason));
  }
  if (const auto all = static_cast<int>(left_out.size()); told < all)
    sentences.push_back(fmt::format("{} more are left out for other reasons", all - told));
  return sentences;
}

}  // namespace lv
