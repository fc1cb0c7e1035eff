#include "lv/fluid/stokes.hpp"

#include <numbers>

namespace lv::fluid {
namespace {

std::vector<double> wave_numbers(int cells, double spacing) {
  std::vector<double> k(cells + 1);
  for (int m = 0; m <= cells; ++m)
    k[m] = 2.0 / spacing * std::sin(std::numbers::pi * m / (2.0 * cells));
  return k;
}

/// One row of modes: fixed m_z and m_x, all m_y. The pointers are to m_y = 1, except the y
/// component's, to m_y = 0.
struct Row {
  double* u[3];
  const double* f[3];
};

/// The Helmholtz factors of one row: u* = (a u + b f) / (a + damping k^2 ...), see Stokes::advance.
struct Factors {
  double inertia;    ///< rho/dt
  double half_drag;  ///< rho c/2
  double half_mu;    ///< mu/2
  double scale;      ///< normalisation of the force

  [[nodiscard]] double advance(double u, double f, double k2) const {
    const double damping = half_mu * k2 + half_drag;
    return ((inertia - damping) * u + scale * f) / (inertia + damping);
  }
};

}  // namespace

Stokes::Stokes(const Grid& grid, const BoxTransform& transform, Blood blood)
    : blood_(blood),
      layout_{transform.layout(0), transform.layout(1), transform.layout(2)},
      wave_{wave_numbers(grid.cells[0], grid.spacing[0]),
            wave_numbers(grid.cells[1], grid.spacing[1]),
            wave_numbers(grid.cells[2], grid.spacing[2])},
      normalisation_(1.0 / (8.0 * grid.cells[0] * grid.cells[1] * grid.cells[2])) {}

namespace {

/// Pointer to mode (m_x, m_y, m_z) of one component.
template <class Values>
auto* mode_at(Values& values, const ModeLayout& l, int mx, int my, int mz) {
  const std::size_t row = static_cast<std::size_t>(mz - l.first_z) * l.count_x + (mx - l.first_x);
  return values.data() + row * l.count_y + (my - l.first_y);
}

/// Modes that the divergence does not see (their own wave number is zero): Helmholtz alone.
void advance_alone(double* u, const double* f, int count, double k2_others, const double* wave,
                   const Factors& factors) {
  for (int i = 0; i < count; ++i)
    u[i] = factors.advance(u[i], f[i], k2_others + wave[i] * wave[i]);
}

/// Helmholtz, then the projection onto divergence-free modes: u -= k (k.u)/k^2.
void advance_coupled(const Row& row, int count, double kx, double kz, const double* ky,
                     const Factors& factors) {
  for (int i = 0; i < count; ++i) {
    const double k2 = kx * kx + ky[i] * ky[i] + kz * kz;
    const double u = factors.advance(row.u[0][i], row.f[0][i], k2);
    const double v = factors.advance(row.u[1][i], row.f[1][i], k2);
    const double w = factors.advance(row.u[2][i], row.f[2][i], k2);
    const double potential = (kx * u + ky[i] * v + kz * w) / k2;
    row.u[0][i] = u - kx * potential;
    row.u[1][i] = v - ky[i] * potential;
    row.u[2][i] = w - kz * potential;
  }
}

}  // namespace

void Stokes::advance(ModeField& velocity, const ModeField& force, double dt, double drag) const {
  const Factors factors{blood_.density / dt, 0.5 * blood_.density * drag, 0.5 * blood_.viscosity,
                        normalisation_};
  const int my_count = layout_[0].count_y;
  const double* ky = wave_[1].data() + 1;
  const auto u = [&](int c, int mx, int my, int mz) {
    return mode_at(velocity[c], layout_[c], mx, my, mz);
  };
  const auto f = [&](int c, int mx, int my, int mz) {
    return mode_at(force[c], layout_[c], mx, my, mz);
  };

  const int first_x = layout_[1].first_x;
  const int end_x = first_x + layout_[1].count_x;
  for (int mz = 0; mz <= layout_[0].count_z; ++mz) {
    const double kz = wave_[2][mz];
    if (mz > 0 && layout_[0].first_x == 0)
      advance_alone(u(0, 0, 1, mz), f(0, 0, 1, mz), my_count, kz * kz, ky, factors);
    for (int mx = first_x; mx < end_x; ++mx) {
      const double kx = wave_[0][mx];
      if (mz == 0) {
        advance_alone(u(2, mx, 1, 0), f(2, mx, 1, 0), my_count, kx * kx, ky, factors);
        continue;
      }
      advance_alone(u(1, mx, 0, mz), f(1, mx, 0, mz), 1, kx * kx + kz * kz, wave_[1].data(),
                    factors);
      const Row row{{u(0, mx, 1, mz), u(1, mx, 1, mz), u(2, mx, 1, mz)},
                    {f(0, mx, 1, mz), f(1, mx, 1, mz), f(2, mx, 1, mz)}};
      advance_coupled(row, my_count, kx, kz, ky, factors);
    }
  }
}

AlignedValues Stokes::pressure(const ModeField& force, const ModeLayout& layout) const {
  AlignedValues p(layout.size());
  const auto f = [&](int c, int mx, int my, int mz) {
    return *mode_at(force[c], layout_[c], mx, my, mz);
  };
  for (int mz = 1; mz <= layout.count_z; ++mz) {
    for (int mx = layout.first_x; mx < layout.first_x + layout.count_x; ++mx) {
      for (int my = 1; my <= layout.count_y; ++my) {
        const double kx = wave_[0][mx];
        const double ky = wave_[1][my];
        const double kz = wave_[2][mz];
        const double divergence =
            kx * f(0, mx, my, mz) + ky * f(1, mx, my, mz) + kz * f(2, mx, my, mz);
        *mode_at(p, layout, mx, my, mz) =
            normalisation_ * divergence / (kx * kx + ky * ky + kz * kz);
      }
    }
  }
  return p;
}

}  // namespace lv::fluid
