#include "lv/page/opening.hpp"

#include "lv/analysis/quantities.hpp"
#include "lv/base/nearest.hpp"
#include "lv/drawing/canvas.hpp"
#include "lv/drawing/wall_surface.hpp"
#include "lv/mesh/curved.hpp"
#include "lv/report/work_folder.hpp"

#include <algorithm>
#include <cmath>

namespace lv::page {
namespace {

/// The page's camera (web/src/wall_view.ts).
drawing::Camera camera_of(const Reach& reach, const Vec3& view) {
  constexpr double margin = 2.0;  // [mm]
  const double width = 2.0 * (reach.radius + margin);
  // a base seen from above is an ellipse
  const double height = reach.top - reach.bottom + width * std::abs(view.z());
  return {.view = view,
          .centre = {0.0, 0.0, 0.5 * (reach.bottom + reach.top)},
          .width = width,
          .height = height};
}

/// How far the quantity's percentiles over the whole wall lie from its middle; 0 without results.
double most_off_middle(const std::filesystem::path& work, const analysis::Quantity& quantity) {
  const auto regions = report::table_of(work, "results", "regions.csv");
  if (!regions)
    return 0.0;
  const auto scheme = regions->words("scheme");
  const auto name = regions->words("quantity");
  const auto low = regions->numbers("p1");
  const auto high = regions->numbers("p99");
  double most = 0.0;
  for (std::size_t i = 0; i < scheme.size(); ++i)
    if (scheme[i] == "whole" && name[i] == quantity.name)
      for (const double value : {low[i], high[i]})
        if (std::isfinite(value))
          most = std::max(most, std::abs(value - quantity.middle));
  return most;
}

double at_share(const Course& c, double share) {
  return c.times.front() + share * (c.times.back() - c.times.front());
}

/// Of the slider's even steps through a beat, the one that is nearest to its end-systole.
double opening_share(const Course& c) {
  constexpr double steps = 80.0;
  const double span = c.times.back() - c.times.front();
  if (!c.end_systole || !(span > 0.0))
    return 0.0;
  const double share = (*c.end_systole - c.times.front()) / span;
  return std::clamp(std::round(steps * share) / steps, 0.0, 1.0);
}

}  // namespace

std::optional<drawing::ColourScale> opening_scale(const std::vector<std::filesystem::path>& works) {
  const analysis::Quantity& quantity = analysis::quantity(opening_quantity);
  double most = 0.0;
  for (const std::filesystem::path& work : works)
    most = std::max(most, most_off_middle(work, quantity));
  if (most <= 0.0)
    return {};
  return drawing::ColourScale{drawing::diverging(), quantity.middle - most, quantity.middle + most,
                              quantity.middle, quantity.floor};
}

std::vector<std::optional<std::size_t>> opening_frames(const std::vector<Course>& cases) {
  const auto all = [&](const auto& holds) {
    return std::all_of(cases.begin(), cases.end(), holds);
  };
  const bool are_beats =
      cases.size() > 1 && all([](const Course& c) { return c.has_beats && !c.times.empty(); });
  const bool all_contract = all([](const Course& c) {
    constexpr double rounding = 1e-5;  // of times in a series [s]
    return c.end_systole && (c.times.empty() || *c.end_systole <= c.times.back() + rounding);
  });
  const double share = are_beats ? opening_share(cases.front()) : 0.0;
  std::vector<std::optional<std::size_t>> frames;
  for (const Course& c : cases)
    if (c.times.empty())
      frames.emplace_back();
    else if (are_beats)
      frames.emplace_back(nearest_number(at_share(c, share), c.times));
    else
      frames.emplace_back(all_contract ? nearest_number(*c.end_systole, c.times)
                                       : c.times.size() - 1);
  return frames;
}

Opening opening(const WallSeries& wall, int order, std::size_t frame, const NamedView& view,
                const drawing::Orientation& orientation, const drawing::ColourScale& scale) {
  constexpr double pixels_per_mm = 5.0;
  const mesh::CurvedMesh curved = mesh::curved(wall.mesh(order));
  const std::vector<Vec3> x = curved.at_nodes(wall.positions(frame));
  const std::vector<float>& field = wall.quantities.at(opening_quantity)[frame];
  const std::vector<double> values =
      curved.at_nodes(std::vector<double>(field.begin(), field.end()));
  const std::vector<double> infarct =
      has_infarct(wall)
          ? curved.at_nodes(std::vector<double>(wall.infarct.begin(), wall.infarct.end()))
          : std::vector<double>{};
  const auto item = [&](const drawing::WallPatch& patch, bool is_shaded) {
    return drawing::Item{.patch = patch.patch,
                         .paint = drawing::PointValues{patch.at_points(values), scale},
                         .shaded = is_shaded,
                         .border = infarct.empty() ? infarct : patch.at_points(infarct)};
  };
  drawing::Scene scene{
      .items = {item(drawing::wall_surface(curved.mesh, x, curved.mesh.epi), true)}};
  if (view.opened == Opened::long_axis) {
    scene.cut = view.cut(orientation);
    scene.items.push_back(item(drawing::wall_section(curved.mesh, x, *scene.cut), false));
  }
  const drawing::Camera camera = camera_of(wall.reach, view.view(orientation));
  const auto pixels = [&](double mm) { return static_cast<int>(std::lround(mm * pixels_per_mm)); };
  // the page shows it at about half its size
  const drawing::Image image = drawing::render(
      scene, camera,
      {.width = pixels(camera.width), .height = pixels(camera.height), .pixels_per_point = 2.0});
  return {drawing::image_png(image), image.width * image.mm_per_pixel};
}

}  // namespace lv::page
