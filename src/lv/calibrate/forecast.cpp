#include "lv/calibrate/forecast.hpp"

#include "lv/base/check.hpp"
#include "lv/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lv::calibrate {
namespace {

constexpr std::size_t remembered = 5;   // equilibria of each kind
constexpr double curvature = 0.15;      // of ln V in ln x: misfit over the two before it
constexpr double least_slope = 0.1;     // of ln V by ln x
constexpr double power_of_nodes = 1.3;  // with which the time of a tangent grows
constexpr double afar = 0.6;            // of the first one's work: it was loaded from nothing again

/// What equilibria usually take, in tangents, in the order of Sought and then the firsts.
using Usual = std::array<double, 6>;
constexpr Usual free_of_stress{2.0, 1.2, 2.0, 1.2, 19.0, 27.0};
constexpr Usual unloaded{9.0, 2.3, 10.0, 1.4, 20.0, 36.0};
constexpr Usual unloaded_from_near{6.0, 2.3, 6.0, 1.4, 9.0, 34.0};
constexpr Usual polished{14.0, 2.3, 16.0, 1.4, 19.0, 36.0};

/// Of an even number the lower of the two: what is seldom and long must not tell the rest.
double lower_median(std::vector<double> values) {
  const auto middle = values.begin() + (std::ssize(values) - 1) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::size_t first_of(std::size_t muscle) {
  return 4 + muscle;
}

std::size_t muscle_of(std::size_t kind) {
  return kind < 4 ? kind / 2 : kind - 4;
}

/// The last `most`.
std::vector<double> seconds_of(const std::vector<Effort>& efforts, std::size_t most) {
  std::vector<double> seconds;
  for (std::size_t n = efforts.size() - std::min(most, efforts.size()); n < efforts.size(); ++n)
    seconds.push_back(efforts[n].seconds);
  return seconds;
}

std::vector<double> work_of(const std::vector<Effort>& efforts) {
  std::vector<double> work;
  for (const Effort& effort : efforts)
    work.push_back(effort.work.all);
  return work;
}

}  // namespace

void FitForecast::begin_mesh(std::vector<FitPart> parts) {
  const std::size_t mesh = seen_.size();
  LV_CHECK(mesh < meshes_.size());
  meshes_[mesh].parts = std::move(parts);
  seen_.push_back(is_same(mesh) ? Seen{seen_.back().efforts, {}} : Seen{});
  parts_begun_ = 0;
  present_.reset();
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

void FitForecast::bracket(double misfit, double accuracy, double first_step) {
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
  const bool is_next = misfits_.size() > 1 || smallest < least_slope * first_step;
  const double until_between = is_between ? 0.0 : is_next ? 1.0 : 2.0;
  expect(std::max(1.0, trials) + until_between);
}

std::size_t FitForecast::kind_of(Sought which) const {
  const auto k = static_cast<std::size_t>(which);
  return seen_.back().has_muscle[muscle_of(k)] ? k : first_of(muscle_of(k));
}

/// Of a wall that is unloaded each muscle takes about as much as the first.
bool FitForecast::is_from_afar(std::size_t muscle, double work) const {
  const std::vector<Effort>& firsts = seen_.back().efforts[first_of(muscle)];
  return !meshes_[seen_.size() - 1].is_loaded && !firsts.empty() &&
         work > afar * firsts.front().work.all;
}

void FitForecast::on_the_way(Sought which, Effort so_far, double share) {
  present_ = {which, so_far, present_ ? present_->first_share : share, share};
}

void FitForecast::record(Sought which, Effort effort) {
  present_.reset();
  const auto k = static_cast<std::size_t>(which);
  left_[k] = std::max(0.0, left_[k] - 1.0);
  if (effort.work.all <= 0.0)
    return;
  Seen& seen = seen_.back();
  const std::size_t muscle = muscle_of(k);
  seen.efforts[is_from_afar(muscle, effort.work.all) ? first_of(muscle) : kind_of(which)].push_back(
      effort);
  seen.has_muscle[muscle] = true;
}

/// But the one on its way.
Equilibria FitForecast::left_on(std::size_t mesh) const {
  const bool is_present = mesh + 1 == seen_.size();
  Equilibria all = is_present ? left_ : Equilibria{};
  if (is_present && present_) {
    double& left = all[static_cast<std::size_t>(present_->which)];
    left = std::max(0.0, left - 1.0);
  }
  const std::vector<FitPart>& parts = meshes_[mesh].parts;
  for (std::size_t p = is_present ? parts_begun_ : 0; p < parts.size(); ++p)
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k] += parts[p].trials * parts[p].each[k];
  return all;
}

/// Of a wall that has begun or not; what is expected counts as one of those that were seen.
double FitForecast::cost(std::size_t mesh, std::size_t kind) const {
  std::vector<double> seconds{usual_work(mesh, kind) * harder(mesh) * pace(mesh)};
  if (mesh < seen_.size())
    for (const double seen : seconds_of(seen_[mesh].efforts[kind], remembered))
      seconds.push_back(seen);
  return lower_median(std::move(seconds));
}

/// Of what it usually takes, or took by now if that is more. Steps grow with the load that is on,
/// so that work grows as the logarithm of the load in first steps.
double FitForecast::rest_of_present() const {
  const auto& [which, so_far, first_share, share] = *present_;
  const double done = std::log1p(share / first_share) / std::log1p(1.0 / first_share);
  return (1.0 - done) * std::max(cost(seen_.size() - 1, kind_of(which)), so_far.seconds);
}

bool FitForecast::is_polished(std::size_t mesh) const {
  if (mesh >= seen_.size())
    return false;
  const auto is = [](const Effort& effort) { return effort.work.polishing > 0.0; };
  return std::any_of(seen_[mesh].efforts.begin(), seen_[mesh].efforts.end(),
                     [&](const auto& all) { return std::any_of(all.begin(), all.end(), is); });
}

bool FitForecast::is_same(std::size_t mesh) const {
  return mesh > 0 && meshes_[mesh].nodes == meshes_[mesh - 1].nodes;
}

/// On the wall before, where from afar the last counts: its muscle is most like that to come. A
/// wall that fixed points follow on says nothing of finer ones, and these are unloaded first from
/// near by.
double FitForecast::usual_work(std::size_t mesh, std::size_t kind) const {
  const bool is_loaded = meshes_[mesh].is_loaded;
  const bool is_finer = mesh > 0 && !is_same(mesh);
  if (mesh == 0 || (is_finer && is_polished(mesh - 1))) {
    const Usual& of_unloaded = is_polished(mesh) ? polished
                               : is_finer        ? unloaded_from_near
                                                 : unloaded;
    return (is_loaded ? of_unloaded : free_of_stress)[kind];
  }
  if (is_finer && is_loaded && kind == first_of(0))
    return usual_work(mesh, 0);
  const std::size_t before = mesh - 1;
  std::vector<double> work{usual_work(before, kind) * harder(before)};
  if (before < seen_.size()) {
    const std::vector<double> seen = work_of(seen_[before].efforts[kind]);
    if (kind == first_of(muscle_of(kind)) && !seen.empty())
      return seen.back();
    work.insert(work.end(), seen.begin(), seen.end());
  }
  return lower_median(std::move(work));
}

/// In the middle of the kinds that were seen. Walls on which no fixed points follow are all alike.
double FitForecast::harder(std::size_t mesh) const {
  std::vector<double> ratios;
  for (std::size_t k = 0; is_polished(mesh) && k < kinds; ++k)
    if (const auto& efforts = seen_[mesh].efforts[k]; !efforts.empty())
      ratios.push_back(lower_median(work_of(efforts)) / usual_work(mesh, k));
  return ratios.empty() ? 1.0 : 0.5 * (lower_median(ratios) + median(ratios));
}

/// Seconds per tangent; 0 where nothing was seen yet.
double FitForecast::pace(std::size_t mesh) const {
  Effort all = present_ && mesh + 1 == seen_.size() ? present_->so_far : Effort{};
  if (mesh < seen_.size())
    for (const std::vector<Effort>& efforts : seen_[mesh].efforts)
      for (const Effort& effort : efforts) {
        all.seconds += effort.seconds;
        all.work.all += effort.work.all;
      }
  if (all.work.all > 0.0)
    return all.seconds / all.work.all;
  return mesh == 0 ? 0.0
                   : pace(mesh - 1) * std::pow(static_cast<double>(meshes_[mesh].nodes) /
                                                   static_cast<double>(meshes_[mesh - 1].nodes),
                                               power_of_nodes);
}

double FitForecast::seconds_left() const {
  if (seen_.empty() || pace(seen_.size() - 1) == 0.0)
    return -1.0;
  double seconds = present_ ? rest_of_present() : 0.0;
  for (std::size_t mesh = seen_.size() - 1; mesh < meshes_.size(); ++mesh) {
    Equilibria left = left_on(mesh);
    for (std::size_t muscle = 0; muscle < 2; ++muscle) {
      double& anew = left[2 * muscle];
      double& again = left[2 * muscle + 1];
      const bool is_on_its_way = present_ && mesh + 1 == seen_.size() &&
                                 muscle_of(static_cast<std::size_t>(present_->which)) == muscle;
      const bool is_seen = is_on_its_way || (mesh < seen_.size() && seen_[mesh].has_muscle[muscle]);
      if (!is_seen && anew + again > 0.0) {
        seconds += cost(mesh, first_of(muscle));
        double& fewer = anew > 0.0 ? anew : again;
        fewer = std::max(0.0, fewer - 1.0);
      }
      seconds += anew * cost(mesh, 2 * muscle) + again * cost(mesh, 2 * muscle + 1);
    }
  }
  return seconds;
}

}  // namespace lv::calibrate
