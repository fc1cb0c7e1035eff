#include "lv/fluid/field.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lv::fluid {
namespace {

constexpr int g = ghost_layers;
constexpr int alignment = line_of_cache;

int round_up(int n) {
  return (n + alignment - 1) / alignment * alignment;
}

/// Where ghost point -1-l (lower side) or n+l (upper side) is mirrored, and with which sign.
struct Mirror {
  [[nodiscard]] int lower(int l) const { return on_faces ? 1 + l : l; }
  [[nodiscard]] int upper(int l) const { return on_faces ? n - 2 - l : n - 1 - l; }
  [[nodiscard]] double sign() const { return on_faces ? 1.0 : -1.0; }
  int n;
  bool on_faces;
};

void fill_x(Component& u, bool on_faces) {
  const Mirror mirror{u.nx(), on_faces};
  for (int k = 0; k < u.nz(); ++k) {
    for (int j = 0; j < u.ny(); ++j) {
      double* row = u.row(j, k);
      for (int l = 0; l < g; ++l) {
        row[-1 - l] = mirror.sign() * row[mirror.lower(l)];
        row[u.nx() + l] = mirror.sign() * row[mirror.upper(l)];
      }
    }
  }
}

void copy_scaled(const double* from, double* to, std::ptrdiff_t count, double sign) {
  for (std::ptrdiff_t i = 0; i < count; ++i)
    to[i] = sign * from[i];
}

void fill_y(Component& u, bool on_faces) {
  const Mirror mirror{u.ny(), on_faces};
  for (int k = 0; k < u.nz(); ++k) {
    for (int l = 0; l < g; ++l) {
      copy_scaled(u.row(mirror.lower(l), k) - g, u.row(-1 - l, k) - g, u.nx() + 2 * g,
                  mirror.sign());
      copy_scaled(u.row(mirror.upper(l), k) - g, u.row(u.ny() + l, k) - g, u.nx() + 2 * g,
                  mirror.sign());
    }
  }
}

/// Sends g planes to one neighbour and receives g planes from the other.
void shift_planes(Component& u, int send_from, int send_to, int receive_into, int receive_from) {
  const int count = static_cast<int>(g * u.stride_z());
  MPI_Sendrecv(u.plane(send_from).data(), count, MPI_DOUBLE, send_to, 0,
               u.plane(receive_into).data(), count, MPI_DOUBLE, receive_from, 0, MPI_COMM_WORLD,
               MPI_STATUS_IGNORE);
}

/// The neighbour above sends planes counted from its own first plane, and so does this rank to the
/// one above: the last rank's extra face plane of component z never crosses a boundary between
/// slabs.
void fill_z(Component& u, bool on_faces, const Slab& slab) {
  const int above = slab.last ? MPI_PROC_NULL : parallel::rank() + 1;
  const int below = slab.first ? MPI_PROC_NULL : parallel::rank() - 1;
  shift_planes(u, 0, below, u.nz(), above);
  shift_planes(u, u.nz() - g, above, -g, below);

  const Mirror mirror{u.nz(), on_faces};
  for (int l = 0; l < g; ++l) {
    if (slab.first)
      copy_scaled(u.plane(mirror.lower(l)).data(), u.plane(-1 - l).data(), u.stride_z(),
                  mirror.sign());
    if (slab.last)
      copy_scaled(u.plane(mirror.upper(l)).data(), u.plane(u.nz() + l).data(), u.stride_z(),
                  mirror.sign());
  }
}

}  // namespace

Component::Component(int nx, int ny, int nz)
    : nx_(nx),
      ny_(ny),
      nz_(nz),
      stride_y_(round_up(nx + g) + alignment),
      stride_z_(stride_y_ * (ny + 2 * g)),
      origin_(g * stride_z_ + g * stride_y_ + alignment),
      values_(stride_z_ * (nz + 2 * g), 0.0) {}

std::span<double> Component::plane(int k) {
  return {values_.data() + (k + g) * stride_z_, static_cast<std::size_t>(stride_z_)};
}

FaceField::FaceField(const Grid& grid, const Slab& slab)
    : component{Component(grid.points(0, 0), grid.points(0, 1), slab.points(0)),
                Component(grid.points(1, 0), grid.points(1, 1), slab.points(1)),
                Component(grid.points(2, 0), grid.points(2, 1), slab.points(2))} {}

void FaceField::set_zero() {
  for (Component& c : component)
    std::fill(c.values().begin(), c.values().end(), 0.0);
}

void fill_ghosts(FaceField& velocity, const Slab& slab) {
  for (int d = 0; d < 3; ++d) {
    Component& u = velocity.component[d];
    fill_x(u, d == 0);
    fill_y(u, d == 1);
    fill_z(u, d == 2, slab);
  }
}

void fill_ghosts(Component& pressure, const Slab& slab) {
  fill_x(pressure, false);
  fill_y(pressure, false);
  fill_z(pressure, false, slab);
}

std::vector<double> gather(const Component& component) {
  std::vector<double> mine;
  mine.reserve(static_cast<std::size_t>(component.nx()) * component.ny() * component.nz());
  for (int k = 0; k < component.nz(); ++k)
    for (int j = 0; j < component.ny(); ++j)
      mine.insert(mine.end(), component.row(j, k), component.row(j, k) + component.nx());
  return parallel::gather(mine);
}

void scatter(std::span<const double> values, Component& component) {
  const std::size_t count =
      static_cast<std::size_t>(component.nx()) * component.ny() * component.nz();
  const std::vector<double> mine = parallel::scatter(values, count);
  const double* next = mine.data();
  for (int k = 0; k < component.nz(); ++k)
    for (int j = 0; j < component.ny(); ++j, next += component.nx())
      std::copy_n(next, component.nx(), component.row(j, k));
}

Motion motion(const FaceField& velocity, const Grid& grid, double density) {
  double squares = 0.0;
  double largest = 0.0;
  for (const Component& u : velocity.component)
    for (int k = 0; k < u.nz(); ++k)
      for (int j = 0; j < u.ny(); ++j)
        for (const double v : std::span(u.row(j, k), static_cast<std::size_t>(u.nx()))) {
          squares += v * v;
          largest = std::max(largest, std::abs(v));
        }
  return {0.5 * density * grid.cell_volume() * parallel::sum(squares), parallel::max(largest)};
}

}  // namespace lv::fluid
