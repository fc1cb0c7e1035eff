#pragma once

#include <stdexcept>
#include <string>

namespace lv {

/// The user's input cannot be used. Says where (file:line, key or place), what is wrong, and what
/// to do about it.
class InputError : public std::runtime_error {
 public:
  InputError(std::string where, const std::string& what, const std::string& what_to_do);

  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  std::string where_;
};

/// The computation cannot go on although the input is valid (a step that stays unstable, a full
/// disk).
class RunError : public std::runtime_error {
 public:
  RunError(const std::string& what, const std::string& what_to_do);
};

/// Nature has no answer to what was looked for (no equilibrium, no root): what a search for another
/// one may go on from, which no other RunError is.
class NoSolution : public RunError {
 public:
  using RunError::RunError;
};

/// The computation cannot go on because another rank failed, which says why.
class FailedElsewhere : public std::runtime_error {
 public:
  FailedElsewhere() : std::runtime_error("another rank failed") {}
};

/// A mistake of the program itself.
class LogicError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] void fail_check(const char* condition, const char* file, int line);

}  // namespace lv

/// Our own mistakes, always checked: keep it off hot paths.
#define LV_CHECK(condition) \
  static_cast<void>((condition) ? 0 : (::lv::fail_check(#condition, __FILE__, __LINE__), 0))

/// Our own mistakes, checked in development builds only.
#ifdef NDEBUG
#define LV_ASSERT(condition) static_cast<void>(0)
#else
#define LV_ASSERT(condition) LV_CHECK(condition)
#endif
