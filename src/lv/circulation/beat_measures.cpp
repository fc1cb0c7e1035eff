#include "lv/circulation/beat_measures.hpp"

#include "lv/base/periodic.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lv::circulation {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

using Beat = std::span<const Sample>;
using Value = double Signals::*;

/// Where a signal changes its sign for the first time after a time: the sample before it and the
/// share of the way to the next; upwards or downwards.
struct Crossing {
  std::size_t before = 0;
  double share = 0.0;
  bool found = false;

  [[nodiscard]] double of(Beat beat, Value value) const {
    return found ? std::lerp(beat[before].signals.*value, beat[before + 1].signals.*value, share)
                 : none;
  }
  [[nodiscard]] double time(Beat beat) const {
    return found ? std::lerp(beat[before].time, beat[before + 1].time, share) - beat[0].time : none;
  }
};

Crossing crossing(Beat beat, Value value, bool upwards, std::size_t from = 0) {
  for (std::size_t i = from; i + 1 < beat.size(); ++i) {
    const double a = beat[i].signals.*value;
    const double b = beat[i + 1].signals.*value;
    if (upwards ? a <= 0.0 && b > 0.0 : a >= 0.0 && b < 0.0)
      return {i, a / (a - b), true};
  }
  return {};
}

double largest(Beat beat, Value value) {
  double result = -std::numeric_limits<double>::infinity();
  for (const Sample& s : beat)
    result = std::max(result, s.signals.*value);
  return result;
}

double least(Beat beat, Value value) {
  double result = std::numeric_limits<double>::infinity();
  for (const Sample& s : beat)
    result = std::min(result, s.signals.*value);
  return result;
}

double mean(Beat beat, Value value) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < beat.size(); ++i)
    sum += 0.5 * (beat[i].signals.*value + beat[i + 1].signals.*value) *
           (beat[i + 1].time - beat[i].time);
  return sum / (beat.back().time - beat.front().time);
}

double work(Beat beat) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < beat.size(); ++i)
    sum -= 0.5 * (beat[i].signals.pressure + beat[i + 1].signals.pressure) *
           (beat[i + 1].signals.volume - beat[i].signals.volume);
  return sum;
}

/// Inflow between two times of a beat that repeats: its volume and its greatest.
struct Inflow {
  double volume = none, flow = none;
};

Inflow inflow(Beat beat, double from, double to) {
  const double period = beat.back().time - beat.front().time;
  const auto since = [&](double t) { return time_in_period(t - from, period); };
  Inflow in;
  if (!std::isfinite(from) || !std::isfinite(to))
    return in;
  in = {0.0, 0.0};
  for (std::size_t i = 0; i + 1 < beat.size(); ++i) {
    const double middle = 0.5 * (beat[i].time + beat[i + 1].time) - beat.front().time;
    if (since(middle) > since(to))
      continue;
    const double flow =
        std::max(0.0, 0.5 * (beat[i].signals.mitral_flow + beat[i + 1].signals.mitral_flow));
    in.volume += flow * (beat[i + 1].time - beat[i].time);
    in.flow = std::max(in.flow, flow);
  }
  return in;
}

double rate(Beat beat, std::size_t i) {
  return (beat[i + 1].signals.pressure - beat[i].signals.pressure) /
         (beat[i + 1].time - beat[i].time);
}

/// When the pressure falls fastest, after the beat's beginning: where a parabola through the rates
/// of three steps, the steepest between the others, has its least [s].
double fastest_fall(Beat beat, std::size_t step) {
  const auto middle = [&](std::size_t i) { return std::midpoint(beat[i].time, beat[i + 1].time); };
  double t = middle(step) - beat[0].time;
  if (step == 0 || step + 2 >= beat.size())
    return t;
  const double before = middle(step) - middle(step - 1);
  const double after = middle(step + 1) - middle(step);
  const double fall = (rate(beat, step) - rate(beat, step - 1)) / before;
  const double rise = (rate(beat, step + 1) - rate(beat, step)) / after;
  if (rise > fall)
    t -= (fall * after + rise * before) / (2.0 * (rise - fall));
  return t;
}

/// Least squares of log p, linear between samples, against time between two times after the beat's
/// beginning: sums would jump where a sample passes an end.
double relaxation(Beat beat, double from, double to) {
  if (!(to > from))
    return none;
  double n = 0.0;
  double t1 = 0.0;
  double t2 = 0.0;
  double y1 = 0.0;
  double ty = 0.0;
  const auto add = [&](double weight, double t, double y) {
    n += weight;
    t1 += weight * t;
    t2 += weight * t * t;
    y1 += weight * y;
    ty += weight * t * y;
  };
  for (std::size_t i = 0; i + 1 < beat.size(); ++i) {
    const double t = beat[i].time - beat[0].time - from;
    const double step = beat[i + 1].time - beat[i].time;
    const double begin = std::max(t, 0.0);
    const double end = std::min(t + step, to - from);
    if (end <= begin)
      continue;
    const double p = beat[i].signals.pressure;
    const double next = beat[i + 1].signals.pressure;
    if (!(p > 0.0 && next > 0.0))
      return none;
    for (const auto& [share, weight] : {std::pair{0.0, 1.0}, {0.5, 4.0}, {1.0, 1.0}}) {
      const double at = std::lerp(begin, end, share);  // Simpson's rule, exact for parabolas
      add(weight * (end - begin), at, std::lerp(std::log(p), std::log(next), (at - t) / step));
    }
  }
  const double slope = (n * ty - t1 * y1) / (n * t2 - t1 * t1);
  return slope < 0.0 ? -1.0 / slope : none;
}

/// Whether the aortic valve that is open as the beat begins is so until ejection is over: then the
/// ejection that ends with its closing is the beat's, and a later opening the next beat's.
bool begins_in_ejection(Beat beat, const Crossing& closes) {
  return closes.found && beat.front().signals.aortic_gradient > 0.0 &&
         least(beat.first(closes.before + 1), &Signals::mitral_gradient) < 0.0;
}

/// From the closing of one valve to the opening of the other; none where that opens before this
/// one has closed [s].
double isovolumic(Beat beat, double closes, const Crossing& opens, Value closed_gradient) {
  return opens.of(beat, closed_gradient) < 0.0 ? opens.time(beat) - closes : none;
}

/// The last closing of the mitral valve before ejection: in a closed loop it may close and open
/// again before the atrium contracts. A beat that begins with a closed one, which does not open
/// again, begins with that.
Crossing end_diastole(Beat beat, const Crossing& aortic_opens) {
  Crossing closes = crossing(beat, &Signals::mitral_gradient, false);
  for (Crossing next = closes;
       aortic_opens.found && next.found && next.before <= aortic_opens.before;
       next = crossing(beat, &Signals::mitral_gradient, false, next.before + 1))
    closes = next;
  const bool is_late = !closes.found || (aortic_opens.found && closes.before > aortic_opens.before);
  if (is_late && beat.front().signals.mitral_gradient < 0.0)
    return {0, 0.0, true};
  return closes;
}

/// When the mitral valve closed that is closed as the beat begins: before it, as at the end of a
/// beat that repeats [s]; not a number where it does not close there.
double closed_before(Beat beat, const Crossing& opens) {
  Crossing last;
  for (Crossing next = crossing(beat, &Signals::mitral_gradient, false, opens.before); next.found;
       next = crossing(beat, &Signals::mitral_gradient, false, next.before + 1))
    last = next;
  return last.time(beat) - (beat.back().time - beat.front().time);
}

}  // namespace

BeatMeasures measure_beat(Beat beat, double atrium) {
  const Crossing first_closing = crossing(beat, &Signals::aortic_gradient, false);
  const bool in_ejection = begins_in_ejection(beat, first_closing);
  const Crossing aortic_opens =
      in_ejection ? Crossing{} : crossing(beat, &Signals::aortic_gradient, true);
  const Crossing mitral_closes = end_diastole(beat, aortic_opens);
  const Crossing aortic_closes =
      in_ejection ? first_closing
                  : crossing(beat, &Signals::aortic_gradient, false, aortic_opens.before);
  const Crossing mitral_opens = crossing(beat, &Signals::mitral_gradient, true,
                                         aortic_closes.found ? aortic_opens.before : 0);
  std::size_t fastest_rise = 0;
  std::size_t steepest_fall = 0;
  for (std::size_t i = 0; i + 1 < beat.size(); ++i) {
    fastest_rise = rate(beat, i) > rate(beat, fastest_rise) ? i : fastest_rise;
    steepest_fall = rate(beat, i) < rate(beat, steepest_fall) ? i : steepest_fall;
  }
  BeatMeasures m{};
  m.end_diastolic_volume = mitral_closes.of(beat, &Signals::volume);
  m.end_systolic_volume = aortic_closes.of(beat, &Signals::volume);
  m.stroke_volume = m.end_diastolic_volume - m.end_systolic_volume;
  m.ejection_fraction = m.stroke_volume / m.end_diastolic_volume;
  m.end_diastolic_pressure = mitral_closes.of(beat, &Signals::pressure);
  m.end_systolic_pressure = aortic_closes.of(beat, &Signals::pressure);
  m.peak_pressure = largest(beat, &Signals::pressure);
  m.aortic_systolic = largest(beat, &Signals::aortic_pressure);
  m.aortic_diastolic = least(beat, &Signals::aortic_pressure);
  m.aortic_mean = mean(beat, &Signals::aortic_pressure);
  m.stroke_work = work(beat);
  m.largest_pressure_rate = rate(beat, fastest_rise);
  m.least_pressure_rate = rate(beat, steepest_fall);
  const bool begins_closed =
      mitral_closes.before == 0 && beat.front().signals.mitral_gradient < 0.0;
  m.mitral_closes = begins_closed ? closed_before(beat, mitral_opens) : mitral_closes.time(beat);
  m.aortic_opens = aortic_opens.time(beat);
  m.aortic_closes = aortic_closes.time(beat);
  m.mitral_opens = mitral_opens.time(beat);
  m.isovolumic_contraction =
      isovolumic(beat, m.mitral_closes, aortic_opens, &Signals::mitral_gradient);
  m.ejection_time = m.aortic_closes - m.aortic_opens;
  m.isovolumic_relaxation =
      isovolumic(beat, m.aortic_closes, mitral_opens, &Signals::aortic_gradient);
  const double filled = std::isnan(m.mitral_closes) ? mitral_closes.time(beat) : m.mitral_closes;
  const Inflow early = inflow(beat, m.mitral_opens, std::isnan(atrium) ? filled : atrium);
  const Inflow late = inflow(beat, atrium, filled);
  m.early_filling = early.volume;
  m.early_filling_flow = early.flow;
  m.late_filling = late.volume;
  m.late_filling_flow = late.flow;
  m.relaxation_constant =
      relaxation(beat, fastest_fall(beat, steepest_fall), mitral_opens.time(beat));
  return m;
}

}  // namespace lv::circulation
