#include "lv/solid/contraction.hpp"

#include "lv/base/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::solid {
namespace {

/// Damping rate of the waves that the filter removes, per step; explicit damping is stable to about
/// ten times this.
constexpr double damping_number = 0.3;

/// Packs of values[first + lane], repeating the last value beyond the end.
Pack load(std::span<const double> values, std::size_t first) {
  alignas(Pack) std::array<double, pack_size> lanes;
  for (std::size_t i = 0; i < pack_size; ++i)
    lanes[i] = values[std::min(first + i, values.size() - 1)];
  return Pack::load_aligned(lanes.data());
}

}  // namespace

std::vector<double> strength(const mesh::Mesh& mesh, const material::InfarctScaling& infarct) {
  std::vector<double> result;
  result.reserve(mesh.infarct.size());
  for (const double M : mesh.infarct)
    result.push_back(infarct.active(M));
  return result;
}

Contraction::Contraction(const material::ActiveLaw& law, const ContractingNodes& nodes,
                         double density, double shortest_wave)
    : muscle_(law, nodes.positions.size()),
      density_(density),
      shortest_wave_(shortest_wave),
      filter_(nodes.positions, nodes.volumes),
      tension_(nodes.positions.size(), 0.0),
      strength_(nodes.strength.begin(), nodes.strength.end()),
      contractility_(nodes.contractility.begin(), nodes.contractility.end()),
      stiffness_(nodes.positions.size(), 0.0),
      stretch_rate_(nodes.positions.size(), 0.0),
      damping_(nodes.positions.size(), 0.0) {
  if (contractility_.empty())
    contractility_.assign(nodes.positions.size(), 1.0);
}

void Contraction::relax(double Ca) {
  constexpr std::array at_rest{1.0};
  muscle_.relax(Ca, at_rest);
  publish_tension();
}

void Contraction::relax(double Ca, std::span<const double> stretch) {
  muscle_.relax(Ca, stretch);
  std::fill(damping_.begin(), damping_.end(), 0.0);
  publish_tension();
}

void Contraction::advance(std::span<const double> stretch, const CalciumStep& calcium, double dt) {
  muscle_.visit([&](const auto& law, auto& packs) {
    for (std::size_t a = 0; a < stretch.size(); ++a)
      stretch_rate_[a] = (stretch[a] - packs[a / pack_size].stretch.get(a % pack_size)) / dt;
    damp_what_is_smoothed_away(dt);
    for (std::size_t g = 0; g < packs.size(); ++g)
      law.advance(packs[g], load(stretch, g * pack_size), load(stretch_rate_, g * pack_size),
                  load(calcium.before, g * pack_size), load(calcium.after, g * pack_size), dt);
  });
  publish_tension();
}

/// Smooths the stretch rates, and leaves in damping_ the viscous tension on the rest.
void Contraction::damp_what_is_smoothed_away(double dt) {
  const double needed = RateFilter::stable_width(wave_speed(), dt);
  if (needed > filter_width_ || needed < 0.5 * filter_width_)
    filter_width_ = 1.2 * needed;
  damping_ = stretch_rate_;
  filter_.smooth(stiffness_, filter_width_, stretch_rate_);
  const double viscosity = damping_number * density_ * shortest_wave_ * shortest_wave_ / dt;
  for (std::size_t a = 0; a < damping_.size(); ++a)
    damping_[a] = viscosity * (damping_[a] - stretch_rate_[a]);
}

void Contraction::prescribe(double tension) {
  for (std::size_t a = 0; a < tension_.size(); ++a)
    tension_[a] = contractility_[a] * tension;
}

double Contraction::wave_speed() const {
  return std::sqrt(*std::max_element(stiffness_.begin(), stiffness_.end()) / density_);
}

void Contraction::publish_tension() {
  muscle_.visit([&](const auto& law, const auto& packs) {
    for (std::size_t g = 0; g < packs.size(); ++g) {
      const Pack stiffness = law.sudden_stiffness(packs[g]);
      for (std::size_t a = g * pack_size; a < std::min((g + 1) * pack_size, tension_.size()); ++a) {
        tension_[a] = contractility_[a] * packs[g].tension.get(a % pack_size) + damping_[a];
        stiffness_[a] = contractility_[a] * strength_[a] * stiffness.get(a % pack_size);
      }
    }
  });
}

std::vector<double> Contraction::state() const {
  std::vector<double> numbers = muscle_.numbers();
  numbers.push_back(filter_width_);
  return numbers;
}

void Contraction::set_state(std::span<const double> numbers) {
  LV_CHECK(!numbers.empty());
  muscle_.set_numbers(numbers.first(numbers.size() - 1));
  filter_width_ = numbers.back();
  std::fill(damping_.begin(), damping_.end(), 0.0);
  publish_tension();
}

}  // namespace lv::solid
