#include "lv/heartbeat/step_forecast.hpp"

#include <catch2/catch.hpp>

#include <vector>

using lv::heartbeat::StepForecast;

namespace {

/// A load step of a recorded beat: processor time [s] and progress [%] of its phase.
struct Recorded {
  double seconds, progress;
};

/// The default ventricle, 110 ml at end-diastole, elements of 14 mm.
const std::vector<Recorded> recorded_filling{
    {0.26, 0.2}, {0.12, 0.4}, {0.12, 0.8}, {0.12, 1.4}, {0.01, 2.3}, {0.01, 4},  {0.01, 6.8},
    {0.07, 12},  {0.03, 20},  {0.06, 28},  {0.02, 35},  {0.04, 43},  {0.07, 51}, {0.01, 60},
    {0.09, 68},  {0.02, 78},  {0.07, 87},  {0.02, 98},  {0.03, 100}};
const std::vector<Recorded> recorded_contraction{
    {0.08, 0.2}, {0.07, 0.4}, {0.10, 0.74}, {0.06, 1.1}, {0.07, 1.5}, {0.08, 2.0},
    {0.07, 2.7}, {0.09, 3.5}, {0.08, 4.3},  {0.11, 5.6}, {0.25, 7.5}, {0.12, 9.4},
    {0.12, 11},  {0.07, 15},  {0.03, 18},   {0.08, 21},  {0.08, 27},  {0.02, 32},
    {0.07, 38},  {0.03, 47},  {0.07, 56},   {0.07, 72},  {0.09, 100}};

double seconds_of(const std::vector<Recorded>& steps) {
  double sum = 0.0;
  for (const Recorded& step : steps)
    sum += step.seconds;
  return sum;
}

}  // namespace

TEST_CASE("the time left of a quasi-static beat is right within 30% at 25, 50 and 75%",
          "[unit][heartbeat]") {
  StepForecast forecast(2);
  CHECK(forecast.seconds_left() < 0.0);
  const double all = seconds_of(recorded_filling) + seconds_of(recorded_contraction);
  double done = 0.0;
  double next = 0.25;
  for (const auto* phase : {&recorded_filling, &recorded_contraction}) {
    forecast.begin();
    double before = 0.0;
    for (const Recorded& step : *phase) {
      forecast.record(step.seconds, 0.01 * step.progress, 0.01 * (step.progress - before));
      before = step.progress;
      done += step.seconds;
      if (done < next * all || next > 0.75)
        continue;
      next += 0.25;
      INFO("at " << done << " of " << all << " s");
      CHECK(forecast.seconds_left() == Approx(all - done).epsilon(0.3));
    }
  }
  CHECK(next == 1.0);
  CHECK(forecast.seconds_left() == 0.0);
}
