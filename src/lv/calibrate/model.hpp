#pragma once

#include "lv/quasi_static/unload.hpp"

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

  [[nodiscard]] bool operator==(const Parameters&) const = default;
};

/// What a fit asks of a ventricle; all may throw RunError where there is no equilibrium.
struct Model {
  using Loads = quasi_static::Loads;
  /// Of the cavity in equilibrium [mm^3].
  std::function<double(const Parameters&, const Loads&)> volume;
  /// Of the cavity without load [mm^3].
  std::function<double(const Parameters&)> unloaded_volume;
  /// Regional strains between two equilibria, in the order of Plan::strains. May be empty without
  /// such.
  std::function<std::vector<double>(const Parameters&, const Loads& ed, const Loads& es)> strains;
};

/// The quasi-static engine as such a model. It keeps the equilibrium of every load that it was
/// asked for, from which the next under the same or nearby loads is found in a few corrections.
/// When the shape that it is given is a loaded one, it is unloaded anew for all parameters, from
/// the last result on.
class Ventricle {
 public:
  using MuscleOf = std::function<quasi_static::Muscle(const Parameters&)>;

  /// The mesh must outlive it.
  Ventricle(const mesh::Mesh& mesh, const mesh::FibreRule& fibres, MuscleOf muscle_of,
            const quasi_static::Parameters& solver,
            const quasi_static::UnloadParameters& unloading = {});

  // Each throws RunError where there is no equilibrium and is collective.

  /// Of the cavity [mm^3].
  [[nodiscard]] double volume(const Parameters& parameters, const quasi_static::Loads& loads);
  [[nodiscard]] double unloaded_volume(const Parameters& parameters);

  /// Of the nodes [mm].
  [[nodiscard]] std::vector<Vec3> positions(const Parameters& parameters,
                                            const quasi_static::Loads& loads);
  /// Free of stress.
  [[nodiscard]] const mesh::Mesh& wall(const Parameters& parameters);
  /// The same with its equilibrium under the load that it was seen with; nothing when it was given
  /// free of stress.
  [[nodiscard]] const std::optional<quasi_static::Unloaded>& unloaded(const Parameters& parameters);

  struct Equilibrium {
    quasi_static::Loads loads;
    quasi_static::State state;
  };
  /// All that further answers depend on.
  struct Memory {
    std::vector<Equilibrium> known;
    std::optional<quasi_static::Unloaded> unloaded;
    Parameters unloaded_with;
  };
  [[nodiscard]] Memory memory() const { return {known_, unloaded_, unloaded_with_}; }
  void restore(Memory memory);

 private:
  void go_to(const Parameters& parameters, const quasi_static::Loads& loads);
  void approach(const quasi_static::Muscle& muscle, const quasi_static::Loads& loads);
  [[nodiscard]] Equilibrium& nearest(const quasi_static::Loads& loads);

  const mesh::Mesh& given_;
  mesh::FibreRule fibres_;
  MuscleOf muscle_of_;
  quasi_static::Parameters solver_;
  quasi_static::UnloadParameters unloading_;
  mesh::Mesh wall_;  ///< free of stress
  solid::Cavity cavity_;
  std::optional<quasi_static::Unloaded> unloaded_;
  Parameters unloaded_with_;
  std::optional<quasi_static::Engine> engine_;  ///< of wall_
  std::vector<Equilibrium> known_;
};

}  // namespace lv::calibrate
