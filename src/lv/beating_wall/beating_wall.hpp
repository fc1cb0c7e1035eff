#pragma once

#include "lv/anatomy/mesh_result.hpp"
#include "lv/case_file/beat_fit.hpp"
#include "lv/heartbeat/cycle.hpp"

#include <Eigen/Core>

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

namespace lv::beating_wall {

/// Heartbeats up to their limit cycle, with some values of the fitted parameters.
struct HeartbeatsAt {
  Eigen::VectorXd x;  ///< logarithms of the factors
  double accuracy = 0.0;
  bool found = false;
  std::string why;  ///< there are none, if so
  circulation::Cycle cycle;
  heartbeat::BeatBegin end;

  [[nodiscard]] const circulation::BeatMeasures& last() const { return cycle.beats.back(); }
};

/// The difference of logarithms of which sensitivities are made: well above what beats scatter by.
inline constexpr double difference_of_logarithms = 0.05;

/// The wall of a case and its heartbeats with other values of what is fitted, each evaluation kept
/// in a file of `folder`. The same questions in the same order get the same answers. Case, wall and
/// fit must outlive it. Collective, but for what only looks.
class BeatingWall {
 public:
  BeatingWall(const case_file::Case& c, const anatomy::MeshResult& wall,
              const case_file::BeatFit& fit, std::filesystem::path folder);

  /// Of the first beats of all [kPa]; a closed loop begins as it is told, for its blood's sake.
  void begin_with(double arterial_pressure) { arterial_pressure_ = arterial_pressure; }
  [[nodiscard]] double arterial_pressure(const Eigen::VectorXd& x) const;

  [[nodiscard]] case_file::Case case_at(const Eigen::VectorXd& x) const;

  /// Beats up to where the last changes nothing by more than `accuracy`, from where those of the
  /// nearest evaluation before had come to. `purpose` and the evaluations that are still to come,
  /// roughly (negative: nobody knows), are for the log.
  const HeartbeatsAt& at(const Eigen::VectorXd& x, double accuracy, const char* purpose,
                         double to_come);

  /// What the data's logarithms change by with those of the parameters, for a stand-in that beats
  /// as the wall did there. Throws RunError where it does not beat.
  [[nodiscard]] Eigen::MatrixXd slopes(const Eigen::VectorXd& x) const;

  [[nodiscard]] const std::deque<HeartbeatsAt>& known() const { return known_; }
  /// Of the same place, the last: it is known best.
  [[nodiscard]] const HeartbeatsAt& nearest(const Eigen::VectorXd& x) const;

  /// ln(model/measured) of the measured data.
  [[nodiscard]] Eigen::VectorXd logarithms(const circulation::BeatMeasures& beat) const;

  void remove_records() const;

 private:
  [[nodiscard]] const case_file::Parameter& parameter(Eigen::Index j) const;
  [[nodiscard]] std::filesystem::path record_of(std::size_t n) const;
  [[nodiscard]] std::filesystem::path folder_of(std::size_t n) const;
  [[nodiscard]] bool is_recorded(std::size_t n, const Eigen::VectorXd& x);

  [[nodiscard]] heartbeat::CycleSetup setup(const case_file::Case& c, double accuracy) const;
  [[nodiscard]] HeartbeatsAt run(std::size_t n, const Eigen::VectorXd& x, double accuracy) const;
  [[nodiscard]] bool has_beaten() const;
  [[nodiscard]] heartbeat::BeatBegin begin_at(const Eigen::VectorXd& x,
                                              const case_file::Case& c) const;
  [[nodiscard]] double blood(const case_file::Case& c) const;

  [[nodiscard]] circulation::CycleAlone beats_alone(const HeartbeatsAt& from,
                                                    const Eigen::VectorXd& x) const;
  [[nodiscard]] circulation::StandIn stand_in(const HeartbeatsAt& from,
                                              const Eigen::VectorXd& x) const;

  void tell(const HeartbeatsAt& e, const char* purpose, double to_come) const;
  [[nodiscard]] std::string in_words(const HeartbeatsAt& e) const;

  const case_file::Case& case_;
  const anatomy::MeshResult& wall_;
  const case_file::BeatFit& fit_;
  std::filesystem::path folder_;
  std::vector<double> activated_;
  std::size_t asked_ = 0;
  heartbeat::BaseMotion base_motion_;
  std::deque<HeartbeatsAt> known_;
  double seconds_ = -1.0;           ///< that the last evaluation of this process took
  double arterial_pressure_ = 0.0;  ///< to begin with [kPa]; 0: the case's
};

}  // namespace lv::beating_wall
