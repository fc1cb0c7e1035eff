#include "lv/calibrate/forecast.hpp"

#include "lv/base/check.hpp"
#include "lv/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lv::calibrate {
namespace {

constexpr std::size_t remembered = 5;       // equilibria of each kind
constexpr double remembered_answer = 1e-3;  // of a fit that was stopped and goes on [s]
constexpr double curvature = 0.15;          // of ln V in ln x: misfit over the two before it
constexpr double power_of_nodes = 1.3;      // with which the time of an equilibrium grows

/// What equilibria usually take, in firsts of muscle at rest, in the order of Sought and then the
/// firsts; of walls that are free of stress, and of those that are unloaded.
constexpr std::array<std::array<double, 6>, 2> usual{
    {{0.10, 0.07, 0.09, 0.075, 1.0, 1.6}, {0.70, 0.13, 0.80, 0.085, 1.0, 2.0}}};

/// Of an even number the lower of the two: what is seldom and long must not tell the rest.
double lower_median(std::vector<double> values) {
  const auto middle = values.begin() + (std::ssize(values) - 1) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::size_t first_of(std::size_t muscle) {
  return 4 + muscle;
}

}  // namespace

void FitForecast::begin_mesh(std::vector<FitPart> parts) {
  const std::size_t mesh = seen_.size();
  LV_CHECK(mesh < meshes_.size());
  meshes_[mesh].parts = std::move(parts);
  const bool is_same = mesh > 0 && meshes_[mesh].nodes == meshes_[mesh - 1].nodes;
  seen_.push_back(is_same ? Seen{seen_.back().seconds, {}} : Seen{});
  parts_begun_ = 0;
  each_ = left_ = {};
}

void FitForecast::begin(const std::string& name) {
  misfits_.clear();
  each_ = left_ = {};
  const std::vector<FitPart>& parts = meshes_[seen_.size() - 1].parts;
  const auto rest = parts.begin() + static_cast<std::ptrdiff_t>(parts_begun_);
  const auto part =
      std::find_if(rest, parts.end(), [&](const FitPart& p) { return p.name == name; });
  if (part == parts.end())
    return;
  parts_begun_ = static_cast<std::size_t>(part - parts.begin()) + 1;
  each_ = part->each;
  expect(part->trials);
}

void FitForecast::expect(double trials) {
  for (std::size_t k = 0; k < each_.size(); ++k)
    left_[k] = trials * each_[k];
}

void FitForecast::bracket(double misfit, double accuracy) {
  misfits_.push_back(misfit);
  double smallest = std::abs(misfit);
  for (const double f : misfits_)
    smallest = std::min(smallest, std::abs(f));
  if (smallest <= accuracy)
    return expect(0.0);
  const auto [low, high] = std::minmax_element(misfits_.begin(), misfits_.end());
  const bool is_between = *low * *high < 0.0;
  const double digits =
      std::log(curvature * accuracy) / std::log(curvature * std::min(smallest, 1.0));
  const double trials = std::ceil(std::log(digits) / std::log(std::numbers::phi));
  const double until_between = is_between ? 0.0 : misfits_.size() > 1 ? 1.0 : 2.0;
  expect(std::max(1.0, trials) + until_between);
}

void FitForecast::record(Sought which, double seconds) {
  const auto k = static_cast<std::size_t>(which);
  left_[k] = std::max(0.0, left_[k] - 1.0);
  if (seconds < remembered_answer)
    return;
  Seen& seen = seen_.back();
  const std::size_t muscle = k / 2;
  seen.seconds[seen.has_muscle[muscle] ? k : first_of(muscle)].push_back(seconds);
  seen.has_muscle[muscle] = true;
}

Equilibria FitForecast::left_on(std::size_t mesh) const {
  const bool is_present = mesh + 1 == seen_.size();
  Equilibria all = is_present ? left_ : Equilibria{};
  const std::vector<FitPart>& parts = meshes_[mesh].parts;
  for (std::size_t p = is_present ? parts_begun_ : 0; p < parts.size(); ++p)
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k] += parts[p].trials * parts[p].each[k];
  return all;
}

/// Of a wall that has begun or not; what is expected counts as one of those that were seen.
double FitForecast::cost(std::size_t mesh, std::size_t kind, std::size_t most) const {
  std::vector<double> seconds{reference(mesh, kind) * slower(mesh)};
  if (mesh < seen_.size()) {
    const std::vector<double>& all = seen_[mesh].seconds[kind];
    const auto last = static_cast<std::ptrdiff_t>(std::min(most, all.size()));
    seconds.insert(seconds.end(), all.end() - last, all.end());
  }
  return lower_median(std::move(seconds));
}

double FitForecast::reference(std::size_t mesh, std::size_t kind) const {
  constexpr auto all = std::numeric_limits<std::size_t>::max();
  return mesh > 0 ? cost(mesh - 1, kind, all) : usual[meshes_[0].is_loaded ? 1 : 0][kind];
}

/// In the middle of the kinds that were seen.
double FitForecast::slower(std::size_t mesh) const {
  std::vector<double> ratios;
  for (std::size_t k = 0; mesh < seen_.size() && k < kinds; ++k)
    if (const auto& seconds = seen_[mesh].seconds[k]; !seconds.empty())
      ratios.push_back(lower_median(seconds) / reference(mesh, k));
  if (!ratios.empty())
    return 0.5 * (lower_median(ratios) + median(ratios));
  return mesh == 0 ? 0.0
                   : std::pow(static_cast<double>(meshes_[mesh].nodes) /
                                  static_cast<double>(meshes_[mesh - 1].nodes),
                              power_of_nodes);
}

double FitForecast::seconds_left() const {
  double seconds = 0.0;
  bool is_known = false;
  for (std::size_t mesh = seen_.empty() ? 0 : seen_.size() - 1; mesh < meshes_.size(); ++mesh) {
    is_known = is_known || slower(mesh) > 0.0;
    Equilibria left = left_on(mesh);
    for (std::size_t muscle = 0; muscle < 2; ++muscle) {
      double& anew = left[2 * muscle];
      double& again = left[2 * muscle + 1];
      const bool is_seen = mesh < seen_.size() && seen_[mesh].has_muscle[muscle];
      if (!is_seen && anew + again > 0.0) {
        seconds += cost(mesh, first_of(muscle), remembered);
        double& fewer = anew > 0.0 ? anew : again;
        fewer = std::max(0.0, fewer - 1.0);
      }
      seconds += anew * cost(mesh, 2 * muscle, remembered) +
                 again * cost(mesh, 2 * muscle + 1, remembered);
    }
  }
  return is_known ? seconds : -1.0;
}

}  // namespace lv::calibrate
