#pragma once

#include "lv/calibrate/model.hpp"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace lv::pipeline {

/// A measured volume beside those of a fit and of a beat with the fitted parameters [mm^3].
struct ConfirmedVolume {
  std::string name;  ///< EDV or ESV
  double measured, quasi_static, beat;

  /// As a fraction of the measured one.
  [[nodiscard]] double off() const { return beat / measured - 1.0; }
  [[nodiscard]] bool within(double tolerance) const { return std::abs(off()) <= tolerance; }
};

/// A beat with parameters of a fit.
struct ConfirmedBeat {
  calibrate::FitParameters parameters;
  std::vector<ConfirmedVolume> volumes;
  bool is_within = false;  ///< the tolerance
};

/// Beats with fitted parameters, one or with corrected parameters more.
struct Confirmation {
  calibrate::FitParameters parameters;  ///< of the last beat, or of the next
  double tolerance = 0.0;               ///< of volumes, as a fraction
  std::vector<ConfirmedBeat> beats;
};

/// Writes an archive, and a JSON file beside it for readers; reads the archive. Throws RunError
/// when it is damaged.
void write_confirmation(const Confirmation& record, const std::filesystem::path& file);
[[nodiscard]] Confirmation read_confirmation(const std::filesystem::path& file);

}  // namespace lv::pipeline
