#pragma once

#include "lv/material/law.hpp"

#include <string>
#include <vector>

namespace lv::material {

/// Stress against stretch of one muscle.
struct StressStretch {
  std::string muscle;           ///< its name
  bool is_published = false;    ///< not the case's own
  std::vector<double> stretch;  ///< along the fibre [-]
  std::vector<double> stress;   ///< Cauchy stress along the fibre [kPa]
};

/// Passive muscle pulled along the fibre; incompressible, sides free (the paper's Figure 5):
///
///   sigma = (P F^T)_ff - (P F^T)_ss,   F = diag(l, l^-1/2, l^-1/2)                         [kPa]
///
/// from l = 1 on, to where it reaches 12 kPa and at most to l = 1.3.
[[nodiscard]] StressStretch pulled_along_fibre(const std::string& muscle, const AnyPassiveLaw& law);

/// The same of muscle whose parameters are printed: the paper's healthy subject and its patient
/// (C_a = 7.5), and excised muscle (Holzapfel & Ogden, Phil. Trans. R. Soc. A 367:3445, 2009).
[[nodiscard]] std::vector<StressStretch> published_muscles();

/// Whether a name is that of one of the paper's two subjects, which stand beside a case on request
/// only.
[[nodiscard]] bool is_subject_of_paper(const std::string& muscle);

}  // namespace lv::material
