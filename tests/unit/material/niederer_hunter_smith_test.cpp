#include "lv/material/niederer_hunter_smith.hpp"

#include "lv/material/calcium.hpp"

#include "support/packs.hpp"
#include "support/steady_reference.hpp"
#include "support/stiff_ode.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace {

using namespace lv;
using material::Calcium;
using material::NiedererHunterSmith;
using material::Sarcomere;

/// The unscaled cell, T_ref = 56.2 kPa. Reference values "computed independently" are for it, by
/// stiff integration and root searches with tolerances of 1e-10.
NiedererHunterSmith unscaled() {
  NiedererHunterSmith law;
  law.T_scale = 1.0;
  return law;
}

using Course = std::function<double(double t)>;

Course constant(double value) {
  return [value](double) { return value; };
}

Course paper_calcium(Calcium::Mode mode) {
  return [mode](double t) { return Calcium{mode}.at(t); };
}

/// Calcium bound in balance with 0.01 uM, no sites, no memory.
Sarcomere<double> nearly_resting(double stretch) {
  Sarcomere<double> state;
  state.Ca_trpn = 0.348258706;
  state.stretch = stretch;
  return state;
}

/// The state after every step from 0 to the end.
std::vector<Sarcomere<double>> integrate(const NiedererHunterSmith& law, Sarcomere<double> state,
                                         const Course& calcium, const Course& stretch, double end,
                                         double dt) {
  std::vector<Sarcomere<double>> states{state};
  const auto steps = std::lround(end / dt);
  for (long i = 0; i < steps; ++i) {
    const double after = static_cast<double>(i + 1) * dt;
    law.advance(state, stretch(after), calcium(static_cast<double>(i) * dt), calcium(after), dt);
    states.push_back(state);
  }
  return states;
}

/// T over T_0 after an instantaneous step of the stretch from 1.
double tension_after_step(double strain) {
  const NiedererHunterSmith law = unscaled();
  Sarcomere<double> state = law.steady_state(1.0, 1.0);
  law.advance(state, 1.0 + strain, 1.0, 1.0, 1e-10);
  return state.tension / law.isometric_tension(state);
}

/// (A.2)-(A.11) as printed, for y = (Ca_trpn, z, Q1, Q2, Q3), T_ref = 56.2 kPa and a stretch within
/// the guards' limits. Written apart from the library on purpose.
struct PrintedModel {
  Course calcium, stretch, stretch_rate;

  static double z_max(double lambda) {
    const double z3 = 0.85 * 0.85 * 0.85;
    const double K3 = 0.15 * 0.15 * 0.15;
    const double K_1 = 1.75 * 0.85 * 0.85 * 3 * K3 / ((z3 + K3) * (z3 + K3));
    const double K_2 = 1.75 * z3 / (z3 + K3) * (1 - 3 * K3 / (z3 + K3));
    const double binding = 8.0 / std::pow(trpn_50(lambda) / 70.0, 3);
    return (binding - K_2) / (2.0 + K_1 + binding);
  }
  static double trpn_50(double lambda) {
    const double Ca_50 = 1.05 * (1 - 4.0 * (lambda - 1));
    return 70.0 * Ca_50 / (Ca_50 + 200.0 / 100.0 * (1 - (1 + 4.9 * (lambda - 1)) / (2 * 2.0)));
  }
  static double tension(std::span<const double> y, double lambda) {
    const double T_0 = 56.2 * (1 + 4.9 * (lambda - 1)) * y[1] / z_max(lambda);
    const double Q = y[2] + y[3] + y[4];
    return Q < 0 ? T_0 * (0.35 * Q + 1) / (1 - Q) : T_0 * (1 + 2.35 * Q) / (1 + Q);
  }
  void operator()(double t, std::span<const double> y, std::span<double> rate) const {
    const double lambda = stretch(t);
    const double k_off = 200.0 * (1 - tension(y, lambda) / (2.0 * 56.2));
    const double z3 = std::pow(y[1], 3);
    rate[0] = 100.0 * calcium(t) * (70.0 - y[0]) - k_off * y[0];
    rate[1] = 8.0 * std::pow(y[0] / trpn_50(lambda), 3) * (1 - y[1]) - 2.0 * y[1] -
              1.75 * z3 / (z3 + std::pow(0.15, 3));
    rate[2] = -29.0 * stretch_rate(t) - 30.0 * y[2];
    rate[3] = 138.0 * stretch_rate(t) - 130.0 * y[3];
    rate[4] = 129.0 * stretch_rate(t) - 625.0 * y[4];
  }
};

/// A twitch of muscle whose length swings between 0.99 and 1.11 at 2.5 Hz.
const Course swinging_stretch = [](double t) {
  return 1.05 + 0.06 * std::sin(5.0 * std::numbers::pi * t);
};
const Course swinging_rate = [](double t) {
  return 0.06 * 5.0 * std::numbers::pi * std::cos(5.0 * std::numbers::pi * t);
};
constexpr std::array<double, 4> twitch_times{0.1, 0.2, 0.3, 0.5};

/// Tension of the swinging twitch at twitch_times.
std::vector<double> swinging_tension_by_cvode() {
  const PrintedModel model{paper_calcium(Calcium::Mode::transient), swinging_stretch,
                           swinging_rate};
  const auto y = test::solve_stiff_ode(model, {0.348258706, 0, 0, 0, 0}, twitch_times, 1e-11);
  std::vector<double> tension;
  for (std::size_t i = 0; i < y.size(); ++i)
    tension.push_back(PrintedModel::tension(y[i], swinging_stretch(twitch_times[i])));
  return tension;
}

std::vector<double> swinging_tension(double dt) {
  const auto states = integrate(unscaled(), nearly_resting(1.05),
                                paper_calcium(Calcium::Mode::transient), swinging_stretch, 0.5, dt);
  std::vector<double> tension;
  for (const double t : twitch_times)
    tension.push_back(states[std::lround(t / dt)].tension);
  return tension;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

TEST_CASE("binding, sites and overlap follow the stretch (A.5)-(A.9)", "[unit][material]") {
  struct Row {
    double stretch, Ca_trpn_50, z_max, overlap;  ///< computed independently
  };
  constexpr std::array<Row, 5> rows{{{0.80, 34.097938144, 0.947430874460, 1.124},
                                     {0.90, 32.006220840, 0.956308291385, 28.662},
                                     {1.00, 28.823529412, 0.967883800992, 56.200},
                                     {1.10, 23.395225464, 0.982685812084, 83.738},
                                     {1.15, 18.937198068, 0.990776638647, 97.507}}};
  const NiedererHunterSmith law = unscaled();
  for (const Row& row : rows) {  // as many digits as the reference has
    CHECK(law.Ca_trpn_max * law.half_binding(row.stretch) == Approx(row.Ca_trpn_50).epsilon(1e-10));
    CHECK(law.z_max(row.stretch) == Approx(row.z_max).epsilon(1e-11));
    CHECK(law.overlap_tension(row.stretch) == Approx(row.overlap).epsilon(1e-12));
  }
}

TEST_CASE("the steady isometric tension is that of the reference", "[unit][material]") {
  const NiedererHunterSmith law = unscaled();
  for (const auto& row : test::steady_reference)
    for (int i = 0; i < 3; ++i)  // eight digits
      CHECK(law.steady_state(row.Ca, row.stretch[i]).tension ==
            Approx(row.tension[i]).epsilon(3e-8));
}

TEST_CASE("a steady state stays as it is", "[unit][material]") {
  const NiedererHunterSmith law;
  for (const double Ca : {0.01, 0.3, 1.0}) {
    const Sarcomere<double> steady = law.steady_state(Ca, 1.07);
    Sarcomere<double> state = steady;
    for (int i = 0; i < 1000; ++i)
      law.advance(state, 1.07, Ca, Ca, 1e-4);
    // the root search knows z to 2^-50
    CHECK(state.z == Approx(steady.z).epsilon(1e-11));
    CHECK(state.Ca_trpn == Approx(steady.Ca_trpn).epsilon(1e-11));
    CHECK(state.tension == Approx(steady.tension).epsilon(1e-11));
  }
}

TEST_CASE("isometric twitches are those of the reference", "[unit][material]") {
  struct Row {
    double stretch, peak, peak_time;
    std::array<double, 4> tension;  ///< at twitch_times [kPa]; computed independently
  };
  constexpr std::array<Row, 4> rows{
      {{0.9, 5.0813516, 0.1289, {4.7074404, 3.9709426, 2.3336698, 1.1641960}},
       {1.0, 14.0106967, 0.13398, {12.6415412, 11.0615304, 5.7426287, 2.5667118}},
       {1.1, 50.9832598, 0.1631, {39.2773822, 48.2731194, 29.5654697, 7.1344799}},
       {1.15, 95.7892455, 0.1346, {91.3286499, 93.8660507, 77.8763900, 25.9878592}}}};
  constexpr double dt = 1e-5;
  for (const Row& row : rows) {
    INFO("stretch " << row.stretch);
    const auto states =
        integrate(unscaled(), nearly_resting(row.stretch), paper_calcium(Calcium::Mode::transient),
                  constant(row.stretch), 0.5, dt);
    // second order with rates up to 300/s: (300 x 1e-5)^2 = 1e-5
    for (std::size_t i = 0; i < twitch_times.size(); ++i)
      CHECK(states[std::lround(twitch_times[i] / dt)].tension ==
            Approx(row.tension[i]).epsilon(1e-5));
    const auto peak = std::max_element(
        states.begin(), states.end(), [](const auto& a, auto& b) { return a.tension < b.tension; });
    CHECK(peak->tension == Approx(row.peak).epsilon(1e-5));
    // the reference's time has four digits
    CHECK(static_cast<double>(peak - states.begin()) * dt == Approx(row.peak_time).margin(6e-5));
    if (row.stretch == 1.0) {
      CHECK(states[std::lround(0.1 / dt)].z == Approx(0.217714287).epsilon(1e-5));
      CHECK(states[std::lround(0.3 / dt)].z == Approx(0.098900309).epsilon(1e-5));
      CHECK(states[std::lround(0.1 / dt)].Ca_trpn == Approx(23.0989638).epsilon(1e-5));
      CHECK(states[std::lround(0.3 / dt)].Ca_trpn == Approx(3.7446748).epsilon(1e-5));
    }
  }
}

TEST_CASE("tension at held calcium rises as in the reference", "[unit][material]") {
  constexpr double dt = 1e-5;
  const auto states = integrate(unscaled(), nearly_resting(1.0), paper_calcium(Calcium::Mode::hold),
                                constant(1.0), 1.0, dt);
  for (const auto& [t, T] : {std::pair{0.1, 13.3445904},
                             {0.2, 23.8755176},
                             {0.3, 30.5257897},
                             {0.5, 36.6685864},
                             {1.0, 38.8852819}})
    CHECK(states[std::lround(t / dt)].tension == Approx(T).epsilon(1e-5));  // see above
}

TEST_CASE("ramp shortening follows the reference", "[unit][material]") {
  // 1.1 to 0.9 at -0.5/s from 0.1 s on, calcium held at its peak; computed independently
  const Course stretch = [](double t) { return std::clamp(1.1 - 0.5 * (t - 0.1), 0.9, 1.1); };
  constexpr double dt = 1e-5;
  const auto states = integrate(unscaled(), nearly_resting(1.1), paper_calcium(Calcium::Mode::hold),
                                stretch, 1.0, dt);
  for (const auto& [t, T] : {std::pair{0.02, 0.962922172},
                             {0.2, 39.6458055},
                             {0.3, 32.7051815},
                             {0.4, 22.2806616},
                             {0.5, 12.9830562},
                             {0.6, 14.5437653},
                             {0.8, 12.2271485},
                             {1.0, 11.5450699}})
    CHECK(states[std::lround(t / dt)].tension == Approx(T).epsilon(1e-5));
  const Sarcomere<double>& shortening = states[std::lround(0.3 / dt)];
  CHECK(shortening.Q[0] == Approx(0.48213527).epsilon(1e-7));  // integrated exactly
  CHECK(shortening.Q[1] == Approx(-0.530769231).epsilon(1e-7));
  CHECK(shortening.Q[2] == Approx(-0.1032).epsilon(1e-7));
}

TEST_CASE("the fading memory gives the reference's force-velocity curve", "[unit][material]") {
  // T/T_0 at constant rates of the stretch [1/s], Q = (sum A_i/alpha_i) rate; computed
  // independently
  const NiedererHunterSmith law = unscaled();
  for (const auto& [rate, ratio] : {std::pair{-5.0, 0.18862995},
                                    {-2.0, 0.49241078},
                                    {-1.0, 0.68744660},
                                    {-0.5, 0.82326428},
                                    {0.5, 1.17673572},
                                    {1.0, 1.31255340},
                                    {2.0, 1.50758922},
                                    {-9.4836055, 0.0}}) {
    Sarcomere<double> state = law.steady_state(1.0, 1.0);
    for (int i = 0; i < 1000; ++i)  // 1 s is 30 times the longest memory
      law.advance(state, state.stretch, rate, 1.0, 1.0, 1e-3);
    CHECK(law.fading_memory(state.Q[0] + state.Q[1] + state.Q[2]) == Approx(ratio).margin(6e-9));
  }
}

TEST_CASE("a sudden change of length changes the tension as in the reference", "[unit][material]") {
  // T/T_0, computed independently; alpha dt = 6e-8 of it has faded
  CHECK(tension_after_step(-0.01) == Approx(0.04940828).epsilon(1e-6));
  CHECK(tension_after_step(-0.001) == Approx(0.74046850).epsilon(1e-6));
  CHECK(tension_after_step(0.001) == Approx(1.25953150).epsilon(1e-6));
}

TEST_CASE("the instantaneous stiffness is the slope of tension over sudden stretch",
          "[unit][material]") {
  const double slope = (tension_after_step(1e-9) - tension_after_step(-1e-9)) / 2e-9;
  CHECK(unscaled().instantaneous_stiffness() == Approx(1.35 * 238.0));
  CHECK(slope == Approx(unscaled().instantaneous_stiffness()).epsilon(1e-6));
}

TEST_CASE("a rate held for a while leaves the memory that (A.11) says", "[unit][material]") {
  // Q after 0.1/ms for 10 ms: A_i rate (1 - exp(-alpha_i t))/alpha_i, in one step or in ten.
  // Chaste's unit test has -25.057, 77.248, 20.601 from its own time steps.
  const NiedererHunterSmith law = unscaled();
  for (const int steps : {1, 10}) {
    Sarcomere<double> state;
    for (int i = 0; i < steps; ++i)
      law.advance(state, 1.0, 100.0, 0.0, 0.0, 0.01 / steps);
    CHECK(state.Q[0] == Approx(-29.0 * 100.0 * -std::expm1(-0.3) / 30.0));
    CHECK(state.Q[1] == Approx(138.0 * 100.0 * -std::expm1(-1.3) / 130.0));
    CHECK(state.Q[2] == Approx(129.0 * 100.0 * -std::expm1(-6.25) / 625.0));
    CHECK(state.Q[1] == Approx(77.248).epsilon(5e-4));
  }
}

TEST_CASE("all tensions scale exactly by T_scale", "[unit][material]") {
  NiedererHunterSmith strong = unscaled();
  strong.T_scale = 4.0;  // a power of two: not even rounding differs
  const auto course = [](const NiedererHunterSmith& law) {
    return integrate(law, nearly_resting(1.05), paper_calcium(Calcium::Mode::transient),
                     swinging_stretch, 0.3, 1e-4);
  };
  const auto weak_states = course(unscaled());
  const auto strong_states = course(strong);
  for (std::size_t i = 0; i < weak_states.size(); ++i) {
    CHECK(strong_states[i].tension == 4.0 * weak_states[i].tension);
    CHECK(strong_states[i].z == weak_states[i].z);
    CHECK(strong_states[i].Ca_trpn == weak_states[i].Ca_trpn);
  }
  CHECK(strong.steady_state(1.0, 1.0).tension ==
        Approx(4.0 * unscaled().steady_state(1.0, 1.0).tension).epsilon(1e-13));
}

TEST_CASE("a twitch at changing length agrees with CVODE", "[unit][material]") {
  const auto exact = swinging_tension_by_cvode();
  // second order, see the isometric twitch: 1e-5 of 40 kPa
  CHECK(largest_difference(swinging_tension(1e-5), exact) < 4e-4);
}

TEST_CASE("the integration is of second order in time", "[unit][material]") {
  const auto exact = swinging_tension_by_cvode();
  double coarse = largest_difference(swinging_tension(8e-4), exact);
  for (const double dt : {4e-4, 2e-4, 1e-4}) {
    const double fine = largest_difference(swinging_tension(dt), exact);
    CHECK(coarse / fine > 3.5);
    CHECK(coarse / fine < 4.6);
    coarse = fine;
  }
}

TEST_CASE("the stretch is limited to [0.8, 1.15] in binding and overlap", "[unit][material]") {
  const NiedererHunterSmith law;
  for (const auto& [beyond, limit] : {std::pair{1.3, 1.15}, {0.5, 0.8}}) {
    CHECK(law.half_binding(beyond) == law.half_binding(limit));
    CHECK(law.z_max(beyond) == law.z_max(limit));
    CHECK(law.overlap_tension(beyond) == law.overlap_tension(limit));
    CHECK(law.steady_state(1.0, beyond).tension == law.steady_state(1.0, limit).tension);
  }
  CHECK(law.overlap_tension(1.1499) < law.overlap_tension(1.15));
  CHECK(law.overlap_tension(0.8001) > law.overlap_tension(0.8));
  // 536 kPa for T_ref = 309.1 kPa (the paper's discussion)
  NiedererHunterSmith patient;
  patient.T_scale = 5.5;
  CHECK(patient.overlap_tension(2.0) == Approx(536.0).epsilon(1e-3));
}

TEST_CASE("however fast muscle shortens its tension is never negative", "[unit][material]") {
  const NiedererHunterSmith law;
  Sarcomere<double> state = law.steady_state(1.0, 1.1);
  bool slack = false;
  for (int i = 0; i < 100; ++i) {
    law.advance(state, state.stretch - 0.002, 1.0, 1.0, 1e-4);  // 20/s
    CHECK(state.tension >= 0.0);
    slack = slack || state.tension == 0.0;
  }
  CHECK(slack);
}

TEST_CASE("however fast muscle lengthens no more calcium is bound than there is room for",
          "[unit][material]") {
  const auto most_bound = [](const NiedererHunterSmith& law) {
    Sarcomere<double> state = law.steady_state(10.0, 1.0);
    double most = 0.0;
    for (int i = 0; i < 1000; ++i) {
      law.advance(state, 1.15, 20.0, 10.0, 10.0, 1e-4);  // 20/s at a limited length
      most = std::max(most, state.Ca_trpn);
    }
    return most;
  };
  NiedererHunterSmith unguarded;
  unguarded.unbinding_min = -100.0;
  CHECK(most_bound(unguarded) > 70.0);  // (A.3) alone lets unbinding become binding
  CHECK(most_bound(NiedererHunterSmith{}) < 70.0);
}

TEST_CASE("packs advance like single cells, each lane with its own stretch", "[unit][material]") {
  const NiedererHunterSmith law;
  const auto stretch = [](int i) { return 0.85 + 0.04 * i; };
  Sarcomere<Pack> pack;
  std::vector<Sarcomere<double>> single(pack_size);
  for (int step = 1; step <= 200; ++step) {
    const double swing = 1.0 + 0.02 * std::sin(0.1 * step);
    law.advance(pack, test::packed([&](int i) { return swing * stretch(i); }), 0.8, 0.9, 1e-4);
    for (int i = 0; i < pack_size; ++i)
      law.advance(single[i], swing * stretch(i), 0.8, 0.9, 1e-4);
  }
  for (int i = 0; i < pack_size; ++i) {
    // rounding of fused multiply-adds over 200 steps
    CHECK(pack.tension.get(i) == Approx(single[i].tension).epsilon(1e-11));
    CHECK(pack.Ca_trpn.get(i) == Approx(single[i].Ca_trpn).epsilon(1e-11));
    CHECK(pack.Q[1].get(i) == Approx(single[i].Q[1]).epsilon(1e-11));
  }
}

TEST_CASE("muscle without strength binds calcium and pulls not at all", "[unit][material]") {
  NiedererHunterSmith law;
  law.T_scale = 0.0;
  auto state = law.steady_state(1.0, 1.05);
  CHECK(state.tension == 0.0);
  CHECK(state.z > 0.5);
  law.advance(state, 1.1, 1.0, 1.0, 1e-4);
  CHECK(state.tension == 0.0);
  CHECK(std::isfinite(state.Ca_trpn));
}
