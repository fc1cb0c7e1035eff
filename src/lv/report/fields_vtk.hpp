#pragma once

#include "lv/analysis/wall_fields.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace lv::report {

/// Writes the wall at one time as a VTU file: displacement, tension and transmural coordinate at
/// the nodes; in the elements f0, s0, n0, F, J, fibre stretch, Green-Lagrange strain and its
/// components against early diastole and (once it is known; NaN before) end-diastole, Cauchy stress
/// total, passive and active with their fibre components, pressure, infarct, region numbers and the
/// element's undeformed volume. Lengths in mm, stresses in kPa. Throws RunError when the file
/// cannot be written.
void write_wall(const std::filesystem::path& file, const mesh::Mesh& mesh,
                const mesh::Regions& regions, const heartbeat::Snapshot& snapshot,
                const std::vector<analysis::CellFields>& now,
                const std::vector<analysis::CellFields>& end_diastole);

/// Cell-centred blood fields on the whole box, x fastest.
struct BloodFields {
  Vec3 lower, spacing;  ///< [mm]
  std::array<int, 3> cells{};
  std::vector<double> velocity;  ///< three numbers per cell [mm/s]
  std::vector<double> pressure;  ///< [kPa]
};

/// Writes the blood at one time as VTK image data (.vti).
void write_blood(const std::filesystem::path& file, const BloodFields& blood);

/// Writes a ParaView time series (.pvd) of files relative to its own folder.
struct TimedFile {
  double time;
  std::string file;
};
void write_pvd(const std::filesystem::path& file, const std::vector<TimedFile>& series);

/// Writes the undeformed mesh with its fibres and regions, for looking at.
void write_mesh(const std::filesystem::path& file, const mesh::Mesh& mesh,
                const mesh::Regions& regions, const std::vector<analysis::CellFields>& undeformed);

/// Writes the endocardium and the epicardium of a wall map, for looking at; the point array t tells
/// them apart.
void write_surfaces(const std::filesystem::path& file, const mesh::WallMap& wall);

/// The same for the sides of a mesh.
void write_surfaces(const std::filesystem::path& file, const mesh::Mesh& mesh);

}  // namespace lv::report
