#include "segment/agreement.hpp"

#include "lv/geometry/contour_measures.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/sunnybrook.hpp"
#include "lv/phantom/study.hpp"
#include "lv/strain/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace lv::test {

using geometry::Contour;
using geometry::Side;

Agreement agreement(const geometry::Contours& found, const geometry::Contours& truth, Side side) {
  Agreement a;
  double own = 0.0;
  double others = 0.0;
  double common = 0.0;
  for (const Contour& loop : found.short_axis)
    own += loop.side == side ? geometry::enclosed_area(loop) : 0.0;
  for (const Contour& loop : truth.short_axis) {
    if (loop.side != side)
      continue;
    ++a.loops;
    others += geometry::enclosed_area(loop);
    const Contour* drawn = geometry::find(found.short_axis, loop.slice, side);
    if (drawn == nullptr) {
      ++a.missed;
      continue;
    }
    const double dice = strain::dice(drawn->points, loop.points);
    a.dice += dice;
    common += dice * (geometry::enclosed_area(*drawn) + geometry::enclosed_area(loop));
    a.distance += strain::distance(drawn->points, {loop.points}, true).mean;
  }
  a.dice /= a.loops;
  a.pooled = common / (own + others);
  a.distance /= std::max(1, a.loops - a.missed);
  a.volume = own / others - 1.0;
  return a;
}

double dice_of_muscle(const geometry::Contours& found, const geometry::Contours& truth) {
  const auto common = [](const Contour& a, const Contour& b) {
    return 0.5 * strain::dice(a.points, b.points) *
           (geometry::enclosed_area(a) + geometry::enclosed_area(b));
  };
  double sum = 0.0;
  int slices = 0;
  for (const Contour& epi : truth.short_axis) {
    const Contour* endo = geometry::find(truth.short_axis, epi.slice, Side::endo);
    const Contour* inner = geometry::find(found.short_axis, epi.slice, Side::endo);
    const Contour* outer = geometry::find(found.short_axis, epi.slice, Side::epi);
    if (epi.side != Side::epi || endo == nullptr || inner == nullptr || outer == nullptr)
      continue;
    // each endocardium lies in its epicardium
    const double both =
        common(*outer, epi) - common(*inner, epi) - common(*outer, *endo) + common(*inner, *endo);
    sum += 2.0 * both /
           (geometry::enclosed_area(*outer) - geometry::enclosed_area(*inner) +
            geometry::enclosed_area(epi) - geometry::enclosed_area(*endo));
    ++slices;
  }
  return sum / std::max(slices, 1);
}

phantom::Scan noisy_scan(std::uint32_t seed) {
  phantom::Scan scan;
  scan.phases = 8;
  scan.field_of_view = 150;
  scan.snr = 20.0;
  scan.shift = 3.0;
  scan.seed = seed;
  return scan;
}

KnownCine phantom_study(const std::string& name, const phantom::Scan& scan,
                        const phantom::Ventricle& v) {
  const phantom::ScanPlanes planes = phantom::planes(v, scan);
  const std::vector<double> times = phantom::phase_times(scan);
  KnownCine known{name, phantom::short_axis_cine(v, scan, planes), 0, 0, {}};
  const auto contracted = [](double a, double b) {
    return phantom::contraction(a) < phantom::contraction(b);
  };
  known.end_systole =
      static_cast<int>(std::max_element(times.begin(), times.end(), contracted) - times.begin());
  for (const int frame : {known.end_diastole, known.end_systole})
    known.truth[frame] = phantom::contours(v, scan, planes, times[static_cast<std::size_t>(frame)]);
  return known;
}

KnownCine phantom_study(const std::string& name, const phantom::Scan& scan, double trabeculae) {
  phantom::Ventricle v;
  v.papillary = 4.0;
  v.trabeculae = trabeculae;
  v.scar.transmurality = 0.0;
  return phantom_study(name, scan, v);
}

phantom::Ventricle hypertrophic(double wall, double papillary, double trabeculae) {
  phantom::Ventricle v;
  v.shape = {.endo_radius = 22.0,
             .endo_length = 62.0,
             .epi_radius = 22.0 + wall,
             .epi_length = 62.0 + wall};
  v.squeeze = 0.65;
  v.papillary = papillary;
  v.trabeculae = trabeculae;
  v.scar.transmurality = 0.0;
  return v;
}

std::optional<KnownCine> patient(const std::string& name, const std::string& images, int diastole,
                                 int systole) {
  const char* set = std::getenv("VENTRICLE_DATA");
  const std::filesystem::path folder =
      std::filesystem::path(set != nullptr ? set : LV_DATA_DIR) / name;
  if (!std::filesystem::exists(folder)) {
    fmt::print("{} skipped: no folder {}; set VENTRICLE_DATA to the folder that holds it\n", name,
               folder.string());
    return std::nullopt;
  }
  const image::DicomStudy study = image::read_dicom_study(std::array{folder / images});
  const image::DicomStack stack = image::choose_stack(study, {}, name, "series");
  const image::DrawnPhases drawn = image::read_sunnybrook(
      folder / "contours", stack, image::PixelOrigin::corner, image::DrawnBy::manual);
  KnownCine known{name, image::read_pixels(stack), diastole - 1, systole - 1, {}};
  for (const int phase : {diastole, systole})
    known.truth[phase - 1] = drawn.phases.at(phase);
  return known;
}

}  // namespace lv::test
