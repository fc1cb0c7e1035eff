#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/job/cine.hpp"
#include "lv/job/strain.hpp"
#include "lv/report/overlay.hpp"
#include "lv/report/picture_files.hpp"
#include "lv/report/wall_surface.hpp"
#include "lv/strain/agreement.hpp"
#include "lv/strain/measures.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>

namespace lv::job {
namespace {

namespace fs = std::filesystem;
using geometry::Contour;
using geometry::Side;
using strain::Pair;

constexpr std::array<const char*, 2> components{"circumferential", "radial"};

/// Pairs of both components, as in `components`.
using Pairs = std::array<std::vector<Pair>, 2>;

/// Systolic strains of the model per element, in the measure of what they are compared with.
class ModelStrain {
 public:
  ModelStrain(const ModelledBeat& model, StrainMeasure measure) : model_(model) {
    const auto& then = model.fields.end_diastole;
    const auto& now = model.fields.end_systole;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const analysis::Strain s = analysis::strain(now[i], then[i]);
      for (std::size_t k = 0; k < 2; ++k) {
        const double E = k == 0 ? s.circumferential : s.radial;
        values_[k].push_back(
            measure == StrainMeasure::green_lagrange ? E : std::sqrt(1.0 + 2.0 * E) - 1.0);
      }
    }
  }

  /// Mean over the elements that a test chooses, NaN if there are none.
  [[nodiscard]] double mean(std::size_t component, const std::function<bool(int)>& chosen) const {
    const auto& cells = model_.fields.end_diastole;
    std::vector<int> members;
    for (int i = 0; i < static_cast<int>(cells.size()); ++i)
      if (chosen(i))
        members.push_back(i);
    return analysis::statistics(values_[component], cells, members).mean;
  }

 private:
  const ModelledBeat& model_;
  std::array<std::vector<double>, 2> values_;
};

void add(Pair pair, double model, std::vector<Pair>& pairs) {
  pair.model = model;
  if (std::isfinite(pair.measured) && std::isfinite(pair.model))
    pairs.push_back(std::move(pair));
}

/// With a table of strains: slice k is the model's slice k.
Pairs from_table(const Case& c, const ModelledBeat& model) {
  const ModelStrain strains(model, c.strain.measured_kind);
  const mesh::Regions& regions = model.mesh.regions;
  Pairs pairs;
  for (const strain::Measured& m : measured_strains(c)) {
    const std::size_t component = m.component == "cir" ? 0 : 1;
    add({"sector", m.slice, m.segment, m.value, 0.0},
        strains.mean(component,
                     [&](int i) {
                       return regions.slice[i] == m.slice &&
                              mesh::sector_name(m.slice, regions.sector[i]) == m.segment;
                     }),
        pairs[component]);
  }
  return pairs;
}

/// One line of segments.csv at end-systole.
struct Row {
  std::string scheme;
  int slice;
  std::string segment;
  std::array<double, 2> values;
};

std::vector<Row> read_rows(const fs::path& strain, int phase) {
  std::istringstream lines(read_file(strain / "segments.csv"));
  std::string line;
  std::getline(lines, line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');)
      fields.push_back(field);
    LV_CHECK(fields.size() >= 7);
    if (fields[3] == std::to_string(phase))
      rows.push_back({fields[0],
                      fields[1].empty() ? 0 : std::stoi(fields[1]),
                      fields[2],
                      {std::stod(fields[5]), std::stod(fields[6])}});
  }
  return rows;
}

/// The model's elements in each of the cine's slices at end-diastole.
std::map<int, std::vector<bool>> in_slices(const ModelledBeat& model, const CineStudy& study) {
  std::map<int, std::vector<bool>> members;
  const auto& loops = study.drawn.short_axis;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const image::Plane& plane = study.cine.slices[study.slice_of[l]].frames.front().plane;
    std::vector<bool>& in = members[loops[l].slice];
    in.clear();
    for (const analysis::CellFields& cell : model.fields.end_diastole)
      in.push_back(std::abs(plane.pixel(model.frame.to_image(cell.position)).z()) <
                   0.5 * study.spacing);
  }
  return members;
}

/// With images: a slice of the cine has the elements within half a slice spacing of its plane.
Pairs from_images(const ModelledBeat& model, const CineStudy& study, const fs::path& strain,
                  int systole) {
  const ModelStrain strains(model, StrainMeasure::green_lagrange);
  const mesh::Regions& regions = model.mesh.regions;
  const auto members = in_slices(model, study);
  Pairs pairs;
  for (const Row& row : read_rows(strain, systole)) {
    const auto in = members.find(row.slice);
    if (row.slice > 0 && in == members.end())
      continue;
    const auto chosen = [&](int i) {
      if (row.scheme == "aha17")
        return row.segment == fmt::format("{} {}", regions.aha[i], mesh::aha_name(regions.aha[i]));
      if (row.scheme == "whole")
        return false;
      if (!in->second[i])
        return false;
      return row.scheme == "slice" ||
             (mesh::sectors_of_slice(regions.slice[i]) == 6 &&
              mesh::sector_name(regions.slice[i], regions.sector[i]) == row.segment);
    };
    for (std::size_t k = 0; k < 2; ++k)
      add({row.scheme, row.slice, row.segment, row.values[k], 0.0}, strains.mean(k, chosen),
          pairs[k]);
  }
  return pairs;
}

std::vector<Pair> of_scheme(const std::vector<Pair>& pairs, const std::string& scheme) {
  std::vector<Pair> chosen;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(chosen),
               [&](const Pair& p) { return p.scheme == scheme; });
  return chosen;
}

std::string write_pairs(const Pairs& pairs, const std::string& measure, const fs::path& folder) {
  nlohmann::ordered_json json{{"measure", measure}};
  std::string text;
  for (std::size_t k = 0; k < 2; ++k) {
    strain::pairs_table(pairs[k]).write_csv(folder /
                                            fmt::format("strain_comparison_{}.csv", components[k]));
    for (const char* scheme : {"sector", "aha17"}) {
      const strain::Agreement a = strain::agreement(of_scheme(pairs[k], scheme));
      if (a.count < 2)
        continue;
      json[components[k]][scheme] = {
          {"count", a.count},       {"bias", a.bias},         {"standard_deviation", a.deviation},
          {"lower_limit", a.lower}, {"upper_limit", a.upper}, {"correlation", a.correlation}};
      text += fmt::format(
          "{} strain at end-systole, model - measured, {} regions ({}): bias {:+.3f}, limits of "
          "agreement {:+.3f} to {:+.3f}, correlation {:.2f}\n",
          components[k], a.count, scheme, a.bias, a.lower, a.upper, a.correlation);
    }
  }
  write_file(folder / "strain_agreement.json", json.dump(2) + "\n");
  return text;
}

/// The model's two surfaces at one time, in image space.
struct Surfaces {
  std::vector<std::array<Vec3, 3>> endo, epi;
};

Surfaces surfaces(const ModelledBeat& model, const std::vector<Vec3>& positions) {
  const auto triangles = [&](const mesh::Surface& side) {
    const report::Patch patch = report::wall_surface(model.mesh.mesh, positions, side).patch;
    std::vector<std::array<Vec3, 3>> all;
    for (const auto& t : patch.triangles)
      all.push_back({model.frame.to_image(patch.points[t[0]]),
                     model.frame.to_image(patch.points[t[1]]),
                     model.frame.to_image(patch.points[t[2]])});
    return all;
  };
  return {triangles(model.mesh.mesh.endo), triangles(model.mesh.mesh.epi)};
}

std::vector<Vec3> closed(std::vector<Vec3> loop) {
  loop.push_back(loop.front());
  return loop;
}

/// Draws one state's outlines over the images and measures their distance from contours.
class Outlines {
 public:
  explicit Outlines(const CineStudy& study)
      : study_(study),
        points_({"state", "slice", "source", "contour", "line", "point", "x_mm", "y_mm", "z_mm"}),
        distances_({"state", "slice", "contour", "points", "mean_mm", "rms_mm", "largest_mm"}) {}

  void add(const std::string& state, const Surfaces& model, const std::vector<Contour>& drawn,
           int phase, const fs::path& picture) {
    std::vector<report::Overlay> overlays;
    const auto& loops = study_.drawn.short_axis;
    for (std::size_t l = 0; l < loops.size(); ++l) {
      if (loops[l].side != Side::endo)
        continue;
      const image::CineSlice& slice = study_.cine.slices[study_.slice_of[l]];
      const image::Picture& frame = slice.frames.at(phase - 1);
      report::Overlay overlay{fmt::format("slice {}, phase {}", loops[l].slice, phase), &frame, {}};
      for (const Side side : {Side::endo, Side::epi}) {
        const auto lines = strain::cut(side == Side::endo ? model.endo : model.epi,
                                       frame.plane.origin, frame.plane.normal());
        for (const auto& line : lines)
          overlay.lines.push_back({line, report::hex(0xe69f00), false, false});
        write(state, loops[l].slice, "model", side, lines);
        if (const Contour* contour = geometry::find(drawn, loops[l].slice, side)) {
          overlay.lines.push_back({contour->points, report::hex(0x56b4e9), true, true});
          write(state, loops[l].slice, "contours", side, {closed(contour->points)});
          measure(state, *contour, lines);
        }
      }
      std::vector<Vec3> around;
      for (const report::OverlayLine& line : overlay.lines)
        around.insert(around.end(), line.points.begin(), line.points.end());
      pictures_.push_back({state, loops[l].slice, phase, report::cut_around(frame, around)});
      overlays.push_back(std::move(overlay));
    }
    report::write_overlays(overlays, "Outlines of the model (solid) and contours drawn (dashed)",
                           picture);
  }

  void write(const fs::path& folder) const {
    points_.write_csv(folder / "outlines.csv");
    distances_.write_csv(folder / "outline_distances.csv");
    report::write_pictures(pictures_, folder / "pictures");
  }

  [[nodiscard]] std::string words(const std::string& state) const {
    const auto found = means_.find(state);
    if (found == means_.end())
      return "";
    double sum = 0.0;
    for (const double mean : found->second)
      sum += mean;
    return fmt::format("outlines of the model lie {:.1f} mm from the contours at {} in the mean\n",
                       sum / static_cast<double>(found->second.size()), state);
  }

 private:
  void write(const std::string& state, int slice, const std::string& source, Side side,
             const std::vector<std::vector<Vec3>>& lines) {
    const auto coordinate = [](double x) { return fmt::format("{:.3f}", x); };
    for (std::size_t n = 0; n < lines.size(); ++n)
      for (std::size_t i = 0; i < lines[n].size(); ++i)
        points_.add_row({state, std::to_string(slice), source, name(side), std::to_string(n + 1),
                         std::to_string(i + 1), coordinate(lines[n][i].x()),
                         coordinate(lines[n][i].y()), coordinate(lines[n][i].z())});
  }

  void measure(const std::string& state, const Contour& contour,
               const std::vector<std::vector<Vec3>>& lines) {
    const strain::Distance d = strain::distance(contour.points, lines, false);
    distances_.add_row({state, std::to_string(contour.slice), name(contour.side),
                        std::to_string(contour.points.size()), Table::number(d.mean, 4),
                        Table::number(d.rms, 4), Table::number(d.largest, 4)});
    if (std::isfinite(d.mean))
      means_[state].push_back(d.mean);
  }

  const CineStudy& study_;
  Table points_, distances_;
  std::vector<report::PictureFile> pictures_;
  std::map<std::string, std::vector<double>> means_;
};

std::string write_outlines(const ModelledBeat& model, const CineStudy& study, int diastole,
                           int systole, const fs::path& folder) {
  Outlines outlines(study);
  outlines.add("end_diastole", surfaces(model, model.beat.end_diastole.positions),
               study.drawn.short_axis, diastole, folder / "outlines_ed.png");
  outlines.add("end_systole", surfaces(model, model.beat.end_systole.positions), study.systolic,
               systole, folder / "outlines_es.png");
  outlines.write(folder);
  return outlines.words("end_diastole") + outlines.words("end_systole");
}

}  // namespace

std::vector<strain::Measured> measured_strains(const Case& c) {
  if (c.strain.measured_column.empty())
    throw InputError(place_of(c, "strain.measured"), "strain.measured_column is not set",
                     "Name the column of the table that holds end-systole");
  const fs::path file = beside(c, c.strain.measured);
  std::vector<strain::Measured> measured = strain::read_measured(file, c.strain.measured_column);
  for (const strain::Measured& m : measured)
    if (m.slice < 1 || m.slice > mesh::slice_count || mesh::sectors_of_slice(m.slice) != 6)
      throw InputError(file.string(),
                       fmt::format("slice {} has no six sectors in the model", m.slice),
                       "Slices 1 (base) to 5 have; leave the others out");
  return measured;
}

std::string compare_strain(const Case& c, const ModelledBeat& model, const fs::path& strain,
                           const fs::path& folder) {
  if (!c.strain.measured.empty()) {
    const bool green = c.strain.measured_kind == StrainMeasure::green_lagrange;
    return write_pairs(from_table(c, model), green ? "green_lagrange" : "engineering", folder);
  }
  if (!c.strain.asked())
    return "";
  const auto phases = nlohmann::json::parse(read_file(strain / "phases.json"));
  const int systole = phases.at("end_systole");
  const CineStudy study = read_cine_study(c);
  return write_pairs(from_images(model, study, strain, systole), "green_lagrange", folder) +
         write_outlines(model, study, phases.at("end_diastole"), systole, folder);
}

}  // namespace lv::job
