#pragma once

#include "lv/implicit/engine.hpp"
#include "lv/mesh/folds.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace lv::implicit {

/// How the shape without load is sought.
struct UnloadParameters {
  double pressure = 0.0;    ///< under which the given shape was seen; 0: it is free of stress [kPa]
  double tolerance = 0.01;  ///< largest distance of a node, loaded again, from the given shape [mm]
  int iterations = 60;      ///< equilibria after which it gives up
  /// Where the wall that is sought is folded: largest rms distance of a smooth one instead, loaded
  /// again, from the given shape [mm]
  double smooth_within = 1.5;
  /// Where the search comes no nearer, or has no more equilibria: largest distance of a wall
  /// without folds that is taken all the same [mm]. A border that follows pixels of 1.25 mm is off
  /// by 1.25/sqrt(12) = 0.36 mm, rms: this is less everywhere.
  double near_enough = 0.25;
};

/// One shape that was tried, loaded again.
struct UnloadStep {
  double largest = 0.0, rms = 0.0;             ///< distance of its nodes from the given shape [mm]
  double unloaded_volume = 0.0, volume = 0.0;  ///< of its cavity without and under load [mm^3]
  double damping = 1.0;                        ///< share of the correction that was taken
  bool accelerated = false;                    ///< by Anderson's method
  double smoothing = 0.0;                      ///< alpha
  mesh::Folds folds;                           ///< against the given shape
};

/// The shape that becomes the given one under load.
struct Unloaded {
  std::vector<Vec3> nodes;        ///< X [mm]
  State loaded;                   ///< its equilibrium under the load
  std::vector<UnloadStep> steps;  ///< shapes that came nearer, in their order; the last is X
  double smoothing = 0.0;         ///< alpha; 0: loaded again it is the given shape, or near it
  /// Work of the fixed points that followed an inverse problem which had led near, as it does on
  /// walls of large elements [tangents, see linear_work].
  double polishing = 0.0;
};

/// The equilibria of a search in the order in which they were sought, nothing where there was none.
using Equilibria = std::vector<std::optional<State>>;

/// Lets a search that was stopped go on to the same result, bit for bit.
struct UnloadRecord {
  Equilibria known;                             ///< of the search so far: not sought again
  std::function<void(const Equilibria&)> keep;  ///< told all of them after each new one; or empty
};

/// What a search begins with, and what is known of it.
struct UnloadTask {
  /// The result for other muscle, from where few steps are needed, or a guess of the nodes alone.
  const Unloaded* start = nullptr;
  UnloadRecord record = {};
  double afterwards = 0.0;  ///< what the stage does then, for the time that is left [s]
  /// Told what the smoothest wall that was tried holds without load, if it is folded too [mm^3].
  double* folded_volume = nullptr;
};

/// The stress-free wall X whose equilibrium x(X) under the pressure on the muscle at rest is the
/// given shape x*. With the direct solver it is sought by the inverse problem first
/// (find_reference); where that finds no wall without folds within the tolerance, from what it
/// leads near to, or else from the start, by fixed-point iteration (backward displacement: M.
/// Sellier, Struct. Multidisc. Optim. 44:683, 2011; J. Bols et al., J. Comput. Appl. Math. 246:10,
/// 2013),
///
///   X_{k+1} = X_k + beta D_k,   R_k = x* - x(X_k),
///   D_k = R_k - sum_j gamma_j (X_{j+1} - X_j + R_{j+1} - R_j),  gamma minimising
///         |R_k - sum_j gamma_j (R_{j+1} - R_j)|  over the last steps (Anderson's acceleration),
///
/// with the largest beta of 1, 1/2, ... for which the wall is sound, has an equilibrium and |R|
/// becomes smaller; D_k = R_k when none does. Where the whole pressure fails from the start it is
/// approached in steps. The fibre rule is applied to the wall without load, whose equilibria they
/// are: an X that is loaded and unloaded comes back with its fibres. Directions that the mesh
/// brings are those of the given shape and turn with it (mesh::with_nodes). Depth t and M(X) are
/// carried along with the nodes.
///
/// What pressure does not tell apart grows when it is taken away: a flat place of the given shape
/// may ask for a dent. Where the search meets a fold (mesh::FoldFinder), or comes within 0.5 mm but
/// no nearer, it goes on with
///
///   R = x* - x(X) - alpha (U - P U),   U = X - x*,
///
/// P to polynomials of degree 3 (SmoothFields): a displacement that is not smooth has to pay with
/// the distance alpha that it leaves. Of falling alpha the last wall without folds is taken, if it
/// comes near enough.
///
/// x(X) need not be smooth in X: where the wall is radial to the long axis, at the apex, fibres
/// that follow a rule turn with it at once, and a wall of large elements may come to a place from
/// which no step leads nearer. If it is near enough there, it is the result, and the last of
/// `steps` says how near.
///
/// Unsolved, with the distance that is left, when the wall does not come near enough, or with the
/// figures of the fold where no smooth wall does. Throws Interrupted. Collective.
Outcome<Unloaded> unload(const mesh::Mesh& given, const StaticModel& model,
                         const UnloadParameters& parameters, const SolverParameters& solver,
                         UnloadTask task = {});

}  // namespace lv::implicit
