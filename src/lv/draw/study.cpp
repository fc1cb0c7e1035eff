#include "lv/draw/study.hpp"

#include "lv/anatomy/segmentation.hpp"
#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/draw/whole_save.hpp"
#include "lv/geometry/contour_checks.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/contour_table.hpp"
#include "lv/image/label_contours.hpp"
#include "lv/image/volume.hpp"
#include "lv/work/workspace.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace lv::draw {
namespace {

namespace fs = std::filesystem;
using geometry::Contour;
using geometry::Landmark;
using geometry::Side;

fs::path phase_file(const fs::path& folder, std::size_t phase) {
  return folder / "contours" / fmt::format("phase_{:02d}.csv", phase + 1);
}

/// Throws InputError unless a line lies on a slice of the cine.
void require_on_cine(const Contour& line, const image::Cine& cine) {
  constexpr double farthest = 1.0;  // [mm]
  const auto slices = static_cast<int>(cine.slices.size());
  const bool there = line.slice >= 1 && line.slice <= slices;
  const auto away = [&](const Vec3& x) {
    return std::abs(cine.slices[line.slice - 1].frames.front().plane.pixel(x).z());
  };
  if (!there || std::any_of(line.points.begin(), line.points.end(),
                            [&](const Vec3& x) { return away(x) > farthest; }))
    throw InputError(
        line.where(), fmt::format("slice {} is not where the case's cine has it", line.slice),
        "It belongs to another cine: move its folder away, or name the cine it was drawn on");
}

Lines read_lines(const fs::path& folder, const image::Cine& cine, const char* how) {
  Lines lines(cine.slices.front().frames.size());
  if (fs::exists(phase_file(folder, lines.size())))
    throw InputError(phase_file(folder, lines.size()).string(),
                     fmt::format("the case's cine has {} phases only", lines.size()),
                     "It belongs to another cine: move its folder away");
  for (std::size_t t = 0; t < lines.size(); ++t) {
    if (!fs::exists(phase_file(folder, t)))
      continue;
    lines[t] = geometry::read_curves(phase_file(folder, t));
    for (Contour& line : lines[t]) {
      require_on_cine(line, cine);
      if (line.drawn.how.empty())
        line.drawn.how = how;
    }
  }
  return lines;
}

std::vector<Confidence> read_confidence(const fs::path& file) {
  std::vector<Confidence> all;
  if (!fs::exists(file))
    return all;
  const Table table = Table::read_csv(file);
  const auto slices = table.whole_numbers("slice");
  const auto phases = table.whole_numbers("phase");
  const auto endo = table.numbers("endo_confidence");
  const auto epi = table.numbers("epi_confidence");
  for (std::size_t i = 0; i < slices.size(); ++i)
    all.push_back({slices[i], phases[i], endo[i], epi[i]});
  return all;
}

/// Landmarks of a folder, each on the image of its number.
std::vector<Landmark> kept_landmarks(const fs::path& file, const Study& study) {
  constexpr double farthest = 1.0;  // [mm]
  if (!fs::exists(file))
    return {};
  std::vector<Landmark> landmarks = geometry::read_landmarks(file);
  for (const Landmark& mark : landmarks) {
    const bool there = mark.slice >= 1 && mark.slice <= static_cast<int>(study.pictures());
    if (!there ||
        std::abs(study.picture(mark.slice).frames.front().plane.pixel(mark.at).z()) > farthest)
      throw InputError(
          file.string(),
          fmt::format("{} lies on no image of number {}: there are {} slices and {} long axes",
                      mark.name, mark.slice, study.cine.slices.size(), study.long_axis.size()),
          "Name the cine and the long axes (segment.long_axis_cine) it was set on, in their order, "
          "or move its folder away");
  }
  return landmarks;
}

/// Volume within the lines of one side [mm^3].
double within(const std::vector<Contour>& lines, Side side, double spacing) {
  double sum = 0.0;
  for (const Contour& line : lines)
    if (line.side == side)
      sum += spacing * geometry::enclosed_area(line);
  return sum;
}

/// The frame of a moment by the volumes of lines.
std::size_t frame_of(case_file::ShapeMoment moment, const Lines& phases, double spacing) {
  std::vector<double> volumes;
  for (const std::vector<Contour>& lines : phases)
    volumes.push_back(within(lines, Side::endo, spacing));
  const image::Phases found = image::propose_phases(volumes);
  return static_cast<std::size_t>(
      moment == case_file::ShapeMoment::end_diastole ? found.end_diastole : found.early_diastole);
}

Proposal proposal_of(const anatomy::CineSegmentation& made, case_file::ShapeMoment moment) {
  const image::Cine& cine = made.cine;
  const segment::Segmentation& found = made.found;
  Proposal proposal;
  for (std::size_t t = 0; t < cine.slices.front().frames.size(); ++t) {
    proposal.lines.push_back(segment::contours_at(cine, found, t).short_axis);
    for (Contour& line : proposal.lines.back())
      line.drawn.how = "proposed";
  }
  for (std::size_t s = 0; s < found.borders.size(); ++s)
    for (std::size_t t = 0; t < found.volumes.size(); ++t)
      if (found.shows[s][t] != 0) {
        const segment::FrameBorders& sure = found.borders[s].frames[t];
        proposal.confidence.push_back(
            {static_cast<int>(s) + 1, static_cast<int>(t) + 1, sure.endo_agrees, sure.epi_agrees});
      }
  proposal.doubts = found.warnings;
  proposal.doubts.insert(proposal.doubts.end(), found.doubts.begin(), found.doubts.end());
  proposal.doubts.insert(proposal.doubts.end(), made.ends.doubts.begin(), made.ends.doubts.end());
  proposal.fall = found.fall;
  proposal.landmark_frame = frame_of(moment, proposal.lines, found.spacing);
  proposal.landmarks = anatomy::proposed_landmarks(made, proposal.landmark_frame);
  return proposal;
}

/// The notes of a folder of ventricle segment that speak of slices or long axes.
std::vector<std::string> read_doubts(const fs::path& file) {
  constexpr std::string_view note = "note: ";
  std::vector<std::string> doubts;
  if (!fs::exists(file))
    return doubts;
  std::istringstream text(read_file(file));
  for (std::string line; std::getline(text, line);)
    for (const char* about : {"slice ", "long axis "})
      if (line.starts_with(std::string(note) + about))
        doubts.push_back(line.substr(note.size()));
  return doubts;
}

/// Where borders are drawn again if no proposal tells.
constexpr double usual_fall = 0.85;

Proposal nothing_proposed(const image::Cine& cine, const std::string& why) {
  return {Lines(cine.slices.front().frames.size()), {}, 0, {}, {why}, usual_fall};
}

/// Where something in a folder that may not be there yet would be written.
bool may_write(fs::path folder) {
  std::error_code none;
  if (fs::exists(folder, none) && !fs::is_directory(folder, none))
    return false;
  while (!folder.empty() && !fs::exists(folder, none))
    folder = folder.parent_path();
  return access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) == 0;
}

anatomy::Cines cines_of(const Study& study) {
  anatomy::Cines cines{study.cine, {}};
  for (const LongAxisImage& view : study.long_axis)
    cines.long_axis.push_back(view.cine);
  return cines;
}

/// Segments the cine and keeps what was found, if the folder can be made.
Proposal propose_first(const Study& study, const fs::path& folder) {
  const case_file::CineAnatomy& a = study.settings.anatomy.cine;
  try {
    const anatomy::CineSegmentation made =
        anatomy::segment_cines(cines_of(study), a.segmentation, "the cine");
    if (may_write(folder))
      anatomy::keep_segmentation(made, folder);
    return proposal_of(made, a.moment);
  } catch (const InputError& error) {
    return nothing_proposed(
        study.cine, std::string("the program found no ventricle: click into its blood, or draw. ") +
                        error.what());
  }
}

Proposal find_proposal(const Study& study) {
  const case_file::Case& c = study.settings;
  const fs::path folder = c.file.parent_path() / (c.file.stem().string() + ".segment");
  if (!fs::exists(folder))
    return propose_first(study, folder);
  Proposal kept;
  kept.lines = read_lines(folder, study.cine, "proposed");
  kept.confidence = read_confidence(folder / "quality.csv");
  kept.doubts = read_doubts(folder / "segmentation.txt");
  kept.fall = anatomy::kept_fall(folder).value_or(usual_fall);
  kept.landmark_frame = frame_of(c.anatomy.cine.moment, kept.lines, study.spacing);
  kept.landmarks = kept_landmarks(anatomy::landmarks_file(folder, kept.landmark_frame), study);
  return kept;
}

/// An empty file where there is no line (see whole_save).
void write_phase(const fs::path& file, const std::vector<Contour>& lines) {
  if (!lines.empty())
    geometry::contour_table(lines).write_csv(file);
  else
    write_file(file, "");
}

void write_marks(const Drawing& drawing, const fs::path& folder) {
  geometry::write_landmarks(drawing.landmarks, folder / "landmarks.csv");
  for (const Side side : {Side::endo, Side::epi}) {
    const std::string name = fmt::format("apex_{}", geometry::name(side));
    std::vector<Contour> tip;
    for (const Landmark& mark : drawing.landmarks)
      if (mark.name == name)
        tip.push_back({mark.slice, side, {mark.at}, {}, {}, {"drawn", mark.by, mark.when}});
    write_phase(folder / (name + ".csv"), tip);
  }
}

void write_quality(const Drawing& drawing, const fs::path& folder) {
  Table table({"slice", "phase", "endo_confidence", "epi_confidence"});
  for (const Confidence& sure : drawing.confidence)
    table.add_row({std::to_string(sure.slice), std::to_string(sure.phase),
                   fmt::format("{:.2f}", sure.endo), fmt::format("{:.2f}", sure.epi)});
  table.write_csv(folder / "quality.csv");
}

void write_volumes(const Drawing& drawing, double spacing, const fs::path& folder) {
  Table table({"phase", "cavity_volume_ml", "wall_volume_ml", "slices"});
  for (std::size_t t = 0; t < drawing.lines.size(); ++t) {
    const std::vector<Contour>& lines = drawing.lines[t];
    const double cavity = within(lines, Side::endo, spacing);
    const double whole = within(lines, Side::epi, spacing);
    const auto slices = std::count_if(lines.begin(), lines.end(),
                                      [](const Contour& l) { return l.side == Side::endo; });
    table.add_row({std::to_string(t + 1), Table::number(1e-3 * cavity, 5),
                   Table::number(1e-3 * std::max(whole - cavity, 0.0), 5), std::to_string(slices)});
  }
  table.write_csv(folder / "volumes.csv");
}

void write_drawing(const Drawing& drawing, double spacing, const fs::path& folder) {
  fs::create_directories(folder / "contours");
  for (std::size_t t = 0; t < drawing.lines.size(); ++t)
    write_phase(phase_file(folder, t), drawing.lines[t]);
  write_marks(drawing, folder);
  write_quality(drawing, folder);
  write_volumes(drawing, spacing, folder);
}

/// Fingerprints of the files that save replaces, of those that are there.
std::map<fs::path, std::string> fingerprints(const Study& study) {
  std::map<fs::path, std::string> all;
  const auto add = [&](const fs::path& file) {
    std::error_code none;
    if (fs::exists(file, none))
      all[file] = work::fingerprint_of_file(file);
  };
  for (std::size_t t = 0; t < study.phases(); ++t)
    add(phase_file(study.folder, t));
  for (const char* name : {"landmarks.csv", "apex_endo.csv", "apex_epi.csv", "quality.csv",
                           "volumes.csv", scar_file, proposed_scar_file, scar_walls_file})
    add(study.folder / name);
  return all;
}

/// The drawing that is kept in the study's folder, else the proposal.
void read_folder(Study& study) {
  const fs::path& folder = study.folder;
  auto files = fingerprints(study);  // before they are read: what comes later has changed
  study.saved = fs::exists(folder / "contours");
  if (study.saved)
    study.drawing = {read_lines(folder, study.cine, "drawn"),
                     kept_landmarks(folder / "landmarks.csv", study),
                     read_confidence(folder / "quality.csv")};
  else
    study.drawing = {study.proposal.lines, study.proposal.landmarks, study.proposal.confidence};
  const int phase = shape_phase(study);
  study.enhancement =
      open_enhancement(study.settings, folder, phase, study.drawing.lines.at(phase - 1));
  study.files = std::move(files);
}

/// "phase 3", "phases 1-4, 6".
std::string phases_in_words(const std::vector<std::size_t>& phases) {
  std::string words = phases.size() == 1 ? "phase " : "phases ";
  for (std::size_t i = 0; i < phases.size();) {
    std::size_t last = i;
    while (last + 1 < phases.size() && phases[last + 1] == phases[last] + 1)
      ++last;
    words += (i == 0 ? "" : ", ") + std::to_string(phases[i]);
    if (last > i)
      words += "-" + std::to_string(phases[last]);
    i = last + 1;
  }
  return words;
}

}  // namespace

std::optional<fs::path> changed_elsewhere(const Study& study) {
  const auto now = fingerprints(study);
  for (const auto* one : {&study.files, &now}) {
    const auto& other = one == &now ? study.files : now;
    for (const auto& [file, content] : *one)
      if (const auto same = other.find(file); same == other.end() || same->second != content)
        return file;
  }
  return {};
}

void catch_up(Study& study) {
  if (!changed_elsewhere(study))
    return;
  ++study.revision;  // first: what was shown is old, even if what is there now cannot be read
  read_folder(study);
}

std::vector<std::string> faults_of(const Lines& lines) {
  std::map<std::pair<int, std::string>, std::vector<std::size_t>> phases;
  for (std::size_t t = 0; t < lines.size(); ++t)
    for (const geometry::SliceFault& fault : geometry::slice_faults(lines[t]))
      phases[{fault.slice, fault.what}].push_back(t + 1);
  std::vector<std::string> sentences;
  for (const auto& [fault, when] : phases)
    sentences.push_back(
        fmt::format("slice {}, {}: {}", fault.first, phases_in_words(when), fault.second));
  return sentences;
}

Study open_study(const case_file::Case& c, const fs::path& folder) {
  if (fs::exists(folder) && !fs::is_directory(folder))
    throw InputError(folder.string(), "is no folder, and a drawing is kept in one",
                     "Name a folder with --to, which need not be there yet");
  Study study;
  study.name = c.name;
  study.settings = c;
  study.folder = folder;
  anatomy::Cines cines = anatomy::read_cines(c);
  study.cine = std::move(cines.short_axis);
  segment::require_cine(study.cine, case_file::beside(c, c.anatomy.cine.images).string());
  study.spacing = image::spacing_of(study.cine);
  study.greys = grey_range(study.cine.slices);
  for (image::CineSlice& view : cines.long_axis) {
    const Greys greys = grey_range({&view, 1});
    study.long_axis.push_back({std::move(view), greys});
  }
  study.proposal = find_proposal(study);
  const bool is_writable = may_write(folder);
  if (is_writable)
    finish_interrupted_save(folder);
  read_folder(study);
  if (!is_writable)
    study.hindrance = fmt::format("{} may not be written", folder.filename().string());
  return study;
}

int shape_phase(const Study& study) {
  return 1 + static_cast<int>(
                 frame_of(study.settings.anatomy.cine.moment, study.drawing.lines, study.spacing));
}

Proposal propose(const Study& study, const Vec3& centre) {
  segment::SegmentParameters parameters = study.settings.anatomy.cine.segmentation;
  parameters.centre = {centre.x(), centre.y(), centre.z()};
  return proposal_of(anatomy::segment_cines(cines_of(study), parameters, "segment.centre"),
                     study.settings.anatomy.cine.moment);
}

void save(Study& study, Drawing drawing, std::optional<ScarDrawing> scar) {
  if (!may_write(study.folder))
    throw RunError(fmt::format("{} may not be written", study.folder.filename().string()),
                   "Allow it, or download the drawing");
  try {
    const fs::path written = begin_save(study.folder);
    write_drawing(drawing, study.spacing, written);
    if (scar && study.enhancement)
      write_scar(*study.enhancement, *scar, written);
    finish_save(study.folder);
  } catch (const fs::filesystem_error& error) {
    study.files = fingerprints(study);  // a part may have been moved, by no other program
    throw RunError(fmt::format("the drawing cannot be moved to its place in {}: {}",
                               study.folder.filename().string(), error.code().message()),
                   "Save it again when the folder can be written, or download it");
  }
  study.files = fingerprints(study);
  study.drawing = std::move(drawing);
  if (scar && study.enhancement)
    keep(*study.enhancement, std::move(*scar));
  study.saved = true;
  ++study.revision;
}

}  // namespace lv::draw
