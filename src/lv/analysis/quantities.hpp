#pragma once

#include "lv/analysis/wall_fields.hpp"

#include <span>
#include <string>
#include <string_view>

namespace lv::analysis {

/// A number that every element has at a moment: what `regions.csv`, the fields, the figures and the
/// page say of it.
struct Quantity {
  const char* name;   ///< in regions.csv
  const char* title;  ///< for readers
  const char* unit;   ///< "1" of numbers without one
  double (*of)(const CellFields& now, const CellStrain& strain);
  const char* field;       ///< of wall_*.vtu; of a strain without the state that it is from
  bool is_strain = false;  ///< its field is there for each state that it may be from
  bool is_shown = false;   ///< in figures and on the page
  bool is_signed = false;  ///< colours diverge from `middle`
  double middle = 0.0;
  double floor = 0.0;     ///< nearer to `middle` is as good as none and has no colour
  const char* help = "";  ///< a sentence for whoever points at it

  /// The array's name in wall_*.vtu: a strain's ends with the name of the state that it is from.
  [[nodiscard]] std::string field_name(std::string_view from) const {
    return is_strain ? std::string(field) + "_" + std::string(from) : field;
  }
};

/// All of them, in the order of regions.csv: the quantities of the paper's sections 3.3-3.5, and
/// when muscle is activated and what it does in a heartbeat, which not all beats know.
[[nodiscard]] std::span<const Quantity> quantities();

/// An infarct's extent M, which a wall has at its nodes and at all moments: in words and colours;
/// it is not `of` an element and in no table.
[[nodiscard]] const Quantity& infarct_extent();

/// For axes and colour bars: "fibre stress [kPa]".
[[nodiscard]] std::string label(const Quantity& quantity);

/// Whether elements have the quantity: it is a number.
[[nodiscard]] bool is_known(const Quantity& quantity, std::span<const CellFields> cells);

/// Throws CheckError (a defect) for a name that is none of theirs.
[[nodiscard]] const Quantity& quantity(std::string_view name);

}  // namespace lv::analysis
