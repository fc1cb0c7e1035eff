#include "lv/circulation/family.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lv::circulation {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double least_volume(std::span<const LoadedBeat> beats) {
  double least = std::numeric_limits<double>::infinity();
  for (const LoadedBeat& beat : beats)
    for (const LoopPoint& p : beat.loop)
      least = std::min(least, p.volume);
  return least;
}

/// Where p/(V - V_0) is largest.
LoopPoint stiffest(const std::vector<LoopPoint>& loop, double V_0) {
  const auto elastance = [&](const LoopPoint& p) { return p.pressure / (p.volume - V_0); };
  return *std::max_element(loop.begin(), loop.end(), [&](const LoopPoint& a, const LoopPoint& b) {
    return elastance(a) < elastance(b);
  });
}

std::vector<double> values(const std::vector<LoopPoint>& points, double LoopPoint::*member) {
  std::vector<double> all;
  for (const LoopPoint& p : points)
    all.push_back(p.*member);
  return all;
}

bool is_same(const Factors& a, const Factors& b) {
  return a.contractility == b.contractility && a.heart_rate == b.heart_rate;
}

}  // namespace

Line line_through(std::span<const double> x, std::span<const double> y) {
  const auto sum = [&](const auto& term) {
    double all = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!std::isnan(x[i] + y[i]))
        all += term(x[i], y[i]);
    return all;
  };
  const double n = sum([](double, double) { return 1.0; });
  const double x_mean = sum([](double a, double) { return a; }) / n;
  const double y_mean = sum([](double, double b) { return b; }) / n;
  const double xx = sum([&](double a, double) { return std::pow(a - x_mean, 2); });
  const double xy = sum([&](double a, double b) { return (a - x_mean) * (b - y_mean); });
  Line line{unknown, unknown, unknown, static_cast<int>(n)};
  constexpr double rounding = 1e-9;
  if (!(xx > n * std::pow(rounding * x_mean, 2)))
    return line;
  line.slope = xy / xx;
  line.intercept = x_mean - y_mean / line.slope;
  if (line.points > 2)
    line.deviation = std::sqrt(sum([&](double a, double b) {
                                 return std::pow(b - line.slope * (a - line.intercept), 2);
                               }) /
                               n);
  return line;
}

EndSystolicRelation end_systolic_relation(std::span<const LoadedBeat> beats) {
  constexpr int most = 100;  // it settles within ten; samples may make it go to and fro
  const double limit = 0.9 * least_volume(beats);
  EndSystolicRelation relation;
  double V_0 = 0.0;
  for (int i = 0; i < most; ++i) {
    relation.points.clear();
    for (const LoadedBeat& beat : beats)
      relation.points.push_back(stiffest(beat.loop, V_0));
    relation.line = line_through(values(relation.points, &LoopPoint::volume),
                                 values(relation.points, &LoopPoint::pressure));
    const double next = std::min(relation.line.intercept, limit);
    if (std::isnan(relation.line.intercept) || next == V_0)
      break;
    V_0 = next;
  }
  return relation;
}

Line recruitable_stroke_work(std::span<const LoadedBeat> beats) {
  std::vector<double> volumes;
  std::vector<double> works;
  for (const LoadedBeat& beat : beats) {
    volumes.push_back(beat.measures.end_diastolic_volume);
    works.push_back(beat.measures.stroke_work);
  }
  return line_through(volumes, works);
}

double arterial_elastance(const BeatMeasures& beat) {
  return beat.end_systolic_pressure / beat.stroke_volume;
}

std::vector<Contractility> by_contractility(std::span<const LoadedBeat> family) {
  std::vector<Contractility> all;
  for (const LoadedBeat& beat : family) {
    auto found = std::find_if(all.begin(), all.end(), [&](const Contractility& c) {
      return is_same(c.beats.front().factors, beat.factors);
    });
    if (found == all.end())
      found = all.insert(all.end(), Contractility{});
    found->beats.push_back(beat);
  }
  for (Contractility& c : all) {
    c.end_systole = end_systolic_relation(c.beats);
    std::vector<LoadedBeat> preloads = c.beats;
    std::erase_if(preloads, [](const LoadedBeat& b) { return !b.factors.is_preload(); });
    c.stroke_work = recruitable_stroke_work(preloads);
  }
  return all;
}

}  // namespace lv::circulation
