#pragma once

#include "lv/verify/quantity.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lv::verify {

/// What a problem found out. On several ranks the root's copy counts.
class Findings {
 public:
  /// `scratch` is an empty folder at first; the runs of one problem on different rank counts share
  /// it, in the order of Problem::ranks.
  Findings(std::string problem, std::filesystem::path scratch)
      : problem_(std::move(problem)), scratch_(std::move(scratch)) {}

  /// A value that must lie within `tolerance` of `reference`.
  void add(const std::string& quantity, double value, double reference, double tolerance,
           const std::string& unit = "") {
    quantities_.push_back({problem_, quantity, value, reference, tolerance, unit});
  }

  /// A value that must lie within `fraction` of `reference`.
  void add_within(const std::string& quantity, double value, double reference, double fraction,
                  const std::string& unit = "") {
    add(quantity, value, reference, fraction * (reference < 0 ? -reference : reference), unit);
  }

  /// An error, never negative, that must not exceed `bound`.
  void add_error(const std::string& quantity, double value, double bound,
                 const std::string& unit = "") {
    add(quantity, value, 0.0, bound, unit);
  }

  [[nodiscard]] const std::filesystem::path& scratch() const { return scratch_; }
  [[nodiscard]] const std::vector<Quantity>& quantities() const { return quantities_; }

 private:
  std::string problem_;
  std::filesystem::path scratch_;
  std::vector<Quantity> quantities_;
};

/// Short problems run by default; long ones when named or asked for.
enum class Length { brief, nightly };

/// A claim about the program and the computation that tests it.
struct Problem {
  std::string name;
  std::string proves;  ///< one line
  Length length = Length::brief;
  std::vector<int> ranks;          ///< it is solved once on each of these numbers of ranks
  void (*solve)(Findings& found);  ///< collective
  bool has_constants = false;      ///< it can be solved with others: Options::constants
};

/// All problems, from the laws up.
[[nodiscard]] std::span<const Problem> problems();

/// The problem of that name. Throws InputError with the nearest name.
[[nodiscard]] const Problem& problem(const std::string& name);

}  // namespace lv::verify
