#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

/// Units at the edges of the program. Inside, everything is in mm, kg, s (hence kPa, mN, mm^3), uM
/// and radians.
namespace lv::units {

inline constexpr double mmHg = 0.133322387415;          ///< [kPa]
inline constexpr double cmH2O = 0.0980665;              ///< by convention, 98.0665 Pa [kPa]
inline constexpr double ml = 1e3;                       ///< [mm^3]
inline constexpr double degree = 0.017453292519943295;  ///< [rad]

/// Powers of length, mass, time, concentration and angle.
using Dimension = std::array<int, 5>;

struct Unit {
  double factor = 1.0;  ///< inner units per this unit
  Dimension dimension{};
};

/// A product of units: "kPa", "g/ml", "Pa s", "1/(uM s)", "mm^2". Empty text is dimensionless; the
/// micro sign and the Greek letter mu stand for u, the sign of degrees for deg.
/// Throws std::invalid_argument that says which part is no unit and what unit it may have meant.
[[nodiscard]] Unit parse_unit(std::string_view text);

/// A number and its unit.
struct Quantity {
  double value = 0.0;  ///< in inner units
  Unit unit;
  bool has_unit = false;
};

/// "8 mmHg", "-60 deg", "1.2e-4 s". Throws std::invalid_argument like parse_unit, and for text that
/// is no number.
[[nodiscard]] Quantity parse_quantity(std::string_view text);

/// "8 mmHg": a value of inner units in another unit, with just as many digits as it needs.
[[nodiscard]] std::string format(double value, std::string_view unit);

/// "pressure", "length", ... of a unit, for messages.
[[nodiscard]] std::string kind_of(const Unit& unit);

}  // namespace lv::units
