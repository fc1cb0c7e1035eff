#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lv {

/// Takes folders out of texts that are kept for sharing: in the name of a folder may stand the name
/// of a patient. "/home/study/anna/labels.nii: damaged" becomes "labels.nii: damaged", and a folder
/// alone "(folder)".
class NamesAlone {
 public:
  NamesAlone() = default;
  explicit NamesAlone(const std::vector<std::filesystem::path>& folders);

  [[nodiscard]] std::string operator()(std::string text) const;

 private:
  std::vector<std::string> folders_;  ///< as they may be written, the longest first
};

}  // namespace lv
