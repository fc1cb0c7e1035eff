#include "lv/mesh_io/foreign_fibres.hpp"

#include "lv/base/check.hpp"
#include "lv/base/units.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lv::mesh_io {
namespace {

constexpr double square_enough = 1.0 * units::degree;
constexpr double least_angle = 5.0 * units::degree;  // between fibres and sheets

/// Throws if any direction is bad; `what` says what they then are.
void refuse(const ForeignMesh& foreign, const std::vector<bool>& bad, const std::string& what,
            const std::string& remedy) {
  const auto count = std::count(bad.begin(), bad.end(), true);
  if (count == 0)
    return;
  const int first = static_cast<int>(std::find(bad.begin(), bad.end(), true) - bad.begin());
  const bool in_cells = foreign.mesh.fibres.given.at == mesh::GivenFibres::At::cells;
  throw InputError(
      in_cells ? foreign.where_cell(first) : foreign.where_node(first),
      fmt::format("{} of the {} directions of {}, the first at {}", count, bad.size(), what,
                  in_cells ? foreign.name_cell(first) : foreign.name_node(first)),
      remedy);
}

void normalise(const ForeignMesh& foreign, const std::string& name, std::vector<Vec3>& directions) {
  std::vector<bool> bad;
  for (Vec3& direction : directions) {
    const double length = direction.stableNorm();
    bad.push_back(!(length > 0.0 && std::isfinite(length)));
    direction /= length;
  }
  refuse(
      foreign, bad, name + " are zero or no numbers",
      "Every place needs a direction; without anatomy.mesh.fibres and sheets they follow a rule");
}

/// The angle between two lines [rad].
double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

}  // namespace

void make_orthonormal(ForeignMesh& foreign) {
  mesh::GivenFibres& fibres = foreign.mesh.fibres.given;
  normalise(foreign, "fibres", fibres.f0);
  normalise(foreign, "sheets", fibres.s0);
  std::vector<bool> along;
  double worst = 0.0;
  for (std::size_t i = 0; i < fibres.s0.size(); ++i) {
    const double angle = angle_between(fibres.f0[i], fibres.s0[i]);
    along.push_back(angle < least_angle);
    worst = std::max(worst, std::numbers::pi / 2 - angle);
    fibres.s0[i] = (fibres.s0[i] - fibres.s0[i].dot(fibres.f0[i]) * fibres.f0[i]).normalized();
  }
  refuse(foreign, along, "sheets lie along the fibres",
         "Name the direction across the fibres in the sheets, or leave anatomy.mesh.sheets out");
  if (worst > square_enough)
    foreign.notes.push_back(
        fmt::format("sheets were up to {:.1f} degrees off the normals of the fibres: their part "
                    "normal to the fibres is used",
                    worst / units::degree));
}

}  // namespace lv::mesh_io
