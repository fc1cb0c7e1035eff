#include "lv/heartbeat/step_forecast.hpp"

#include <catch2/catch.hpp>

#include <vector>

using lv::heartbeat::StepForecast;

namespace {

/// A load step of a recorded beat: processor time [s] and progress [%] of its phase.
struct Recorded {
  double seconds, progress;
};

struct RecordedBeat {
  const char* name;
  std::vector<Recorded> filling, contraction;
};

const std::vector<RecordedBeat> recorded_beats{
    {"the default ventricle on elements of 14 mm",
     {{0.59, 0.25}, {0.22, 0.375}, {0.33, 0.75}, {0.13, 1.38}, {0.03, 2.25}, {0.13, 4},
      {0.17, 6.5},  {0.13, 8.88},  {0.13, 11.4}, {0.08, 13.9}, {0.14, 16.4}, {0.06, 19.1},
      {0.15, 21.8}, {0.08, 24.8},  {0.17, 27.8}, {0.05, 31.2}, {0.15, 34.6}, {0.05, 38.8},
      {0.12, 42.8}, {0.05, 47.6},  {0.15, 52.5}, {0.05, 58.2}, {0.13, 64.1}, {0.04, 71.2},
      {0.13, 78.4}, {0.07, 87.1},  {0.12, 96},   {0.05, 100}},
     {{0.17, 0.197}, {0.17, 0.401}, {0.14, 0.599}, {0.28, 0.923}, {0.15, 1.23}, {0.17, 1.52},
      {0.06, 1.84},  {0.18, 2.15},  {0.06, 2.61},  {0.17, 3.06},  {0.15, 3.79}, {0.19, 4.79},
      {0.19, 5.8},   {0.19, 6.8},   {0.17, 7.8},   {0.07, 8.8},   {0.15, 9.81}, {0.15, 11.5},
      {0.16, 13.2},  {0.27, 16.1},  {0.14, 19},    {0.24, 24},    {0.06, 28.9}, {0.14, 33.8},
      {0.08, 42.2},  {0.18, 50.6},  {0.20, 64.8},  {0.24, 89},    {0.13, 100}}},
    {"a phantom with an infarct, from its labels",
     {{3.77, 0.25}, {1.22, 0.375}, {2.92, 0.75}, {0.63, 1.12}, {0.61, 1.62},
      {0.66, 2.62}, {0.68, 4.25},  {1.29, 7.12}, {1.30, 10},   {1.65, 13.9},
      {1.18, 17.8}, {1.36, 22},    {0.71, 26.2}, {1.24, 30.6}, {1.23, 34.9},
      {0.82, 39.1}, {0.65, 43.4},  {1.23, 50.4}, {0.68, 57.4}, {1.36, 64.4},
      {0.69, 71.4}, {0.18, 78.4},  {0.61, 85.4}, {1.27, 97.4}, {0.82, 100}},
     {{1.24, 0.197}, {1.70, 0.401}, {0.66, 0.599}, {1.60, 0.803}, {0.74, 1},    {0.74, 1.2},
      {0.72, 1.4},   {0.81, 1.6},   {0.72, 1.8},   {1.22, 2},     {0.72, 2.2},  {0.68, 2.54},
      {2.16, 3.12},  {0.77, 3.7},   {1.02, 4.27},  {0.80, 4.85},  {1.48, 5.84}, {1.25, 6.82},
      {1.24, 7.8},   {1.47, 8.78},  {1.41, 9.77},  {1.33, 10.7},  {1.33, 11.7}, {1.42, 13.4},
      {1.84, 15.1},  {1.25, 16.7},  {0.71, 18.4},  {1.44, 21.3},  {0.76, 24.1}, {0.20, 28.9},
      {0.64, 33.7},  {0.76, 42},    {0.20, 50.2},  {0.64, 58.4},  {0.82, 72.3}, {0.70, 86.3},
      {0.32, 100}}}};

double seconds_of(const std::vector<Recorded>& steps) {
  double sum = 0.0;
  for (const Recorded& step : steps)
    sum += step.seconds;
  return sum;
}

}  // namespace

TEST_CASE("the time left of a quasi-static beat is right within 30% at 25, 50 and 75%",
          "[unit][heartbeat]") {
  for (const RecordedBeat& beat : recorded_beats) {
    StepForecast forecast({StepForecast::of_filling, StepForecast::of_contraction});
    CHECK(forecast.seconds_left() < 0.0);
    const double all = seconds_of(beat.filling) + seconds_of(beat.contraction);
    double done = 0.0;
    double next = 0.25;
    for (const auto* phase : {&beat.filling, &beat.contraction}) {
      forecast.begin();
      double before = 0.0;
      for (const Recorded& step : *phase) {
        forecast.record(step.seconds, 0.01 * step.progress, 0.01 * (step.progress - before));
        before = step.progress;
        done += step.seconds;
        if (done < next * all || next > 0.75)
          continue;
        next += 0.25;
        INFO(beat.name << ", at " << done << " of " << all << " s");
        CHECK(forecast.seconds_left() == Approx(all - done).epsilon(0.3));
      }
    }
    CHECK(next == 1.0);
    CHECK(forecast.seconds_left() == 0.0);
  }
}
