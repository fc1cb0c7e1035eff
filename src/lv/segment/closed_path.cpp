#include "lv/segment/closed_path.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace lv::segment {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The least of reached(j) + stiffness (k - j)^2 over the neighbours j of every k, and its j.
struct Step {
  Eigen::ArrayXd cost;
  Eigen::ArrayXi from;
};

Step step(const Eigen::ArrayXd& reached, const PathRule& rule) {
  const int n = static_cast<int>(reached.size());
  Step best{Eigen::ArrayXd::Constant(n, never), Eigen::ArrayXi::Zero(n)};
  for (int k = 0; k < n; ++k)
    for (int j = std::max(k - rule.reach, 0); j <= std::min(k + rule.reach, n - 1); ++j)
      if (const double cost = reached(j) + rule.stiffness * (k - j) * (k - j);
          cost < best.cost(k)) {
        best.cost(k) = cost;
        best.from(k) = j;
      }
  return best;
}

/// The cost of the best open path from each radius of the first ray.
Eigen::ArrayXd open_costs(const Polar& cost, const PathRule& rule) {
  Eigen::ArrayXd reached = cost.row(cost.rows() - 1).transpose();
  for (Eigen::Index i = cost.rows() - 2; i >= 0; --i)
    reached = step(reached, rule).cost + cost.row(i).transpose();
  return reached;
}

struct Path {
  std::vector<int> radii;
  double cost = never;
};

/// The best closed path that begins at a radius.
Path path_from(int start, const Polar& cost, const PathRule& rule) {
  const auto rays = cost.rows();
  std::vector<Eigen::ArrayXi> from;
  Eigen::ArrayXd reached = Eigen::ArrayXd::Constant(cost.cols(), never);
  reached(start) = cost(0, start);
  for (Eigen::Index i = 1; i < rays; ++i) {
    Step next = step(reached, rule);
    reached = next.cost + cost.row(i).transpose();
    from.push_back(std::move(next.from));
  }
  const Step closing = step(reached, rule);
  Path path{std::vector<int>(static_cast<std::size_t>(rays), start), closing.cost(start)};
  int k = closing.from(start);
  for (Eigen::Index i = rays - 1; i > 0; --i) {
    path.radii[static_cast<std::size_t>(i)] = k;
    k = from[static_cast<std::size_t>(i - 1)](k);
  }
  return path;
}

/// The reach with which a path can run through all, in order of their rays.
int reach_through(const std::vector<Fixed>& fixed, int rays, int least) {
  int reach = least;
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const Fixed& next = fixed[(i + 1) % fixed.size()];
    const int apart = (next.ray - fixed[i].ray + rays - 1) % rays + 1;
    reach = std::max(reach, (std::abs(next.k - fixed[i].k) + apart - 1) / apart);
  }
  return reach;
}

/// More than two paths can differ by.
double any_difference(const Polar& cost, const PathRule& rule) {
  const double of_steps = rule.stiffness * rule.reach * rule.reach;
  return 1.0 + static_cast<double>(cost.rows()) * of_steps +
         (cost.rowwise().maxCoeff() - cost.rowwise().minCoeff()).sum();
}

}  // namespace

std::vector<int> open_path(const Polar& cost, const PathRule& rule) {
  std::vector<Eigen::ArrayXi> from;
  Eigen::ArrayXd reached = cost.row(0).transpose();
  for (Eigen::Index i = 1; i < cost.rows(); ++i) {
    Step next = step(reached, rule);
    reached = next.cost + cost.row(i).transpose();
    from.push_back(std::move(next.from));
  }
  std::vector<int> path(static_cast<std::size_t>(cost.rows()));
  reached.minCoeff(&path.back());
  for (std::size_t i = path.size() - 1; i > 0; --i)
    path[i - 1] = from[i - 1](path[i]);
  return path;
}

std::vector<int> closed_path(const Polar& cost, const PathRule& rule) {
  const Eigen::ArrayXd bounds = open_costs(cost, rule);
  std::vector<int> starts(static_cast<std::size_t>(bounds.size()));
  std::iota(starts.begin(), starts.end(), 0);
  std::sort(starts.begin(), starts.end(), [&](int a, int b) { return bounds(a) < bounds(b); });
  Path best;
  for (const int start : starts) {
    if (bounds(start) >= best.cost)
      break;
    if (Path path = path_from(start, cost, rule); path.cost < best.cost)
      best = std::move(path);
  }
  return best.radii;
}

std::vector<int> closed_path(Polar cost, PathRule rule, const std::vector<Fixed>& fixed) {
  if (fixed.empty())
    return closed_path(cost, rule);
  const auto rays = static_cast<int>(cost.rows());
  rule.reach = reach_through(fixed, rays, rule.reach);
  const double forbidden = cost.maxCoeff() + any_difference(cost, rule);
  for (const Fixed& at : fixed) {
    const double own = cost(at.ray, at.k);
    cost.row(at.ray).setConstant(forbidden);
    cost(at.ray, at.k) = own;
  }
  // a path that begins on a ray whose radius is known is found at once
  const int first = fixed.front().ray;
  Polar turned(cost.rows(), cost.cols());
  turned << cost.bottomRows(rays - first), cost.topRows(first);
  std::vector<int> radii = path_from(fixed.front().k, turned, rule).radii;
  std::rotate(radii.begin(), radii.end() - first, radii.end());
  return radii;
}

Radii closed_path(const Polar& cost, const PathRule& rule, const PolarGrid& grid,
                  const std::vector<Fixed>& fixed) {
  const std::vector<int> path = closed_path(cost, rule, fixed);
  Radii radii(cost.rows());
  for (Eigen::Index i = 0; i < radii.size(); ++i)
    radii(i) = grid.radius(path[static_cast<std::size_t>(i)]);
  return radii;
}

}  // namespace lv::segment
