#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace lv::calibrate {

/// Which muscle an equilibrium of a fit has; they take different times.
enum class MuscleState { rests, contracts };

/// When a part of a fit ends.
enum class FitEnd {
  by_misfit,  ///< a root is bracketed: when the misfit is small enough
  counted,    ///< after a known number of equilibria
  open        ///< when steps become small: nobody knows after how many
};

/// A part of a fit.
struct FitPart {
  FitEnd end;
  bool is_near;                      ///< its equilibria are neighbours of known ones
  std::array<double, 2> equilibria;  ///< by MuscleState: usual number; of open parts the least
};

/// How long a fit will still take: the equilibria that are left, each as long as the last ones of
/// its muscle and kind took in the middle in this very fit. The first one of each muscle comes from
/// afar and tells nothing of the others. How many a bracket still needs follows from its misfit:
/// once the root lies between two trials, its digits grow by the golden ratio with each.
class FitForecast {
 public:
  explicit FitForecast(std::vector<FitPart> parts) : parts_(std::move(parts)) {}

  /// The next part begins.
  void begin();

  /// An equilibrium was found in so many seconds.
  void record(MuscleState muscle, double seconds);

  /// In a bracket: ln(V/V_target) of the last equilibrium, and the misfit that ends it. Ignored in
  /// other parts.
  void misfit(double value, double accuracy);

  /// Equilibria that are left, by MuscleState.
  [[nodiscard]] std::array<double, 2> left() const;

  /// Negative while some muscle that is still to come has not been seen twice, or an open part is
  /// not over.
  [[nodiscard]] double seconds_left() const;

  /// ", about 3 min 20 s left"; ", 14 equilibria left" while the seconds are not known, ", at least
  /// 14 equilibria left" while their number is not.
  [[nodiscard]] std::string words() const;

 private:
  /// Durations of one muscle's equilibria.
  struct Muscle {
    bool is_known = false;         ///< the first, from afar, has been found
    std::deque<double> far, near;  ///< of trials; of neighbours in this part [s]
  };
  [[nodiscard]] bool is_open() const;
  [[nodiscard]] double left_of_part(std::size_t muscle) const;
  [[nodiscard]] double left_of_bracket() const;
  [[nodiscard]] std::optional<double> duration(const Muscle& muscle, std::size_t part) const;

  std::vector<FitPart> parts_;
  std::size_t part_ = 0;
  bool begun_ = false;
  std::array<double, 2> done_{};  ///< of the present part
  std::vector<double> misfits_;   ///< of the present part
  double accuracy_ = 0.0;
  std::array<Muscle, 2> muscles_;
};

}  // namespace lv::calibrate
