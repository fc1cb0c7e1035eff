#pragma once

#include "lv/fluid/field.hpp"

#include "support/random_values.hpp"

/// Fields on the whole box, for tests on one rank.
namespace lv::test {

/// Axes that differ in the number and the width of their cells.
inline const fluid::Grid uneven_grid{{6, 5, 8}, {0, 0, 0}, {1.5, 2.0, 1.0}};

/// Calls visit(i, j, k, value) for the points of a component, and `layers` ghosts around them.
template <class Visit>
void for_points(fluid::Component& u, int layers, const Visit& visit) {
  for (int k = -layers; k < u.nz() + layers; ++k)
    for (int j = -layers; j < u.ny() + layers; ++j)
      for (int i = -layers; i < u.nx() + layers; ++i)
        visit(i, j, k, u.at(i, j, k));
}

inline fluid::Slab whole_box(const fluid::Grid& grid) {
  return fluid::slab_of(grid, 0, 1);
}

/// Component c is value(c, position), at the ghosts too.
template <class Value>
fluid::FaceField field_of(const fluid::Grid& grid, const Value& value) {
  fluid::FaceField field(grid, whole_box(grid));
  for (int c = 0; c < 3; ++c)
    for_points(field.component[c], fluid::ghost_layers,
               [&](int i, int j, int k, double& u) { u = value(c, grid.face(c, i, j, k)); });
  return field;
}

/// Random numbers at all points, zero at the ghosts.
inline fluid::FaceField random_field(const fluid::Grid& grid, unsigned seed) {
  RandomValues random(seed);
  fluid::FaceField field(grid, whole_box(grid));
  for (fluid::Component& u : field.component)
    for_points(u, 0, [&](int, int, int, double& value) { value = random(); });
  return field;
}

/// Largest |div u| over the cells.
inline double largest_divergence(const fluid::FaceField& u, const fluid::Grid& grid) {
  double largest = 0.0;
  for (int k = 0; k < grid.cells[2]; ++k) {
    for (int j = 0; j < grid.cells[1]; ++j) {
      for (int i = 0; i < grid.cells[0]; ++i) {
        const auto& [x, y, z] = u.component;
        const double divergence = (x.at(i + 1, j, k) - x.at(i, j, k)) / grid.spacing[0] +
                                  (y.at(i, j + 1, k) - y.at(i, j, k)) / grid.spacing[1] +
                                  (z.at(i, j, k + 1) - z.at(i, j, k)) / grid.spacing[2];
        largest = std::max(largest, std::abs(divergence));
      }
    }
  }
  return largest;
}

/// sum over the points of a.b
inline double product(const fluid::FaceField& a, const fluid::FaceField& b) {
  double sum = 0.0;
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < a.component[c].nz(); ++k)
      for (int j = 0; j < a.component[c].ny(); ++j)
        for (int i = 0; i < a.component[c].nx(); ++i)
          sum += a.component[c].at(i, j, k) * b.component[c].at(i, j, k);
  return sum;
}

}  // namespace lv::test
