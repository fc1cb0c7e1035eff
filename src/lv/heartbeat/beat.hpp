#pragma once

#include "lv/base/tensor.hpp"
#include "lv/circulation/cycle.hpp"
#include "lv/solid/cell_stress.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace lv::heartbeat {

/// One row of the curves of a beat.
struct CurveRow {
  double time = 0.0;              ///< [s]
  std::string phase{};            ///< its name
  double pressure = 0.0;          ///< on the endocardium [kPa]
  double volume = 0.0;            ///< of the cavity [mm^3]
  double calcium = 0.0;           ///< [uM]
  double mean_tension = 0.0;      ///< [kPa]
  double kinetic_energy = 0.0;    ///< of blood and wall in the box [mN mm]
  double largest_velocity = 0.0;  ///< [mm/s]
  double min_J = 1.0;
  double max_J = 1.0;
  double step = 0.0;  ///< [s]
};

/// The wall at one time: all that stresses and strains follow from.
struct Snapshot {
  double time = 0.0;
  double pressure = 0.0;        ///< on the endocardium [kPa]
  double volume = 0.0;          ///< [mm^3]
  std::vector<Vec3> positions;  ///< of the nodes [mm]
  std::vector<double> tension;  ///< per node, of the immersed engine; else empty [kPa]
  /// Per element, of the quasi-static engine, which knows p; else empty.
  std::vector<solid::CellStress> stress;
};

/// The names of the moments that every beat has.
inline constexpr const char* end_diastole = "end_diastole";
inline constexpr const char* end_systole = "end_systole";
/// And those that beats of a circulation have besides.
inline constexpr const char* aortic_opening = "aortic_opening";
inline constexpr const char* mitral_opening = "mitral_opening";

/// What is said of a moment.
struct MomentWords {
  const char* moment;
  const char* title;   ///< for readers
  const char* mark;    ///< on axes and sliders
  const char* volume;  ///< what a clinic calls the cavity's volume then; empty: nothing
};

/// Of all moments that beats may come to, in the order of a heartbeat.
inline constexpr std::array<MomentWords, 4> moment_words{
    {{end_diastole, "end-diastole", "ED", "EDV"},
     {aortic_opening, "aortic opening", "AO", ""},
     {end_systole, "end-systole", "ES", "ESV"},
     {mitral_opening, "mitral opening", "MO", ""}}};

/// A moment's name for readers: "end-diastole".
[[nodiscard]] std::string title(const std::string& moment);

/// A moment of a beat that has a name: that which a phase ends with.
struct NamedMoment {
  std::string name{};         ///< end_diastole, ...
  std::string phase{};        ///< that it ends
  bool by_criterion = false;  ///< its criterion ended the phase, not its longest duration
  Snapshot wall{};
};

/// Work on the wall over a heartbeat: what the cavity's pressure, the muscle and a moving base do
/// is stored, goes into motion, and is taken by supports and viscosity [mN mm].
struct EnergyBalance {
  /// Of the pressure on the endocardium; the negative of the stroke work int p dV where the base
  /// stays in its plane.
  double pressure = 0.0;
  double muscle = 0.0;  ///< -int int P_active : dF dX
  /// The same of each finite element by its undeformed volume [kPa].
  std::vector<double> work_density{};
  double stored = 0.0;     ///< change of int W dX
  double kinetic = 0.0;    ///< change of int rho v.v/2 dX
  double supports = 0.0;   ///< into springs and dashpots
  double viscosity = 0.0;  ///< int int P_viscous : dF dX
  double base = 0.0;       ///< of what moves the base on its springs and dashpots

  /// Whether it was kept: the immersed engine, whose blood moves and rubs too, keeps none.
  [[nodiscard]] bool is_known() const { return muscle != 0.0; }

  /// What is missing, as a part of what the muscle does.
  [[nodiscard]] double error() const {
    return std::abs((pressure + muscle + base - stored - kinetic - supports - viscosity) / muscle);
  }
};

/// What a beat comes to, whichever engine ran it.
struct Beat {
  std::vector<CurveRow> curves;
  std::vector<NamedMoment> moments;  ///< in their order
  /// All heartbeats of a wall joined to a circulation, of which `curves` and `moments` are the
  /// last.
  std::optional<circulation::Cycle> cycle;
  EnergyBalance energy;  ///< of the last heartbeat of a circulation
  /// When each node is activated after the calcium of the beat begins [s]; empty: all at once.
  std::vector<double> activation_times;
  int steps = 0;
  int retries = 0;          ///< steps taken back and repeated smaller
  double wall_clock = 0.0;  ///< of the computation, interruptions left out [s]

  /// The moment of that name, or nothing when the beat did not come to it.
  [[nodiscard]] const NamedMoment* find(const std::string& name) const;

  /// The wall at the moment of that name, which the beat must have come to.
  [[nodiscard]] const Snapshot& at(const std::string& name) const;
};

}  // namespace lv::heartbeat
