#pragma once

#include "lv/anatomy/anatomy.hpp"
#include "lv/case_file/case.hpp"

#include <string>

namespace lv::pipeline {

/// Throws InputError where a fit cannot meet the measured volumes whatever its parameters, as far
/// as that is known without mechanics:
///
/// - calibrate.edv is not above what the shape taken as free of stress holds already;
/// - calibrate.esv is not below what a shape of end-diastole was seen to hold;
/// - one of them asks for fibres that are half as long again as without load, or shorter than four
///   fifths of that, in the mean (calibrate::one_fibre_volume): shorter ones bear no tension,
///   1 + beta_0 (lambda - 1) = 0 in the law of Niederer, Hunter and Smith; in that of Land et al.
///   where its h(lambda) is zero, at 0.72 with its own constants. A loaded shape's volume
///   without load is taken from Klotz's curve, to which it is fitted.
void check_measured_volumes(const case_file::Case& c, const anatomy::Shape& shape);

/// Of a measured end-systolic volume with which less than a tenth of the cavity's volume at
/// end-diastole would be ejected; that is calibrate.edv or, of a loaded shape, what the shape
/// holds. Empty: nothing odd.
[[nodiscard]] std::string little_ejection(const case_file::Case& c, const anatomy::Shape& shape);

}  // namespace lv::pipeline
