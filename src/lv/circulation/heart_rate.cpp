#include "lv/circulation/heart_rate.hpp"

#include "lv/base/periodic.hpp"

#include <algorithm>

namespace lv::circulation {
namespace {

double systole(double period) {
  return 0.546 - 0.0021 * 60.0 / period;
}

/// A chamber that begins before `onset`, in beats of two periods [s].
void change_period(double from, double to, double onset, ElastanceParameters& e) {
  const double ratio = relative_systole(to) / relative_systole(from);
  e.T_C *= ratio;
  e.T_R *= ratio;
  e.t_C = time_in_period(onset - ratio * time_in_period(onset - e.t_C, from), to);
}

}  // namespace

double relative_systole(double period) {
  constexpr double shortest = 60.0 / 180.0;
  const double share = period < shortest ? period / shortest : 1.0;
  return share * systole(std::max(period, shortest)) / systole(CircuitParameters{}.period);
}

CircuitParameters with_times_at(double period, CircuitParameters p) {
  if (period == p.period)
    return p;
  ClosedLoopParameters& loop = p.closed_loop;
  const double onset = loop.right_ventricle.t_C;
  for (ElastanceParameters* chamber :
       {&loop.left_atrium, &loop.right_atrium, &loop.right_ventricle})
    change_period(p.period, period, onset, *chamber);
  change_period(p.period, period, p.left_ventricle.t_C, p.left_ventricle);
  return p;
}

}  // namespace lv::circulation
