#include "lv/implicit/smooth_fields.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

namespace {

using namespace lv;

std::vector<Vec3> cloud() {
  std::vector<Vec3> all;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      for (int k = 0; k < 5; ++k)
        all.emplace_back(10.0 * i - 20.0, 9.0 * j - 15.0, -12.0 * k);
  return all;
}

template <class Map>
Eigen::VectorXd field(const Map& map) {
  const std::vector<Vec3> X = cloud();
  Eigen::VectorXd u(static_cast<Eigen::Index>(3 * X.size()));
  for (std::size_t a = 0; a < X.size(); ++a)
    u.segment<3>(static_cast<Eigen::Index>(3 * a)) = map(X[a]);
  return u;
}

}  // namespace

TEST_CASE("smooth fields hold polynomials of their degree that keep the base plane", "[implicit]") {
  const auto affine = field([](const Vec3& X) {
    return Vec3(1.0 + 0.2 * X.x() - 0.1 * X.z(), -0.3 * X.y(), 0.1 * X.z());
  });
  const auto quadratic =
      field([](const Vec3& X) { return Vec3(0.01 * X.x() * X.z(), 0.0, 0.02 * X.z() * X.y()); });
  const implicit::SmoothFields first(cloud(), 1);
  const implicit::SmoothFields second(cloud(), 2);
  CHECK((first.nearest(affine) - affine).norm() < 1e-10 * affine.norm());
  CHECK((second.nearest(affine) - affine).norm() < 1e-10 * affine.norm());
  CHECK((second.nearest(quadratic) - quadratic).norm() < 1e-10 * quadratic.norm());
  CHECK((first.nearest(quadratic) - quadratic).norm() > 0.1 * quadratic.norm());
}

TEST_CASE("the nearest smooth field leaves what is across to all of them", "[implicit]") {
  const auto rough =
      field([](const Vec3& X) { return Vec3(std::sin(X.x()), std::cos(X.y() * X.z()), X.z()); });
  const implicit::SmoothFields fields(cloud(), 3);
  const Eigen::VectorXd near = fields.nearest(rough);
  CHECK((fields.nearest(near) - near).norm() < 1e-10 * near.norm());
  CHECK(std::abs((rough - near).dot(near)) < 1e-10 * rough.squaredNorm());
  const auto base = field([](const Vec3&) { return Vec3(0.0, 0.0, 1.0); });
  const Eigen::VectorXd moved = fields.nearest(base);
  for (std::size_t a = 0; a < cloud().size(); ++a)
    if (cloud()[a].z() == 0.0)
      CHECK(std::abs(moved[static_cast<Eigen::Index>(3 * a + 2)]) < 1e-12);
}
