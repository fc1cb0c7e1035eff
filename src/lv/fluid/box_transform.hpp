#pragma once

#include "lv/fluid/field.hpp"
#include "lv/fluid/line_transform.hpp"

#include <array>
#include <span>
#include <vector>

namespace lv::fluid {

/// What a transformed array stands for: a velocity component (0, 1, 2) or the pressure at cell
/// centres.
inline constexpr int cell_centred = 3;

/// Which modes of one component this rank holds: all along z and y, a run along x. In memory z is
/// slowest, y fastest.
///
/// Modes are numbered m = 1..N along axes with cell-centred points (sine) and m = 0..N along the
/// component's own axis (cosine). Ranks share the numbers 1..N in equal runs; the number 0 belongs
/// to the first rank. So the modes that the divergence couples, equal numbers of all components,
/// are always on one rank.
struct ModeLayout {
  ModeLayout(const Grid& grid, int component, int rank, int ranks);

  int first_x;           ///< number m_x of the first mode here
  int first_y, first_z;  ///< 0 for cosine, 1 for sine
  int count_x;           ///< modes along x on this rank
  int count_y, count_z;  ///< modes along y and z, all of them

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(count_x) * count_y * count_z;
  }
};

/// Transforms one component between its points in this rank's slab and the modes of the box, with
/// one exchange between ranks each way. to_points(to_modes(f)) = 8 Nx Ny Nz f.
class ComponentTransform {
 public:
  ComponentTransform(const Grid& grid, const Slab& slab, int component);

  void to_modes(const Component& points, AlignedValues& modes);
  void to_points(const AlignedValues& modes, Component& points);

  [[nodiscard]] const ModeLayout& layout() const { return layout_; }

 private:
  [[nodiscard]] double* exchange_row(AlignedValues& buffer, int k, int i) const;
  void planes_to_modes(const Component& points, AlignedValues& buffer);
  void planes_to_points(AlignedValues& buffer, Component& points);
  void along_z(AlignedValues& modes, bool forward);
  void exchange(AlignedValues& from, AlignedValues& to, bool forward) const;

  std::array<int, 3> points_;  ///< Nx, Ny points and the slab's planes
  ModeLayout layout_;
  std::vector<int> rank_of_x_;  ///< which rank holds the modes with x index i
  std::vector<ModeLayout> layouts_;
  std::vector<int> planes_of_rank_;
  LineTransform x_, y_, z_;
  AlignedValues plane_;   ///< one plane, transposed
  AlignedValues buffer_;  ///< what is exchanged; unused on one rank
  AlignedValues work_;    ///< modes on the way back to points
};

/// The modes of a vector field on the faces.
using ModeField = std::array<AlignedValues, 3>;

/// Transforms of all three velocity components.
class BoxTransform {
 public:
  BoxTransform(const Grid& grid, const Slab& slab);

  void to_modes(const FaceField& points, ModeField& modes);
  void to_points(const ModeField& modes, FaceField& points);

  [[nodiscard]] ModeField zero_modes() const;

  /// All modes of the box on the root, in an order that does not depend on the number of ranks;
  /// empty elsewhere.
  [[nodiscard]] std::vector<double> gather(const ModeField& modes, int c) const;

  /// The reverse of `gather`: this rank's modes of component c from the root's.
  void scatter(std::span<const double> all, int c, ModeField& modes) const;

  [[nodiscard]] const ModeLayout& layout(int c) const { return transform_[c].layout(); }

 private:
  Grid grid_;
  std::array<ComponentTransform, 3> transform_;
};

}  // namespace lv::fluid
