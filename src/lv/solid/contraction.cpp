#include "lv/solid/contraction.hpp"

#include "lv/base/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace lv::solid {
namespace {

using Lanes = std::array<double, pack_size>;

/// Damping rate of the waves that the filter removes, per step; explicit damping is stable to about
/// ten times this.
constexpr double damping_number = 0.3;

/// Packs of values[first + lane], repeating the last value beyond the end.
Pack load(std::span<const double> values, std::size_t first) {
  alignas(Pack) Lanes lanes;
  for (std::size_t i = 0; i < pack_size; ++i)
    lanes[i] = values[std::min(first + i, values.size() - 1)];
  return Pack::load_aligned(lanes.data());
}

/// Takes the states of so many nodes from numbers, node by node, after which one more follows.
template <class State>
void set_fields(std::span<const double> numbers, std::size_t nodes, std::vector<State>& packs) {
  constexpr std::size_t per_node = std::tuple_size_v<decltype(std::declval<State>().fields())>;
  LV_CHECK(numbers.size() == nodes * per_node + 1);
  for (std::size_t g = 0; g < packs.size(); ++g) {
    const auto to = packs[g].fields();
    for (std::size_t f = 0; f < per_node; ++f) {
      alignas(Pack) Lanes lanes;
      for (std::size_t i = 0; i < pack_size; ++i)
        lanes[i] = numbers[std::min(g * pack_size + i, nodes - 1) * per_node + f];
      *to[f] = Pack::load_aligned(lanes.data());
    }
  }
}

}  // namespace

std::vector<double> strength(const mesh::Mesh& mesh, const material::InfarctScaling& infarct) {
  std::vector<double> result;
  result.reserve(mesh.infarct.size());
  for (const double M : mesh.infarct)
    result.push_back(infarct.active(M));
  return result;
}

Contraction::Contraction(const material::KineticLaw& law, const ContractingNodes& nodes,
                         double density, double shortest_wave)
    : muscle_(std::visit(
          [&](const auto& kinetics) -> decltype(muscle_) {
            const std::size_t packs = (nodes.positions.size() + pack_size - 1) / pack_size;
            Muscle<std::decay_t<decltype(kinetics)>> muscle{kinetics, {}};
            muscle.packs.resize(packs);
            return muscle;
          },
          law)),
      density_(density),
      shortest_wave_(shortest_wave),
      filter_(nodes.positions, nodes.volumes),
      tension_(nodes.positions.size(), 0.0),
      strength_(nodes.strength.begin(), nodes.strength.end()),
      stiffness_(nodes.positions.size(), 0.0),
      stretch_rate_(nodes.positions.size(), 0.0),
      damping_(nodes.positions.size(), 0.0) {}

void Contraction::relax(double Ca) {
  std::visit(
      [&](auto& muscle) {
        auto rest = muscle.law.steady_state(Ca, 1.0);
        typename std::decay_t<decltype(muscle.packs)>::value_type pack;
        const auto to = pack.fields();
        for (std::size_t f = 0; f < to.size(); ++f)
          *to[f] = Pack(*rest.fields()[f]);
        std::fill(muscle.packs.begin(), muscle.packs.end(), pack);
      },
      muscle_);
  publish_tension();
}

void Contraction::relax(double Ca, std::span<const double> stretch) {
  std::vector<double> numbers;
  std::visit(
      [&](const auto& muscle) {
        for (const double s : stretch) {
          auto rest = muscle.law.steady_state(Ca, s);
          for (const double* field : rest.fields())
            numbers.push_back(*field);
        }
      },
      muscle_);
  numbers.push_back(filter_width_);
  set_state(numbers);
}

void Contraction::advance(std::span<const double> stretch, double Ca_before, double Ca_after,
                          double dt) {
  std::visit(
      [&](auto& muscle) {
        for (std::size_t a = 0; a < stretch.size(); ++a)
          stretch_rate_[a] =
              (stretch[a] - muscle.packs[a / pack_size].stretch.get(a % pack_size)) / dt;
        damp_what_is_smoothed_away(dt);
        for (std::size_t g = 0; g < muscle.packs.size(); ++g)
          muscle.law.advance(muscle.packs[g], load(stretch, g * pack_size),
                             load(stretch_rate_, g * pack_size), Ca_before, Ca_after, dt);
      },
      muscle_);
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
  std::fill(tension_.begin(), tension_.end(), tension);
}

double Contraction::wave_speed() const {
  return std::sqrt(*std::max_element(stiffness_.begin(), stiffness_.end()) / density_);
}

void Contraction::publish_tension() {
  std::visit(
      [&](const auto& muscle) {
        for (std::size_t g = 0; g < muscle.packs.size(); ++g) {
          const Pack stiffness = muscle.law.sudden_stiffness(muscle.packs[g]);
          for (std::size_t a = g * pack_size; a < std::min((g + 1) * pack_size, tension_.size());
               ++a) {
            tension_[a] = muscle.packs[g].tension.get(a % pack_size) + damping_[a];
            stiffness_[a] = strength_[a] * stiffness.get(a % pack_size);
          }
        }
      },
      muscle_);
}

std::vector<double> Contraction::state() const {
  std::vector<double> numbers;
  std::visit(
      [&](const auto& muscle) {
        for (std::size_t a = 0; a < tension_.size(); ++a) {
          auto pack = muscle.packs[a / pack_size];
          for (const Pack* field : pack.fields())
            numbers.push_back(field->get(a % pack_size));
        }
      },
      muscle_);
  numbers.push_back(filter_width_);
  return numbers;
}

void Contraction::set_state(std::span<const double> numbers) {
  std::visit([&](auto& muscle) { set_fields(numbers, tension_.size(), muscle.packs); }, muscle_);
  filter_width_ = numbers.back();
  std::fill(damping_.begin(), damping_.end(), 0.0);
  publish_tension();
}

}  // namespace lv::solid
