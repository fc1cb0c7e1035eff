#include "lv/mesh/folds.hpp"

#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;

/// A dilated, thin ventricle.
mesh::Mesh thin_wall() {
  const geometry::Ellipsoid e{33.0, 70.0, 39.0, 76.0, 24.0};
  return mesh::wall_mesh([e](double u, double theta, double t) { return e.point(u, theta, t); },
                         {.edge_length = 6.0, .layers = 1, .order = 1});
}

template <class Map>
mesh::Folds folds_of(const mesh::Mesh& wall, const Map& map) {
  std::vector<Vec3> nodes;
  for (const Vec3& X : wall.nodes)
    nodes.push_back(map(X));
  return mesh::FoldFinder(wall)(nodes);
}

}  // namespace

TEST_CASE("a wall that shrinks evenly has no folds", "[mesh]") {
  const mesh::Mesh wall = thin_wall();
  const mesh::Folds same = folds_of(wall, [](const Vec3& X) { return X; });
  CHECK(same.dent == 0.0);
  CHECK(same.approach == Approx(1.0));
  CHECK(same.stretch == Approx(1.0));
  const mesh::Folds shrunk =
      folds_of(wall, [](const Vec3& X) { return Vec3(0.6 * X.x(), 0.6 * X.y(), 0.8 * X.z()); });
  CHECK(shrunk.dent == 0.0);
  CHECK(shrunk.approach == Approx(0.6).epsilon(0.01));
  CHECK(shrunk.stretch == Approx(1.0 / 0.6));
  CHECK_FALSE(mesh::is_folded(shrunk));
}

TEST_CASE("a dent is found with its angle and place", "[mesh]") {
  const mesh::Mesh wall = thin_wall();
  const auto dented = [&](double depth) {
    return folds_of(wall, [depth](const Vec3& X) {
      const double z = (X.z() + 45.0) / 15.0;
      const double y = X.y() / 25.0;
      return X.x() > 0.0 ? Vec3(X.x() - depth * std::exp(-z * z - y * y), X.y(), X.z()) : X;
    });
  };
  const mesh::Folds slight = dented(5.0);
  const mesh::Folds deep = dented(15.0);
  CHECK_FALSE(mesh::is_folded(slight));
  CHECK(mesh::is_folded(deep));
  CHECK(deep.dent > 2.0 * slight.dent);
  CHECK(deep.dent_place.x() > 20.0);
  CHECK(deep.dent_place.z() == Approx(-45.0).margin(12.0));
  CHECK_FALSE(mesh::is_folded(deep, {.dent = 2.0}));
}

TEST_CASE("a wall that lies on itself is found", "[mesh]") {
  const mesh::Folds flat =
      folds_of(thin_wall(), [](const Vec3& X) { return Vec3(0.1 * X.x(), X.y(), X.z()); });
  CHECK(flat.approach < 0.15);
  CHECK(mesh::is_folded(flat));
}

TEST_CASE("muscle that would be stretched several times over is found", "[mesh]") {
  const mesh::Folds shortened =
      folds_of(thin_wall(), [](const Vec3& X) { return Vec3(X.x(), X.y(), 0.22 * X.z()); });
  CHECK(shortened.stretch == Approx(1.0 / 0.22));
  CHECK(mesh::is_folded(shortened));
}
