#include "lv/circulation/heart_rate.hpp"

#include "lv/base/periodic.hpp"

#include <catch2/catch.hpp>

using namespace lv;
using namespace lv::circulation;

TEST_CASE("systole shortens with the heart rate as measured", "[unit][circulation]") {
  CHECK(relative_systole(0.8) == 1.0);
  CHECK(relative_systole(0.5) == Approx((546.0 - 2.1 * 120.0) / (546.0 - 2.1 * 75.0)));
  CHECK(relative_systole(1.2) > 1.0);
  CHECK(relative_systole(0.25) == Approx(0.75 * relative_systole(1.0 / 3.0)));
}

TEST_CASE("the published chambers fit into beats of any rate, and atria contract before ventricles",
          "[unit][circulation]") {
  const CircuitParameters usual;
  const CircuitParameters same = with_times_at(usual.period, usual);
  CHECK(same.closed_loop.left_atrium.t_C == usual.closed_loop.left_atrium.t_C);
  CHECK(same.closed_loop.right_ventricle.T_R == usual.closed_loop.right_ventricle.T_R);
  for (double rate = 20.0; rate <= 300.0; rate += 0.5) {
    const double period = 60.0 / rate;
    INFO(rate << " beats a minute");
    const CircuitParameters p = with_times_at(period, usual);
    const ClosedLoopParameters& loop = p.closed_loop;
    for (const ElastanceParameters* chamber :
         {&p.left_ventricle, &loop.left_atrium, &loop.right_atrium, &loop.right_ventricle}) {
      CHECK(chamber->T_C + chamber->T_R <= period);
      CHECK(chamber->t_C >= 0.0);
      CHECK(chamber->t_C < period);
    }
    CHECK(loop.right_ventricle.t_C == 0.1);
    CHECK(p.left_ventricle.t_C == 0.1);
    CHECK(time_in_period(loop.right_ventricle.t_C - loop.left_atrium.t_C, period) ==
          Approx(0.18 * relative_systole(period)));
    CHECK(loop.right_atrium.t_C == loop.left_atrium.t_C);
  }
}
