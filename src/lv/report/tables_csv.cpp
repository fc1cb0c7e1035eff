#include "lv/report/tables_csv.hpp"

#include "lv/base/units.hpp"

namespace lv::report {
namespace {

using units::degree;
using units::mmHg;

const auto cell = [](double value) { return Table::number(value); };

/// The number of an AHA segment, which its name begins with; empty for other regions.
std::string segment(const analysis::RegionalValue& r) {
  return r.scheme == "aha17" ? r.region.substr(0, r.region.find(' ')) : "";
}

}  // namespace

Table curves_table(const std::vector<heartbeat::CurveRow>& curves) {
  Table table({"time_s", "phase", "pressure_mmHg", "cavity_volume_ml", "calcium_uM",
               "mean_active_tension_kPa", "kinetic_energy_mJ", "largest_velocity_m_per_s", "min_J",
               "max_J", "step_s"});
  for (const heartbeat::CurveRow& r : curves)
    table.add_row({cell(r.time), r.phase, cell(r.pressure / mmHg), cell(1e-3 * r.volume),
                   cell(r.calcium), cell(r.mean_tension), cell(1e-3 * r.kinetic_energy),
                   cell(1e-3 * r.largest_velocity), cell(r.min_J), cell(r.max_J), cell(r.step)});
  return table;
}

Table moments_table(const std::vector<heartbeat::NamedMoment>& moments) {
  Table table({"moment", "phase", "time_s", "by_criterion"});
  for (const heartbeat::NamedMoment& m : moments)
    table.add_row({m.name, m.phase, cell(m.wall.time), m.by_criterion ? "yes" : "no"});
  return table;
}

Table regions_table(const analysis::Results& results) {
  Table table({"state", "scheme", "region", "quantity", "unit", "volume_ml", "mean", "sd", "p1",
               "p50", "p99", "segment"});
  for (const analysis::RegionalValue& r : results.regional)
    table.add_row({r.state, r.scheme, r.region, r.quantity, r.unit, cell(1e-3 * r.volume),
                   cell(r.statistics.mean), cell(r.statistics.sd), cell(r.statistics.p1),
                   cell(r.statistics.p50), cell(r.statistics.p99), segment(r)});
  return table;
}

Table rotation_table(const analysis::Results& results) {
  Table table({"slice", "end_diastole_to_end_systole_deg", "early_diastole_to_end_systole_deg",
               "early_to_end_diastole_deg"});
  for (const analysis::SliceRotation& r : results.rotation)
    table.add_row({std::to_string(r.slice), cell(r.from_end_diastole / degree),
                   cell(r.from_early_diastole / degree), cell(r.filling / degree)});
  return table;
}

Table stress_stretch_table(const std::vector<material::StressStretch>& curves) {
  Table table({"muscle", "published", "fibre_stretch", "cauchy_stress_kPa"});
  for (const material::StressStretch& curve : curves)
    for (std::size_t i = 0; i < curve.stretch.size(); ++i)
      table.add_row({curve.muscle, curve.is_published ? "yes" : "no", cell(curve.stretch[i]),
                     cell(curve.stress[i])});
  return table;
}

Table quality_table(const mesh::Quality& quality) {
  Table table({"quantity", "value", "unit"});
  for (const mesh::QualityRow& row : mesh::table(quality))
    table.add_row({row.quantity, cell(row.value), row.unit});
  return table;
}

Table fit_table(const geometry::FitReport& fit) {
  Table table({"image", "slice", "surface", "points", "mean_mm", "rms_mm", "max_mm", "shift_mm"});
  const auto add = [&](const std::string& image, const std::string& slice, const char* surface,
                       const std::optional<geometry::Residual>& r, double shift) {
    if (r)
      table.add_row({image, slice, surface, std::to_string(r->points), cell(r->mean), cell(r->rms),
                     cell(r->max), cell(shift)});
  };
  const auto add_images = [&](const std::string& kind,
                              const std::vector<geometry::ImageReport>& images) {
    for (const geometry::ImageReport& i : images) {
      add(kind, std::to_string(i.slice), "endo", i.endo, i.shift.norm());
      add(kind, std::to_string(i.slice), "epi", i.epi, i.shift.norm());
    }
  };
  add_images("short_axis", fit.short_axis);
  add_images("long_axis", fit.long_axis);
  add("apex", "", "endo", fit.apex_endo, 0.0);
  add("apex", "", "epi", fit.apex_epi, 0.0);
  return table;
}

}  // namespace lv::report
