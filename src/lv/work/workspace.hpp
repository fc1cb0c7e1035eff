#pragma once

#include "lv/base/stage_folders.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lv::work {

/// What a stage's result depends on: names and values as text, program version included.
using Ingredients = std::map<std::string, std::string>;

/// A short text that stands for all ingredients.
[[nodiscard]] std::string fingerprint(const Ingredients& ingredients);

/// How ingredients begin that change what a stage says in words, and none of its numbers.
inline const std::string remark_start = "the remark ";

/// The same of a stage's result, for the stages after it: remarks do not count.
[[nodiscard]] std::string fingerprint_of_result(Ingredients ingredients);

/// A short text that stands for the contents of a file; "absent" when it is no file that can be
/// read.
[[nodiscard]] std::string fingerprint_of_file(const std::filesystem::path& file);

/// One stage's folder in a case's work folder. Results are made in `NAME.part` and become `NAME`
/// when they are complete and on the disk, with a record of the ingredients and of all files with
/// their sizes; a stage whose record equals its ingredients, and whose files are there, is not run
/// again. Sizes tell a file that is gone or cut short at the cost of a look; a checksum of all
/// would read gigabytes at every start, and the files that a run goes on from (mesh.bin, beat.bin)
/// hold their own. An unfinished run is never deleted: one with other ingredients is kept as
/// `NAME.other`, `NAME.other2` and so on, and taken up again when its ingredients come back.
class StageFolder {
 public:
  StageFolder(const std::filesystem::path& work, const std::string& name, Ingredients ingredients);

  [[nodiscard]] bool up_to_date() const;

  /// Why the stage must run, in words: "mesh.edge_length has changed from ... to ...".
  [[nodiscard]] std::string reason() const;

  /// Makes the unfinished folder and returns it, with what an earlier run with the same ingredients
  /// left.
  [[nodiscard]] std::filesystem::path begin() const;

  /// The unfinished folder becomes the stage's folder.
  void finish() const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// Where an unfinished stage keeps its files.
  [[nodiscard]] std::filesystem::path unfinished() const;

 private:
  [[nodiscard]] std::vector<std::filesystem::path> kept() const;
  [[nodiscard]] std::filesystem::path free_name() const;
  void set_aside(const std::filesystem::path& part) const;
  void take_up(const std::filesystem::path& part) const;

  std::filesystem::path folder_;
  Ingredients ingredients_;
};

/// What is missing, unfinished or out of date in a work folder, up to the results, in sentences;
/// none when all is as it should be. Throws InputError when it holds no stage at all.
[[nodiscard]] std::vector<std::string> state_of(const std::filesystem::path& work);

/// Throws RunError for anything in a work folder or its stages that is neither a file nor a folder:
/// a pipe would be waited on for ever, and a link may lead nowhere. Other folders in it are not
/// looked into.
void check_contents(const std::filesystem::path& work);

/// Holds a work folder for this process alone. Throws RunError when another run is at work there,
/// or its contents cannot be used.
class WorkLock {
 public:
  explicit WorkLock(const std::filesystem::path& work);
  ~WorkLock();
  WorkLock(const WorkLock&) = delete;
  WorkLock& operator=(const WorkLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace lv::work
