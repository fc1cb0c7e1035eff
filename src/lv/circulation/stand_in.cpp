#include "lv/circulation/stand_in.hpp"

#include "lv/base/check.hpp"
#include "lv/base/periodic.hpp"

#include <algorithm>

namespace lv::circulation {

StandIn::StandIn(std::span<const Sample> beat, double end_diastolic_volume,
                 const PassiveFilling& filling)
    : filling_(filling), V_ed_(end_diastolic_volume), V_d_(0.1 * end_diastolic_volume) {
  LV_CHECK(beat.size() > 1);
  for (const Sample& s : beat)
    V_d_ = std::min(V_d_, 0.5 * s.signals.volume);
  contractility_ = 0.0;
  for (const Sample& s : beat) {
    const double active = s.signals.pressure - pressure(0.0, s.signals.volume);
    times_.push_back(s.time - beat.front().time);
    elastances_.push_back(active / (s.signals.volume - V_d_));
  }
  contractility_ = 1.0;
}

StandIn StandIn::with_contractility(double factor) const {
  StandIn other = *this;
  other.contractility_ = factor;
  return other;
}

double StandIn::elastance(double t) const {
  if (elastances_.empty() || contractility_ == 0.0)
    return 0.0;
  const double s = time_in_period(t, times_.back());
  const auto after = std::upper_bound(times_.begin() + 1, times_.end() - 1, s);
  const auto i = static_cast<std::size_t>(after - times_.begin());
  const double share = (s - times_[i - 1]) / (times_[i] - times_[i - 1]);
  return std::lerp(elastances_[i - 1], elastances_[i], share);
}

}  // namespace lv::circulation
