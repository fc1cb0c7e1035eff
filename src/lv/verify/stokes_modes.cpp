#include "lv/fluid/stokes.hpp"
#include "lv/verify/problems.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <random>

namespace lv::verify {
namespace {

using fluid::FaceField;
using fluid::Grid;

/// One component, or the pressure, over the whole box on the root, continued beyond the sides by
/// the reflections that the boundary conditions mean: even for points on the sides, odd for points
/// half a cell inside.
class BoxField {
 public:
  /// `component` 3: cell-centred.
  BoxField(const Grid& grid, int component, std::vector<double> values)
      : component_(component), values_(std::move(values)) {
    for (int d = 0; d < 3; ++d)
      points_[d] = grid.cells[d] + (d == component ? 1 : 0);
  }

  [[nodiscard]] int points(int d) const { return points_[d]; }

  [[nodiscard]] double at(std::array<int, 3> index) const {
    double sign = 1.0;
    for (int d = 0; d < 3; ++d) {
      const int last = points_[d] - 1;
      const int on_side = d == component_ ? 0 : 1;
      int& i = index[d];
      const bool outside = i < 0 || i > last;
      if (i < 0)
        i = -i - on_side;
      else if (i > last)
        i = 2 * last - i + on_side;
      if (outside && on_side == 1)
        sign = -sign;
    }
    const auto [i, j, k] = index;
    return sign * values_[(static_cast<std::size_t>(k) * points_[1] + j) * points_[0] + i];
  }

 private:
  int component_;
  std::array<int, 3> points_{};
  std::vector<double> values_;
};

std::array<int, 3> shifted(std::array<int, 3> index, int d, int by) {
  index[d] += by;
  return index;
}

/// Seven-point Laplacian.
double laplacian(const BoxField& u, const std::array<int, 3>& at, const Vec3& h) {
  double sum = 0.0;
  for (int d = 0; d < 3; ++d)
    sum += (u.at(shifted(at, d, 1)) - 2.0 * u.at(at) + u.at(shifted(at, d, -1))) / (h[d] * h[d]);
  return sum;
}

template <class Visit>
void for_points(const BoxField& u, const Visit& visit) {
  for (int k = 0; k < u.points(2); ++k)
    for (int j = 0; j < u.points(1); ++j)
      for (int i = 0; i < u.points(0); ++i)
        visit(std::array<int, 3>{i, j, k});
}

using BoxVector = std::vector<BoxField>;

BoxVector whole(const Grid& grid, const FaceField& field) {
  BoxVector result;
  for (int c = 0; c < 3; ++c)
    result.emplace_back(grid, c, fluid::gather(field.component[c]));
  return result;
}

/// Properties that give all terms of the equation the same size.
struct Properties {
  fluid::Blood blood{1e-6, 2e-3};
  double dt = 2e-4;   // rho/dt = 5e-3
  double drag = 4e3;  // rho c = 4e-3
};

struct Residuals {
  double momentum = 0.0;
  double continuity = 0.0;
};

/// Largest residual of
///   rho (u+ - u-)/dt + grad p - mu lap (u+ + u-)/2 + rho c (u+ + u-)/2 - f = 0,   div u+ = 0
/// over the largest sum of its terms' sizes.
Residuals residuals(const Grid& grid, const Properties& with, const BoxVector& before,
                    const BoxVector& after, const BoxField& p, const BoxVector& f) {
  const Vec3& h = grid.spacing;
  const auto& [rho, mu] = with.blood;
  double worst = 0.0;
  double scale = 0.0;
  for (int c = 0; c < 3; ++c) {
    for_points(after[c], [&](const std::array<int, 3>& at) {
      const double inertia = rho * (after[c].at(at) - before[c].at(at)) / with.dt;
      const double gradient = (p.at(at) - p.at(shifted(at, c, -1))) / h[c];
      const double viscous = 0.5 * mu * (laplacian(after[c], at, h) + laplacian(before[c], at, h));
      const double drag = 0.5 * rho * with.drag * (after[c].at(at) + before[c].at(at));
      worst = std::max(worst, std::abs(inertia + gradient - viscous + drag - f[c].at(at)));
      scale = std::max(scale, std::abs(inertia) + std::abs(gradient) + std::abs(viscous) +
                                  std::abs(drag) + std::abs(f[c].at(at)));
    });
  }
  double worst_divergence = 0.0;
  double divergence_scale = 0.0;
  for_points(p, [&](const std::array<int, 3>& at) {
    double divergence = 0.0;
    double size = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double slope = (after[c].at(shifted(at, c, 1)) - after[c].at(at)) / h[c];
      divergence += slope;
      size += std::abs(slope);
    }
    worst_divergence = std::max(worst_divergence, std::abs(divergence));
    divergence_scale = std::max(divergence_scale, size);
  });
  return {worst / scale, worst_divergence / divergence_scale};
}

/// Random values that do not depend on the number of ranks.
void fill_randomly(const Grid& grid, unsigned seed, FaceField& field) {
  for (int c = 0; c < 3; ++c) {
    std::vector<double> values;
    if (parallel::is_root()) {
      std::mt19937 generator(seed + c);
      std::uniform_real_distribution<double> uniform(-1.0, 1.0);
      values.resize(static_cast<std::size_t>(grid.points(c, 0)) * grid.points(c, 1) *
                    grid.points(c, 2));
      for (double& value : values)
        value = uniform(generator);
    }
    fluid::scatter(values, field.component[c]);
  }
}

/// Two steps from rest under random forces: the second one starts from a velocity without
/// divergence, so that all terms are there. Returns the second step's residuals; meaningful on the
/// root.
Residuals random_steps(const Grid& grid) {
  const Properties with;
  const fluid::Slab slab = fluid::slab_of(grid, parallel::rank(), parallel::size());
  fluid::BoxTransform transform(grid, slab);
  const fluid::Stokes stokes(grid, transform, with.blood);
  FaceField force(grid, slab);
  FaceField before(grid, slab);
  FaceField after(grid, slab);
  fluid::ModeField modes = transform.zero_modes();
  fluid::ModeField force_modes = transform.zero_modes();
  for (const unsigned seed : {10U, 20U}) {
    fill_randomly(grid, seed, force);
    transform.to_points(modes, before);
    transform.to_modes(force, force_modes);
    stokes.advance(modes, force_modes, with.dt, with.drag);
  }
  transform.to_points(modes, after);
  fluid::ComponentTransform centred(grid, slab, fluid::cell_centred);
  fluid::Component p(grid.cells[0], grid.cells[1], slab.planes.size());
  centred.to_points(stokes.pressure(force_modes, centred.layout()), p);

  const BoxVector f = whole(grid, force);
  const BoxVector u_before = whole(grid, before);
  const BoxVector u_after = whole(grid, after);
  const BoxField pressure(grid, fluid::cell_centred, fluid::gather(p));
  if (!parallel::is_root())
    return {};
  return residuals(grid, with, u_before, u_after, pressure, f);
}

}  // namespace

void stokes_modes(Findings& found) {
  constexpr double tolerance = 1e-11;  // rounding, times the transforms' length and condition
  const std::array<Grid, 4> grids{{{{16, 16, 16}, Vec3::Zero(), Vec3::Constant(1.5)},
                                   {{15, 17, 13}, Vec3::Zero(), Vec3::Constant(1.5)},
                                   {{18, 24, 20}, Vec3::Zero(), Vec3(1.5, 1.2, 2.0)},
                                   {{21, 14, 25}, Vec3::Zero(), Vec3(1.1, 1.7, 0.9)}}};
  for (const Grid& grid : grids) {
    const Residuals r = random_steps(grid);
    const std::string where =
        fmt::format("{} x {} x {}, mesh width {} x {} x {} mm, {} rank{}", grid.cells[0],
                    grid.cells[1], grid.cells[2], grid.spacing[0], grid.spacing[1], grid.spacing[2],
                    parallel::size(), parallel::size() == 1 ? "" : "s");
    found.add_error("momentum, " + where, r.momentum, tolerance);
    found.add_error("continuity, " + where, r.continuity, tolerance);
  }
}

}  // namespace lv::verify
