#pragma once

#include "lv/case_file/parameters.hpp"

#include <algorithm>
#include <initializer_list>
#include <type_traits>

/// How parameters.cpp declares parameters: rows of tables, each made by the function of its kind.
namespace lv::case_file {

inline constexpr Range any{};
inline constexpr Range positive{.low = 0.0, .low_included = false};
inline constexpr Range not_negative{.low = 0.0};
constexpr Range between(double low, double high) {
  return {.low = low, .high = high};
}
constexpr Range above_up_to(double low, double high) {
  return {.low = low, .high = high, .low_included = false};
}

template <class T>
Slot slot(T& member) {
  if constexpr (std::is_enum_v<T>)
    return Choice{&member,
                  [](const void* at) { return static_cast<int>(*static_cast<const T*>(at)); },
                  [](void* at, int value) { *static_cast<T*>(at) = static_cast<T>(value); }};
  else
    return &member;
}

/// A parameter's place in the case.
#define LV_AT(member) [](lv::case_file::Case& c) { return lv::case_file::slot(c.member); }

/// The name of a parameter that is called as its place in the case is, and the place.
#define LV_NAMED(member) #member, LV_AT(member)

using Place = Slot (*)(Case&);

/// A number, whole number, or three of either. The unit "" is that of a number without one.
constexpr Parameter number(const char* name, Place at, const char* unit, const Range& range,
                           const char* help, const char* equation = "") {
  return {name, at, unit, range, "", help, equation};
}

/// A list of numbers without a unit, which may be empty.
constexpr Parameter numbers(const char* name, Place at, const Range& range, const char* help) {
  return {name, at, "", range, "", help, ""};
}

/// A flag, text, list of texts or list of whole numbers.
constexpr Parameter value(const char* name, Place at, const char* help) {
  return {name, at, "", any, "", help, ""};
}

/// A list of whole numbers, at least one.
constexpr Parameter filled_list(const char* name, Place at, const char* help) {
  Parameter p = value(name, at, help);
  p.may_be_empty = false;
  return p;
}

/// A file.
constexpr Parameter file(const char* name, Place at, const char* help) {
  Parameter p = value(name, at, help);
  p.text = Text::file;
  return p;
}

/// A file or folder.
constexpr Parameter path(const char* name, Place at, const char* help) {
  Parameter p = value(name, at, help);
  p.text = Text::path;
  return p;
}

/// Words that may name a file, or a list of such.
constexpr Parameter perhaps_path(const char* name, Place at, const char* help) {
  Parameter p = value(name, at, help);
  p.text = Text::perhaps_path;
  return p;
}

/// One of several words.
constexpr Parameter choice(const char* name, Place at, const char* words, const char* help,
                           const char* equation = "") {
  return {name, at, "", any, words, help, equation};
}

/// The parameter counts only where this holds too.
constexpr Parameter when(const Condition& condition, Parameter p) {
  *std::find(p.conditions.begin(), p.conditions.end(), nullptr) = &condition;
  return p;
}

/// What comes of the parameter depends on whether a case sets it, even if to its default.
constexpr Parameter whether_set(Parameter p) {
  p.whether_set_counts = true;
  return p;
}

/// Whether a case sets the parameter is a remark of these stages: no number depends on it.
constexpr Parameter remark_whether_set(Stages stages, Parameter p) {
  p.remark_whether_set = stages;
  return p;
}

/// The parameter changes how a stage goes about its work, not what comes out.
constexpr Parameter same_results(Parameter p) {
  p.changes_results = false;
  return p;
}

/// Rows that the same stages read under the same conditions.
struct Group {
  Stages read_by;
  std::initializer_list<const Condition*> conditions;
  std::initializer_list<Parameter> rows;
};

/// A row with what its group says of it.
inline Parameter in_group(const Group& group, Parameter row) {
  row.read_by = group.read_by;
  for (const Condition* condition : group.conditions)
    row = when(*condition, row);
  return row;
}

}  // namespace lv::case_file
