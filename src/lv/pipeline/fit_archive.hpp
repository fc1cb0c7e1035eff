#pragma once

#include "lv/calibrate/record.hpp"
#include "lv/heartbeat/archive.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lv::pipeline {

/// The JSON file beside an archive, which tells people what is in it.
[[nodiscard]] inline std::filesystem::path for_readers(std::filesystem::path archive) {
  return archive.replace_extension(".json");
}

/// A fit as arrays of an archive, and back. Loading throws RunError for what no fit can be.
void store(const calibrate::FitParameters& parameters, heartbeat::Archive& archive,
           const std::string& name = "parameters");
[[nodiscard]] calibrate::FitParameters load_parameters(const heartbeat::Archive& archive,
                                                       const std::string& name = "parameters");
void store(const calibrate::RecordedFit& fit, heartbeat::Archive& archive);
[[nodiscard]] calibrate::RecordedFit load_fit(const heartbeat::Archive& archive);

inline constexpr std::size_t parameter_count = 4 + mesh::aha_count;

/// Values of all parameters that a fit may change, and back.
[[nodiscard]] std::vector<double> numbers(const calibrate::FitParameters& parameters);
[[nodiscard]] calibrate::FitParameters parameters_of(
    std::span<const double, parameter_count> numbers);

}  // namespace lv::pipeline
