#pragma once

#include "lv/circulation/beat_measures.hpp"

#include <span>
#include <string>
#include <vector>

/// What heartbeats under several loads say of the ventricle, whatever its load.
namespace lv::circulation {

/// What is changed of a case, as factors; 1 is the case's own.
struct Factors {
  double preload = 1.0;        ///< of the pressure or the blood that the ventricle is filled from
  double afterload = 1.0;      ///< of the resistance that it ejects against
  double contractility = 1.0;  ///< of the tension of its muscle
  double heart_rate = 1.0;     ///< of beats per time

  /// Whether the load differs in preload alone, if at all.
  [[nodiscard]] bool is_preload() const { return afterload == 1.0; }
};

/// Volume [mm^3] and pressure [kPa] of the cavity.
struct LoopPoint {
  double volume, pressure;
};

/// The last beat of one of a family of cases.
struct LoadedBeat {
  std::string name;
  Factors factors;
  int beats = 0;          ///< up to and with this one
  bool is_limit = false;  ///< it is that of a limit cycle
  BeatMeasures measures;
  std::vector<LoopPoint> loop;
};

/// One of a family whose beats found no solution.
struct MissingBeat {
  std::string name;
  Factors factors;
  std::string why;
};

/// A straight line y = slope (x - intercept).
struct Line {
  double slope, intercept;
  double deviation;  ///< root mean square of the points' distance from it in y
  int points;
};

/// The line of least squares in y through points; one with an unknown number (NaN) is left out.
/// Slope and intercept are NaN where fewer than two differ in x, the deviation of fewer than three.
[[nodiscard]] Line line_through(std::span<const double> x, std::span<const double> y);

/// The end-systolic pressure-volume relation p = E_es (V - V_0) of beats that differ in their loads
/// alone, and the point of each beat on it.
struct EndSystolicRelation {
  Line line;                      ///< E_es [kPa/mm^3], V_0 [mm^3], deviation [kPa]
  std::vector<LoopPoint> points;  ///< of the beats in their order
};

/// A beat's end-systolic point is that of its largest p/(V - V_0), its greatest elastance; the line
/// through the points of all beats gives V_0. Both are repeated, beginning with V_0 = 0, until the
/// points stay (Sagawa, Circulation 63:1223, 1981; Kono et al., Circulation 70:1057, 1984). In
/// looking for points V_0 is held below 0.9 of the least volume.
[[nodiscard]] EndSystolicRelation end_systolic_relation(std::span<const LoadedBeat> beats);

/// Preload-recruitable stroke work SW = M_w (EDV - V_w) of beats that differ in preload alone:
/// M_w [kPa], V_w [mm^3], deviation [kPa mm^3] (Glower et al., Circulation 71:994, 1985).
[[nodiscard]] Line recruitable_stroke_work(std::span<const LoadedBeat> beats);

/// Effective arterial elastance, end-systolic pressure / stroke volume [kPa/mm^3] (Sunagawa et al.,
/// Am. J. Physiol. 245:H773, 1983).
[[nodiscard]] double arterial_elastance(const BeatMeasures& beat);

/// Beats of one contractility and heart rate, and what they say together.
struct Contractility {
  std::vector<LoadedBeat> beats;
  EndSystolicRelation end_systole;  ///< of all loads
  Line stroke_work;                 ///< of the preloads
};

/// A family divided by contractility and heart rate, in the order of the family.
[[nodiscard]] std::vector<Contractility> by_contractility(std::span<const LoadedBeat> family);

}  // namespace lv::circulation
