#include "lv/fluid/line_transform.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace {

using lv::fluid::LineTransform;
using Kind = LineTransform::Kind;
using std::numbers::pi;

/// Values of one line, different at every point and column.
double sample(int j, int column) {
  return std::sin(1.3 * j + 0.7 * column) + 0.1 * j;
}

std::vector<double> modes_of_column(LineTransform& transform, int column) {
  std::vector<double> row(transform.columns());
  for (int j = 0; j < transform.points(); ++j) {
    for (int c = 0; c < transform.columns(); ++c)
      row[c] = sample(j, c);
    transform.load_point(j, row.data(), transform.columns());
  }
  transform.to_modes();
  std::vector<double> modes;
  for (int m = 0; m < transform.points(); ++m) {
    transform.store_mode(m, row.data(), transform.columns());
    modes.push_back(row[column]);
  }
  return modes;
}

/// The defining sums, term by term.
std::vector<double> modes_by_definition(Kind kind, int N, int column) {
  std::vector<double> modes;
  const int points = kind == Kind::sine ? N : N + 1;
  for (int i = 0; i < points; ++i) {
    double sum = 0.0;
    for (int j = 0; j < points; ++j) {
      if (kind == Kind::sine)
        sum += 2.0 * sample(j, column) * std::sin(pi * (i + 1) * (j + 0.5) / N);
      else
        sum += (j == 0 || j == N ? 1.0 : 2.0) * sample(j, column) * std::cos(pi * i * j / N);
    }
    modes.push_back(sum);
  }
  return modes;
}

}  // namespace

TEST_CASE("line transforms equal their defining sums", "[unit][fluid]") {
  for (const Kind kind : {Kind::sine, Kind::cosine}) {
    for (const int N : {1, 2, 3, 8, 13, 96, 97}) {
      LineTransform transform(kind, N, 6);
      for (const int column : {0, 3, 5}) {
        const auto modes = modes_of_column(transform, column);
        const auto expected = modes_by_definition(kind, N, column);
        for (std::size_t m = 0; m < modes.size(); ++m)
          CHECK(modes[m] ==
                Approx(expected[m]).margin(1e-10));  // sums of up to 97 terms of size 10
      }
    }
  }
}

TEST_CASE("a line transformed to modes and back is itself times 2N", "[unit][fluid]") {
  for (const Kind kind : {Kind::sine, Kind::cosine}) {
    for (const int N : {1, 2, 5, 16, 33, 128}) {
      LineTransform transform(kind, N, 4);
      const auto modes = modes_of_column(transform, 1);
      std::vector<double> row(4, 0.0);
      for (int m = 0; m < transform.points(); ++m) {
        row[1] = modes[m];
        transform.load_mode(m, row.data(), 4);
      }
      transform.to_points();
      for (int j = 0; j < transform.points(); ++j) {
        transform.store_point(j, row.data(), 4);
        CHECK(row[1] == Approx(2.0 * N * sample(j, 1)).margin(1e-10 * N));
      }
    }
  }
}

// A tile that is never full must not remember: what stays in its unused columns would grow from
// use to use and spoil the last line through rounding.
TEST_CASE("a partly filled tile gives the same in its thousandth use", "[unit][fluid]") {
  for (const Kind kind : {Kind::sine, Kind::cosine}) {
    constexpr int N = 16;
    LineTransform transform(kind, N, 4);
    std::vector<double> first(1);
    std::vector<double> last(1);
    for (int use = 0; use < 1000; ++use) {
      for (int j = 0; j < transform.points(); ++j) {
        const double value = sample(j, 0);
        transform.load_point(j, &value, 1);
      }
      transform.to_modes();
      transform.store_mode(3, use == 0 ? first.data() : last.data(), 1);
      for (int m = 0; m < transform.points(); ++m) {
        const double value = sample(m, 1);
        transform.load_mode(m, &value, 1);
      }
      transform.to_points();
    }
    CHECK(first[0] == last[0]);
  }
}
