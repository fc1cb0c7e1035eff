#pragma once

#include "lv/job/case.hpp"

// toml++ asserts in headings such as "[ = ]" what it then refuses in words
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

#include <functional>
#include <string>
#include <vector>

namespace lv::job {

/// The first stage whose result a parameter changes.
enum class Stage { strain, anatomy, mesh, calibrate, unload, beat, results, report };

/// One parameter of a case file, declared once, in parameters.cpp.
struct Parameter {
  std::string name;  ///< with its tables: "blood.density"
  std::string type;  ///< "quantity", "number", "whole number", "choice", "true or false", "text",
                     ///< "file", ...
  std::string unit;  ///< unit of the default's text; any unit of the same dimension may be written
  std::string rule;  ///< what values are allowed, in words
  std::string help;
  std::string equation;  ///< where the paper has it
  Stage stage = Stage::beat;
  std::function<std::string(const Case&)> get;  ///< value as it would be written in a case file
  std::function<void(Case&, const toml::node&)>
      set;  ///< throws std::invalid_argument with the rule that is broken
};

/// A table of a case file and what it is about.
struct Section {
  std::string name;
  std::string help;
};

/// All parameters, in the order of the manual.
[[nodiscard]] const std::vector<Parameter>& parameters();
[[nodiscard]] const std::vector<Section>& sections();

}  // namespace lv::job
