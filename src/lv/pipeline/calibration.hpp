#pragma once

#include "lv/pipeline/stages.hpp"

#include <optional>

namespace lv::pipeline {

/// The same case on the quasi-static engine, which calibrates whatever engine runs the beat.
[[nodiscard]] case_file::Case for_calibration(case_file::Case c);

/// The same case with one layer of long elements, on which a fit of the muscle is tried first;
/// nothing where none is asked for, or its elements are hardly shorter.
[[nodiscard]] std::optional<case_file::Case> on_coarse_wall(case_file::Case c);

/// Walls on which fits are made first.
struct CoarseWalls {
  std::optional<anatomy::MeshResult> of_muscle;  ///< on_coarse_wall
  std::optional<anatomy::MeshResult> of_beats;   ///< beating_wall::with_coarse_wall
};

/// Fits what the case asks for: the muscle at given pressures, with the wall unloaded anew for all
/// parameters where it was seen under load, and then heartbeats (beating_wall::fit_heartbeats).
/// Writes into `folder` calibration.bin, calibration.json and calibration.csv of the muscle (every
/// equilibrium of the search), the files of beating_wall::fit_heartbeats, calibration.txt of both
/// and calibrated.toml (for a case file); collective. A fit that was stopped goes on from the
/// answers that it left in `folder`. With a coarse wall a fit is made there first, so that the one
/// on `mesh` starts near its end, and a volume that is out of reach there by more than
/// calibrate::reach_margin is refused within seconds. Throws InputError for a volume out of reach,
/// with the volumes within reach.
void make_calibration(const case_file::Case& c, const anatomy::MeshResult& mesh,
                      const CoarseWalls& coarse, const std::filesystem::path& folder);

/// The archives with fitted parameters: of a calibration, and of a beat made with them. JSON files
/// of the same names tell readers of them.
inline constexpr const char* calibration_name = "calibration.bin";
inline constexpr const char* confirmation_name = "confirmation.bin";

/// Factors of contractility fitted to strain, of a calibration and beside the results.
inline constexpr const char* contractility_name = "contractility.csv";

/// Names of the parameters that a calibration changes.
[[nodiscard]] std::vector<std::string> fitted_names(const case_file::Case& c);

/// Whether the muscle's contractility is among them.
[[nodiscard]] bool fits_contractility(const case_file::Case& c);

/// The case with the muscle's parameters of such an archive; the JSON file beside it stands for
/// where they come from.
[[nodiscard]] case_file::Case calibrated(case_file::Case c, const std::filesystem::path& file);

/// The case with the muscle's parameters in use, without what is fitted to heartbeats: those of its
/// wall without load, which is found before.
[[nodiscard]] case_file::Case with_muscle(const case_file::Case& c,
                                          const std::filesystem::path& calibration,
                                          const std::filesystem::path& beat = {});

/// The case with the parameters in use: its own, those of the calibration's folder, or those of a
/// beat in whose folder they were corrected.
[[nodiscard]] case_file::Case fitted(const case_file::Case& c,
                                     const std::filesystem::path& calibration,
                                     const std::filesystem::path& beat);

/// Records a beat made with the parameters of the calibration, and its volumes beside the measured
/// ones and the quasi-static engine's, in confirmation.bin and confirmation.json of the beat's
/// `folder`. When they are off by more than the tolerance and the case wants confirmation, up to
/// twice, it records corrected parameters too, removes the checkpoint and returns true: the beat
/// must run again. The correction takes the volumes' derivatives from the quasi-static engine:
///
///   sum_j x_j dV_k/dx_j d ln x_j = V_k,measured - V_k,beat
///
/// for EDV and ESV and the parameters that were bracketed to them.
[[nodiscard]] bool correct(const case_file::Case& c, const std::filesystem::path& calibration,
                           const heartbeat::Beat& beat, const std::filesystem::path& folder);

/// Measured volumes beside those of the fit and of the beat, as recorded in the beat's folder, and
/// what the calibration's says of Klotz's curve; no volumes for a case without calibration. The
/// pressures that the case does not bring are assumptions, with the interval that an end-diastolic
/// one leaves where the fit was repeated.
[[nodiscard]] FitRecord fit_record(const case_file::Case& c,
                                   const std::filesystem::path& calibration,
                                   const std::filesystem::path& beat);

}  // namespace lv::pipeline
