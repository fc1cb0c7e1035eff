#pragma once

#include "lv/anatomy/anatomy.hpp"
#include "lv/anatomy/mesh_result.hpp"
#include "lv/case_file/case.hpp"

#include <string>

namespace lv::pipeline {

/// What a run would be made of, as far as its files tell.
struct CheckedCase {
  std::string strain;  ///< what will be followed and compared with, in words
  anatomy::Shape shape;
  anatomy::MeshResult wall;
  int members = 0;  ///< of its study; 0 without one
  bool warned_of_infarct = false;
};

/// Builds anatomy and mesh in memory and reads all files that fits and heartbeats take. Throws
/// InputError with all that is missing or wrong, as far as it can be told without the rest.
[[nodiscard]] CheckedCase check_case(const case_file::Case& c);

/// Throws InputError for files and boxes that do not fit to the wall.
void check_on_wall(const case_file::Case& c, const anatomy::MeshResult& wall);

/// Says what a run would compute; its last line says what the beat would take on each engine, which
/// warnings matter and what to do next. Throws InputError as check_case.
[[nodiscard]] std::string validate(const case_file::Case& c);

/// Warns of what is odd in a case as a run begins, or would begin.
void warn_of(const case_file::Case& c);

/// What is to know of a fit in a case with heartbeats, which is made outside of them; empty else.
[[nodiscard]] std::string fit_outside_heartbeats(const case_file::Case& c);

/// What is odd about fibres that run as a left-handed helix; empty for others. The human heart's
/// are right-handed at the endocardium (Streeter et al., Circ. Res. 24:339, 1969), which is a
/// negative angle here and a positive one in most other programs.
[[nodiscard]] std::string left_handed_fibres(const case_file::Case& c);

/// What is odd about an end-diastolic or venous pressure that no patient has; empty for others.
/// Experiments may go there, so it is no mistake.
[[nodiscard]] std::string high_filling_pressure(const case_file::Case& c);

/// The same of a peak of calcium that no heart's muscle has.
[[nodiscard]] std::string high_calcium(const case_file::Case& c);

/// What is odd about a shape that bears another pressure than the model has at end-diastole, where
/// it is that of end-diastole or bears more; empty for others. One that bears less may be that of
/// an earlier moment.
[[nodiscard]] std::string unlike_end_diastole(const case_file::Case& c);

}  // namespace lv::pipeline
