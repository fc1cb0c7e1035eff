#include "lv/segment/closed_path.hpp"

#include <algorithm>
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

}  // namespace

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

Radii closed_path(const Polar& cost, const PathRule& rule, const PolarGrid& grid) {
  const std::vector<int> path = closed_path(cost, rule);
  Radii radii(cost.rows());
  for (Eigen::Index i = 0; i < radii.size(); ++i)
    radii(i) = grid.radius(path[static_cast<std::size_t>(i)]);
  return radii;
}

}  // namespace lv::segment
