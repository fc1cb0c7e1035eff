#include "lv/draw/whole_save.hpp"

#include <vector>

namespace lv::draw {
namespace {

namespace fs = std::filesystem;

constexpr const char* unfinished = "saving";
constexpr const char* finished = "saved";

std::vector<fs::path> files_within(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files.push_back(fs::relative(entry.path(), folder));
  return files;
}

}  // namespace

fs::path begin_save(const fs::path& folder) {
  finish_interrupted_save(folder);
  fs::remove_all(folder / unfinished);
  fs::create_directories(folder / unfinished);
  return folder / unfinished;
}

void finish_save(const fs::path& folder) {
  fs::rename(folder / unfinished, folder / finished);
  finish_interrupted_save(folder);
}

void finish_interrupted_save(const fs::path& folder) {
  const fs::path from = folder / finished;
  if (!fs::exists(from))
    return;
  for (const fs::path& file : files_within(from)) {
    fs::create_directories((folder / file).parent_path());
    if (fs::is_empty(from / file)) {
      fs::remove(folder / file);
      fs::remove(from / file);
    } else {
      fs::rename(from / file, folder / file);
    }
  }
  fs::remove_all(from);
}

}  // namespace lv::draw
