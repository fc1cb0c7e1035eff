#include "lv/material/holzapfel_ogden.hpp"

#include "lv/verify/problems.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace lv::verify {
namespace {

using material::HolzapfelOgden;

struct ParameterSet {
  const char* name;
  HolzapfelOgden law;
};

/// The paper's healthy subject; Holzapfel & Ogden 2009, their table 1; Wang et al. 2013.
const ParameterSet healthy{"healthy", {0.24, 5.08, 1.46, 4.15, 0.87, 1.6, 0.3, 1.3}};
const ParameterSet pig{"HO 2009", {0.059, 8.023, 18.472, 16.026, 2.481, 11.12, 0.216, 11.436}};
const ParameterSet human{"Wang 2013",
                         {0.2362, 10.81, 20.037, 14.154, 3.7245, 5.1645, 0.4108, 11.3}};

/// Cauchy stress sigma = P F^T / J.
Mat3 cauchy(const HolzapfelOgden& law, const Mat3& F) {
  return law.stress(F) * F.transpose() / determinant(F);
}

/// sigma_ij when the material line i is sheared by gamma towards j: F = 1 + gamma e_j (x) e_i.
double shear_stress(const HolzapfelOgden& law, int i, int j, double gamma) {
  Mat3 F = Mat3::Identity();
  F(j, i) = gamma;
  return cauchy(law, F)(i, j);
}

struct ShearMode {
  const char* name;
  int i, j;
};
constexpr std::array<ShearMode, 6> modes{
    {{"fs", 0, 1}, {"fn", 0, 2}, {"sf", 1, 0}, {"sn", 1, 2}, {"nf", 2, 0}, {"ns", 2, 1}}};

constexpr std::array<double, 3> shears{0.1, 0.3, 0.5};

/// Stress of each mode at each shear [kPa], computed from the closed forms
///   fs: [a e^{b g^2} + 2 a_f g^2 e^{b_f g^4} + a_fs e^{b_fs g^2}] g,   fn: without the last term,
///   sf, sn: the same with a_s, b_s,                                     nf = ns: a e^{b g^2} g
/// by an independent program.
struct ShearTable {
  const ParameterSet& set;
  std::array<std::array<double, 3>, 6> stress;
};
const std::array<ShearTable, 3> shear_tables{{
    {healthy,
     {{{0.0585644569, 0.296440426, 1.10799062},
       {0.0281719108, 0.195269678, 0.900386019},
       {0.0573835232, 0.262497996, 0.875281579},
       {0.0269909772, 0.161327248, 0.667676982},
       {0.0252506988, 0.113734424, 0.427302307},
       {0.0252506988, 0.113734424, 0.427302307}}}},
    {pig,
     {{{0.0676130802, 1.3535625, 14.6766349},
       {0.0433961178, 1.17219133, 12.7926749},
       {0.0355773471, 0.36441145, 3.34599469},
       {0.0113603847, 0.183040279, 1.46203469},
       {0.00639286389, 0.0364388182, 0.219234134},
       {0.00639286389, 0.0364388182, 0.219234134}}}},
    {human,
     {{{0.11244168, 1.74164925, 17.3577171},
       {0.0664472002, 1.4009045, 13.894479},
       {0.0797637671, 0.737927292, 6.51078254},
       {0.0337692873, 0.397182538, 3.04754444},
       {0.0263164393, 0.187467613, 1.76169505},
       {0.0263164393, 0.187467613, 1.76169505}}}},
}};

/// Tension or compression along one direction of an incompressible cube with free sides: its
/// stretch, the stretch of the first of the other two directions that leaves both sides free, and
/// the stress.
struct Tension {
  int along, across;
  double stretch, lateral;
  double sigma;  ///< [kPa]
};

struct TensionTable {
  const ParameterSet& set;
  const char* direction;
  std::array<Tension, 5> rows;
};
const std::array<TensionTable, 4> tension_tables{{
    {healthy,
     "fibre",
     {{{0, 1, 0.8, 1.04612842, -0.430808539},
       {0, 1, 0.9, 1.01398904, -0.114273764},
       {0, 1, 1.1, 0.953462589, 0.974317937},
       {0, 1, 1.2, 0.912870929, 4.38200599},
       {0, 1, 1.3, 0.877058019, 25.2639719}}}},
    {healthy,
     "sheet",
     {{{1, 0, 0.8, 1.03434083, -0.467801136},
       {1, 0, 0.9, 1.00947686, -0.118395119},
       {1, 0, 1.1, 0.953462589, 0.557791858},
       {1, 0, 1.2, 0.912870929, 1.75308382},
       {1, 0, 1.3, 0.877058019, 5.05157344}}}},
    {healthy,
     "normal",
     {{{2, 0, 0.8, 1.09603865, -1.11253434},
       {2, 0, 0.9, 1.04295654, -0.36651367},
       {2, 0, 1.1, 0.953462589, 0.0833339039},
       {2, 0, 1.2, 0.912870929, 0.250317422},
       {2, 0, 1.3, 0.877058019, 0.705338409}}}},
    {pig,
     "fibre",
     {{{0, 1, 0.8, 1.01292335, -0.237105106},
       {0, 1, 0.9, 1.00189916, -0.035174996},
       {0, 1, 1.1, 0.953462589, 19.054271},
       {0, 1, 1.15, 0.932504808, 83.4797561},
       {0, 1, 1.2, 0.912870929, 521.057853}}}},
}};

/// Half a unit of the ninth and last figure of the tables, of a number that begins with 1; in
/// tension the lateral stretch, with nine figures too, enters with the law's stiffness.
constexpr double shear_tolerance = 5e-9;
constexpr double tension_tolerance = 1e-6;

void check_shear(Findings& found) {
  for (const ShearTable& table : shear_tables) {
    for (std::size_t m = 0; m < modes.size(); ++m) {
      for (std::size_t g = 0; g < shears.size(); ++g) {
        const double sigma = shear_stress(table.set.law, modes[m].i, modes[m].j, shears[g]);
        found.add_within(
            fmt::format("{}: shear {} at {}", table.set.name, modes[m].name, shears[g]), sigma,
            table.stress[m][g], shear_tolerance, "kPa");
      }
    }
  }
}

/// The applied stress is the difference to the free sides, since the pressure is free.
void check_tension(Findings& found) {
  for (const TensionTable& table : tension_tables) {
    double imbalance = 0.0;
    for (const Tension& t : table.rows) {
      const int third = 3 - t.along - t.across;
      Mat3 F = Mat3::Zero();
      F(t.along, t.along) = t.stretch;
      F(t.across, t.across) = t.lateral;
      F(third, third) = 1.0 / (t.stretch * t.lateral);
      const Mat3 sigma = cauchy(table.set.law, F);
      found.add_within(
          fmt::format("{}: {} at stretch {}", table.set.name, table.direction, t.stretch),
          sigma(t.along, t.along) - sigma(t.across, t.across), t.sigma, tension_tolerance, "kPa");
      const double scale = std::abs(t.sigma);
      imbalance =
          std::max(imbalance, std::abs(sigma(t.across, t.across) - sigma(third, third)) / scale);
    }
    found.add_error(
        fmt::format("{}: {}, difference of the free sides", table.set.name, table.direction),
        imbalance, tension_tolerance);
  }
}

}  // namespace

void holzapfel_ogden_curves(Findings& found) {
  check_shear(found);
  check_tension(found);
}

}  // namespace lv::verify
