#pragma once

#include "lv/analysis/results.hpp"
#include "lv/anatomy/anatomy.hpp"
#include "lv/anatomy/mesh_result.hpp"
#include "lv/beating_wall/heartbeat_record.hpp"
#include "lv/calibrate/fit.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/pipeline/beat_result.hpp"
#include "lv/report/summary.hpp"

#include <filesystem>
#include <optional>

namespace lv::pipeline {

/// Throws InputError when the immersed engine has no room for the wall in its box, or when the mesh
/// is too coarse for the grid.
void check_room(const case_file::Case& c, const mesh::Mesh& mesh);

[[nodiscard]] anatomy::MeshResult make_mesh(const case_file::Case& c, const anatomy::Shape& shape);

/// Writes the mesh for ParaView, its quality table and pictures; collective.
void show_mesh(const anatomy::MeshResult& result, const case_file::Case& c,
               const std::filesystem::path& folder);

/// What the anatomy's stage left beside the folder of another stage.
[[nodiscard]] anatomy::AnatomyRecord anatomy_beside(const std::filesystem::path& folder);

/// Runs the beat in `folder`, writing fields and curves as it goes; collective.
[[nodiscard]] heartbeat::Beat make_beat(const case_file::Case& c, const anatomy::MeshResult& mesh,
                                        const std::filesystem::path& folder);

/// What results say of a fit, and of pressures that nobody measured.
struct FitRecord {
  std::vector<report::FittedVolume> volumes;       ///< empty unless the case is calibrated
  std::vector<report::KlotzVolume> klotz;          ///< empty unless it is fitted to that curve
  std::vector<calibrate::FittedSegment> segments;  ///< factors of contractility, if fitted
  std::vector<beating_wall::FittedDatum>
      beats;  ///< what heartbeats were fitted to; empty unless they were
  std::optional<report::FittedShape> shape;
  std::vector<geometry::Assumption> assumed;
};

/// Computes and writes the results; collective. `unloaded` is empty unless the wall was seen under
/// load. Returns the text for the terminal on the root.
[[nodiscard]] std::string make_results(const case_file::Case& c, const anatomy::MeshResult& mesh,
                                       const BeatResult& beat, const FitRecord& fitted,
                                       const std::optional<report::UnloadedShape>& unloaded,
                                       const std::filesystem::path& folder);

}  // namespace lv::pipeline
