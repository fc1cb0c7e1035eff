#pragma once

#include "lv/solid/base_motion.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace lv::heartbeat {

/// A base's motion over a beat as a table has it: times from the beginning of a beat's calcium on,
/// less than a period, ascending.
struct MeasuredMotion {
  std::vector<double> times;  ///< [s]
  std::vector<solid::BasePose> poses;
};

/// How a table of a base's motion is read, and what it must hold over a period.
struct MotionFile {
  std::string file;
  double period = 0.0;  ///< of a beat [s]
};

/// Reads a CSV table with the columns
///
///   time_s                              time after the calcium of a beat begins, or
///   cycle_share                         the same as a share of the period, from 0 to 1
///   axial_mm                            BasePose::axial
///   septal_tilt_deg, anterior_tilt_deg  BasePose::septal_tilt, anterior_tilt
///   rotation_deg                        BasePose::rotation
///
/// in any order, all of them and no others. Lines that begin with # are comments. The first time is
/// 0; the last is the end of the beat and repeats the first line, or is at most a quarter of the
/// period before it. Throws InputError naming file and line for columns that are missing or
/// unknown, what is no number, times that do not increase or leave the beat, a table that does not
/// close, and motion beyond what hearts do: 30 mm, 20 degrees of tilt and 30 of rotation from one
/// line to any other, 400 mm/s and 400 degrees/s between two lines.
[[nodiscard]] MeasuredMotion read_motion(const MotionFile& source);

/// The base's motion through every beat, of one period: between the table's lines cubic, with
/// slopes that overshoot no line and meet there (F.N. Fritsch & J. Butland, SIAM J. Sci. Stat.
/// Comput. 5:300, 1984), from the last line on to the first one again. All is measured from the
/// pose at one time, at which the base is where the undeformed wall has it.
class BaseMotion {
 public:
  /// A base that stays.
  BaseMotion() = default;

  /// `zero`: the time of that pose; `onset`: when in a beat calcium begins [s].
  struct Clock {
    double period = 0.0, onset = 0.0, zero = 0.0;
  };
  BaseMotion(const MeasuredMotion& measured, const solid::BaseFrame& frame, const Clock& clock);

  /// The displacement at a time since a beat began [mm].
  [[nodiscard]] solid::AffineField at(double since) const;

 private:
  [[nodiscard]] Eigen::Vector4d pose(double time) const;

  Clock clock_;
  solid::BaseFrame frame_;
  std::vector<double> times_;           ///< those of the lines, and the first of the next beat
  std::vector<Eigen::Vector4d> poses_;  ///< of the same
  std::vector<Eigen::Vector4d> slopes_;
  Eigen::Vector4d zero_ = Eigen::Vector4d::Zero();
};

}  // namespace lv::heartbeat
