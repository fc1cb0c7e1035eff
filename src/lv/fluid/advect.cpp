#include "lv/fluid/advect.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace lv::fluid {
namespace {

/// Flux a q through the side between points 0 and 1 of q: fourth-order central value plus |a| times
/// the dissipation that makes it the third-order upwind-biased one.
inline double flux(double a, double q_minus, double q0, double q1, double q2) {
  const double central = 7.0 * (q0 + q1) - (q_minus + q2);
  const double upwind = (q2 - q_minus) - 3.0 * (q1 - q0);
  return (a * central + std::abs(a) * upwind) * (1.0 / 12.0);
}

/// Fluxes of component c in direction d for one row of points: side i lies between point i and its
/// neighbour along d.
struct FluxRow {
  FluxRow(const FaceField& velocity, int c, int d, int j, int k)
      : q(velocity.component[c].row(j, k)), stride(stride_along(velocity.component[c], d)) {
    const Component& u = velocity.component[d];
    const int dx = (d == 0) - (c == 0);
    const int dy = (d == 1) - (c == 1);
    const int dz = (d == 2) - (c == 2);
    before = u.row(j + dy, k + dz) + dx;
    const double* at_side = u.row(j + (d == 1), k + (d == 2)) + (d == 0 ? 1 : 0);
    after = at_side;
  }

  static std::ptrdiff_t stride_along(const Component& u, int d) {
    return d == 0 ? 1 : d == 1 ? u.stride_y() : u.stride_z();
  }

  void evaluate(int first, int last, double* __restrict out) const {
    const double* q_minus = q - stride;
    const double* q1 = q + stride;
    const double* q2 = q + 2 * stride;
    for (int i = first; i < last; ++i)
      out[i] = flux(0.5 * (before[i] + after[i]), q_minus[i], q[i], q1[i], q2[i]);
  }

  const double* q;
  std::ptrdiff_t stride;
  const double* before;  ///< the advecting velocity's two points that are averaged to the side
  const double* after;
};

/// Fluxes through the sides of one component's control volumes, kept from row to row so that each
/// is computed once.
class FluxSweep {
 public:
  FluxSweep(const FaceField& velocity, int c)
      : velocity_(velocity),
        c_(c),
        nx_(velocity.component[c].nx()),
        ny_(velocity.component[c].ny()),
        x_(nx_ + 1),
        y_low_(nx_),
        y_high_(nx_),
        z_low_(static_cast<std::size_t>(nx_) * ny_),
        z_high_(z_low_.size()) {
    for (int j = 0; j < ny_; ++j)
      FluxRow(velocity_, c_, 2, j, -1).evaluate(0, nx_, z_row(z_high_, j));
  }

  void start_plane(int k) {
    std::swap(z_low_, z_high_);
    FluxRow(velocity_, c_, 1, -1, k).evaluate(0, nx_, y_high_.data());
  }

  /// N = div(u u) for the points of row (j, k).
  void divergence(int j, int k, const Vec3& h, double* __restrict out) {
    std::swap(y_low_, y_high_);
    FluxRow(velocity_, c_, 0, j, k).evaluate(-1, nx_, x_.data() + 1);
    FluxRow(velocity_, c_, 1, j, k).evaluate(0, nx_, y_high_.data());
    double* z_high = z_row(z_high_, j);
    FluxRow(velocity_, c_, 2, j, k).evaluate(0, nx_, z_high);
    const double* z_low = z_row(z_low_, j);
    const Vec3 inverse = h.cwiseInverse();
    for (int i = 0; i < nx_; ++i)
      out[i] = (x_[i + 1] - x_[i]) * inverse[0] + (y_high_[i] - y_low_[i]) * inverse[1] +
               (z_high[i] - z_low[i]) * inverse[2];
  }

 private:
  double* z_row(std::vector<double>& plane, int j) const {
    return plane.data() + static_cast<std::ptrdiff_t>(j) * nx_;
  }

  const FaceField& velocity_;
  int c_, nx_, ny_;
  std::vector<double> x_, y_low_, y_high_, z_low_, z_high_;
};

/// f = now N + before N_before, and N_before = N.
void extrapolate_row(const double* __restrict N, int count, const Extrapolation& weights,
                     double* __restrict N_before, double* __restrict f) {
  for (int i = 0; i < count; ++i) {
    f[i] = weights.now * N[i] + weights.before * N_before[i];
    N_before[i] = N[i];
  }
}

}  // namespace

void convection_force(const FaceField& velocity, const Grid& grid, double density,
                      const Extrapolation& weights, FaceField& previous, FaceField& force) {
  std::array<FluxSweep, 3> sweeps{FluxSweep(velocity, 0), FluxSweep(velocity, 1),
                                  FluxSweep(velocity, 2)};
  std::vector<double> N(grid.cells[0] + 1);
  const Extrapolation scaled{-density * weights.now, -density * weights.before};
  // plane by plane over all components, so that the velocity comes from memory once
  for (int k = 0; k < velocity.component[2].nz(); ++k) {
    for (int c = 0; c < 3; ++c) {
      const Component& u = velocity.component[c];
      if (k >= u.nz())
        continue;
      sweeps[c].start_plane(k);
      for (int j = 0; j < u.ny(); ++j) {
        sweeps[c].divergence(j, k, grid.spacing, N.data());
        extrapolate_row(N.data(), u.nx(), scaled, previous.component[c].row(j, k),
                        force.component[c].row(j, k));
      }
    }
  }
}

}  // namespace lv::fluid
