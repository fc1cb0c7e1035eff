#pragma once

#include "lv/case_file/case.hpp"

#include <filesystem>
#include <string>

namespace lv::draw {

/// What is asked of ventricle draw.
struct Options {
  std::filesystem::path folder;   ///< of the drawing; empty: CASE.draw beside the case file
  std::filesystem::path page;     ///< to write instead of serving
  std::filesystem::path drawing;  ///< that such a page let download, to be kept
  bool browser = true;            ///< open one
};

/// Serves the page on which the borders of a case's cine are drawn until the process is asked to
/// stop, or writes it with the study inside, or takes in what such a page let download.
void run(const case_file::Case& c, const Options& options);

}  // namespace lv::draw
