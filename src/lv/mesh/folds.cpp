#include "lv/mesh/folds.hpp"

#include "lv/mesh/cell.hpp"
#include "lv/mesh/surface.hpp"

#include <Eigen/SVD>

#include <algorithm>

namespace lv::mesh {
namespace {

// distances of two faces in the smooth wall, in units of its thickness
constexpr double piece_from = 1.5;
constexpr double piece_to = 3.0;
constexpr double apart = 4.0;

double mean_thickness(const Mesh& mesh) {
  double volume = 0.0;
  for (int c = 0; c < mesh.cell_count(); ++c)
    volume += cell_volume(mesh, c);
  return 2.0 * volume / (area(mesh.nodes, mesh.endo) + area(mesh.nodes, mesh.epi));
}

/// Largest principal stretch of the cells from `nodes` to the smooth wall, by their mean F.
double largest_stretch(const Mesh& smooth, std::span<const Vec3> nodes) {
  Mesh moved = smooth;
  moved.nodes.assign(nodes.begin(), nodes.end());
  std::array<std::vector<double>, 3> x;
  for (const Vec3& node : smooth.nodes)
    for (std::size_t i = 0; i < 3; ++i)
      x[i].push_back(node[static_cast<Eigen::Index>(i)]);
  double largest = 1.0;
  for (int c = 0; c < moved.cell_count(); ++c) {
    Eigen::Matrix3d F;
    for (std::size_t i = 0; i < 3; ++i)
      F.row(static_cast<Eigen::Index>(i)) = mean_gradient(moved, c, x[i]).transpose();
    largest = std::max(largest, F.jacobiSvd().singularValues()[0]);
  }
  return largest;
}

}  // namespace

bool is_folded(const Folds& folds, const FoldLimits& limits) {
  return folds.dent > limits.dent || folds.approach < limits.approach ||
         folds.stretch > limits.stretch;
}

FoldFinder::FoldFinder(const Mesh& smooth)
    : smooth_(smooth),
      thickness_(mean_thickness(smooth)),
      sides_{side(smooth.nodes, smooth.endo, -1.0), side(smooth.nodes, smooth.epi, 1.0)} {}

FoldFinder::Side FoldFinder::side(std::span<const Vec3> nodes, const Surface& surface,
                                  double sign) const {
  Side s{&surface, sign, {}, {}};
  for (int f = 0; f < surface.size(); ++f) {
    s.centre.push_back(face_centre(nodes, surface.face(f)));
    s.normal.emplace_back(sign * area_vector(nodes, surface.face(f)).normalized());
  }
  return s;
}

Folds FoldFinder::operator()(std::span<const Vec3> nodes) const {
  Folds folds;
  for (const Side& smooth : sides_)
    compare(smooth, side(nodes, *smooth.surface, smooth.sign), folds);
  folds.stretch = largest_stretch(smooth_, nodes);
  return folds;
}

void FoldFinder::compare(const Side& smooth, const Side& now, Folds& folds) const {
  const auto turn = [](const Side& s, std::size_t i, std::size_t j) {
    return (s.normal[j] - s.normal[i]).dot((s.centre[j] - s.centre[i]).normalized());
  };
  for (std::size_t i = 0; i < smooth.centre.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = (smooth.centre[j] - smooth.centre[i]).norm();
      if (distance > apart * thickness_) {
        const double ratio = (now.centre[j] - now.centre[i]).norm() / distance;
        if (ratio < folds.approach) {
          folds.approach = ratio;
          folds.approach_place = smooth.centre[i];
        }
      } else if (distance > piece_from * thickness_ && distance < piece_to * thickness_) {
        const double b = turn(now, i, j);
        const double dent = std::min(-b, turn(smooth, i, j) - b);
        if (dent > folds.dent) {
          folds.dent = dent;
          folds.dent_place = smooth.centre[i];
        }
      }
    }
}

}  // namespace lv::mesh
