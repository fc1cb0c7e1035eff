#include "lv/solid/contraction.hpp"

#include "lv/base/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::solid {
namespace {

using Lanes = std::array<double, pack_size>;
constexpr std::size_t numbers_per_node = 7;

/// Damping rate of the waves that the filter removes, per step; explicit damping is stable to about
/// ten times this.
constexpr double damping_number = 0.3;

/// The numbers of a Sarcomere, in the order of a checkpoint.
template <class S>
auto fields(S& s) {
  return std::array{&s.Ca_trpn, &s.z, &s.Q[0], &s.Q[1], &s.Q[2], &s.stretch, &s.tension};
}

/// Packs of values[first + lane], repeating the last value beyond the end.
Pack load(std::span<const double> values, std::size_t first) {
  alignas(Pack) Lanes lanes;
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

Contraction::Contraction(const material::NiedererHunterSmith& law, const ContractingNodes& nodes,
                         double density, double shortest_wave)
    : law_(law),
      density_(density),
      shortest_wave_(shortest_wave),
      filter_(nodes.positions, nodes.volumes),
      sarcomeres_((nodes.positions.size() + pack_size - 1) / pack_size),
      tension_(nodes.positions.size(), 0.0),
      strength_(nodes.strength.begin(), nodes.strength.end()),
      isometric_tension_(nodes.positions.size(), 0.0),
      stretch_rate_(nodes.positions.size(), 0.0),
      damping_(nodes.positions.size(), 0.0) {}

void Contraction::relax(double Ca) {
  const material::Sarcomere<double> rest = law_.steady_state(Ca, 1.0);
  material::Sarcomere<Pack> pack;
  pack.Ca_trpn = Pack(rest.Ca_trpn);
  pack.z = Pack(rest.z);
  pack.tension = Pack(rest.tension);
  std::fill(sarcomeres_.begin(), sarcomeres_.end(), pack);
  publish_tension();
}

void Contraction::advance(std::span<const double> stretch, double Ca_before, double Ca_after,
                          double dt) {
  for (std::size_t a = 0; a < stretch.size(); ++a)
    stretch_rate_[a] = (stretch[a] - sarcomeres_[a / pack_size].stretch.get(a % pack_size)) / dt;
  damp_what_is_smoothed_away(dt);
  for (std::size_t g = 0; g < sarcomeres_.size(); ++g)
    law_.advance(sarcomeres_[g], load(stretch, g * pack_size), load(stretch_rate_, g * pack_size),
                 Ca_before, Ca_after, dt);
  publish_tension();
}

/// Smooths the stretch rates, and leaves in damping_ the viscous tension on the rest.
void Contraction::damp_what_is_smoothed_away(double dt) {
  const double needed = RateFilter::stable_width(wave_speed(), dt);
  if (needed > filter_width_ || needed < 0.5 * filter_width_)
    filter_width_ = 1.2 * needed;
  damping_ = stretch_rate_;
  filter_.smooth(isometric_tension_, filter_width_, stretch_rate_);
  const double viscosity = damping_number * density_ * shortest_wave_ * shortest_wave_ / dt;
  for (std::size_t a = 0; a < damping_.size(); ++a)
    damping_[a] = viscosity * (damping_[a] - stretch_rate_[a]);
}

void Contraction::prescribe(double tension) {
  std::fill(tension_.begin(), tension_.end(), tension);
}

double Contraction::wave_speed() const {
  const double T_0 = *std::max_element(isometric_tension_.begin(), isometric_tension_.end());
  return std::sqrt(law_.instantaneous_stiffness() * T_0 / density_);
}

void Contraction::publish_tension() {
  for (std::size_t g = 0; g < sarcomeres_.size(); ++g) {
    const Pack T_0 = law_.isometric_tension(sarcomeres_[g]);
    for (std::size_t a = g * pack_size; a < std::min((g + 1) * pack_size, tension_.size()); ++a) {
      tension_[a] = sarcomeres_[g].tension.get(a % pack_size) + damping_[a];
      isometric_tension_[a] = strength_[a] * T_0.get(a % pack_size);
    }
  }
}

std::vector<double> Contraction::state() const {
  std::vector<double> numbers;
  numbers.reserve(tension_.size() * numbers_per_node + 1);
  for (std::size_t a = 0; a < tension_.size(); ++a)
    for (const Pack* field : fields(sarcomeres_[a / pack_size]))
      numbers.push_back(field->get(a % pack_size));
  numbers.push_back(filter_width_);
  return numbers;
}

void Contraction::set_state(std::span<const double> numbers) {
  LV_CHECK(numbers.size() == tension_.size() * numbers_per_node + 1);
  for (std::size_t g = 0; g < sarcomeres_.size(); ++g) {
    const auto to = fields(sarcomeres_[g]);
    for (std::size_t f = 0; f < numbers_per_node; ++f) {
      alignas(Pack) Lanes lanes;
      for (std::size_t i = 0; i < pack_size; ++i)
        lanes[i] = numbers[std::min(g * pack_size + i, tension_.size() - 1) * numbers_per_node + f];
      *to[f] = Pack::load_aligned(lanes.data());
    }
  }
  filter_width_ = numbers.back();
  std::fill(damping_.begin(), damping_.end(), 0.0);
  publish_tension();
}

}  // namespace lv::solid
