#include "lv/page/views.hpp"

#include "lv/base/units.hpp"
#include "lv/drawing/wall_surface.hpp"

#include <algorithm>

namespace lv::page {
namespace {

/// Horizontal unit vector at an angle from the septum [deg].
Vec3 across(const drawing::Orientation& orientation, double angle) {
  const double a = angle * units::degree;
  return std::cos(a) * orientation.septal() + std::sin(a) * orientation.anterior();
}

/// Black where a patch is infarcted, white elsewhere.
drawing::Item marked(const drawing::WallPatch& patch, const std::vector<double>& infarct) {
  const std::vector<double> M = patch.at_points(infarct);
  drawing::FaceColours colours;
  for (const auto& [a, b, c] : patch.patch.triangles)
    colours.emplace_back(drawing::hex(M[a] + M[b] + M[c] > 1.5 ? 0x000000 : 0xffffff));
  return {.patch = patch.patch, .paint = std::move(colours), .shaded = false};
}

/// The black part of a scene [mm²].
double black_area(const drawing::Scene& scene, const Vec3& view) {
  constexpr int pixels = 200;  // about a millimetre each
  const drawing::Image image = drawing::render(
      scene, drawing::fitted(scene, view), {.width = pixels, .height = pixels, .supersampling = 1});
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      count += image.opacity(x, y) > 0.5 && image.colour(x, y).r < 0.5 ? 1 : 0;
  return count * image.mm_per_pixel * image.mm_per_pixel;
}

}  // namespace

Vec3 NamedView::view(const drawing::Orientation& orientation) const {
  const double up = elevation * units::degree;
  return -std::cos(up) * across(orientation, azimuth) - std::sin(up) * Vec3::UnitZ();
}

drawing::Plane NamedView::cut(const drawing::Orientation& orientation) const {
  const Vec3 normal = across(orientation, plane + 90.0);
  return {Vec3::Zero(), normal.dot(view(orientation)) < 0.0 ? normal : Vec3(-normal)};
}

bool has_infarct(const WallSeries& wall) {
  return std::any_of(wall.infarct.begin(), wall.infarct.end(), [](float M) { return M > 0.5F; });
}

std::vector<double> infarct_shown(const WallSeries& wall, std::size_t frame,
                                  const drawing::Orientation& orientation) {
  std::vector<double> shown(views.size(), 0.0);
  if (!has_infarct(wall))
    return shown;
  const std::vector<double> M(wall.infarct.begin(), wall.infarct.end());
  const mesh::Mesh mesh = wall.mesh();
  const std::vector<Vec3> x = wall.positions(frame);
  const drawing::Item surface = marked(drawing::wall_surface(mesh, x, mesh.epi), M);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!views[i].is_from_the_side())
      continue;
    drawing::Scene scene{.items = {surface}};
    if (views[i].opened == Opened::long_axis) {
      scene.cut = views[i].cut(orientation);
      scene.items.push_back(marked(drawing::wall_section(mesh, x, *scene.cut), M));
    }
    shown[i] = black_area(scene, views[i].view(orientation));
  }
  return shown;
}

std::size_t opening_view(std::span<const double> shown) {
  const auto most = [&](auto&& counts) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < shown.size(); ++i)
      if (counts(views[i]) && shown[i] > shown[best])
        best = i;
    return best;
  };
  const std::size_t any = most([](const NamedView&) { return true; });
  const std::size_t open =
      most([](const NamedView& view) { return view.opened == Opened::long_axis; });
  return shown[open] >= 0.5 * shown[any] ? open : any;
}

}  // namespace lv::page
