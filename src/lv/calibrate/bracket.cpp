#include "lv/calibrate/bracket.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace lv::calibrate {
namespace {

constexpr double shortest = 1e-2;   // step, of the unknown's logarithm
constexpr double overshoot = 1.5;   // of a step to where the last two trials let expect the root
constexpr double narrowest = 1e-7;  // bracket, of the unknown's logarithm
// volumes of walls that are unloaded anew scatter: a bracket that closes this much farther off, in
// units of the accuracy, counts as a root
constexpr double scatter = 20.0;
constexpr std::uintmax_t most_trials = 60;
constexpr double misfit_nowhere = -10.0;  // misfit where there is no equilibrium
// times the start, where that has no equilibrium: less first, since muscle that contracts more than
// its wall can follow is the usual reason
constexpr std::array<double, 4> other_starts{0.5, 2.0, 0.25, 4.0};

class Search {
 public:
  Search(const std::function<Outcome<double>(double)>& volume, const Unknown& unknown,
         const Target& target, double accuracy)
      : volume_(volume),
        unknown_(unknown),
        target_(target),
        accuracy_(accuracy),
        low_(std::log(unknown.range.low)),
        high_(std::log(unknown.range.high)) {}

  Outcome<double> run() {
    const Outcome<Point> start = first_point();
    return start ? outwards_from(*start) : start.why();
  }

 private:
  struct Point {
    double log_x, f;
  };

  Outcome<double> outwards_from(const Point& start) {
    auto [a, f_a] = start;
    if (f_a == 0.0)
      return std::exp(a);
    double away = f_a > 0.0 ? 1.0 : -1.0;  // a cavity too large asks for more of the unknown
    double step = std::log(unknown_.first_factor);
    std::optional<Point> before;
    while (true) {
      step = std::min(step, way_from(a, away));
      const double b = std::clamp(a + away * step, low_, high_);
      if (std::abs(b - a) < shortest)
        refuse({a, f_a}, before, away > 0.0 ? high_ : low_);
      const Outcome<double> f_b = misfit(b);
      if (!f_b) {
        nowhere_ = {b, f_b.why().what};
        step *= 0.25;
        continue;
      }
      if (f_a * *f_b <= 0.0 && (f_a > 0.0 || away < 0.0))
        return away > 0.0 ? between(a, b, f_a, *f_b) : between(b, a, *f_b, f_a);
      if (f_a < 0.0 && *f_b < f_a) {  // smaller still: the other way, or the maximum is passed
        if (before)
          return beyond_maximum(*before, {b, *f_b});
        before = {b, *f_b};
        away = -away;
        continue;
      }
      before = {a, f_a};
      a = b;
      f_a = *f_b;
      if (f_a == 0.0)
        return std::exp(a);
      step = next_step({a, f_a}, *before);
    }
  }

  /// Twice the last one, or shorter where the straight line through the last two meets the target:
  /// the equilibrium of another muscle is dear where it lies far from the last.
  [[nodiscard]] static double next_step(const Point& now, const Point& before) {
    const double last = std::abs(now.log_x - before.log_x);
    const double to_root = last * now.f / (before.f - now.f);
    return to_root > 0.0 ? std::clamp(overshoot * to_root, 2.0 * shortest, 2.0 * last) : 2.0 * last;
  }

  /// The start, or another place that has an equilibrium if that has none.
  Outcome<Point> first_point() {
    const double start = std::clamp(std::log(unknown_.start), low_, high_);
    const Outcome<double> f = misfit(start);
    if (f)
      return Point{start, *f};
    nowhere_ = {start, f.why().what};
    for (const double multiple : other_starts) {
      const double x = start + std::log(multiple);
      if (x < low_ || x > high_)
        continue;
      if (const Outcome<double> other = misfit(x))
        return Point{x, *other};
    }
    return f.why();
  }

  /// How far a step from a place may go: half the way to where there is no equilibrium.
  [[nodiscard]] double way_from(double log_x, double away) const {
    const bool ahead = nowhere_ && away * (nowhere_->log_x - log_x) > 0.0;
    return ahead ? 0.5 * std::abs(nowhere_->log_x - log_x)
                 : std::numeric_limits<double>::infinity();
  }

  /// ln(V/V_target), and zero where that is small enough, which ends the search.
  Outcome<double> misfit(double log_x) {
    const Outcome<double> volume = volume_(std::exp(log_x));
    if (!volume)
      return volume.why();
    const double f = std::log(*volume / target_.volume);
    if (std::abs(f) < std::abs(nearest_.f))
      nearest_ = {log_x, f};
    return std::abs(f) <= accuracy_ ? 0.0 : f;
  }

  Outcome<double> between(double a, double b, double f_a, double f_b) {
    if (f_a == 0.0 || f_b == 0.0)
      return std::exp(f_a == 0.0 ? a : b);
    std::optional<Unsolved> hole;  // no equilibrium: found as a root, which ends the search
    const auto misfit_or_hole = [&](double log_x) {
      const Outcome<double> f = misfit(log_x);
      if (!f)
        hole = f.why();
      return f ? *f : 0.0;
    };
    std::uintmax_t trials = most_trials;
    const auto [x, y] = boost::math::tools::toms748_solve(
        misfit_or_hole, a, b, f_a, f_b, [](double l, double r) { return r - l < narrowest; },
        trials);
    if (hole)
      return *hole;
    if (x != y && std::abs(nearest_.f) <= scatter * accuracy_)
      return std::exp(nearest_.log_x);
    if (x != y && !changed_branch_)
      if (const auto root = on_other_branch(x, y))
        return *root;
    if (x != y)
      return Unsolved{fmt::format("The volume jumps between {0} = {1:.9g} and {2:.9g}",
                                  unknown_.name, std::exp(x), std::exp(y)),
                      "Lower quasi_static.tolerance, or raise calibrate.tolerance"};
    return std::exp(x);
  }

  /// Where a wall has two equilibria, the one that it came to first need not be the one that it
  /// keeps: of a jump an end whose volume is now on the other side of the target begins the search
  /// anew, on the branch of the other end. Nothing where both ends keep their sides.
  std::optional<Outcome<double>> on_other_branch(double x, double y) {
    changed_branch_ = true;
    for (const auto& [end, side] : {Point{x, 1.0}, Point{y, -1.0}}) {
      const Outcome<double> f = misfit(end);
      if (f && *f * side <= 0.0)
        return outwards_from({end, *f});
    }
    return {};
  }

  /// The stiffer root when a maximum of the volume lies between two points that have less.
  Outcome<double> beyond_maximum(const Point& a, const Point& b) {
    const Point& stiff = a.log_x > b.log_x ? a : b;
    std::uintmax_t trials = most_trials;
    constexpr int bits = 10;  // of the place
    const auto [log_x, minus_f] = boost::math::tools::brent_find_minima(
        [this](double x) {
          const Outcome<double> f = misfit(x);
          return f ? -*f : -misfit_nowhere;
        },
        std::min(a.log_x, b.log_x), std::max(a.log_x, b.log_x), bits, trials);
    if (minus_f > 0.0)
      refuse_beyond(log_x, -minus_f);
    return between(log_x, stiff.log_x, -minus_f, stiff.f);
  }

  [[noreturn]] void refuse_beyond(double log_x, double f) const {
    throw OutOfReach(target_.origin,
                     fmt::format("{:.2f} ml cannot be reached: the model's volume is largest near "
                                 "{} = {:.3g}, about {:.2f} ml, and smaller on both sides",
                                 1e-3 * target_.volume, unknown_.name, std::exp(log_x),
                                 1e-3 * target_.volume * std::exp(f)),
                     "Check this volume and its pressure, and unloaded.pressure; a muscle with "
                     "other exponents fills farther",
                     std::abs(f));
  }

  /// The misfit at the end of the range, on the line through two points; not known from one.
  static std::optional<double> expected(const Point& farthest, const std::optional<Point>& before,
                                        double end) {
    if (std::abs(end - farthest.log_x) < shortest)
      return farthest.f;
    if (!before || before->log_x == farthest.log_x)
      return {};
    const double slope = (farthest.f - before->f) / (farthest.log_x - before->log_x);
    return farthest.f + slope * (end - farthest.log_x);
  }

  /// Of the point that is farthest on the way to the target, towards `end`: at the end of the
  /// range, or where there is no equilibrium any farther, and why.
  [[noreturn]] void refuse(const Point& farthest, const std::optional<Point>& before,
                           double end) const {
    const double x = std::exp(farthest.log_x);
    const bool at_end = farthest.log_x - low_ < shortest || high_ - farthest.log_x < shortest;
    const std::optional<double> f_end = expected(farthest, before, end);
    const bool misses = f_end && *f_end * farthest.f > 0.0;
    throw OutOfReach(
        target_.origin,
        fmt::format(
            "{:.2f} ml cannot be reached: the model's volume is {:.2f} ml at {} = {:.3g}, {}",
            1e-3 * target_.volume, 1e-3 * target_.volume * std::exp(farthest.f), unknown_.name, x,
            at_end || !nowhere_ ? "the end of its range"
                                : "and no farther (" + nowhere_->why + ")"),
        fmt::format(
            "Check this volume and its pressure, and the shape that was seen{}",
            at_end ? fmt::format("; or widen the range of {} in [calibrate]", unknown_.name) : ""),
        misses ? std::abs(*f_end) : 0.0);
  }

  const std::function<Outcome<double>(double)>& volume_;
  const Unknown& unknown_;
  const Target& target_;
  double accuracy_;
  double low_, high_;
  bool changed_branch_ = false;
  /// The last place tried that has no equilibrium.
  struct Nowhere {
    double log_x;
    std::string why;
  };
  std::optional<Nowhere> nowhere_;
  Point nearest_{0.0, std::numeric_limits<double>::infinity()};
};

}  // namespace

Outcome<double> find_root(const std::function<Outcome<double>(double)>& volume,
                          const Unknown& unknown, const Target& target, double accuracy) {
  LV_CHECK(unknown.range.low > 0.0 && unknown.range.low < unknown.range.high);
  return Search(volume, unknown, target, accuracy).run();
}

}  // namespace lv::calibrate
