#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace lv::job {

/// What a stage's result depends on: names and values as text, program version included.
using Ingredients = std::map<std::string, std::string>;

/// A short text that stands for all ingredients.
[[nodiscard]] std::string fingerprint(const Ingredients& ingredients);

/// A short text that stands for the contents of a file; "absent" when it cannot be read.
[[nodiscard]] std::string fingerprint_of_file(const std::filesystem::path& file);

/// One stage's folder in a case's work folder. Results are made in `NAME.part` and become `NAME`
/// when they are complete, with a record of the ingredients; a stage whose record equals its
/// ingredients is not run again.
class StageFolder {
 public:
  StageFolder(const std::filesystem::path& work, const std::string& name, Ingredients ingredients);

  [[nodiscard]] bool up_to_date() const;

  /// Why the stage must run, in words: "mesh.edge_length has changed from ... to ...".
  [[nodiscard]] std::string reason() const;

  /// Makes the unfinished folder and returns it. What an earlier run with the same ingredients left
  /// there stays.
  [[nodiscard]] std::filesystem::path begin() const;

  /// The unfinished folder becomes the stage's folder.
  void finish() const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// Where an unfinished stage keeps its files.
  [[nodiscard]] std::filesystem::path unfinished() const;

 private:
  std::filesystem::path folder_;
  Ingredients ingredients_;
};

/// Holds a work folder for this process alone. Throws RunError when another run is at work there.
class WorkLock {
 public:
  explicit WorkLock(const std::filesystem::path& work);
  ~WorkLock();
  WorkLock(const WorkLock&) = delete;
  WorkLock& operator=(const WorkLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace lv::job
