#include "lv/material/land2017.hpp"

#include "lv/material/calcium.hpp"
#include "lv/verify/problems.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

/// Reference values: the equations of Land et al. 2017 with its whole-organ constants, solved by an
/// independent program with a stiff integrator at tolerance 1e-10.
namespace lv::verify {
namespace {

using material::Calcium;
using material::Land2017;
using State = material::CrossBridges<double>;

constexpr double fraction = 1e-3;  ///< what a time step of 1e-4 s may cost at most
constexpr double dt = 1e-4;        ///< the immersed engine's longest step [s]

/// A time or calcium, and the tension at several stretches or rates [kPa].
template <std::size_t N>
struct TensionRow {
  double at;
  std::array<double, N> T;
};

constexpr std::array<double, 5> stretches{0.9, 1.0, 1.1, 1.15, 1.2};

constexpr std::array<TensionRow<5>, 10> steady{
    {{0.1, {0.00137989692, 0.00650446376, 0.045173234, 0.155544887, 0.7307173}},
     {0.2, {0.0412712533, 0.18591186, 1.15364435, 4.0161239, 40.1919949}},
     {0.3, {0.280576059, 1.17488835, 13.1692256, 58.4125104, 139.620579}},
     {0.4, {1.01577719, 6.57426641, 65.1364754, 124.666857, 164.316555}},
     {0.5, {3.78498453, 28.9777799, 111.698828, 147.117155, 169.999452}},
     {0.6, {13.9860519, 63.0241212, 131.133218, 154.154757, 171.931381}},
     {0.8, {52.4270315, 102.266474, 141.960878, 158.201576, 173.246973}},
     {1.0, {76.3344636, 112.797883, 144.566101, 159.334715, 173.692833}},
     {2.0, {90.8055702, 118.67944, 146.470672, 160.327804, 174.15797}},
     {10.0, {91.8904403, 119.352562, 146.816506, 160.548388, 174.279805}}}};

constexpr Calcium transient_a{.mode = Calcium::Mode::transient,
                              .Ca_0 = 0.1,
                              .Ca_max = 0.7,
                              .shape = Calcium::CurveShape::double_exponential,
                              .t_1 = 0.04,
                              .t_2 = 0.22};
constexpr Calcium transient_b{.mode = Calcium::Mode::transient,
                              .Ca_0 = 0.1,
                              .Ca_max = 0.6,
                              .shape = Calcium::CurveShape::double_exponential,
                              .t_1 = 0.02,
                              .t_2 = 0.11};

constexpr std::array<TensionRow<5>, 10> twitch_a{
    {{0.02, {0.0102849197, 0.0465070533, 0.361976609, 1.59851892, 7.63434089}},
     {0.04, {0.363199255, 2.54446463, 17.4884584, 36.6259987, 61.4897541}},
     {0.06, {3.14206757, 16.917688, 56.3871889, 80.7831976, 103.96716}},
     {0.1, {15.9937741, 55.3020211, 106.466378, 127.84015, 146.735025}},
     {0.15, {22.8567999, 73.3972831, 127.509221, 147.652884, 164.861965}},
     {0.2, {17.1797747, 65.0846528, 128.36906, 151.419565, 169.557603}},
     {0.3, {4.6628075, 24.1449837, 91.9107101, 136.007599, 166.595473}},
     {0.4, {1.1241839, 5.53270331, 33.9650945, 82.8072173, 146.812403}},
     {0.6, {0.0742174438, 0.34492276, 2.15380185, 7.36812846, 40.5549867}},
     {0.8, {0.00925014567, 0.0428977973, 0.281571519, 0.930998445, 4.63631431}}}};

constexpr std::array<TensionRow<5>, 10> twitch_b{
    {{0.02, {0.028382043, 0.131425753, 1.33420377, 4.75269974, 15.0560922}},
     {0.04, {0.898632071, 6.00153721, 29.6120114, 50.2822294, 71.9982815}},
     {0.06, {3.75340083, 21.104394, 66.0169056, 89.6535164, 110.391612}},
     {0.1, {5.90714685, 34.6282326, 99.3485977, 126.792748, 147.751237}},
     {0.15, {3.28285883, 20.744258, 83.6763991, 126.349679, 158.721715}},
     {0.2, {1.54046722, 9.30267422, 44.0068305, 86.9371805, 143.946008}},
     {0.3, {0.297218534, 1.73166361, 8.41854326, 19.234994, 55.7067249}},
     {0.4, {0.0562519732, 0.320188577, 1.60686898, 3.85390336, 12.4074477}},
     {0.6, {0.00356097264, 0.0183129301, 0.109218562, 0.326484789, 1.35054743}},
     {0.8, {0.00152792745, 0.0072424973, 0.0497391853, 0.169653437, 0.789576375}}}};

/// From the steady state at 0.6 uM and a stretch of 1.1, at these rates.
constexpr std::array<double, 7> rates{-5.0, -2.0, -1.0, -0.5, 0.5, 1.0, 2.0};

constexpr std::array<TensionRow<7>, 7> ramps{
    {{0.002, {103.526403, 119.856397, 125.455148, 128.284207, 133.967915, 136.801919, 142.46788}},
     {0.01, {51.2065626, 96.2316358, 113.153517, 122.006909, 139.697237, 148.289271, 165.565162}},
     {0.02, {17.8991495, 78.0626698, 103.177396, 116.787689, 143.872579, 156.807456, 183.249682}},
     {0.03, {1.66637523, 65.3125341, 95.6226089, 112.706931, 146.999109, 163.250134, 196.76898}},
     {0.04, {-4.75384664, 55.8869366, 89.5380232, 109.318278, 149.596789, 168.611634, 207.894748}},
     {0.05, {-5.82025849, 48.5037429, 84.3454849, 106.353999, 151.922338, 173.375889, 217.518411}},
     {0.06, {-3.98189963, 42.3595547, 79.673344, 103.641065, 154.117986, 177.806095, 219.180192}}}};

/// Isometric from rest to a time, in steps of a length.
State twitch(const Calcium& calcium, double stretch, double end, double step) {
  const Land2017 law;
  State state = law.steady_state(calcium.Ca_0, stretch);
  const long steps = std::lround(end / step);
  for (long i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) * step;
    law.advance(state, stretch, calcium.at(t), calcium.at(t + step), step);
  }
  return state;
}

template <std::size_t N>
void check_twitches(Findings& found, const std::string& name, const Calcium& calcium,
                    const std::array<TensionRow<5>, N>& rows) {
  for (const TensionRow<5>& row : rows)
    for (std::size_t i = 0; i < stretches.size(); ++i)
      found.add_within(fmt::format("calcium {}: T at stretch {}, {} s", name, stretches[i], row.at),
                       twitch(calcium, stretches[i], row.at, dt).tension, row.T[i], fraction,
                       "kPa");
}

/// The tension after a ramp of a duration in equal steps.
double after_ramp(double rate, double duration, int steps) {
  const Land2017 law;
  State state = law.steady_state(0.6, 1.1);
  for (int i = 1; i <= steps; ++i)
    law.advance(state, 1.1 + rate * duration * i / steps, 0.6, 0.6, duration / steps);
  return state.tension;
}

}  // namespace

void land2017_steady(Findings& found) {
  const Land2017 law;
  for (const TensionRow<5>& row : steady)
    for (std::size_t i = 0; i < stretches.size(); ++i)
      found.add_within(fmt::format("T at {} uM, stretch {}", row.at, stretches[i]),
                       law.steady_state(row.at, stretches[i]).tension, row.T[i], fraction, "kPa");
  // the steady state is where time integration ends
  State held = law.steady_state(0.1, 1.1);
  for (int i = 0; i < 50'000; ++i)
    law.advance(held, 1.1, 0.6, 0.6, dt);
  found.add_within("T after 5 s at 0.6 uM, stretch 1.1", held.tension, 131.133218, fraction, "kPa");
}

void land2017_twitch(Findings& found) {
  check_twitches(found, "a", transient_a, twitch_a);
  check_twitches(found, "b", transient_b, twitch_b);
  const auto tension = [](double step) { return twitch(transient_a, 1.0, 0.1, step).tension; };
  const double T1 = tension(4e-4);
  const double T2 = tension(2e-4);
  const double T4 = tension(1e-4);
  found.add("order in time", std::log2(std::abs((T1 - T2) / (T2 - T4))), 2.0, 0.1);
  // stable in the steps of an implicit engine, which meet the sudden rise of calcium less
  // well
  found.add_within("T with steps of 4 ms, stretch 1, 0.2 s",
                   twitch(transient_a, 1.0, 0.2, 4e-3).tension, 65.0846528, 5e-3, "kPa");
}

void land2017_ramp(Findings& found) {
  for (const TensionRow<7>& row : ramps)
    for (std::size_t i = 0; i < rates.size(); ++i)
      found.add_within(fmt::format("T at {} /s after {} s", rates[i], row.at),
                       after_ramp(rates[i], row.at, static_cast<int>(std::lround(row.at / dt))),
                       row.T[i], fraction, "kPa");
  struct Jump {
    double change, ratio;  // of the stretch, of the tension
  };
  constexpr std::array<Jump, 4> jumps{
      {{-0.01, 0.7100873984}, {-0.001, 0.9704996545}, {0.001, 1.0296134756}, {0.01, 1.3012256098}}};
  for (const Jump& jump : jumps) {
    constexpr double instant = 1e-10;  // [s]
    found.add_within(
        fmt::format("T/T_0 right after {} %", 100 * jump.change),
        after_ramp(1.1 * jump.change / instant, instant, 1) / after_ramp(0.0, instant, 1),
        jump.ratio, fraction);
  }
}

}  // namespace lv::verify
