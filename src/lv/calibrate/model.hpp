#pragma once

#include "lv/quasi_static/engine.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace lv::calibrate {

/// The parameters that a calibration may change.
struct Parameters {
  double C_a = 1.0;       ///< factor of a_f, a_s and a_fs (2.25)
  double scale = 1.0;     ///< factor of a, a_f, a_s and a_fs besides
  double exponent = 1.0;  ///< factor of b, b_f, b_s and b_fs
  double T_scale = 1.0;   ///< strength of contraction (Appendix A)
};

/// Volume of the cavity [mm^3] in equilibrium with loads.
using Model = std::function<double(const Parameters&, const quasi_static::Loads&)>;

/// The quasi-static engine as such a model. It keeps the equilibrium of every load that it was
/// asked for, from which the next under the same or nearby loads is found in a few corrections.
class Ventricle {
 public:
  using MuscleOf = std::function<quasi_static::Muscle(const Parameters&)>;

  /// The mesh must outlive it.
  Ventricle(const mesh::Mesh& mesh, const mesh::FibreRule& fibres, MuscleOf muscle_of,
            const quasi_static::Parameters& solver);

  /// Throws RunError where there is no equilibrium. Collective.
  [[nodiscard]] double volume(const Parameters& parameters, const quasi_static::Loads& loads);

 private:
  struct Equilibrium {
    quasi_static::Loads loads;
    quasi_static::State state;
  };
  void approach(const quasi_static::Muscle& muscle, const quasi_static::Loads& loads);
  [[nodiscard]] Equilibrium& nearest(const quasi_static::Loads& loads);

  const mesh::Mesh& mesh_;
  mesh::FibreRule fibres_;
  MuscleOf muscle_of_;
  quasi_static::Parameters solver_;
  std::optional<quasi_static::Engine> engine_;
  std::vector<Equilibrium> known_;
};

}  // namespace lv::calibrate
