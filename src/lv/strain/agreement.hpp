#pragma once

#include "lv/base/table.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace lv::strain {

/// A strain of one region, measured and of the model.
struct Pair {
  std::string scheme;  ///< sector, slice or aha17
  int slice = 0;       ///< 0 unless the region belongs to one
  std::string segment;
  double measured = 0.0, model = 0.0;
};

/// Bland and Altman's agreement (Lancet 327:307, 1986) of model with measurement.
struct Agreement {
  int count = 0;
  double bias = 0.0;                ///< mean of model - measured
  double deviation = 0.0;           ///< of the differences, with count - 1
  double lower = 0.0, upper = 0.0;  ///< bias -+ 1.96 deviation: 95% limits of agreement
  double correlation = 0.0;         ///< Pearson's; NaN where either side has one value alone
};

/// NaN where there are too few pairs.
[[nodiscard]] Agreement agreement(const std::vector<Pair>& pairs);

/// Columns: scheme, slice, segment, measured, model, difference.
[[nodiscard]] Table pairs_table(const std::vector<Pair>& pairs);

/// A strain that somebody else measured.
struct Measured {
  int slice;
  std::string component;  ///< cir or rad
  std::string segment;    ///< as mesh::sector_name has it
  double value;
};

/// The two measures of a change of length l over L.
enum class Measure {
  engineering,    ///< l / L - 1
  green_lagrange  ///< ((l / L)^2 - 1) / 2
};

/// The strain that a text gives. Throws InputError at `where` unless it is a number above that of a
/// length that vanishes (-1, Green-Lagrange -1/2) and below 2, which percentages are not.
[[nodiscard]] double strain_in(const std::string& text, Measure measure, const std::string& where);

/// Reads a CSV file with the columns slice, component (cir or rad), segment (Ant, AntSept, InfSept,
/// Inf, InfLat, AntLat, in any case) and one column per image, of which `column` is taken. Throws
/// InputError naming file, line and what is wrong.
[[nodiscard]] std::vector<Measured> read_measured(const std::filesystem::path& file,
                                                  const std::string& column, Measure measure);

}  // namespace lv::strain
