#include "lv/implicit/arc_length.hpp"

#include "lv/base/interrupt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace lv::implicit {
namespace {

constexpr double load_scale = 1.0;  // w [mm]
constexpr double kept_below = 0.3;  // ratio of corrections with which a tangent serves on
constexpr int most_corrections = 12;
constexpr int few_corrections = 4, many_corrections = 8;
constexpr double longer = 1.5;

/// Of the path, or a correction: a change of all unknowns, and of the share of the loads.
struct Change {
  std::vector<double> u;
  double share = 0.0;
};

struct Balance {
  State state;
  double share = 0.0;
};

Balance along(Balance p, const Change& by, double times) {
  const double* next = by.u.data();
  for (Vec3& x : p.state.positions)
    for (int i = 0; i < 3; ++i)
      x[i] += times * *next++;
  for (double& pressure : p.state.pressures)
    pressure += times * *next++;
  p.share += times * by.share;
  return p;
}

class Follower {
 public:
  Follower(const Equations& equations, const WayOfLoads& way, const PathParameters& parameters,
           const std::function<void(const PathStep&, const State&)>& observe)
      : equations_(equations),
        way_(way),
        parameters_(parameters),
        observe_(observe),
        tangent_(equations.pattern(), parameters.linear, equations.undeformed()) {}

  Path run(State& state, double share) {
    now_ = {state, share};
    if (set_direction({}))
      go();
    state = std::move(now_.state);
    path_.share = now_.share;
    return std::move(path_);
  }

 private:
  void go() {
    double length = parameters_.first;
    for (int step = 0; step < parameters_.most_steps && !path_.arrived && path_.why.empty();
         ++step) {
      interrupt::check_together();
      std::optional<Balance> next = corrected(along(now_, direction_, length), direction_);
      if (next && next->share >= 1.0)
        next = at_the_end(*next);
      if (!next) {
        length *= 0.25;
        if (length < parameters_.shortest)
          give_up("no equilibrium was found a short way along the path");
        else if (!factorise(now_))
          give_up("the tangent is singular");
        continue;
      }
      accept(*next, length);
      length = next_length(length);
    }
    if (!path_.arrived && path_.why.empty())
      give_up(fmt::format("{} steps were not enough", parameters_.most_steps));
  }

  void give_up(const std::string& why) { path_.why = why; }

  [[nodiscard]] double next_length(double length) const {
    if (corrections_ >= many_corrections)
      return length / longer;
    return corrections_ > few_corrections ? length : std::min(length * longer, parameters_.longest);
  }

  /// The equilibrium with all of the loads, between the last one and one beyond.
  std::optional<Balance> at_the_end(const Balance& beyond) {
    const double part = (1.0 - now_.share) / (beyond.share - now_.share);
    Balance guess = now_;
    for (std::size_t a = 0; a < guess.state.positions.size(); ++a)
      guess.state.positions[a] += part * (beyond.state.positions[a] - now_.state.positions[a]);
    for (std::size_t m = 0; m < guess.state.pressures.size(); ++m)
      guess.state.pressures[m] += part * (beyond.state.pressures[m] - now_.state.pressures[m]);
    guess.share = 1.0;
    if (!factorise(guess))
      return {};
    const int before = corrections_;
    std::optional<Balance> end =
        corrected(std::move(guess), {std::vector<double>(response_.size(), 0.0), 1.0});
    corrections_ += before;
    return end;
  }

  void accept(const Balance& next, double length) {
    const Change before = direction_;
    const double share = now_.share;
    now_ = next;
    path_.arrived = next.share == 1.0;
    if (!set_direction(before) && !path_.arrived)
      return;
    if (before.share * direction_.share < 0.0 && !path_.arrived)
      note_turn(share, before.share, length);
    if (observe_)
      observe_({now_.share, direction_.share, length,
                equations_.endocardium().volume(now_.state.positions), corrections_},
               now_.state);
  }

  /// s by the length l is a parabola between two points of which slopes are known.
  void note_turn(double share, double slope, double length) {
    const double to_turn = length * slope / (slope - direction_.share);
    Turn turn{.share = share + 0.5 * slope * to_turn, .is_highest = slope > 0.0};
    double largest = 0.0, sum = 0.0, sum_of_squares = 0.0;
    const std::size_t nodes = now_.state.positions.size();
    for (std::size_t a = 0; a < nodes; ++a) {
      const double m = Eigen::Map<const Vec3>(direction_.u.data() + 3 * a).squaredNorm();
      sum += m;
      sum_of_squares += m * m;
      if (m > largest)
        turn.place = equations_.undeformed()[a];
      largest = std::max(largest, m);
    }
    turn.width = sum * sum / (static_cast<double>(nodes) * sum_of_squares);
    path_.turns.push_back(turn);
  }

  /// The mean over the nodes of the products of displacements.
  [[nodiscard]] double product(const std::vector<double>& a, const std::vector<double>& b) const {
    const auto nodes = static_cast<std::size_t>(equations_.node_count());
    double sum = 0.0;
    for (std::size_t k = 0; k < 3 * nodes; ++k)
      sum += a[k] * b[k];
    return sum / static_cast<double>(nodes);
  }

  [[nodiscard]] double product(const Change& a, const Change& b) const {
    return product(a.u, b.u) + load_scale * load_scale * a.share * b.share;
  }

  /// The path's direction at the present point, the way the last one went, and the tangent there.
  bool set_direction(const Change& last) {
    if (!factorise(now_)) {
      give_up("the tangent is singular");
      return false;
    }
    Change t{response_, 1.0};
    const double size = std::sqrt(product(t, t));
    const bool is_back = !last.u.empty() && product(t, last) < 0.0;
    const double factor = (is_back ? -1.0 : 1.0) / size;
    for (double& k : t.u)
      k *= factor;
    t.share *= factor;
    direction_ = std::move(t);
    return true;
  }

  /// K, and b.
  bool factorise(const Balance& p) {
    const Loads loads = way_.at(p.share);
    equations_.tangent(p.state, loads, tangent_);
    std::vector<double> slope = equations_.residual(p.state, way_.to);
    const std::vector<double> at_start = equations_.residual(p.state, way_.from);
    if (slope.empty() || at_start.empty())
      return false;
    for (std::size_t k = 0; k < slope.size(); ++k)
      slope[k] = at_start[k] - slope[k];
    auto b = tangent_.solve(slope);
    if (!b)
      return false;
    response_ = *b;
    return true;
  }

  /// Newton's method from a point that satisfies the second equation, which is linear, with the
  /// tangent at hand at first.
  std::optional<Balance> corrected(Balance p, const Change& t) {
    double last = std::numeric_limits<double>::infinity();
    bool is_fresh = false;
    for (corrections_ = 1; corrections_ <= most_corrections; ++corrections_) {
      const std::optional<Change> change = correction(p, t);
      if (!change)
        return {};
      const double size = std::sqrt(product(*change, *change));
      if (size > kept_below * last && !is_fresh) {
        if (!factorise(p))
          return {};
        is_fresh = true;
        continue;
      }
      if (size > last)
        return {};
      p = along(std::move(p), *change, 1.0);
      if (size <= parameters_.tolerance)
        return p;
      is_fresh = false;
      last = size;
    }
    return {};
  }

  std::optional<Change> correction(const Balance& p, const Change& t) {
    const std::vector<double> R = equations_.residual(p.state, way_.at(p.share));
    if (R.empty())
      return {};
    auto against = tangent_.solve(R);
    if (!against)
      return {};
    Change change{*against, 0.0};
    change.share =
        product(t.u, change.u) / (load_scale * load_scale * t.share + product(t.u, response_));
    for (std::size_t k = 0; k < change.u.size(); ++k)
      change.u[k] = change.share * response_[k] - change.u[k];
    return change;
  }

  const Equations& equations_;
  const WayOfLoads& way_;
  const PathParameters& parameters_;
  const std::function<void(const PathStep&, const State&)>& observe_;
  SparseMatrix tangent_;
  std::vector<double> response_;  ///< b
  Change direction_;              ///< t
  Balance now_;
  int corrections_ = 0;
  Path path_;
};

}  // namespace

Path follow_path(const Equations& equations, State& state, double share, const WayOfLoads& way,
                 const PathParameters& parameters,
                 const std::function<void(const PathStep&, const State&)>& observe) {
  return Follower(equations, way, parameters, observe).run(state, share);
}

}  // namespace lv::implicit
