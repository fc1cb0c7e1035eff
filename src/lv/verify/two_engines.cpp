#include "lv/base/parallel.hpp"
#include "lv/heartbeat/quasi_static_beat.hpp"
#include "lv/verify/analyse.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/small_ventricle.hpp"

#include <fmt/format.h>

#include <algorithm>

/// The same ventricle by both engines.
namespace lv::verify {
namespace {

using analysis::CellFields;
using heartbeat::Beat;
using units::ml;

/// One engine's answer.
struct Answer {
  mesh::Regions regions;
  Analysis analysis;
};

Answer immersed_answer(const Findings& found) {
  const mesh::Mesh mesh = ideal_mesh({});
  const Beat beat =
      heartbeat::run_immersed_beat(default_beat(mesh, {96, 96, 128}, 1e-4), found.scratch(), {});
  return {mesh::divide(mesh, {}), analyse(mesh, beat, {})};
}

Answer quasi_static_answer() {
  const mesh::Mesh mesh =
      ideal_mesh({.edge_length = 2.5, .order = 2, .apex = 0.3, .endocardium = 0.5});
  const solid::CardiacModel heart;  // with the immersed engine's springs
  const Beat beat = heartbeat::run_quasi_static_beat({mesh, heart, {}, {}}, {});
  return {mesh::divide(mesh, {}), analyse(mesh, beat, heart)};
}

Vec3 mean_displacement(const std::vector<CellFields>& cells, const std::vector<int>& members) {
  Vec3 sum = Vec3::Zero();
  double volume = 0.0;
  for (const int c : members) {
    sum += cells[c].volume * (cells[c].position - cells[c].reference);
    volume += cells[c].volume;
  }
  return sum / volume;
}

/// The largest distance between the places to which both answers move the middle of one of the 38
/// sectors [mm].
double largest_difference(const Answer& a, const Answer& b, const std::string& moment) {
  const auto& cells_a = a.analysis.fields.at(moment);
  const auto& cells_b = b.analysis.fields.at(moment);
  const auto list_a = analysis::region_list(a.regions, cells_a);
  const auto list_b = analysis::region_list(b.regions, cells_b);
  double largest = 0.0;
  for (std::size_t i = 0; i < list_a.size(); ++i)
    if (list_a[i].scheme == "sector")
      largest = std::max(largest, (mean_displacement(cells_a, list_a[i].cells) -
                                   mean_displacement(cells_b, list_b[i].cells))
                                      .norm());
  return largest;
}

}  // namespace

/// The default ventricle at the paper's resolution. The paper's bounds for its own pair of engines:
/// 3 % in volume, 0.5 mm in displacement (section 3.1).
void engines_agree(Findings& found) {
  const Answer immersed = immersed_answer(found);
  const Answer quasi_static = quasi_static_answer();
  if (!parallel::is_root())
    return;
  for (const char* state : {heartbeat::end_diastole, heartbeat::end_systole}) {
    const analysis::Results& a = immersed.analysis.results;
    const analysis::Results& b = quasi_static.analysis.results;
    const auto name = [&](const char* quantity) { return fmt::format("{}, {}", quantity, state); };
    found.add_within(name("cavity volume"), a.at(state).cavity_volume / ml,
                     b.at(state).cavity_volume / ml, 0.03, "ml");
    found.add(name("z of the endocardial apex"), a.at(state).apex_endo_z, b.at(state).apex_endo_z,
              0.5, "mm");
    found.add(name("z of the epicardial apex"), a.at(state).apex_epi_z, b.at(state).apex_epi_z, 0.5,
              "mm");
    found.add_error(name("largest difference of a sector's displacement"),
                    largest_difference(immersed, quasi_static, state), 0.5, "mm");
    for (const auto& [quantity, fraction, unit] :
         {std::tuple{"fibre_stretch", 0.01, ""}, std::tuple{"fibre_stress", 0.03, "kPa"}})
      found.add_within(name(fmt::format("mean {}", quantity).c_str()),
                       a.whole(state, quantity).mean, b.whole(state, quantity).mean, fraction,
                       unit);
  }
}

}  // namespace lv::verify
