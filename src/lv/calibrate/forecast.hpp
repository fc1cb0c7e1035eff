#pragma once

#include "lv/calibrate/model.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lv::calibrate {

/// Which muscle an equilibrium of a fit has, and whether its parameters are others than those of
/// the equilibrium before: a loaded shape is unloaded anew for them.
enum class Sought { rests_anew, rests_again, contracts_anew, contracts_again };

/// Equilibria by Sought.
using Equilibria = std::array<double, 4>;

/// What an equilibrium takes.
struct Effort {
  double seconds = 0.0;
  Work work;
};

/// A part of a fit: the same equilibria for each of so many trials, as many as are usual.
struct FitPart {
  std::string name;
  Equilibria each;
  double trials = 1.0;
};

/// A wall on which the muscle is fitted.
struct FittedMesh {
  std::size_t nodes = 0;
  bool is_loaded = false;  ///< it is unloaded for all parameters
  std::vector<FitPart> parts = {};
};

/// How long a fit will still take, on all its walls: the equilibria that are left, each as long as
/// the last ones of its kind took in the middle on this wall. What was not seen there yet takes the
/// tangents that it took on the wall before, or usually takes, each as long as tangents take here;
/// on walls to come times a power of the number of nodes. The same mesh under another pressure goes
/// on with what was seen. The first equilibrium of each muscle on a wall comes from afar and is a
/// kind of its own: steps that fail on its way say nothing of those that follow. A wall that was
/// seen free of stress may be loaded from nothing again for other muscle, and then that counts.
/// Where fixed points follow the inverse problem of a wall without load, all kinds are the harder
/// the more those that were seen took; finer walls are taken to need none.
class FitForecast {
 public:
  explicit FitForecast(std::vector<FittedMesh> meshes) : meshes_(std::move(meshes)) {}

  /// The fit on the next wall begins; its parts are these now.
  void begin_mesh(std::vector<FitPart> parts);
  /// The next part of this name begins; those before it are over or left out.
  void begin(const std::string& name);
  /// So many trials of this part are still to come, as it now looks.
  void expect(double trials);
  /// The same in a bracket, of which this is the last ln(V/V_target), the one that ends it, and the
  /// first step of ln x. Once the root lies between two trials, which usually takes two more (one
  /// where the misfit is less than what a volume that hardly depends on x changes by in the first
  /// step), each misfit is a usual curvature times the product of the two before, so that the
  /// digits of curvature times misfit grow by the golden ratio with each.
  void bracket(double misfit, double accuracy, double first_step);

  /// The next equilibrium is on its way, of which such a share of the loads is done.
  void on_the_way(Sought which, Effort so_far, double share);

  /// An equilibrium was found. What took no work, as answers of a fit that was stopped, says
  /// nothing of others.
  void record(Sought which, Effort effort);

  /// Negative before the first one of the fit.
  [[nodiscard]] double seconds_left() const;

 private:
  static constexpr std::size_t kinds = 6;  ///< Sought, and the first of each muscle
  struct Seen {
    std::array<std::vector<Effort>, kinds> efforts;
    std::array<bool, 2> has_muscle{};
  };
  struct Present {
    Sought which;
    Effort so_far;
    double first_share, share;  ///< of the loads, after the first step and now
  };
  [[nodiscard]] std::size_t kind_of(Sought which) const;
  [[nodiscard]] bool is_from_afar(std::size_t muscle, double work) const;
  [[nodiscard]] Equilibria left_on(std::size_t mesh) const;
  [[nodiscard]] double cost(std::size_t mesh, std::size_t kind) const;
  [[nodiscard]] double rest_of_present() const;
  [[nodiscard]] double usual_work(std::size_t mesh, std::size_t kind) const;
  [[nodiscard]] double harder(std::size_t mesh) const;
  [[nodiscard]] bool is_polished(std::size_t mesh) const;
  [[nodiscard]] bool is_same(std::size_t mesh) const;
  [[nodiscard]] double pace(std::size_t mesh) const;

  std::vector<FittedMesh> meshes_;
  std::vector<Seen> seen_;
  std::size_t parts_begun_ = 0;  ///< on the last wall of seen_
  Equilibria each_{}, left_{};   ///< of the present part
  std::vector<double> misfits_;  ///< of the present part
  std::optional<Present> present_;
};

}  // namespace lv::calibrate
