#include "lv/implicit/unload.hpp"

#include "lv/base/dense.hpp"
#include "lv/base/log.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/implicit/inverse.hpp"
#include "lv/implicit/linear_work.hpp"
#include "lv/implicit/smooth_fields.hpp"
#include "lv/implicit/unload_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <deque>
#include <span>

namespace lv::implicit {
namespace {

constexpr std::size_t depth = 6;  // of Anderson's method
constexpr double smallest_damping = 1.0 / 16;
constexpr double smallest_share = 1.0 / 64;  // of the pressure, before it gives up
constexpr double far_below = 0.02;
constexpr double loose = 0.5;  // tolerance on the way to the whole pressure, and what is near [mm]

constexpr int creeping = 20;  // equilibria, failed ones included, without halving the distance

constexpr double near_end = 2.0;  // of the given shape: no trial begins from no load there [mm]

constexpr int smooth_degree = 3;
constexpr std::array<double, 6> smoothings{0.8, 0.4, 0.2, 0.1, 0.05, 0.025};  // alpha

using Nodes = std::vector<Vec3>;

Eigen::Map<const Eigen::VectorXd> as_vector(const Nodes& shape) {
  return {shape.front().data(), static_cast<Eigen::Index>(3 * shape.size())};
}

Nodes as_nodes(const Eigen::VectorXd& numbers) {
  Nodes shape(static_cast<std::size_t>(numbers.size() / 3));
  for (std::size_t a = 0; a < shape.size(); ++a)
    shape[a] = numbers.segment<3>(static_cast<Eigen::Index>(3 * a));
  return shape;
}

/// A shape without load, and what becomes of it.
struct Trial {
  Eigen::VectorXd X;  ///< nodes
  Eigen::VectorXd R;  ///< given shape minus x(X), and what smoothing adds
  State loaded;
  UnloadStep step;
  double left = 0.0;      ///< largest of R [mm]
  double pressure = 0.0;  ///< [kPa]
};

class Unloader {
 public:
  Unloader(const mesh::Mesh& given, const StaticModel& model, const UnloadParameters& parameters,
           const SolverParameters& solver, UnloadTask task)
      : given_(given),
        model_(model),
        parameters_(parameters),
        solver_(solver),
        record_(std::move(task.record)),
        afterwards_(task.afterwards),
        folded_volume_(task.folded_volume),
        endocardium_(given),
        find_folds_(given),
        target_(as_vector(given.nodes)),
        forecast_(far_below * parameters.tolerance) {}

  Outcome<Unloaded> run(const Unloaded* start) {
    if (start != nullptr && start->smoothing > 0.0) {
      now_ = {as_vector(start->nodes), {}, start->loaded, {}};
      if (auto as_smooth = smooth(now_.X, std::array{start->smoothing}))
        return as_smooth;
      forget();
      start = nullptr;
    }
    if (inverse_finds(start))
      return result();
    const std::optional<Unloaded> inverse = near_inverse();
    if (!inverse && has_inverse())
      warn();
    if (inverse)
      start = &*inverse;
    forget();
    const double work_before = linear_work();
    if (start == nullptr || !(try_from(as_vector(start->nodes), loaded_of(*start)) || is_near()))
      approach();
    if (has_wall() && is_folded(now_.step.folds)) {
      log::info("the wall that is looked for is folded: {}", words(now_.step.folds));
      return smooth(target_ + smoothed(now_.X), smoothings);
    }
    if (is_near_enough()) {
      Unloaded found = result();
      found.polishing = inverse ? linear_work() - work_before : 0.0;
      return found;
    }
    if (!is_near() || equilibria_ >= parameters_.iterations)
      return not_found();
    log::info("the search comes no nearer than {:.3g} mm", now_.left);
    return smooth(now_.X, smoothings);
  }

 private:
  static const State* loaded_of(const Unloaded& start) {
    return start.loaded.positions.empty() ? nullptr : &start.loaded;
  }

  [[nodiscard]] bool has_inverse() const {
    return solver_.newton.linear.method == LinearMethod::direct;
  }

  /// By the inverse problem, a wall without folds that loaded again is within the tolerance.
  bool inverse_finds(const Unloaded* start) {
    if (!has_inverse())
      return false;
    std::optional<Reference> guess;
    if (start != nullptr)
      guess = Reference{start->nodes, start->loaded.pressures};
    const auto found = find_reference(given_, model_, parameters_.pressure, solver_.newton,
                                      guess ? &*guess : nullptr, afterwards_);
    if (!found)
      return false;
    const mesh::Mesh wall = mesh::with_nodes(given_, found->nodes);
    Engine engine(wall, model_, solver_);
    pressure_ = parameters_.pressure;
    if (!engine.find({given_.nodes, found->pressures}, {engine.equations().steady(0.0), pressure_})
             .converged)
      return false;
    now_ = trial_of(as_vector(wall.nodes), engine.state());
    steps_.push_back(now_.step);
    const bool is_found = now_.left <= parameters_.tolerance && !is_folded(now_.step.folds);
    const bool says_left = is_found && afterwards_ > 0.0;
    log::info("unloaded: {:.2f} ml fill to {:.2f} ml at {:.2f} mmHg, off by {:.2g} mm{}",
              1e-3 * now_.step.unloaded_volume, 1e-3 * now_.step.volume, pressure_ / units::mmHg,
              now_.left, says_left ? time_left(afterwards_) + " of unloading" : "");
    return is_found;
  }

  /// What the inverse problem led near to: fixed points may lead nearer.
  [[nodiscard]] std::optional<Unloaded> near_inverse() const {
    if (!is_near() || is_folded(now_.step.folds))
      return {};
    return Unloaded{as_nodes(now_.X), now_.loaded, {}};
  }

  Unloaded result() {
    if (now_.left > parameters_.tolerance)
      log::info("the search comes no nearer than {:.3g} mm, which is near enough", now_.left);
    return {as_nodes(now_.X), std::move(now_.loaded), std::move(steps_), smoothing_, 0.0};
  }

  void forget() {
    now_ = {};
    steps_.clear();
    smooth_.reset();
    passes_folds_ = false;
    smoothing_ = 0.0;
  }

  /// Whether any wall had an equilibrium.
  [[nodiscard]] bool has_wall() const { return now_.X.size() > 0; }

  /// Whether the search has come near under the whole pressure.
  [[nodiscard]] bool is_near() const {
    return has_wall() && now_.pressure == parameters_.pressure && now_.left <= loose;
  }

  /// Whether it is a result under the whole pressure, at least where no step leads nearer.
  [[nodiscard]] bool is_near_enough() const {
    return has_wall() && now_.pressure == parameters_.pressure && !is_folded(now_.step.folds) &&
           now_.left <= std::max(parameters_.tolerance, parameters_.near_enough);
  }

  /// Whether it is near enough and hardly comes nearer, or creeps.
  [[nodiscard]] bool is_done_with() const {
    return is_creeping() || (is_near_enough() && equilibria_ - halved_ >= UnloadForecast::patience);
  }

  [[nodiscard]] bool is_creeping() const { return equilibria_ - halved_ >= creeping; }

  /// P (X - x*)
  [[nodiscard]] Eigen::VectorXd smoothed(const Eigen::VectorXd& X) const {
    return SmoothFields(given_.nodes, smooth_degree).nearest(X - target_);
  }

  /// What follows may take a minute.
  void warn() const {
    const std::string why = has_wall() && is_folded(now_.step.folds)
                                ? fmt::format("is folded ({})", words(now_.step.folds))
                                : "was not found";
    log::warn(
        "the wall without load that becomes the seen shape at {:.2f} mmHg {}: that shape cannot be "
        "reached unless a smooth wall near by is found",
        parameters_.pressure / units::mmHg, why);
  }

  [[nodiscard]] Unsolved not_found() const {
    if (!has_wall())
      return {fmt::format("The shape without load was not found: no wall that was tried has an "
                          "equilibrium at {:.2f} mmHg or a 64th of it",
                          parameters_.pressure / units::mmHg),
              "Check unloaded.pressure, the stiffness and the mesh's worst element"};
    return {fmt::format("The shape without load was not found at {:.2f} mmHg: loaded again it is "
                        "off by {:.3g} mm (rms {:.3g} mm) at {:.2f} mmHg after {} equilibria",
                        parameters_.pressure / units::mmHg, now_.step.largest, now_.step.rms,
                        now_.pressure / units::mmHg, equilibria_),
            "Check unloaded.pressure (a soft wall may never have had so much), or raise "
            "unloaded.near_enough or unloaded.iterations"};
  }

  /// Of a search that met a fold, with the nearest smooth wall, if there is one.
  [[nodiscard]] Unsolved folded(const UnloadStep& exact, const std::optional<Trial>& best) const {
    const std::string smooth = best ? fmt::format(
                                          "the nearest smooth one is off by {:.3g} mm rms ({:.3g} "
                                          "mm at most), loaded again",
                                          best->step.rms, best->step.largest)
                                    : "no smooth one near it was found";
    return {fmt::format("The wall that becomes the given shape at {:.2f} mmHg is folded: {}; {}",
                        parameters_.pressure / units::mmHg, words(exact.folds), smooth),
            "Check unloaded.pressure and the stiffness (a softer wall under more pressure unloads "
            "farther), look at the drawn borders for flat or thin places, or raise "
            "unloaded.smooth_within"};
  }

  [[nodiscard]] static std::string words(const mesh::Folds& folds) {
    return fmt::format(
        "it turns inwards by {:.0f} degrees within three thicknesses near ({:.0f}, {:.0f}, {:.0f}) "
        "mm, parts that lie apart come to {:.0f}% of their distance, and muscle is stretched "
        "{:.2f} times",
        folds.dent / units::degree, folds.dent_place.x(), folds.dent_place.y(),
        folds.dent_place.z(), 100.0 * folds.approach, folds.stretch);
  }

  /// From a wall near the last one, ever less smooth; the last without folds.
  Outcome<Unloaded> smooth(Eigen::VectorXd X, std::span<const double> alphas) {
    const Trial exact = now_;
    pressure_ = parameters_.pressure;
    smooth_.emplace(given_.nodes, smooth_degree);
    std::optional<Trial> best;
    for (const double alpha : alphas) {
      if (!settles(X, alpha, !best))
        break;
      best = now_;
      X = now_.X;
    }
    return near_enough(best, exact);
  }

  /// Whether the search for a smooth wall ends at one without folds.
  bool settles(const Eigen::VectorXd& X, double alpha, bool passes_folds) {
    smoothing_ = alpha;
    passes_folds_ = passes_folds;
    return begin(X, &now_.loaded) && (improve(parameters_.tolerance) || is_near_enough()) &&
           !is_folded(now_.step.folds);
  }

  Outcome<Unloaded> near_enough(std::optional<Trial>& best, const Trial& exact) {
    if (!best || best->step.rms > parameters_.smooth_within) {
      tell_folded_volume(best.has_value());
      if (is_folded(exact.step.folds))
        return folded(exact.step, best);
      now_ = exact;
      return not_found();
    }
    smoothing_ = best->step.smoothing;
    now_ = std::move(*best);
    steps_.push_back(now_.step);
    return result();
  }

  /// Of the smoothest wall that was tried, where that is folded too.
  void tell_folded_volume(bool has_smooth) const {
    if (folded_volume_ != nullptr && !has_smooth && now_.left <= parameters_.tolerance &&
        is_folded(now_.step.folds))
      *folded_volume_ = now_.step.unloaded_volume;
  }

  /// The whole pressure from one guess; false when that has no equilibrium or does not lead to the
  /// tolerance.
  bool try_from(const Eigen::VectorXd& X, const State* loaded) {
    pressure_ = parameters_.pressure;
    return begin(X, loaded) && improve(parameters_.tolerance);
  }

  /// From the given shape, by a part of the pressure where the whole is too much at once.
  void approach() {
    if (try_from(target_, nullptr) || is_near())
      return;
    if (has_wall() && (is_folded(now_.step.folds) || is_creeping()))
      return;
    double reached = 0.0;
    double share = 0.5;
    Eigen::VectorXd X = target_;
    Eigen::VectorXd slope;  // dX/d(share), once two are known
    while (reached < 1.0 && share >= smallest_share && equilibria_ < parameters_.iterations) {
      const double next = std::min(1.0, reached + share);
      const Eigen::VectorXd guess =
          slope.size() > 0 ? Eigen::VectorXd(X + (next - reached) * slope) : X;
      pressure_ = next * parameters_.pressure;
      log::info("unloading from {:.2f} mmHg first", pressure_ / units::mmHg);
      if (begin(guess, nullptr) && improve(next < 1.0 ? loose : parameters_.tolerance)) {
        slope = (now_.X - X) / (next - reached);
        X = now_.X;
        reached = next;
      } else if (is_near()) {
        return;
      } else {
        share *= 0.5;
      }
    }
  }

  bool begin(const Eigen::VectorXd& X, const State* loaded) {
    if (!smooth_)
      steps_.clear();
    history_.clear();
    forecast_.begin(loaded != nullptr);
    auto trial = load(X, loaded, true);
    if (!trial)
      return false;
    accept(std::move(*trial));
    return true;
  }

  /// Steps until the distance is far below the tolerance, or below it and hardly falls any more;
  /// false when no step brings the wall near enough. What is left scatters the volumes of a fit.
  bool improve(double tolerance) {
    while (now_.left > far_below * tolerance) {
      const double before = now_.left;
      if (!advance())
        break;
      const bool ends = !passes_folds_ && is_folded(now_.step.folds);
      if (now_.left > 0.5 * before && (now_.left <= tolerance || ends))
        break;
    }
    return now_.left <= tolerance;
  }

  bool advance() {
    if (!history_.empty() && step_along(accelerated(), true))
      return true;
    history_.clear();
    return step_along(now_.R, false);
  }

  bool step_along(const Eigen::VectorXd& direction, bool is_accelerated) {
    const double least = is_accelerated ? 0.5 : smallest_damping;
    for (double damping = 1.0; damping >= least; damping *= 0.5) {
      if (equilibria_ >= parameters_.iterations || is_done_with())
        return false;
      auto trial = load(now_.X + damping * direction, &now_.loaded, now_.step.largest > near_end);
      if (!trial || trial->R.norm() >= now_.R.norm())
        continue;
      trial->step.damping = damping;
      trial->step.accelerated = is_accelerated;
      history_.push_back({trial->X - now_.X, trial->R - now_.R});
      if (history_.size() > depth)
        history_.pop_front();
      accept(std::move(*trial));
      return true;
    }
    return false;
  }

  [[nodiscard]] Eigen::VectorXd accelerated() const {
    const auto n = static_cast<Eigen::Index>(history_.size());
    Eigen::MatrixXd dX(target_.size(), n), dR(target_.size(), n);
    for (Eigen::Index j = 0; j < n; ++j) {
      dX.col(j) = history_[static_cast<std::size_t>(j)].dX;
      dR.col(j) = history_[static_cast<std::size_t>(j)].dR;
    }
    const Eigen::VectorXd gamma = dense::least_squares(dR, now_.R);
    return now_.R - (dX + dR) * gamma;
  }

  /// The equilibrium of X; nothing where the wall is turned inside out or has none.
  std::optional<Trial> load(const Eigen::VectorXd& X, const State* near, bool from_rest) {
    const mesh::Mesh wall = mesh::with_nodes(given_, as_nodes(X));
    if (!is_sound(wall))
      return {};
    std::optional<State> loaded = next_equilibrium(wall, near, from_rest);
    if (!loaded)
      return {};
    return trial_of(X, std::move(*loaded));
  }

  [[nodiscard]] Trial trial_of(const Eigen::VectorXd& X, State loaded) const {
    const Nodes nodes = as_nodes(X);
    Trial trial{X, {}, std::move(loaded), {}};
    trial.step.volume = endocardium_.volume(trial.loaded.positions);
    trial.R = target_ - as_vector(trial.loaded.positions);
    trial.step.unloaded_volume = endocardium_.volume(nodes);
    trial.step.largest = largest_of(trial.R);
    trial.step.rms = std::sqrt(3.0 * trial.R.squaredNorm() / static_cast<double>(trial.R.size()));
    trial.step.folds = find_folds_(nodes);
    trial.step.smoothing = smoothing_;
    trial.left = trial.step.largest;
    trial.pressure = pressure_;
    if (smooth_) {
      const Eigen::VectorXd U = X - target_;
      trial.R -= smoothing_ * (U - smooth_->nearest(U));
      trial.left = largest_of(trial.R);
    }
    return trial;
  }

  static double largest_of(const Eigen::VectorXd& R) {
    return Eigen::Map<const Eigen::Matrix3Xd>(R.data(), 3, R.size() / 3)
        .colwise()
        .norm()
        .maxCoeff();
  }

  /// From the record, or found and put there.
  std::optional<State> next_equilibrium(const mesh::Mesh& wall, const State* near, bool from_rest) {
    const auto n = static_cast<std::size_t>(equilibria_++);
    if (n >= record_.known.size()) {
      const auto began = std::chrono::steady_clock::now();
      record_.known.push_back(equilibrium(wall, near, from_rest));
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - began;
      forecast_.sought(elapsed.count());
      if (record_.keep)
        record_.keep(record_.known);
    }
    return record_.known[n];
  }

  /// From the guesses, then perhaps all the way from no load. Steps near the end of the search do
  /// without: an equilibrium that no guess leads to is another one, if there is any, and dear.
  std::optional<State> equilibrium(const mesh::Mesh& wall, const State* near, bool from_rest) {
    Engine engine(wall, model_, solver_);
    if (near != nullptr) {
      for (const State& guess : guesses(wall, *near))
        if (engine.find(guess, {engine.equations().steady(0.0), pressure_}).converged)
          return engine.state();
      if (!from_rest)
        return {};
      engine.relax();
    }
    const auto volume = engine.go_to({pressure_, 0.0});
    if (volume)
      return engine.state();
    log::info("a wall that was tried without load has no equilibrium: {}", volume.why().what);
    return {};
  }

  /// The given shape, which is near what is looked for unless the wall is a smooth one; and the
  /// last equilibrium, moved as the wall is.
  [[nodiscard]] std::vector<State> guesses(const mesh::Mesh& wall, const State& near) const {
    std::vector<State> all;
    if (!smooth_)
      all.push_back({given_.nodes, near.pressures});
    if (has_wall())
      all.push_back(
          {as_nodes(as_vector(near.positions) + as_vector(wall.nodes) - now_.X), near.pressures});
    return all;
  }

  void accept(Trial&& trial) {
    now_ = std::move(trial);
    steps_.push_back(now_.step);
    if (history_.empty() || now_.left <= 0.5 * half_of_) {
      half_of_ = now_.left;
      halved_ = equilibria_;
    }
    forecast_.accepted(now_.left, equilibria_ - halved_);
    // on the way to the whole pressure it is not known how many steps of it there will be
    const double left = pressure_ < parameters_.pressure ? -1.0 : forecast_.seconds_left();
    log::info(
        "unloading {:2d}: off by {:.4f} mm (rms {:.4f}), {:.2f} ml fill to {:.2f} ml at {:.2f} "
        "mmHg, dent {:.0f} degrees{}",
        equilibria_, now_.step.largest, now_.step.rms, 1e-3 * now_.step.unloaded_volume,
        1e-3 * now_.step.volume, pressure_ / units::mmHg, now_.step.folds.dent / units::degree,
        left < 0.0 ? "" : time_left(left + afterwards_) + " of unloading");
  }

  struct Difference {
    Eigen::VectorXd dX, dR;
  };

  const mesh::Mesh& given_;
  const StaticModel& model_;
  const UnloadParameters& parameters_;
  const SolverParameters& solver_;
  UnloadRecord record_;
  double afterwards_;      ///< what the caller does then [s]
  double* folded_volume_;  ///< UnloadTask::folded_volume
  solid::EndocardialSurface endocardium_;
  mesh::FoldFinder find_folds_;
  Eigen::VectorXd target_;
  std::optional<SmoothFields> smooth_;  ///< once a fold was met
  double smoothing_ = 0.0;              ///< alpha
  bool passes_folds_ = false;           ///< a wall may be folded on the way to a smooth one
  double pressure_ = 0.0;               ///< in force [kPa]
  int equilibria_ = 0;
  int halved_ = 0;        ///< equilibria by which the distance was last halved
  double half_of_ = 0.0;  ///< the distance then [mm]
  UnloadForecast forecast_;
  Trial now_;
  std::deque<Difference> history_;
  std::vector<UnloadStep> steps_;
};

}  // namespace

Outcome<Unloaded> unload(const mesh::Mesh& given, const StaticModel& model,
                         const UnloadParameters& parameters, const SolverParameters& solver,
                         UnloadTask task) {
  const Unloaded* start = task.start;
  return Unloader(given, model, parameters, solver, std::move(task)).run(start);
}

}  // namespace lv::implicit
