#pragma once

#include "lv/implicit/linear_work.hpp"
#include "lv/implicit/unload.hpp"
#include "lv/mesh/regions.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace lv::calibrate {

/// The parameters that a calibration may change.
struct FitParameters {
  double C_a = 1.0;       ///< factor of a_f, a_s and a_fs (2.25)
  double scale = 1.0;     ///< factor of a, a_f, a_s and a_fs besides
  double exponent = 1.0;  ///< factor of b, b_f, b_s and b_fs
  double T_scale = 1.0;   ///< strength of contraction (Appendix A)
  mesh::SegmentFactors segments = mesh::even_segments();  ///< factors of it

  [[nodiscard]] bool operator==(const FitParameters&) const = default;
};

/// What was done for equilibria, in tangents (implicit::linear_work).
struct Work {
  double all = 0.0;
  double polishing = 0.0;  ///< of it, what finer walls need not (implicit::Unloaded)
};

/// Told after a step to loads which share of the way to them is done.
using OnTheWay = std::function<void(const solid::Loads&, double share)>;

/// What a fit asks of a ventricle; nowhere need there be an equilibrium.
struct Model {
  using Loads = solid::Loads;
  /// Of the cavity in equilibrium [mm^3].
  std::function<Outcome<double>(const FitParameters&, const Loads&)> volume;
  /// Of the cavity without load [mm^3].
  std::function<Outcome<double>(const FitParameters&)> unloaded_volume;
  /// Regional strains between two equilibria, in the order of Plan::strains. May be empty without
  /// such.
  std::function<Outcome<std::vector<double>>(const FitParameters&, const Loads& ed,
                                             const Loads& es)>
      strains;
  /// By how much the end-systolic surfaces lie outside of what was drawn of them, in the order of
  /// Plan::drawn [mm]. May be empty without such.
  std::function<Outcome<std::vector<double>>(const FitParameters&, const Loads& es)> distances = {};
  /// From now on answers for muscle that differs from this one in its factors of segments alone may
  /// be right to first order only; nothing: no more. May be empty.
  std::function<void(const std::optional<FitParameters>& about)> linearise = {};
  /// What the smoothest wall near the one that was sought last holds without load, if that is
  /// folded too [mm^3]; else not a number. May be empty.
  std::function<double()> folded_volume = {};
  /// The share of the pressure of the seen shape under which its wall without load, folded or not,
  /// would hold a volume [mm^3]. May be empty.
  std::function<Outcome<double>(const FitParameters&, double volume)> share_that_leaves = {};
  /// What it did so far. Without it no time left is known.
  std::function<Work()> work = {};
  /// On the way to further equilibria it tells how far it is; nothing: no more. May be empty.
  std::function<void(const OnTheWay&)> tell = {};
};

/// The quasi-static engine as such a model. It keeps the equilibrium of every load that it was
/// asked for, from which the next under the same or nearby loads is found in a few corrections.
/// When the shape that it is given is a loaded one, it is unloaded anew for all parameters, from
/// the last result on.
class Ventricle {
 public:
  using ModelOf = std::function<implicit::StaticModel(const FitParameters&)>;

  /// The mesh must outlive it.
  Ventricle(const mesh::Mesh& mesh, ModelOf model_of, const implicit::SolverParameters& solver,
            const implicit::UnloadParameters& unloading = {});

  /// The first search for the wall without load begins with these nodes [mm].
  void begin_near(std::vector<Vec3> unloaded);

  // Each is collective.

  /// Of the cavity [mm^3].
  Outcome<double> volume(const FitParameters& parameters, const solid::Loads& loads);
  Outcome<double> unloaded_volume(const FitParameters& parameters);
  /// Model::share_that_leaves
  [[nodiscard]] Outcome<double> share_that_leaves(const FitParameters& parameters,
                                                  double volume) const;

  /// From now on muscle that differs from `about` in its factors c_j of these segments alone is
  /// taken to move the wall to first order, under loads and with the wall without load held,
  ///
  ///   x = x_0 + sum_j (ln c_j - ln c_j0) dx/d ln c_j,   dx/d ln c_j = -K^-1 dR/d ln c_j;
  ///
  /// nothing: no more.
  void linearise(const std::optional<FitParameters>& about, const std::vector<int>& segments);

  /// Model::work
  [[nodiscard]] Work work() const { return {implicit::linear_work(), polishing_}; }
  /// Model::tell
  void tell(OnTheWay on_the_way) { on_the_way_ = std::move(on_the_way); }

  /// Of the nodes [mm].
  Outcome<std::vector<Vec3>> positions(const FitParameters& parameters, const solid::Loads& loads);

  /// The wall free of stress, with the parameters that were asked for last.
  [[nodiscard]] const mesh::Mesh& wall() const { return wall_; }
  /// The same with its equilibrium under the load that it was seen with; nothing when it was given
  /// free of stress.
  [[nodiscard]] const std::optional<implicit::Unloaded>& unloaded() const { return unloaded_; }
  /// Model::folded_volume
  [[nodiscard]] double folded_volume() const { return folded_volume_; }

  struct Equilibrium {
    solid::Loads loads;
    implicit::State state;
  };
  /// All that further answers depend on.
  struct Memory {
    std::vector<Equilibrium> known;
    std::optional<implicit::Unloaded> unloaded;
    FitParameters unloaded_with;
  };
  [[nodiscard]] Memory memory() const { return {known_, unloaded_, unloaded_with_}; }
  void restore(Memory memory);

 private:
  /// An equilibrium of about_, and how it moves with the logarithm of each segment's factor [mm].
  struct Slopes {
    solid::Loads loads;
    std::vector<Vec3> positions;
    std::vector<std::vector<Vec3>> by_segment;
  };

  Outcome<double> approach(const implicit::StaticModel& model, const solid::Loads& loads);
  [[nodiscard]] bool is_linear(const FitParameters& parameters) const;
  Outcome<Slopes> slopes(const solid::Loads& loads);
  Outcome<std::vector<Vec3>> moved(const FitParameters& parameters, const solid::Loads& loads);
  [[nodiscard]] Equilibrium& nearest(const solid::Loads& loads);

  const mesh::Mesh& given_;
  ModelOf model_of_;
  implicit::SolverParameters solver_;
  implicit::UnloadParameters unloading_;
  mesh::Mesh wall_;  ///< free of stress
  solid::EndocardialSurface endocardium_;
  std::optional<implicit::Unloaded> unloaded_;
  double folded_volume_ = std::numeric_limits<double>::quiet_NaN();
  FitParameters unloaded_with_;
  std::optional<implicit::Engine> engine_;  ///< of wall_
  std::vector<Equilibrium> known_;
  OnTheWay on_the_way_;
  double polishing_ = 0.0;
  std::optional<FitParameters> about_;
  std::vector<int> segments_;
  std::vector<Slopes> slopes_;
};

}  // namespace lv::calibrate
