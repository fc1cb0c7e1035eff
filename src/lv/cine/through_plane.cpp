#include "lv/cine/through_plane.hpp"

#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/strain/reslice.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lv::cine {
namespace {

/// z along the long axis, origin in the endocardial apex.
geometry::Frame apical_frame(const strain::Orientation& o) {
  geometry::Frame frame;
  frame.origin = o.apex;
  frame.axes.col(2) = o.up;
  frame.axes.col(0) = o.up.unitOrthogonal();
  frame.axes.col(1) = o.up.cross(frame.axes.col(0));
  return frame;
}

std::vector<strain::LongAxisTask> views_of(const case_file::Case& c, const CineStudy& study) {
  std::vector<strain::LongAxisTask> views;
  for (const LongAxisView& view : study.long_axis) {
    const image::CineSlice& cine = view.cine.slices.front();
    views.push_back({&cine, static_cast<int>(drawn_frame(c, cine)), view.endo, view.epi});
  }
  return views;
}

/// The tasks' slices with their loops, moved to where the long axes put them.
std::vector<image::CineSlice> aligned(std::vector<strain::SliceTask>& tasks,
                                      const std::map<int, Vec3>& shift_of) {
  std::vector<image::CineSlice> stack;
  for (strain::SliceTask& task : tasks) {
    stack.push_back(*task.cine);
    const Vec3& shift = shift_of.at(task.endo.slice);
    if (shift.isZero())
      continue;
    for (image::Picture& picture : stack.back().frames)
      picture = strain::moved(picture, shift);
    for (geometry::Contour* loop : {&task.endo, &task.epi})
      for (Vec3& x : loop->points)
        x += shift;
  }
  return stack;
}

}  // namespace

std::optional<ThroughPlane> follow_through_planes(const case_file::Case& c, const CineStudy& study,
                                                  std::vector<strain::SliceTask> tasks) {
  if (study.long_axis.empty())
    return {};
  const geometry::Frame frame = apical_frame(study.orientation);
  const auto images = static_cast<int>(tasks.front().cine->frames.size());
  ThroughPlane through{{views_of(c, study), frame, images, c.strain.registration}, {}, {}, {}};
  const std::vector<image::CineSlice> stack = aligned(tasks, study.shift_of);
  const Vec3 normal = stack.front().frames.front().plane.normal();
  const double sense = normal.dot(study.orientation.up) > 0.0 ? 1.0 : -1.0;
  Progress progress("taking images of the muscle", tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    strain::MuscleSlice muscle = strain::follow_muscle(
        stack, i, tasks[i].drawn,
        [&](const Vec3& X, int step) { return sense * through.axial(X, step); });
    const Vec3 centre = geometry::mean_of(tasks[i].endo.points);
    through.slices.push_back(
        {tasks[i].endo.slice, centre, frame.to_model(centre).z(), muscle.beyond});
    through.images.push_back(std::move(muscle.images));
    progress.add();
  }
  through.tasks = std::move(tasks);
  for (std::size_t i = 0; i < through.tasks.size(); ++i)
    through.tasks[i].cine = &through.images[i];
  return through;
}

Table axial_table(const ThroughPlane& through) {
  Table table({"slice", "phase", "height_mm", "axial_displacement_mm", "residual_mm"});
  const auto number = [](double x) { return Table::number(x, 5); };
  for (std::size_t i = 0; i < through.slices.size(); ++i) {
    const strain::SliceTask& task = through.tasks[i];
    const auto images = static_cast<int>(task.phases.size());
    for (int k = 0; k < images; ++k) {
      const int step = (k - task.drawn + images) % images;
      table.add_row({std::to_string(through.slices[i].slice), std::to_string(task.phases[k]),
                     number(through.slices[i].height),
                     number(through.axial(through.slices[i].centre, step)),
                     number(through.axial.residual(step))});
    }
  }
  return table;
}

Table base_motion_table(const ThroughPlane& through, const strain::Orientation& o,
                        const std::vector<double>& rotation) {
  const AxialSlice& basal = *std::max_element(
      through.slices.begin(), through.slices.end(),
      [](const AxialSlice& a, const AxialSlice& b) { return a.height < b.height; });
  const Vec3 middle = basal.centre + (o.base - basal.centre).dot(o.up) * o.up;
  const auto across = [&](const Vec3& x) { return Vec3(x - x.dot(o.up) * o.up); };
  const Vec3 septum = across(o.septum - middle).normalized();
  const Vec3 anterior = o.up.cross(septum);
  Table table({"cycle_share", "axial_mm", "septal_tilt_deg", "anterior_tilt_deg", "rotation_deg"});
  const auto number = [](double x) { return Table::number(x, 5); };
  const auto images = static_cast<int>(rotation.size());
  for (int k = 0; k < images; ++k) {
    const double u = through.axial(middle, k);
    const auto tilt = [&](const Vec3& towards) {  // u is linear across the axis
      return number(std::atan(u - through.axial(middle + towards, k)) / units::degree);
    };
    table.add_row({number(static_cast<double>(k) / images), number(0.0 - u), tilt(septum),
                   tilt(anterior), number(rotation[static_cast<std::size_t>(k)] / units::degree)});
  }
  return table;
}

std::string words_of(const ThroughPlane& through, int systole) {
  constexpr double little = 0.5;  // [mm]
  const strain::SliceTask& task = through.tasks.front();
  const auto images = static_cast<int>(task.phases.size());
  const auto phase = std::find(task.phases.begin(), task.phases.end(), systole);
  const int step = (static_cast<int>(phase - task.phases.begin()) - task.drawn + images) % images;
  const auto lowest = [](const AxialSlice& a, const AxialSlice& b) { return a.height < b.height; };
  const auto [apical, basal] =
      std::minmax_element(through.slices.begin(), through.slices.end(), lowest);
  const double u_apical = through.axial(apical->centre, step);
  const double u_basal = through.axial(basal->centre, step);
  std::string text = fmt::format(
      "muscle moves along the axis by {:.1f} mm (slice {}) and {:.1f} mm (slice {}) until "
      "end-systole, {:+.1f}% of the length between; it was followed through the planes, strain and "
      "rotation are of muscle\n",
      u_basal, basal->slice, u_apical, apical->slice,
      100.0 * (u_basal - u_apical) / (basal->height - apical->height));
  for (const AxialSlice& s : through.slices)
    if (s.beyond > little)
      text += fmt::format(
          "note: muscle of slice {} leaves the slices with contours by {:.1f} mm; beyond the last "
          "one nothing was seen of it\n",
          s.slice, s.beyond);
  return text;
}

}  // namespace lv::cine
