#pragma once

#include "lv/case_file/parameters.hpp"
#include "lv/work/workspace.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lv::work {

/// Short texts that stand for what files and folders hold, never for their names or places: a study
/// that was moved is the same study. Each is read once.
class FileContents {
 public:
  /// `own`: what the program itself has written or reads otherwise, which is left out of folders.
  explicit FileContents(std::vector<std::filesystem::path> own = {}) : own_(std::move(own)) {}

  /// Of a file with those that belong to it (the .img of a .hdr), or of all files below a folder;
  /// "absent" when there is none.
  [[nodiscard]] const std::string& of(const std::filesystem::path& path);

 private:
  std::vector<std::filesystem::path> own_;
  std::map<std::filesystem::path, std::string> known_;
};

/// The case as a stage sees it: the parameters that it reads, as parameters.cpp declares them.
/// Others have their defaults; numbers that the stage never reads are not numbers, so that a
/// declaration that is missing cannot go unnoticed. The results name all parameters and see them.
[[nodiscard]] case_file::Case stage_view(const case_file::Case& c, case_file::Stage stage);

/// Where a case sets something ("case.toml:12", as its origins are), without what does not count:
/// "line 12" of the case file, whatever its name, or another file's name and line.
[[nodiscard]] std::string place_alone(const case_file::Case& c, const std::string& origin);

/// What the result of a stage depends on besides the stages before it: the program, every parameter
/// of its view, and the contents of the files that those name.
[[nodiscard]] Ingredients ingredients(const case_file::Case& c, case_file::Stage stage,
                                      FileContents& files);

}  // namespace lv::work
