#include "lv/base/check.hpp"
#include "lv/base/json_file.hpp"
#include "lv/base/log.hpp"
#include "lv/base/table.hpp"
#include "lv/cine/cine.hpp"
#include "lv/cine/outlines.hpp"
#include "lv/cine/strain.hpp"
#include "lv/cine/strain_targets.hpp"
#include "lv/heartbeat/archive.hpp"
#include "lv/strain/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace lv::cine {
namespace {

using case_file::Case;
using heartbeat::Archive;
namespace fs = std::filesystem;
using strain::Pair;

constexpr const char* phases_name = "phases.bin";
constexpr std::array<const char*, 2> components{"circumferential", "radial"};

/// Pairs of both components, as in `components`.
using Pairs = std::array<std::vector<Pair>, 2>;

/// Systolic strains of the model per element, in the measure of what they are compared with.
class ModelStrain {
 public:
  ModelStrain(const ModelledBeat& model, case_file::StrainMeasure measure) : model_(model) {
    const auto& then = model.fields.at(heartbeat::end_diastole);
    const auto& now = model.fields.at(heartbeat::end_systole);
    for (std::size_t i = 0; i < now.size(); ++i) {
      const analysis::CellStrain s = analysis::strain(now[i], then[i]);
      for (std::size_t k = 0; k < 2; ++k) {
        const double E = k == 0 ? s.circumferential : s.radial;
        values_[k].push_back(measure == case_file::StrainMeasure::green_lagrange
                                 ? E
                                 : std::sqrt(1.0 + 2.0 * E) - 1.0);
      }
    }
  }

  /// Mean over the elements that a test chooses, NaN if there are none.
  [[nodiscard]] double mean(std::size_t component, const std::function<bool(int)>& chosen) const {
    const auto& cells = model_.fields.at(heartbeat::end_diastole);
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

/// What of a table has no element of the model to be compared with, in words; empty if nothing.
std::string words_of_left_out(const std::vector<strain::Measured>& left, std::size_t all) {
  if (left.empty())
    return "";
  std::vector<std::string> names;
  for (const strain::Measured& m : left)
    names.push_back(fmt::format("{} of slice {}, {}", m.component, m.slice, m.segment));
  return fmt::format(
      "{} of {} measured strains are not compared, for the mesh has no element there: {}; elements "
      "about as small as a sector of a slice have one in each",
      left.size(), all, fmt::join(names, "; "));
}

/// With a table of strains: slice k is the model's slice k. Says what is left out.
Pairs from_table(const Case& c, const ModelledBeat& model, std::string& left_out) {
  const ModelStrain strains(model, c.strain.measured_kind);
  const mesh::Regions& regions = model.mesh.regions;
  Pairs pairs;
  const std::vector<strain::Measured> measured = measured_strains(c);
  std::vector<strain::Measured> left;
  for (const strain::Measured& m : measured) {
    const std::size_t component = m.component == "cir" ? 0 : 1;
    const double mean = strains.mean(component, [&](int i) {
      return regions.slice[i] == m.slice &&
             mesh::sector_name(m.slice, regions.sector[i]) == m.segment;
    });
    if (!std::isfinite(mean))
      left.push_back(m);
    add({"sector", m.slice, m.segment, m.value, 0.0}, mean, pairs[component]);
  }
  left_out = words_of_left_out(left, measured.size());
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
  const Table table = Table::read_csv(strain / "segments.csv");
  const auto scheme = table.words("scheme");
  const auto segment = table.words("segment");
  const auto slice = table.whole_numbers("slice");
  const auto at = table.whole_numbers("phase");
  const auto circumferential = table.numbers("circumferential_strain");
  const auto radial = table.numbers("radial_strain");
  std::vector<Row> rows;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (at[i] == phase)
      rows.push_back({scheme[i], slice[i], segment[i], {circumferential[i], radial[i]}});
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
    for (const analysis::CellFields& cell : model.fields.at(heartbeat::end_diastole))
      in.push_back(std::abs(plane.pixel(model.frame->to_image(cell.position)).z()) <
                   0.5 * study.spacing);
  }
  return members;
}

/// With images: a slice of the cine has the elements within half a slice spacing of its plane; none
/// if the wall is not there.
Pairs from_images(const ModelledBeat& model, const CineStudy& study, const fs::path& strain,
                  int systole) {
  const ModelStrain strains(model, case_file::StrainMeasure::green_lagrange);
  const mesh::Regions& regions = model.mesh.regions;
  const auto members = model.frame ? in_slices(model, study) : std::map<int, std::vector<bool>>{};
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
          "agreement {:+.3f} to {:+.3f}, {}\n",
          components[k], a.count, scheme, a.bias, a.lower, a.upper,
          std::isnan(a.correlation) ? "no correlation: all strains of one side are the same"
                                    : fmt::format("correlation {:.2f}", a.correlation));
    }
  }
  write_file(folder / "strain_agreement.json", json.dump(2) + "\n");
  return text;
}

}  // namespace

void write_phases(const CinePhases& phases, const fs::path& folder) {
  Archive archive;
  archive.set("phases",
              {static_cast<double>(phases.end_diastole), static_cast<double>(phases.end_systole)});
  archive.write(folder / phases_name);
}

CinePhases read_phases(const fs::path& folder) {
  const auto phases =
      Archive::read(folder / phases_name).get_whole("phases", 2, heartbeat::not_negative);
  return {phases[0], phases[1]};
}

std::vector<strain::Measured> measured_strains(const Case& c) {
  if (c.strain.measured_column.empty())
    throw InputError(case_file::place_of(c, "strain.measured"), "strain.measured_column is not set",
                     "Name the column of the table that holds end-systole");
  const fs::path file = case_file::beside(c, c.strain.measured);
  std::vector<strain::Measured> measured =
      strain::read_measured(file, c.strain.measured_column, measure_of(c.strain.measured_kind));
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
    const bool green = c.strain.measured_kind == case_file::StrainMeasure::green_lagrange;
    std::string left_out;
    const Pairs pairs = from_table(c, model, left_out);
    if (!left_out.empty()) {
      log::warn("{}: {}", c.strain.measured, left_out);
      left_out = fmt::format("note: {}\n", left_out);
    }
    return left_out + write_pairs(pairs, green ? "green_lagrange" : "engineering", folder);
  }
  if (!c.strain.asked())
    return "";
  const auto [diastole, systole] = read_phases(strain);
  const CineStudy study = read_cine_study(c);
  ModelledBeat placed = model;
  std::string text;
  if (!lies_in_images(model, study)) {
    placed.frame.reset();
    text =
        "the wall does not lie where the cine shows a heart: it is not laid over the images, and "
        "AHA segments alone are compared\n";
  }
  return text + write_pairs(from_images(placed, study, strain, systole), "green_lagrange", folder) +
         write_outlines(placed, study, diastole, systole, folder);
}

}  // namespace lv::cine
