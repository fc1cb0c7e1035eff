#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <string>
#include <vector>

namespace lv::calibrate {

/// Which muscle an equilibrium of a fit has; they take different times.
enum class MuscleState { rests, contracts };

/// A part of a fit and how many equilibria it usually takes.
struct FitPart {
  std::string purpose;
  std::array<double, 2> equilibria;  ///< by MuscleState
};

/// How long a fit will still take: the equilibria of the parts that are left, each as long as the
/// last ones of its muscle took in the middle.
class FitForecast {
 public:
  explicit FitForecast(std::vector<FitPart> parts) : parts_(std::move(parts)) {}

  /// The next part begins.
  void begin();

  /// An equilibrium was found in so many seconds.
  void record(MuscleState muscle, double seconds);

  /// Negative if nothing can be said yet.
  [[nodiscard]] double seconds_left() const;

  /// ", about 3 min 20 s left", or nothing.
  [[nodiscard]] std::string words() const;

 private:
  [[nodiscard]] double left(std::size_t muscle) const;

  std::vector<FitPart> parts_;
  std::size_t part_ = 0;
  bool begun_ = false;
  std::array<double, 2> done_{};                 ///< of the present part
  std::array<std::deque<double>, 2> durations_;  ///< of the last equilibria
};

}  // namespace lv::calibrate
