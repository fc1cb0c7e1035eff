#include "lv/calibrate/root_search.hpp"

#include "lv/base/dense.hpp"

#include <algorithm>

namespace lv::calibrate {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double shortest_try = 3e-4;  // of a step that is worth an evaluation, of each component
constexpr double share_of_misfit = 0.05;

double largest(const VectorXd& v) {
  return v.cwiseAbs().maxCoeff();
}

class RootFinder {
 public:
  RootFinder(const CostlyModel& model, const RootSearch& search)
      : model_(model), search_(search), longest_(search.longest) {}

  Outcome<FoundRoot> run(const VectorXd& start) {
    at_.x = start.cwiseMax(search_.low).cwiseMin(search_.high);
    const auto first = ask(at_.x, search_.rough);
    if (!first)
      return first.why();
    move_to(at_.x, *first, search_.rough);
    while (!at_.found && at_.evaluations < search_.most && go_on()) {
    }
    return at_;
  }

 private:
  Outcome<VectorXd> ask(const VectorXd& x, double accuracy) {
    ++at_.evaluations;
    return model_.misfits(x, accuracy);
  }

  void move_to(const VectorXd& x, const VectorXd& r, double accuracy) {
    at_.x = x;
    at_.r = r;
    accuracy_ = accuracy;
    at_.found = accuracy <= search_.accuracy && largest(r) <= search_.tolerance;
    if (!at_.found)
      slopes_ = model_.slopes(x);
  }

  /// Whether there is anything left to try.
  bool go_on() {
    if (largest(at_.r) <= search_.tolerance)
      return look_closely();
    const MatrixXd J = corrected();
    const VectorXd full = -dense::least_squares(J, at_.r);
    const double shortening = std::min(1.0, longest_ / largest(full));
    const VectorXd step =
        (at_.x + shortening * full).cwiseMax(search_.low).cwiseMin(search_.high) - at_.x;
    return largest(step) >= shortest_try && try_step(step, J);
  }

  bool look_closely() {
    const auto r = ask(at_.x, search_.accuracy);
    if (r)
      move_to(at_.x, *r, search_.accuracy);
    else
      at_.last_failure = r.why();
    return static_cast<bool>(r);
  }

  bool try_step(const VectorXd& step, const MatrixXd& J) {
    const double accuracy =
        std::clamp(share_of_misfit * largest(at_.r), search_.accuracy, search_.rough);
    const auto r = ask(at_.x + step, accuracy);
    if (!r) {
      at_.last_failure = r.why();
      longest_ = 0.4 * largest(step);
      return true;
    }
    correction_ += (*r - at_.r - J * step) * step.transpose() / step.squaredNorm();
    if (r->norm() < at_.r.norm()) {
      move_to(at_.x + step, *r, accuracy);
      longest_ = std::min(search_.longest, 2.0 * longest_);
    } else {
      longest_ = 0.4 * largest(step);
    }
    return true;
  }

  [[nodiscard]] MatrixXd corrected() {
    if (correction_.size() == 0)
      correction_ = MatrixXd::Zero(slopes_.rows(), slopes_.cols());
    return slopes_ + correction_;
  }

  const CostlyModel& model_;
  const RootSearch& search_;
  FoundRoot at_;
  MatrixXd slopes_, correction_;
  double accuracy_ = 0.0;  ///< of the misfits at hand
  double longest_;
};

}  // namespace

Outcome<FoundRoot> search_root(const CostlyModel& model, const VectorXd& start,
                               const RootSearch& search) {
  return RootFinder(model, search).run(start);
}

/// One component after the other, again and again: a convex problem of a few unknowns.
VectorXd least_within(const MatrixXd& J, const VectorXd& r, const VectorXd& low,
                      const VectorXd& high) {
  constexpr int sweeps = 1000;
  VectorXd s = VectorXd::Zero(J.cols());
  VectorXd left = r;
  for (int n = 0; n < sweeps; ++n)
    for (Eigen::Index j = 0; j < J.cols(); ++j) {
      if (J.col(j).isZero(0.0))
        continue;
      const double best = s[j] - J.col(j).dot(left) / J.col(j).squaredNorm();
      const double change = std::clamp(best, low[j], high[j]) - s[j];
      s[j] += change;
      left += change * J.col(j);
    }
  return left;
}

}  // namespace lv::calibrate
