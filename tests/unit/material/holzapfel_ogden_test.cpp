#include "lv/material/holzapfel_ogden.hpp"

#include "lv/material/tangent_algebra.hpp"

#include "support/law_checks.hpp"
#include "support/tangent_checks.hpp"

#include <array>

namespace {

using namespace lv;
using material::HolzapfelOgden;

const HolzapfelOgden healthy;  // the paper, section 3.1
// Holzapfel & Ogden 2009, Table 1: pig, fitted to simple shear
const HolzapfelOgden pig{0.059, 8.023, 18.472, 16.026, 2.481, 11.120, 0.216, 11.436};
// Wang et al. 2013: human
const HolzapfelOgden human{0.2362, 10.810, 20.037, 14.154, 3.7245, 5.1645, 0.4108, 11.300};

/// The term of (2.18) that is no derivative of W: it removes the stress at rest.
Mat3 rest_term(const HolzapfelOgden& law, const Mat3& F) {
  return law.a * std::exp(law.b * (F.squaredNorm() - 3.0)) * cofactor(F) / determinant(F);
}

Mat3 cauchy(const HolzapfelOgden& law, const Mat3& F) {
  return law.stress(F) * F.transpose() / determinant(F);
}

/// Shear stress when the material line i is sheared by gamma towards j.
double shear_stress(const HolzapfelOgden& law, int i, int j, double gamma) {
  Mat3 F = Mat3::Identity();
  F(j, i) = gamma;
  return cauchy(law, F)(i, j);
}

struct ShearRow {
  double gamma;
  std::array<double, 6> stress;  ///< fs, fn, sf, sn, nf, ns [kPa]
};

void check_shear(const HolzapfelOgden& law, const std::array<ShearRow, 3>& rows) {
  constexpr std::array<std::array<int, 2>, 6> modes{
      {{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}}};
  for (const ShearRow& row : rows)
    for (int m = 0; m < 6; ++m)  // the reference has nine digits
      CHECK(shear_stress(law, modes[m][0], modes[m][1], row.gamma) ==
            Approx(row.stress[m]).epsilon(5e-9));
}

/// An incompressible bar stretched by lambda along `axis`, with the stretch `side` across on the
/// first other axis.
Mat3 bar(int axis, double lambda, double side) {
  const int first = axis == 0 ? 1 : 0;
  Mat3 F = Mat3::Identity();
  F(axis, axis) = lambda;
  F(first, first) = side;
  F(3 - axis - first, 3 - axis - first) = 1.0 / (lambda * side);
  return F;
}

/// Stress along the bar when the pressure leaves its sides free.
void check_tension(const HolzapfelOgden& law, int axis, double lambda, double side,
                   double expected) {
  const int first = axis == 0 ? 1 : 0;
  const Mat3 sigma = cauchy(law, bar(axis, lambda, side));
  const int second = 3 - axis - first;
  INFO("axis " << axis << ", stretch " << lambda);
  // `side` has nine digits; across, exponents multiply its error by up to 1e2
  CHECK(sigma(axis, axis) - sigma(second, second) == Approx(expected).epsilon(1e-7));
  CHECK(sigma(first, first) == Approx(sigma(second, second)).epsilon(1e-6));
}

/// Healthy muscle with fibres and sheets a hundred times as stiff.
HolzapfelOgden with_stiff_fibres() {
  HolzapfelOgden stiff = healthy;
  stiff.a_f *= 100.0;
  stiff.a_s *= 100.0;
  return stiff;
}

}  // namespace

TEST_CASE("Holzapfel-Ogden muscle at rest is free of stress", "[unit][material]") {
  for (const HolzapfelOgden& law : {healthy, pig, human})
    test::check_no_stress_at_rest(law);
}

TEST_CASE("the Holzapfel-Ogden stress is dW/dF - a exp[b(I1-3)] F^-T", "[unit][material]") {
  test::check_stress_is_derivative(
      [&](const Mat3& F) { return Mat3(healthy.stress(F) + rest_term(healthy, F)); },
      [&](const Mat3& F) { return healthy.energy(F); }, 1e-7);  // exponents up to b I1 = 15
}

TEST_CASE("the Holzapfel-Ogden tangent is the derivative of the stress", "[unit][material]") {
  for (const HolzapfelOgden& law : {healthy, pig, human})
    test::check_tangent(law);
}

TEST_CASE("the Holzapfel-Ogden tangent is symmetric but for the term of (2.18)",
          "[unit][material]") {
  test::check_symmetric([](const Mat3& F) {
    const Mat3 rest = rest_term(healthy, F);
    return material::Tangent<double>(healthy.tangent(F) + material::outer(2 * healthy.b * rest, F));
  });
}

TEST_CASE("fibres and sheets have no stiffness in compression", "[unit][material]") {
  const HolzapfelOgden stiff = with_stiff_fibres();
  Mat3 F = Mat3::Identity();
  F.diagonal() << 0.95, 0.9, 1.2;
  CHECK(stiff.tangent(F) == healthy.tangent(F));
  CHECK(stiff.tangent(Mat3::Identity()) == healthy.tangent(Mat3::Identity()));  // I4f = I4s = 1
  F(0, 0) = 1.0 + 1e-9;
  // 4 a_f: all of the fibre's stiffness at once, not gradually
  CHECK(stiff.tangent(F)(0, 0) - healthy.tangent(F)(0, 0) == Approx(99.0 * 4.0 * healthy.a_f));
}

TEST_CASE("the Holzapfel-Ogden law is objective", "[unit][material]") {
  test::check_objective(healthy);
  test::check_packs_agree(healthy);
}

TEST_CASE("simple shear gives the six curves of the Holzapfel-Ogden law", "[unit][material]") {
  // Computed independently from the closed forms of Holzapfel & Ogden 2009, eq. (5.24)-(5.29):
  // fs: [a e^{b g^2} + 2 a_f g^2 e^{b_f g^4} + a_fs e^{b_fs g^2}] g, fn: without a_fs, and so on.
  check_shear(
      pig,
      {{{0.1,
         {0.0676130802, 0.0433961178, 0.0355773471, 0.0113603847, 0.00639286389, 0.00639286389}},
        {0.3, {1.3535625, 1.17219133, 0.36441145, 0.183040279, 0.0364388182, 0.0364388182}},
        {0.5, {14.6766349, 12.7926749, 3.34599469, 1.46203469, 0.219234134, 0.219234134}}}});
  check_shear(
      healthy,
      {{{0.1, {0.0585644569, 0.0281719108, 0.0573835232, 0.0269909772, 0.0252506988, 0.0252506988}},
        {0.3, {0.296440426, 0.195269678, 0.262497996, 0.161327248, 0.113734424, 0.113734424}},
        {0.5, {1.10799062, 0.900386019, 0.875281579, 0.667676982, 0.427302307, 0.427302307}}}});
  check_shear(
      human,
      {{{0.1, {0.11244168, 0.0664472002, 0.0797637671, 0.0337692873, 0.0263164393, 0.0263164393}},
        {0.3, {1.74164925, 1.4009045, 0.737927292, 0.397182538, 0.187467613, 0.187467613}},
        {0.5, {17.3577171, 13.894479, 6.51078254, 3.04754444, 1.76169505, 1.76169505}}}});
}

TEST_CASE("tension and compression of incompressible bars give the reference stresses",
          "[unit][material]") {
  // stretch; stress and transverse stretch of bars along f (s across), s (f across), n (f across).
  // Computed independently: closed form in tension, a root search for the side in compression.
  constexpr std::array<std::array<double, 7>, 6> rows_healthy{
      {{0.8, -0.430808539, 1.04612842, -0.467801136, 1.03434083, -1.11253434, 1.09603865},
       {0.9, -0.114273764, 1.01398904, -0.118395119, 1.00947686, -0.36651367, 1.04295654},
       {1.05, 0.382066374, 0.975900073, 0.237346681, 0.975900073, 0.0373825026, 0.975900073},
       {1.1, 0.974317937, 0.953462589, 0.557791858, 0.953462589, 0.0833339039, 0.953462589},
       {1.2, 4.38200599, 0.912870929, 1.75308382, 0.912870929, 0.250317422, 0.912870929},
       {1.3, 25.2639719, 0.877058019, 5.05157344, 0.877058019, 0.705338409, 0.877058019}}};
  constexpr std::array<std::array<double, 7>, 2> rows_pig{
      {{1.1, 19.054271, 0.953462589, 2.08116118, 0.953462589, 0.0222578129, 0.953462589},
       {1.2, 521.057853, 0.912870929, 27.1509096, 0.912870929, 0.0842297617, 0.912870929}}};
  const auto check = [](const HolzapfelOgden& law, const std::array<double, 7>& row) {
    for (int axis = 0; axis < 3; ++axis)
      check_tension(law, axis, row[0], row[2 + 2 * axis], row[1 + 2 * axis]);
  };
  for (const auto& row : rows_healthy)
    check(healthy, row);
  for (const auto& row : rows_pig)
    check(pig, row);
}

TEST_CASE("a general deformation gives the energy and stress computed independently",
          "[unit][material]") {
  Mat3 F;
  F << 1.10, 0.05, -0.02, 0.03, 0.98, 0.04, -0.01, 0.06, 0.95;
  Mat3 P;  // by automatic differentiation of (2.14), with the sheet switched off (I4s = 0.9665)
  P << 0.88548408, 0.05642443, -0.01142100, 0.07540186, -0.01544915, 0.03829815, -0.01723966,
      0.03750746, -0.03844622;
  CHECK(healthy.energy(F) == Approx(0.07258309779946).epsilon(1e-13));
  CHECK((healthy.stress(F) - P).cwiseAbs().maxCoeff() < 6e-9);  // eight decimals
}

TEST_CASE("fibres and sheets carry no load in compression", "[unit][material]") {
  const HolzapfelOgden stiff = with_stiff_fibres();
  Mat3 F = Mat3::Identity();
  F.diagonal() << 0.95, 0.9, 1.2;
  CHECK(stiff.stress(F) == healthy.stress(F));
  CHECK(stiff.energy(F) == healthy.energy(F));
  F.diagonal() << 1.05, 0.9, 1.1;
  CHECK(stiff.stress(F)(0, 0) > 2.0 * healthy.stress(F)(0, 0));
  CHECK(stiff.stress(F)(1, 1) == healthy.stress(F)(1, 1));
  F.diagonal() << 0.9, 1.05, 1.1;
  CHECK(stiff.stress(F)(0, 0) == healthy.stress(F)(0, 0));
  CHECK(stiff.stress(F)(1, 1) > 2.0 * healthy.stress(F)(1, 1));
}

TEST_CASE("the switches do not make the stress jump", "[unit][material]") {
  for (const int axis : {0, 1}) {
    Mat3 below = Mat3::Identity();
    Mat3 above = Mat3::Identity();
    below(axis, axis) -= 1e-9;
    above(axis, axis) += 1e-9;
    // moduli of 10 kPa times the step
    CHECK((pig.stress(above) - pig.stress(below)).norm() < 100.0 * 2e-9);
  }
}

TEST_CASE("the remote muscle of a patient is stiffer in its anisotropic terms alone (2.25)",
          "[unit][material]") {
  const HolzapfelOgden remote = healthy.with_anisotropy_scaled(7.5);
  CHECK(remote.a_f == Approx(7.5 * 1.46));
  CHECK(remote.a_s == Approx(7.5 * 0.87));
  CHECK(remote.a_fs == Approx(7.5 * 0.3));
  CHECK(remote.a == healthy.a);
  CHECK(remote.b == healthy.b);
  CHECK(remote.b_f == healthy.b_f);
  CHECK(remote.b_s == healthy.b_s);
  CHECK(remote.b_fs == healthy.b_fs);
}
