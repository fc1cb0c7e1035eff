#pragma once

#include "lv/base/table.hpp"
#include "lv/mesh/mesh.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lv::page {

/// A number per node at each time.
using NodalSeries = std::vector<std::vector<float>>;

/// The faces that belong to one cell only, with normals that point out of the wall.
struct Skin {
  std::vector<std::int32_t> nodes;  ///< face after face
  std::vector<std::int32_t> cells;  ///< behind each face
};

/// How far the wall reaches about the long axis, at all moments [mm].
struct Reach {
  double radius = 0.0;
  double bottom = 0.0;  ///< z
  double top = 0.0;     ///< z
};

/// The wall of a beat as its files on disk (`wall.pvd` and the frames it names) give it. Values of
/// elements are averaged to the nodes.
struct WallSeries {
  mesh::CellKind kind = mesh::CellKind::hexahedron;
  std::vector<int> cells;                 ///< nodes of cell after cell
  std::vector<Vec3> undeformed;           ///< nodes at early diastole [mm]
  std::vector<Vec3> f0;                   ///< fibre direction per cell
  std::vector<float> infarct;             ///< M per node
  std::vector<int> slice, sector, aha17;  ///< per cell
  std::vector<double> times;              ///< of the frames [s]
  NodalSeries displacement;               ///< three numbers per node [mm]
  /// By the names of regions.csv. Strains are from early diastole up to `end_diastole`, from
  /// end-diastole after it.
  std::map<std::string, NodalSeries> quantities;
  Skin skin;
  Reach reach;

  /// The nodes at a frame [mm].
  [[nodiscard]] std::vector<Vec3> positions(std::size_t frame) const;
  /// The undeformed mesh, with all its surface as the epicardium. Of order 2, eight consecutive
  /// cells are the parts of one quadratic element.
  [[nodiscard]] mesh::Mesh mesh(int order = 1) const;
};

/// One file of a ParaView series.
struct TimedFrame {
  double time;  ///< [s]
  std::filesystem::path file;
};

/// The frames of a .pvd file that are there; empty when there is no such file.
[[nodiscard]] std::vector<TimedFrame> frames_of(const std::filesystem::path& pvd);

/// Reads all frames. `end_diastole` [s] is infinite when it has not been reached. Throws RunError
/// naming a file that cannot be read.
[[nodiscard]] WallSeries read_wall_series(const std::vector<TimedFrame>& frames,
                                          double end_diastole);

/// segments_over_time.csv: the mean of every strain and stress that the page shows over each AHA
/// segment at each frame, weighted by undeformed volume. Frames have strains from early diastole up
/// to `end_diastole`, from end-diastole after it, as above. Throws RunError naming a file that
/// cannot be read.
[[nodiscard]] Table segments_over_time(const std::vector<TimedFrame>& frames, double end_diastole);

}  // namespace lv::page
