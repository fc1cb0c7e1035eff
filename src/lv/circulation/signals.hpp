#pragma once

#include <string>
#include <vector>

namespace lv::circulation {

/// What a circulation shows of the left ventricle at one time.
struct Signals {
  double volume = 0.0;              ///< [mm^3]
  double pressure = 0.0;            ///< [kPa]
  double filling_pressure = 0.0;    ///< before the mitral valve [kPa]
  double aortic_pressure = 0.0;     ///< at the root [kPa]
  double mitral_gradient = 0.0;     ///< pressure before the valve less that behind it [kPa]
  double aortic_gradient = 0.0;     ///< [kPa]
  double mitral_flow = 0.0;         ///< [mm^3/s]
  double aortic_flow = 0.0;         ///< [mm^3/s]
  std::vector<double> others = {};  ///< of the circuit's own columns
};

/// A column of a table: what it holds and in which unit it is shown.
struct Column {
  std::string name;
  std::string unit;
};

}  // namespace lv::circulation
