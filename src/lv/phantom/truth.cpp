#include "lv/phantom/truth.hpp"

#include "lv/base/units.hpp"
#include "lv/mesh/regions.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace lv::phantom {
namespace {

using geometry::Side;
using nlohmann::ordered_json;
using std::numbers::pi;
using units::degree;

/// Refilled by this part of the stroke volume, the ventricle is in early diastole.
constexpr double early_share = 0.15;

int third_of(const Ventricle& v, double Z) {
  return std::clamp(static_cast<int>(3.0 * Z / v.cavity_apex()), 0, 3);
}

/// The motion of a plane Z = const, seen along the axis.
strain::Deformation in_plane(const Motion& motion, double Z) {
  return [&motion, Z](const strain::Vec2& X) {
    const Vec3 whole(X.x(), X.y(), Z);
    return strain::Moved{motion.forward(whole).head<2>(),
                         motion.gradient(whole).topLeftCorner<2, 2>()};
  };
}

strain::SliceSeries series(const Ventricle& v, const Scan& scan, double Z) {
  strain::SliceSeries s;
  s.third = third_of(v, Z);
  const auto radius = [&v, Z](Side side) {
    return [R = std::sqrt(v.radius_squared(side, Z))](double) { return R; };
  };
  const strain::SliceWall wall{radius(Side::endo), radius(Side::epi)};
  const std::vector<double> times = phase_times(scan);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Motion motion(v, contraction(times[k]));
    s.phases.push_back(static_cast<int>(k) + 1);
    s.times.push_back(times[k] * scan.rr);
    s.motion.push_back(strain::follow(wall, in_plane(motion, Z)));
  }
  return s;
}

/// The whole cavity's height in thin slices.
std::vector<strain::SliceSeries> thin_slices(const Ventricle& v, const Scan& scan) {
  constexpr int count = 42;
  std::vector<strain::SliceSeries> slices;
  for (int k = 0; k < count; ++k)
    slices.push_back(series(v, scan, v.cavity_apex() * (k + 0.5) / count));
  return slices;
}

std::vector<strain::SegmentStrain> all_segments(const Ventricle& v, const Scan& scan,
                                                const std::vector<strain::SliceSeries>& slices) {
  std::vector<strain::SegmentStrain> rows = strain::segments(slices);
  const auto joint = [](const strain::SegmentStrain& row) { return row.slice == 0; };
  std::erase_if(rows, joint);
  for (const strain::SegmentStrain& row : strain::segments(thin_slices(v, scan)))
    if (joint(row) && (row.scheme == "aha17" || row.scheme == "whole"))
      rows.push_back(row);
  return rows;
}

std::array<double, 17> scar_of_segments(const Ventricle& v) {
  constexpr int heights = 400;
  constexpr int turns = 360;
  constexpr int layers = 40;
  std::array<double, 17> volumes{};
  const double dz = -v.apex() / heights;
  for (int a = 0; a < heights; ++a) {
    const double Z = -(a + 0.5) * dz;
    const double inner = std::sqrt(std::max(0.0, v.radius_squared(Side::endo, Z)));
    const double outer = std::sqrt(v.radius_squared(Side::epi, Z));
    for (int b = 0; b < turns; ++b) {
      const double Theta = 2.0 * pi * (b + 0.5) / turns;
      const int third = third_of(v, Z);
      const int segment =
          third == 3 ? 17 : 6 * third + mesh::sector_at(Theta, 0.0, third == 2 ? 4 : 6);
      for (int k = 0; k < layers; ++k) {
        const double R = inner + (outer - inner) * (k + 0.5) / layers;
        if (v.in_scar({R * std::cos(Theta), R * std::sin(Theta), Z}))
          volumes.at(segment - 1) += R * (outer - inner) / layers * 2.0 * pi / turns * dz;
      }
    }
  }
  return volumes;
}

/// The first phase after end-systole in which the cavity has refilled by early_share of the stroke.
int early_phase(const std::vector<double>& volumes, int end_systole) {
  const double least = volumes[end_systole - 1];
  for (std::size_t k = end_systole; k < volumes.size(); ++k)
    if (volumes[k] >= least + early_share * (volumes.front() - least))
      return static_cast<int>(k) + 1;
  return end_systole;
}

std::vector<double> numbers(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

ordered_json slices_json(const Truth& truth, const Ventricle& v, const ScanPlanes& planes) {
  ordered_json list = ordered_json::array();
  const Motion systole(v, 1.0);
  for (std::size_t s = 0; s < planes.short_axis.size(); ++s) {
    const ScanPlane& p = planes.short_axis[s];
    const int number = static_cast<int>(s) + 1;
    const bool drawn =
        std::any_of(truth.slices.begin(), truth.slices.end(),
                    [&](const strain::SliceSeries& series) { return series.slice == number; });
    list.push_back({{"slice", number},
                    {"height_mm", p.height},
                    {"shift_mm", numbers(p.shift)},
                    {"drawn_at_end_diastole", drawn},
                    {"muscle_in_plane_at_end_systole",
                     p.height < systole.z(0.0) && p.height > systole.z(v.apex())},
                    {"through_plane_motion_at_end_systole_mm", systole.z(p.height) - p.height}});
  }
  return list;
}

}  // namespace

std::vector<double> phase_times(const Scan& scan) {
  std::vector<double> times;
  for (int k = 0; k < scan.phases; ++k)
    times.push_back(static_cast<double>(k) / scan.phases);
  return times;
}

Truth truth(const Ventricle& v, const Scan& scan, const ScanPlanes& planes) {
  Truth t;
  for (const double time : phase_times(scan)) {
    t.times.push_back(time * scan.rr);
    t.cavity_volumes.push_back(Motion(v, contraction(time)).cavity_volume());
  }
  const auto least = std::min_element(t.cavity_volumes.begin(), t.cavity_volumes.end());
  t.end_systole = static_cast<int>(least - t.cavity_volumes.begin()) + 1;
  t.early_diastole = early_phase(t.cavity_volumes, t.end_systole);
  t.wall_volume = wall_volume(v);
  t.scar_volume = scar_volume(v);
  t.scar_of_segment = scar_of_segments(v);
  for (const geometry::Contour& c : contours(v, scan, planes, 0.0).short_axis) {
    if (c.side != Side::endo)
      continue;
    const ScanPlane& plane = planes.short_axis[c.slice - 1];
    strain::SliceSeries s = series(v, scan, plane.height);
    s.slice = c.slice;
    t.slices.push_back(std::move(s));
  }
  t.segments = all_segments(v, scan, t.slices);
  return t;
}

std::string truth_json(const Truth& t, const Ventricle& v, const Scan& scan,
                       const ScanPlanes& planes) {
  const geometry::Frame frame = pose(scan);
  std::vector<double> volumes_ml;
  for (const double volume : t.cavity_volumes)
    volumes_ml.push_back(1e-3 * volume);
  std::vector<double> scar_ml;
  for (const double volume : t.scar_of_segment)
    scar_ml.push_back(1e-3 * volume);
  const auto at = [&](int phase) { return volumes_ml.at(phase - 1); };
  const ordered_json json{
      {"phases", scan.phases},
      {"times_s", t.times},
      {"cavity_volume_ml", volumes_ml},
      {"end_diastole", {{"phase", t.end_diastole}, {"cavity_volume_ml", at(t.end_diastole)}}},
      {"end_systole", {{"phase", t.end_systole}, {"cavity_volume_ml", at(t.end_systole)}}},
      {"early_diastole", {{"phase", t.early_diastole}, {"cavity_volume_ml", at(t.early_diastole)}}},
      {"ejection_fraction", 1.0 - at(t.end_systole) / at(t.end_diastole)},
      {"wall_volume_ml", 1e-3 * t.wall_volume},
      {"scar_volume_ml", 1e-3 * t.scar_volume},
      {"scar_volume_of_aha_segment_ml", scar_ml},
      {"frame",
       {{"origin_in_image_space_mm", numbers(frame.origin)},
        {"septum_direction", numbers(frame.axes.col(0))},
        {"anterior_direction", numbers(frame.axes.col(1))},
        {"base_direction", numbers(frame.axes.col(2))}}},
      {"apex_height_mm", {{"endo", v.cavity_apex()}, {"epi", v.apex()}}},
      {"scar",
       {{"angle_deg", v.scar.angle / degree},
        {"width_deg", v.scar.width / degree},
        {"bottom_mm", v.scar.bottom},
        {"top_mm", v.scar.top},
        {"transmurality", v.scar.transmurality}}},
      {"short_axis", slices_json(t, v, planes)},
      {"seed", scan.seed},
      {"snr", scan.snr},
      {"shift_mm", scan.shift}};
  return json.dump(2) + "\n";
}

}  // namespace lv::phantom
