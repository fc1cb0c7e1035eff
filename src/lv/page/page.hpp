#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lv::page {

/// A case's work folder and how far its run has come.
struct PageCase {
  std::filesystem::path work;
  bool complete = true;
  std::vector<std::string> state;  ///< what is unfinished or out of date, in sentences
};

/// That one case has heartbeats and the other the paper's protocol, so that moments of one name are
/// not defined alike; empty for others.
[[nodiscard]] std::string unlike_moments(const std::vector<PageCase>& cases);

/// One self-contained page that shows one case, or two side by side, from what their work folders
/// hold (docs/report.md says where each number comes from). What is not there is shown as missing.
/// Throws RunError naming a file that cannot be read.
[[nodiscard]] std::string page(const std::vector<PageCase>& cases, const std::string& version);

}  // namespace lv::page
