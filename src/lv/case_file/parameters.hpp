#pragma once

#include "lv/base/names_alone.hpp"
#include "lv/case_file/case.hpp"

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace lv::case_file {

/// The stages of a run, in their order.
enum class Stage { circulation, strain, anatomy, mesh, calibrate, unload, beat, results, report };
inline constexpr std::array all_stages{Stage::circulation, Stage::strain,    Stage::anatomy,
                                       Stage::mesh,        Stage::calibrate, Stage::unload,
                                       Stage::beat,        Stage::results,   Stage::report};

/// Which stages read a parameter.
class Stages {
 public:
  template <class... S>
  constexpr explicit Stages(S... stages)
      : bits_(((1U << static_cast<unsigned>(stages)) | ... | 0U)) {}
  [[nodiscard]] constexpr bool contains(Stage stage) const {
    return (bits_ >> static_cast<unsigned>(stage) & 1U) != 0U;
  }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0U; }

 private:
  unsigned bits_;
};

/// Whether a case has a stage: circulation, strain, calibrate and unload are of cases that ask for
/// them.
[[nodiscard]] bool has_stage(const Case& c, Stage stage);

/// What a case must be like for a parameter to count in a stage.
struct Condition {
  bool (*holds)(const Case&, Stage);
  const char* words;  ///< "with engine = \"immersed\""
};

/// Allowed values of a number, in the parameter's own unit.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true;
  bool high_included = true;

  [[nodiscard]] bool contains(double x) const;
  [[nodiscard]] std::string words(const std::string& unit) const;
};

/// A member of a case that is an enumerator, as its number.
struct Choice {
  void* at;
  int (*get)(const void*);
  void (*set)(void*, int);
};

/// The member of a case that a parameter sets.
using Slot = std::variant<double*, int*, bool*, std::string*, Choice, std::array<double, 3>*,
                          std::array<int, 3>*, std::optional<std::array<double, 3>>*,
                          std::vector<int>*, std::vector<double>*, std::vector<std::string>*>;

/// How the text of a parameter is meant.
enum class Text {
  words,        ///< as it is
  file,         ///< a file: its contents count, not its name
  path,         ///< a file or folder, likewise
  perhaps_path  ///< a file where there is one of that name, else words
};

/// One parameter of a case file, declared once, in parameters.cpp: what it is, which stages read it
/// and in which cases it counts.
struct Parameter {
  const char* name;  ///< with its tables: "blood.density"
  Slot (*slot)(Case&);
  const char* unit;      ///< of the default's text; any of the same dimension may be written
  Range range;           ///< of numbers
  const char* words;     ///< of a choice, separated by spaces: word i is the enumerator i
  const char* help;      ///< what it means
  const char* equation;  ///< where the paper has it
  Text text = Text::words;
  bool may_be_empty = true;              ///< a list
  bool whether_set_counts = false;       ///< what comes of it depends on whether it is set at all
  Stages remark_whether_set = Stages();  ///< stages that say in words, alone, whether it is set
  bool changes_results = true;           ///< false: only how a stage goes about its work
  Stages read_by = Stages();
  std::array<const Condition*, 4> conditions = {};  ///< all must hold; null: none

  /// The value as it would be written in a case file.
  [[nodiscard]] std::string get(const Case& c) const;
  /// The same, without the names of folders.
  [[nodiscard]] std::string shown(const Case& c) const;
  /// What values are allowed, in words.
  [[nodiscard]] std::string rule() const;
};

/// A table of a case file and what it is about.
struct Section {
  std::string name;
  std::string help;
};

/// All parameters, in the order of the manual.
[[nodiscard]] const std::vector<Parameter>& parameters();
[[nodiscard]] const std::vector<Section>& sections();

/// The parameter of this name; null when there is none.
[[nodiscard]] const Parameter* find_parameter(const std::string& name);

/// Whether a stage of a case reads a parameter.
[[nodiscard]] bool counts(const Parameter& p, const Case& c, Stage stage);

/// Why no stage of the case reads a parameter: "with passive.law = \"guccione\""; empty if one
/// does.
[[nodiscard]] std::string counts_only(const Parameter& p, const Case& c);

/// Whether a text of a parameter is that of a file or folder.
[[nodiscard]] bool names_file(const Parameter& p, const Case& c, const std::string& text);

/// What a parameter names that are, or may be, files and folders, as the case file writes it; none
/// for other parameters.
[[nodiscard]] std::vector<std::string> paths(const Parameter& p, const Case& c);

/// Takes the folders of a case, of its files and of its work out of texts that are kept.
[[nodiscard]] NamesAlone names_alone(const Case& c, const std::filesystem::path& work = {});

/// Whether the case sets a parameter. A stage may ask what its record says: the results of every
/// parameter, stages that read it where whether_set_counts, those of remark_whether_set.
[[nodiscard]] bool is_set(const Case& c, const std::string& parameter, Stage asking);

/// Gives one case's value of a parameter to another.
void copy(const Parameter& p, const Case& from, Case& to);

/// Makes a number not a number, so that what reads it cannot go on unnoticed.
void forget(const Parameter& p, Case& c);

}  // namespace lv::case_file
