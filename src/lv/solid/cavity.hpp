#pragma once

#include "lv/mesh/quadratic.hpp"
#include "lv/solid/shape_table.hpp"

#include <array>
#include <span>
#include <vector>

namespace lv::solid {

/// Volume of the cavity: enclosed by the endocardium, whose sides are those of the mesh's order,
/// and, at the base, by the fan between its edge and the edge's centre (the basal plane as long as
/// the base stays plane).
class Cavity {
 public:
  explicit Cavity(const mesh::Mesh& mesh);

  /// [mm^3]
  [[nodiscard]] double volume(std::span<const Vec3> positions) const;

 private:
  mesh::ElementNodes endo_;
  ShapeTable shapes_;
  std::vector<std::array<int, 2>> edge_;  ///< of the endocardium at the base
};

}  // namespace lv::solid
