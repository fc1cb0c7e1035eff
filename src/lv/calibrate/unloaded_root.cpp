#include "lv/calibrate/unloaded_root.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace lv::calibrate {
namespace {

constexpr double longest_stride = 1.4;    // of the stiffness's logarithm: a factor of 4
constexpr double shortest_stride = 0.03;  // towards where there is no wall without load
constexpr double usual_slope = -0.6;      // d ln(seen - V)/d ln stiffness, before it is known
constexpr int most_walls = 30;
constexpr int most_without = 4;  // walls for which there is none without load, before one has

/// A wall that was tried: ln stiffness and ln((seen - V)/(seen - target)), which falls.
struct Tried {
  double log_x, f;
};

class UnloadedSearch {
 public:
  UnloadedSearch(const std::function<Outcome<double>(double)>& volume, const Unknown& stiffness,
                 const Target& target, double seen, double accuracy,
                 const std::function<double()>& folded_volume)
      : volume_(volume),
        folded_volume_(folded_volume),
        unknown_(stiffness),
        target_(target),
        seen_(seen),
        accuracy_(accuracy),
        low_(std::log(stiffness.range.low)),
        high_(std::log(stiffness.range.high)) {
    LV_CHECK(target.volume > 0.0 && target.volume < seen);
  }

  double run() {
    double x = std::clamp(std::log(unknown_.start), low_, high_);
    for (int n = 0; n < most_walls; ++n) {
      if (try_at(x))
        return std::exp(x);
      const double next = std::clamp(next_place(), low_, high_);
      if (at_its_end(next))
        refuse();
      x = next;
    }
    throw NoSolution(fmt::format("The search for the {} with which the wall holds {:.2f} ml "
                                 "without load does not come to an end",
                                 unknown_.name, 1e-3 * target_.volume),
                     "Lower quasi_static.tolerance, or raise calibrate.tolerance");
  }

 private:
  /// Whether the volume is near enough to the target.
  bool try_at(double log_x) {
    const Outcome<double> V = volume_(std::exp(log_x));
    if (!V) {
      ++without_;
      nowhere_ = std::max(log_x, nowhere_.value_or(log_x));
      reason_ = V.why().what;
      folds_above_ = folded_volume_ && folded_volume_() > target_.volume;
      return false;
    }
    if (std::abs(*V / target_.volume - 1.0) <= accuracy_)
      return true;
    before_ = now_;
    now_ = {log_x, std::log(std::max(1e-6, (seen_ - *V) / (seen_ - target_.volume)))};
    auto& end = now_->f > 0.0 ? soft_ : stiff_;
    if (!end || (now_->f > 0.0 ? log_x > end->log_x : log_x < end->log_x))
      end = now_;
    return false;
  }

  [[nodiscard]] double next_place() const {
    if (!now_)  // nothing known but that softer muscle has no wall without load
      return *nowhere_ + 0.5 * longest_stride;
    double slope = usual_slope;
    if (before_ && std::abs(before_->log_x - now_->log_x) > 0.0)
      slope = std::min(-0.1, (now_->f - before_->f) / (now_->log_x - before_->log_x));
    const Tried& from = now_->f < 0.0 && stiff_ ? *stiff_ : *now_;
    double next = from.log_x + std::clamp(-from.f / slope, -longest_stride, longest_stride);
    const double softest = soft_ ? soft_->log_x : nowhere_.value_or(low_ - longest_stride);
    if (stiff_ && next > stiff_->log_x)
      next = 0.5 * (softest + stiff_->log_x);
    if (next <= softest)
      next = 0.5 * (softest + from.log_x);
    return next;
  }

  /// Whether there is no farther to go, in the direction that is left.
  [[nodiscard]] bool at_its_end(double next) const {
    if (!now_)
      return *nowhere_ >= high_ || without_ >= most_without || folds_above_;
    if (soft_ && stiff_)
      return false;
    if (soft_)
      return soft_->log_x >= high_ || next <= soft_->log_x;
    return stiff_->log_x <= low_ || (nowhere_ && stiff_->log_x - *nowhere_ < shortest_stride);
  }

  [[noreturn]] void refuse() const {
    const std::string what = fmt::format(
        "The wall that holds {:.2f} ml as it was seen cannot hold {:.2f} ml without load, which "
        "Klotz's curve says",
        1e-3 * seen_, 1e-3 * target_.volume);
    const char* remedy =
        "Check unloaded.pressure and the shape, or give calibrate.passive another value; a wall "
        "that folds or turns inside out when it is unloaded is often drawn too thin somewhere, or "
        "pressed flat by the right ventricle, whose pressure septum.pressure_share gives";
    if (!now_)
      throw OutOfReach(
          target_.origin,
          fmt::format("{}: no stiffness up to {} = {:.3g} gives it a shape without load{}: {}",
                      what, unknown_.name, std::exp(*nowhere_),
                      folds_above_ ? ", with which it would hold more already" : "", reason_),
          remedy, 0.0);
    const Tried& end = soft_ ? *soft_ : *stiff_;
    const bool at_end_of_range = soft_ || !nowhere_;
    const double V = seen_ - (seen_ - target_.volume) * std::exp(end.f);
    throw OutOfReach(
        target_.origin,
        fmt::format("{}: at {} = {:.3g}, {}, it holds {:.2f} ml{}", what, unknown_.name,
                    std::exp(end.log_x),
                    at_end_of_range ? "the end of its range"
                                    : "the softest for which there is a shape without load",
                    1e-3 * V, at_end_of_range ? "" : " (softer: " + reason_ + ")"),
        remedy, at_end_of_range ? std::abs(std::log(V / target_.volume)) : 0.0);
  }

  const std::function<Outcome<double>(double)>& volume_;
  const std::function<double()>& folded_volume_;
  const Unknown& unknown_;
  const Target& target_;
  double seen_, accuracy_, low_, high_;
  std::optional<Tried> now_, before_;
  std::optional<Tried> soft_, stiff_;  ///< the nearest on both sides of the root
  std::optional<double> nowhere_;      ///< the stiffest without a wall free of load
  std::string reason_;                 ///< why there is none
  int without_ = 0;                    ///< such walls
  bool folds_above_ = false;           ///< the last of them holds more than the target
};

}  // namespace

double find_unloaded_root(const std::function<Outcome<double>(double)>& volume,
                          const Unknown& stiffness, const Target& target, double seen,
                          double accuracy, const std::function<double()>& folded_volume) {
  return UnloadedSearch(volume, stiffness, target, seen, accuracy, folded_volume).run();
}

}  // namespace lv::calibrate
