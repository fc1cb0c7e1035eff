#include "lv/draw/study.hpp"

#include "lv/anatomy/segmentation.hpp"
#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/contour_table.hpp"
#include "lv/image/label_contours.hpp"
#include "lv/image/volume.hpp"

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

Proposal proposal_of(const image::Cine& cine, const segment::Segmentation& found) {
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
  proposal.doubts = found.doubts;
  proposal.fall = found.fall;
  return proposal;
}

/// The notes of a folder of ventricle segment that speak of slices.
std::vector<std::string> read_doubts(const fs::path& file) {
  constexpr std::string_view mark = "note: slice ";
  std::vector<std::string> doubts;
  if (!fs::exists(file))
    return doubts;
  std::istringstream text(read_file(file));
  for (std::string line; std::getline(text, line);)
    if (line.starts_with(mark))
      doubts.push_back(line.substr(mark.size() - std::string_view("slice ").size()));
  return doubts;
}

/// Where borders are drawn again if no proposal tells.
constexpr double usual_fall = 0.85;

Proposal nothing_proposed(const image::Cine& cine, const std::string& why) {
  return {Lines(cine.slices.front().frames.size()), {}, {why}, usual_fall};
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

/// A folder that is there is whole.
void keep_proposal(const anatomy::CineSegmentation& made, const fs::path& folder) {
  fs::path unfinished = folder;
  unfinished += ".part";
  fs::remove_all(unfinished);
  anatomy::write_segmentation(made, unfinished);
  fs::rename(unfinished, folder);
}

/// Segments the cine and keeps what was found, if the folder can be made.
Proposal propose_first(const case_file::Case& c, const image::Cine& cine, const fs::path& folder) {
  try {
    const anatomy::CineSegmentation made{
        cine, segment::segment(cine, c.anatomy.cine.segmentation, "the cine")};
    if (may_write(folder))
      keep_proposal(made, folder);
    return proposal_of(cine, made.found);
  } catch (const InputError& error) {
    return nothing_proposed(
        cine, std::string("the program found no ventricle: click into its blood, or draw. ") +
                  error.what());
  }
}

Proposal find_proposal(const case_file::Case& c, const image::Cine& cine) {
  const fs::path folder = c.file.parent_path() / (c.file.stem().string() + ".segment");
  if (!fs::exists(folder))
    return propose_first(c, cine, folder);
  return {read_lines(folder, cine, "proposed"), read_confidence(folder / "quality.csv"),
          read_doubts(folder / "segmentation.txt"),
          anatomy::kept_fall(folder).value_or(usual_fall)};
}

void write_phase(const fs::path& file, const std::vector<Contour>& lines) {
  if (!lines.empty())
    geometry::contour_table(lines).write_csv(file);
  else
    fs::remove(file);
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

/// Volume within the lines of one side [mm^3].
double within(const std::vector<Contour>& lines, Side side, double spacing) {
  double sum = 0.0;
  for (const Contour& line : lines)
    if (line.side == side)
      sum += spacing * geometry::enclosed_area(line);
  return sum;
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

}  // namespace

Study open_study(const case_file::Case& c, const fs::path& folder) {
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
  study.proposal = find_proposal(c, study.cine);
  study.saved = fs::exists(folder / "contours");
  if (study.saved)
    study.drawing = {read_lines(folder, study.cine, "drawn"),
                     kept_landmarks(folder / "landmarks.csv", study),
                     read_confidence(folder / "quality.csv")};
  else
    study.drawing = {study.proposal.lines, {}, study.proposal.confidence};
  const int phase = shape_phase(study);
  study.enhancement = open_enhancement(c, folder, phase, study.drawing.lines.at(phase - 1));
  if (!may_write(folder))
    study.hindrance = fmt::format("{} may not be written", folder.filename().string());
  return study;
}

int shape_phase(const Study& study) {
  std::vector<double> volumes;
  for (const std::vector<Contour>& lines : study.drawing.lines)
    volumes.push_back(within(lines, Side::endo, study.spacing));
  const image::Phases phases = image::propose_phases(volumes);
  return 1 + (study.settings.anatomy.cine.moment == case_file::ShapeMoment::end_diastole
                  ? phases.end_diastole
                  : phases.early_diastole);
}

Proposal propose(const Study& study, const Vec3& centre) {
  segment::SegmentParameters parameters = study.settings.anatomy.cine.segmentation;
  parameters.centre = {centre.x(), centre.y(), centre.z()};
  return proposal_of(study.cine, segment::segment(study.cine, parameters, "segment.centre"));
}

void save(Study& study, Drawing drawing, std::optional<ScarDrawing> scar) {
  if (!may_write(study.folder))
    throw RunError(fmt::format("{} may not be written", study.folder.filename().string()),
                   "Allow it, or download the drawing");
  fs::create_directories(study.folder / "contours");
  for (std::size_t t = 0; t < drawing.lines.size(); ++t)
    write_phase(phase_file(study.folder, t), drawing.lines[t]);
  write_marks(drawing, study.folder);
  write_quality(drawing, study.folder);
  write_volumes(drawing, study.spacing, study.folder);
  if (scar && study.enhancement)
    save_scar(*study.enhancement, std::move(*scar), study.folder);
  study.drawing = std::move(drawing);
  study.saved = true;
  ++study.revision;
}

}  // namespace lv::draw
