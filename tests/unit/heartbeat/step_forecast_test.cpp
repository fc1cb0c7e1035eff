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
    {"a heart with an infarct on elements of 12 mm, on which the shares were chosen",
     {{0.52, 0.188},
      {0.10, 0.375},
      {0.10, 0.75},
      {0.10, 1.31},
      {0.11, 2.31},
      {0.22, 4},
      {0.21, 6.81},
      {0.29, 11.6},
      {0.20, 19.9},
      {0.24, 28.1},
      {0.28, 42},
      {0.28, 55.9},
      {0.22, 69.9},
      {0.17, 93.6},
      {0.13, 100}},
     {{0.40, 0.202}, {0.19, 0.404}, {0.11, 0.596}, {0.17, 0.936}, {0.19, 1.39}, {0.20, 1.85},
      {0.28, 2.63},  {0.37, 3.4},   {0.50, 4.18},  {0.28, 4.96},  {0.34, 6.28}, {0.21, 7.6},
      {0.19, 8.91},  {0.11, 11.2},  {0.18, 13.4},  {0.19, 17.2},  {0.19, 21},   {0.10, 24.8},
      {0.19, 31.3},  {0.15, 37.8},  {0.05, 48.8},  {0.24, 59.9},  {0.13, 78.6}, {0.17, 100}}},
    {"weak muscle on elements of 10 mm",
     {{1.30, 0.25}, {0.79, 0.375}, {0.39, 0.75}, {0.38, 1.38}, {0.06, 2.25}, {0.34, 4},
      {0.43, 6.5},  {0.37, 8.88},  {0.37, 11.4}, {0.16, 13.9}, {0.36, 16.4}, {0.11, 19},
      {0.41, 21.8}, {0.12, 24.8},  {0.38, 27.8}, {0.11, 31.1}, {0.42, 34.6}, {0.11, 38.8},
      {0.45, 42.8}, {0.15, 47.6},  {0.56, 52.4}, {0.13, 58.2}, {0.48, 64.1}, {0.13, 71.2},
      {0.50, 78.4}, {0.18, 87.1},  {0.38, 95.9}, {0.12, 100}},
     {{0.44, 0.197}, {0.46, 0.542}, {0.79, 0.88}, {0.54, 1.22}, {0.52, 1.56},
      {0.67, 2.14},  {0.52, 2.72},  {0.51, 3.7},  {0.52, 4.77}, {0.43, 6.02},
      {0.44, 7.66},  {0.51, 9.99},  {0.49, 13.5}, {0.64, 19.2}, {0.64, 25},
      {0.47, 34.8},  {0.43, 51.5},  {0.49, 68.2}, {0.58, 84.9}, {0.21, 100}}},
    {"a thin wall on elements of 12 mm",
     {{0.57, 0.25}, {0.14, 0.375}, {0.14, 0.75}, {0.16, 1.38}, {0.15, 2.25}, {0.19, 4},
      {0.16, 5.62}, {0.14, 7.38},  {0.15, 9.12}, {0.05, 10.9}, {0.14, 12.8}, {0.10, 14.8},
      {0.17, 16.8}, {0.06, 19.2},  {0.15, 21.6}, {0.06, 24.5}, {0.16, 27.5}, {0.05, 31},
      {0.17, 34.6}, {0.10, 39.1},  {0.17, 43.5}, {0.06, 49.1}, {0.17, 54.8}, {0.05, 61.9},
      {0.20, 68.9}, {0.06, 78},    {0.16, 87},   {0.07, 98.5}, {0.09, 100}},
     {{0.19, 0.197}, {0.19, 0.401}, {0.18, 0.739}, {0.15, 1.08}, {0.17, 1.65}, {0.22, 2.51},
      {0.18, 3.23},  {0.31, 3.92},  {0.16, 4.7},   {0.17, 5.68}, {0.15, 6.94}, {0.08, 8.85},
      {0.17, 10.7},  {0.14, 14},    {0.16, 19.5},  {0.18, 28.8}, {0.18, 38.1}, {0.16, 54},
      {0.17, 69.9},  {0.18, 96.9},  {0.06, 100}}}};

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
    StepForecast forecast({StepForecast::Kind::filling, StepForecast::Kind::contraction});
    CHECK(forecast.seconds_left() < 0.0);
    const double all = seconds_of(beat.filling) + seconds_of(beat.contraction);
    double done = 0.0;
    double next = 0.25;
    for (const auto* phase : {&beat.filling, &beat.contraction}) {
      forecast.begin();
      for (const Recorded& step : *phase) {
        forecast.record(step.seconds, 0.01 * step.progress);
        done += step.seconds;
        if (done < next * all || next > 0.75)
          continue;
        next += 0.25;
        INFO(beat.name << ", at " << done << " of " << all << " s");
        CHECK(forecast.seconds_left() == Approx(all - done).epsilon(0.3));
      }
    }
    CHECK(next == 1.0);
    CHECK(forecast.seconds_left() == Approx(0.0).margin(1e-9));
  }
}
