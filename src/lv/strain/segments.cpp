#include "lv/strain/segments.hpp"

#include "lv/base/units.hpp"
#include "lv/mesh/regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>

namespace lv::strain {
namespace {

constexpr int sectors = 6;

/// The rays of a slice that a test chooses.
std::vector<Ray> chosen(const SliceMotion& motion, const std::function<bool(double)>& holds) {
  std::vector<Ray> rays;
  for (const Ray& ray : motion.rays)
    if (holds(ray.angle))
      rays.push_back(ray);
  return rays;
}

double time_of(const SliceSeries& slice, std::size_t phase) {
  return slice.times.empty() ? std::numeric_limits<double>::quiet_NaN() : slice.times[phase];
}

/// The AHA segment of a ray in a third: six sectors, in the apical third four.
int aha_segment(int third, double angle) {
  return 6 * third + mesh::sector_at(angle, 0.0, third == 2 ? 4 : sectors);
}

void add_slice(const SliceSeries& s, std::vector<SegmentStrain>& rows) {
  for (std::size_t k = 0; k < s.motion.size(); ++k) {
    const auto add = [&](const char* scheme, const std::string& name,
                         const std::vector<Ray>& rays) {
      rows.push_back({scheme, s.slice, name, s.phases[k], time_of(s, k), strain_of(rays)});
    };
    add("slice", "all", s.motion[k].rays);
    for (int sector = 1; sector <= sectors; ++sector)
      add("sector", mesh::sector_name(1, sector), chosen(s.motion[k], [&](double angle) {
            return mesh::sector_at(angle, 0.0, sectors) == sector;
          }));
  }
}

/// Rays of all slices at one phase of each.
using RaysAt = std::function<std::vector<Ray>(const SliceSeries& slice, std::size_t phase)>;

void add_joint(const std::string& scheme, const std::string& name,
               const std::vector<SliceSeries>& slices, const RaysAt& rays_at,
               std::vector<SegmentStrain>& rows) {
  for (std::size_t k = 0; k < slices.front().phases.size(); ++k) {
    const int phase = slices.front().phases[k];
    std::vector<Ray> rays;
    double time = 0.0;
    bool everywhere = true;
    for (const SliceSeries& s : slices) {
      const auto found = std::find(s.phases.begin(), s.phases.end(), phase);
      everywhere = everywhere && found != s.phases.end();
      if (!everywhere)
        break;
      const auto at = static_cast<std::size_t>(found - s.phases.begin());
      const std::vector<Ray> more = rays_at(s, at);
      rays.insert(rays.end(), more.begin(), more.end());
      time += time_of(s, at) / static_cast<double>(slices.size());
    }
    if (everywhere && !rays.empty())
      rows.push_back({scheme, 0, name, phase, time, strain_of(rays)});
  }
}

std::string number(double value) {
  return Table::number(value, 6);
}

}  // namespace

std::vector<SegmentStrain> segments(const std::vector<SliceSeries>& slices) {
  std::vector<SegmentStrain> rows;
  if (slices.empty())
    return rows;
  for (const SliceSeries& s : slices)
    add_slice(s, rows);
  for (int segment = 1; segment <= 16; ++segment)
    add_joint(
        "aha17", fmt::format("{} {}", segment, mesh::aha_name(segment)), slices,
        [&](const SliceSeries& s, std::size_t k) {
          return chosen(s.motion[k],
                        [&](double angle) { return aha_segment(s.third, angle) == segment; });
        },
        rows);
  add_joint(
      "whole", "wall", slices, [](const SliceSeries& s, std::size_t k) { return s.motion[k].rays; },
      rows);
  return rows;
}

Table segments_table(const std::vector<SegmentStrain>& rows) {
  Table table({"scheme", "slice", "segment", "phase", "time_s", "circumferential_strain",
               "radial_strain", "circumferential_shortening", "wall_thickening"});
  for (const SegmentStrain& r : rows)
    table.add_row({r.scheme, r.slice == 0 ? "" : std::to_string(r.slice), r.segment,
                   std::to_string(r.phase), number(r.time), number(r.strain.circumferential),
                   number(r.strain.radial), number(r.strain.shortening),
                   number(r.strain.thickening)});
  return table;
}

Table rotation_table(const std::vector<SliceSeries>& slices) {
  Table table({"slice", "phase", "time_s", "rotation_deg"});
  for (const SliceSeries& s : slices)
    for (std::size_t k = 0; k < s.motion.size(); ++k)
      table.add_row({std::to_string(s.slice), std::to_string(s.phases[k]), number(time_of(s, k)),
                     number(s.motion[k].rotation / units::degree)});
  return table;
}

}  // namespace lv::strain
