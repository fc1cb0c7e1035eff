#pragma once

#include "lv/case_file/case.hpp"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace lv::beating_wall {

/// A datum of heartbeats that were fitted; in its own unit.
struct FittedDatum {
  std::string name, unit;
  double measured;  ///< NaN: not
  double model;
};

/// A parameter that was fitted to it; in its own unit.
struct FittedValue {
  std::string parameter;  ///< of a case file
  std::string words;      ///< "filling pressure"
  std::string unit;
  std::string datum;  ///< the name of what tells of it
  double before = 0.0, fitted = 0.0;
};

/// What a fit of heartbeats came to.
struct HeartbeatFit {
  std::vector<FittedDatum> data;
  std::vector<FittedValue> parameters;
  Eigen::MatrixXd sensitivity;          ///< d ln datum/d ln parameter; NaN: no heartbeats there
  std::vector<std::string> left_alone;  ///< what is not fitted and why, as sentences
  double tolerance = 0.0;               ///< of the data, as a fraction
  int evaluations = 0, beats = 0;

  /// The value of a parameter if a datum were off by `by` (of its logarithm), to first order; NaN
  /// where that is not known.
  [[nodiscard]] double moved(std::size_t parameter, std::size_t datum, double by) const;
};

/// For a terminal, and as a JSON object.
[[nodiscard]] std::string text(const HeartbeatFit& fit);
[[nodiscard]] std::string json(const HeartbeatFit& fit);

/// The archive in a calibration's folder, and the fit from it; heartbeats.json beside it is for
/// readers. Throws RunError when it is damaged.
inline constexpr const char* heartbeats_name = "heartbeats.bin";
inline constexpr const char* heartbeats_json = "heartbeats.json";
inline constexpr const char* heartbeats_text = "heartbeats.txt";
void write_heartbeats(const HeartbeatFit& fit, const std::filesystem::path& file);
[[nodiscard]] HeartbeatFit read_heartbeats(const std::filesystem::path& file);

/// The case with the fitted values; `file` stands for where they come from.
[[nodiscard]] case_file::Case with_values(case_file::Case c, const HeartbeatFit& fit,
                                          const std::filesystem::path& file);

}  // namespace lv::beating_wall
