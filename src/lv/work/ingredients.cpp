#include "lv/work/ingredients.hpp"

#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"
#include "lv/mesh_io/abaqus_blocks.hpp"
#include "lv/work/version.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::work {
namespace {

using case_file::Case;
using case_file::Parameter;
using case_file::Stage;
namespace fs = std::filesystem;

/// The parts of a pair of header and image: same name, other endings.
bool is_part_of_pair(const fs::path& file) {
  const std::string end = ending_of(ending_of(file) == ".gz" ? file.stem() : file);
  return end == ".hdr" || end == ".img";
}

fs::path name_of_pair(const fs::path& file) {
  return ending_of(file) == ".gz" ? file.stem().stem() : file.stem();
}

/// A header of NRRD or MetaImage and the files beside it that a line of it names.
std::vector<fs::path> named_by_header(const fs::path& header) {
  std::vector<fs::path> files{header};
  std::error_code failed;
  if (!fs::is_regular_file(header, failed))
    return files;
  for (LineReader lines(header); lines.next();) {
    const std::string_view name =
        trimmed(lines.text().substr(lines.text().find_first_of(":=") + 1));
    const fs::path file = header.parent_path() / fs::path(name);
    if (!name.empty() && file != header && fs::is_regular_file(file, failed))
      files.push_back(file);
  }
  return files;
}

/// A file and those without which it cannot be read.
std::vector<fs::path> files_of(const fs::path& file) {
  if (ending_of(file) == ".nhdr" || ending_of(file) == ".mhd")
    return named_by_header(file);
  if (!is_part_of_pair(file))
    return {file};
  std::vector<fs::path> pair;
  std::error_code failed;
  const fs::path folder = file.parent_path().empty() ? "." : file.parent_path();
  for (const auto& entry : fs::directory_iterator(folder, failed))
    if (is_part_of_pair(entry.path()) && name_of_pair(entry.path()) == name_of_pair(file))
      pair.push_back(entry.path());
  std::sort(pair.begin(), pair.end());
  return pair;
}

/// Whether a file is one of these, or in one of these folders.
bool is_among(const fs::path& file, const std::vector<fs::path>& places) {
  return std::any_of(places.begin(), places.end(), [&](const fs::path& place) {
    const fs::path way = fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(place));
    return !way.empty() && *way.begin() != "..";
  });
}

/// Readers go by endings, so the ending counts; in a folder names count too.
std::string contents(const fs::path& path, const std::vector<fs::path>& own) {
  std::error_code failed;
  Ingredients parts;
  if (fs::is_directory(path, failed)) {
    for (const fs::path& file : files_in(path, true).files)
      if (!is_among(file, own))
        parts[file.lexically_relative(path).string()] = fingerprint_of_file(file);
  } else {
    for (const fs::path& file : files_of(path))
      parts[ending_of(file)] += fingerprint_of_file(file);
  }
  return fs::exists(path, failed) ? fingerprint(parts) : "absent";
}

/// The files that a mesh includes, by their names alone.
void add_included(const fs::path& mesh, FileContents& files, Ingredients& ingredients) {
  std::error_code failed;
  if (ending_of(mesh) != ".inp" || !fs::is_regular_file(mesh, failed))
    return;
  for (const std::string& file : mesh_io::read_abaqus_blocks(mesh.string()).files)
    if (fs::path(file) != mesh)
      ingredients["contents of " + fs::path(file).filename().string()] += files.of(file);
}

void add_files(const Parameter& p, const Case& c, FileContents& files, Ingredients& ingredients) {
  std::vector<std::string> all;
  for (const std::string& name : case_file::paths(p, c)) {
    const bool is_file = case_file::names_file(p, c, name);
    all.push_back(is_file ? files.of(case_file::beside(c, name)) : name);
    if (is_file)
      add_included(case_file::beside(c, name), files, ingredients);
  }
  if (!all.empty())
    ingredients[fmt::format("contents of {}", p.name)] = fmt::format("{}", fmt::join(all, ", "));
}

/// The results name every parameter and where it is set.
void add_all(const Case& c, Ingredients& ingredients) {
  Ingredients places;
  for (const Parameter& p : case_file::parameters())
    ingredients[p.name] = p.shown(c);
  for (const auto& [name, place] : c.origin)
    places[name] = place_alone(c, place);
  ingredients["lines of the case file"] = fingerprint(places);
}

bool sees_all(Stage stage) {
  return stage == Stage::results || stage == Stage::report;
}

}  // namespace

const std::string& FileContents::of(const fs::path& path) {
  const auto found = known_.find(path);
  return found != known_.end() ? found->second : known_[path] = contents(path, own_);
}

Case stage_view(const Case& c, Stage stage) {
  if (sees_all(stage))
    return c;
  Case view;
  view.file = c.file;
  view.origin = c.origin;  // for messages
  for (const Parameter& p : case_file::parameters())
    if (case_file::counts(p, c, stage))
      case_file::copy(p, c, view);
    else if (!p.read_by.contains(stage))
      case_file::forget(p, view);
  return view;
}

std::string place_alone(const Case& c, const std::string& origin) {
  const std::string case_file = c.file.string() + ":";
  return origin.starts_with(case_file) ? "line " + origin.substr(case_file.size())
                                       : fs::path(origin).filename().string();
}

Ingredients ingredients(const Case& c, Stage stage, FileContents& files) {
  Ingredients all{{"program", source_hash()}};
  if (stage == Stage::results)
    add_all(c, all);
  for (const Parameter& p : case_file::parameters()) {
    if (!case_file::counts(p, c, stage) || !p.changes_results)
      continue;
    if (p.text != case_file::Text::words)
      add_files(p, c, files, all);
    else
      all[p.name] = p.get(c);
    const std::string whether_set = fmt::format("whether {} is set", p.name);
    const char* is_set = c.origin.contains(p.name) ? "yes" : "no";
    if (p.whether_set_counts)
      all[whether_set] = is_set;
    if (p.remark_whether_set.contains(stage))
      all[remark_start + whether_set] = is_set;
  }
  return all;
}

}  // namespace lv::work
