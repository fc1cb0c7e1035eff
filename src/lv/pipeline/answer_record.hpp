#pragma once

#include "lv/calibrate/model.hpp"

#include <filesystem>
#include <functional>
#include <vector>

namespace lv::pipeline {

/// The answers that a calibration has got from its ventricle, in a file with all that the
/// ventricle's further answers depend on. A calibration that was stopped asks the same questions in
/// the same order: it gets the recorded answers, then those that it would have got, bit for bit.
class AnswerRecord {
 public:
  /// Reads the file if it is there; `nodes` of the ventricle. Throws RunError when it cannot be
  /// used.
  AnswerRecord(calibrate::Ventricle& ventricle, std::size_t nodes, std::filesystem::path file);

  /// The next answer, recorded or asked for and recorded; collective.
  Outcome<std::vector<double>> answer(const std::function<Outcome<std::vector<double>>()>& ask);

 private:
  using Answer = std::vector<double>;  ///< empty: there was no equilibrium
  void read(std::size_t nodes);
  void write() const;

  calibrate::Ventricle& ventricle_;
  std::filesystem::path file_;
  std::vector<Answer> answers_;
  std::size_t given_ = 0;
};

}  // namespace lv::pipeline
