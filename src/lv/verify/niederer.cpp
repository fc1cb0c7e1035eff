#include "lv/material/calcium.hpp"
#include "lv/material/niederer_hunter_smith.hpp"
#include "lv/verify/problems.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

/// Reference values: the equations of Niederer, Hunter & Smith 2006 (the paper's Appendix A) with
/// T_ref = 56.2 kPa, solved by an independent program with stiff and Runge-Kutta integrators at
/// tolerance 1e-10. They agree with the CellML model and Chaste's equation by equation.
namespace lv::verify {
namespace {

using material::Calcium;
using material::NiedererHunterSmith;
using material::Sarcomere;

constexpr double step_cost = 1e-3;     ///< what a time step of 1e-4 s may cost at most
constexpr double longest_step = 1e-4;  ///< the engine's longest step [s]

NiedererHunterSmith unscaled() {
  NiedererHunterSmith law;
  law.T_scale = 1.0;
  return law;
}

/// A muscle at balance with calcium of 0.01 uM, before any site is open.
Sarcomere<double> resting(double stretch) {
  Sarcomere<double> state;
  state.Ca_trpn = 0.348258706;
  state.stretch = stretch;
  return state;
}

/// Tension of a twitch at constant stretch, from the beginning to a time.
struct Twitch {
  Twitch(Calcium::Mode mode, double fibre_stretch, double time_step = longest_step)
      : calcium{mode}, stretch(fibre_stretch), step(time_step), state(resting(fibre_stretch)) {}

  void go_to(double end) {
    while (steps * step < end - 0.5 * step) {
      const double t = steps * step;
      law.advance(state, stretch, calcium.at(t), calcium.at(t + step), step);
      ++steps;
      if (state.tension > peak) {
        peak = state.tension;
        peak_time = steps * step;
      }
    }
  }

  NiedererHunterSmith law = unscaled();
  Calcium calcium;
  double stretch, step;
  Sarcomere<double> state;
  int steps = 0;
  double peak = 0.0;
  double peak_time = 0.0;
};

void check_constants(Findings& found) {
  struct Row {
    double stretch, Ca_trpn50, z_max, overlap;
  };
  constexpr std::array<Row, 5> rows{{{0.80, 34.097938144, 0.947430874460, 1.124},
                                     {0.90, 32.006220840, 0.956308291385, 28.662},
                                     {1.00, 28.823529412, 0.967883800992, 56.2},
                                     {1.10, 23.395225464, 0.982685812084, 83.738},
                                     {1.15, 18.937198068, 0.990776638647, 97.507}}};
  const NiedererHunterSmith law = unscaled();
  for (const Row& r : rows) {
    found.add_within(fmt::format("half-binding Ca_trpn at stretch {}", r.stretch),
                     law.Ca_trpn_max * law.half_binding(r.stretch), r.Ca_trpn50, 1e-9, "uM");
    found.add_within(fmt::format("z_max at stretch {}", r.stretch), law.z_max(r.stretch), r.z_max,
                     1e-9);
    found.add_within(fmt::format("overlap tension at stretch {}", r.stretch),
                     law.overlap_tension(r.stretch), r.overlap, 1e-9, "kPa");
  }
}

}  // namespace

void niederer_steady(Findings& found) {
  check_constants(found);
  constexpr std::array<double, 5> stretches{0.8, 0.9, 1.0, 1.1, 1.15};
  struct Row {
    double Ca;
    std::array<double, 5> T;
  };
  constexpr std::array<Row, 8> rows{
      {{0.1, {0.004401672812, 0.1345766056, 0.3567841744, 0.9667921538, 2.000234527}},
       {0.3, {0.05583388193, 1.601217316, 3.760157439, 7.913680628, 13.9458349}},
       {0.5, {0.1082859082, 3.107361707, 7.504146614, 27.29140791, 94.49989239}},
       {0.8, {0.1982430828, 6.446655782, 25.27908505, 77.20484437, 96.14115756}},
       {1.0, {0.2956065742, 11.17093452, 38.9519243, 79.49406644, 96.50998308}},
       {1.5, {0.6001069136, 19.8707874, 48.69334432, 81.50342088, 96.91466086}},
       {3.0, {0.9270414694, 25.67561792, 53.60306326, 82.83224357, 97.24159627}},
       {10.0, {1.081281098, 28.00362145, 55.59034098, 83.50159152, 97.43324928}}}};
  const NiedererHunterSmith law = unscaled();
  for (const Row& r : rows)
    for (std::size_t i = 0; i < stretches.size(); ++i)
      found.add_within(fmt::format("T at {} uM, stretch {}", r.Ca, stretches[i]),
                       law.steady_state(r.Ca, stretches[i]).tension, r.T[i], step_cost, "kPa");
  // the steady state is where time integration ends
  Twitch held(Calcium::Mode::hold, 1.0);
  held.go_to(5.0);
  found.add_within("T after 5 s at 1 uM, stretch 1", held.state.tension, 38.9519243, step_cost,
                   "kPa");
}

void niederer_twitch(Findings& found) {
  struct Row {
    double stretch, peak, peak_time;
    std::array<double, 4> T;  // at 0.1, 0.2, 0.3, 0.5 s
  };
  constexpr std::array<double, 4> times{0.1, 0.2, 0.3, 0.5};
  constexpr std::array<Row, 4> rows{
      {{0.9, 5.0813516, 0.1289, {4.7074404, 3.9709426, 2.3336698, 1.1641960}},
       {1.0, 14.0106967, 0.13398, {12.6415412, 11.0615304, 5.7426287, 2.5667118}},
       {1.1, 50.9832598, 0.1631, {39.2773822, 48.2731194, 29.5654697, 7.1344799}},
       {1.15, 95.7892455, 0.1346, {91.3286499, 93.8660507, 77.8763900, 25.9878592}}}};
  for (const Row& r : rows) {
    Twitch twitch(Calcium::Mode::transient, r.stretch);
    for (std::size_t i = 0; i < times.size(); ++i) {
      twitch.go_to(times[i]);
      found.add_within(fmt::format("T at stretch {}, {} s", r.stretch, times[i]),
                       twitch.state.tension, r.T[i], step_cost, "kPa");
    }
    found.add_within(fmt::format("peak T at stretch {}", r.stretch), twitch.peak, r.peak, step_cost,
                     "kPa");
    // to the step and the last printed digit
    found.add(fmt::format("time of the peak at stretch {}", r.stretch), twitch.peak_time,
              r.peak_time, 1.5 * longest_step, "s");
  }

  constexpr std::array<double, 5> hold_times{0.1, 0.2, 0.3, 0.5, 1.0};
  constexpr std::array<double, 5> hold{13.3445904, 23.8755176, 30.5257897, 36.6685864, 38.8852819};
  Twitch held(Calcium::Mode::hold, 1.0);
  for (std::size_t i = 0; i < hold.size(); ++i) {
    held.go_to(hold_times[i]);
    found.add_within(fmt::format("T with calcium held, {} s", hold_times[i]), held.state.tension,
                     hold[i], step_cost, "kPa");
  }

  const auto tension_with_step = [](double step) {
    Twitch twitch(Calcium::Mode::transient, 1.0, step);
    twitch.go_to(0.1);
    return twitch.state.tension;
  };
  const double T1 = tension_with_step(4e-4);
  const double T2 = tension_with_step(2e-4);
  const double T4 = tension_with_step(1e-4);
  found.add("order in time", std::log2(std::abs((T1 - T2) / (T2 - T4))), 2.0, 0.1);
}

namespace {

/// T/T_0 after a stretch rate has acted for a second, long enough for all of the memory (its
/// slowest part fades in 1/30 s).
double steady_ratio(double rate) {
  const NiedererHunterSmith law = unscaled();
  Sarcomere<double> state = law.steady_state(1.0, 1.0);
  for (int i = 0; i < 10000; ++i)
    law.advance(state, 1.0, rate, 1.0, 1.0, longest_step);
  return state.tension / law.isometric_tension(state);
}

/// T/T_0 right after a change of length too fast for the memory to fade.
Sarcomere<double> after_sudden(double change) {
  const NiedererHunterSmith law = unscaled();
  Sarcomere<double> state = law.steady_state(1.0, 1.0);
  law.advance(state, 1.0 + change, 1.0, 1.0, 1e-10);
  return state;
}

void check_ramp(Findings& found) {
  struct Row {
    double time, Ca_trpn, z, Q1, T;
  };
  constexpr std::array<Row, 9> rows{{{0.2, 30.49856, 0.691159837, 0.459269584, 39.6458055},
                                     {0.3, 29.0382579, 0.685185941, 0.48213527, 32.7051815},
                                     {0.4, 26.9588283, 0.613453051, 0.483273685, 22.2806616},
                                     {0.5, 25.3297331, 0.526175582, 0.483330364, 12.9830562},
                                     {0.6, 25.5541556, 0.470333632, 0.0240636019, 14.5437653},
                                     {0.7, 25.2816581, 0.43162146, 0.00119805619, 12.9572432},
                                     {0.8, 25.1610498, 0.407926245, 5.96477055e-05, 12.2271485},
                                     {0.9, 25.091175, 0.39370203, 2.96968439e-06, 11.7998902},
                                     {1.0, 25.0496927, 0.385201446, 1.4785188e-07, 11.5450699}}};
  const auto stretch = [](double t) { return 1.1 - 0.5 * std::clamp(t - 0.1, 0.0, 0.4); };
  const NiedererHunterSmith law = unscaled();
  const Calcium calcium;
  Sarcomere<double> state = resting(1.1);
  int step = 0;
  for (const Row& r : rows) {
    for (; step * longest_step < r.time - 0.5 * longest_step; ++step)
      law.advance(state, stretch((step + 1) * longest_step), calcium.at(step * longest_step),
                  calcium.at((step + 1) * longest_step), longest_step);
    found.add_within(fmt::format("shortening 1.1 to 0.9: Ca_trpn at {} s", r.time), state.Ca_trpn,
                     r.Ca_trpn, step_cost, "uM");
    found.add_within(fmt::format("shortening 1.1 to 0.9: z at {} s", r.time), state.z, r.z,
                     step_cost);
    found.add_within(fmt::format("shortening 1.1 to 0.9: Q_1 at {} s", r.time), state.Q[0], r.Q1,
                     step_cost);
    found.add_within(fmt::format("shortening 1.1 to 0.9: T at {} s", r.time), state.tension, r.T,
                     step_cost, "kPa");
  }
}

}  // namespace

void niederer_release(Findings& found) {
  check_ramp(found);
  struct Pair {
    double change, ratio;
  };
  constexpr std::array<Pair, 7> rates{{{-5, 0.18862995},
                                       {-2, 0.49241078},
                                       {-1, 0.68744660},
                                       {-0.5, 0.82326428},
                                       {0.5, 1.17673572},
                                       {1, 1.31255340},
                                       {2, 1.50758922}}};
  for (const Pair& p : rates)
    found.add_within(fmt::format("T/T_0 at {} /s", p.change), steady_ratio(p.change), p.ratio,
                     step_cost);
  double slow = -9.0;
  double fast = -10.0;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (slow + fast);
    (steady_ratio(middle) > 0.0 ? slow : fast) = middle;
  }
  found.add_within("shortening without tension", slow, -9.4836055, step_cost, "1/s");

  constexpr std::array<Pair, 3> jumps{
      {{-0.01, 0.04940828}, {-0.001, 0.74046850}, {0.001, 1.25953150}}};
  const NiedererHunterSmith law = unscaled();
  for (const Pair& p : jumps) {
    const Sarcomere<double> state = after_sudden(p.change);
    found.add_within(fmt::format("T/T_0 right after {} %", 100 * p.change),
                     state.tension / law.isometric_tension(state), p.ratio, step_cost);
  }

  Sarcomere<double> lengthened;  // Chaste's unit test: 0.1 per ms for 10 ms
  for (int i = 0; i < 100; ++i)
    law.advance(lengthened, 1.0 + (i + 1) * 100.0 * longest_step, 0.01, 0.01, longest_step);
  constexpr std::array<double, 3> Q{-25.057, 77.248, 20.601};
  for (int i = 0; i < 3; ++i)
    found.add_within(fmt::format("Q_{} after 10 ms at 100 /s", i + 1), lengthened.Q[i], Q[i],
                     step_cost);
}

}  // namespace lv::verify
