#include "lv/case_file/family.hpp"

#include "lv/base/check.hpp"
#include "lv/case_file/read_case.hpp"

#include "support/heartbeat_case.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;
using Catch::Matchers::Contains;

case_file::Case studied(const std::string& study, const std::string& kind = "windkessel") {
  return test::heartbeat_case(kind, "[study]\n" + study);
}

}  // namespace

TEST_CASE("every contractility and heart rate of a study meets every load", "[unit][case_file]") {
  const auto c = studied("preload = [0.8, 1.2]\nafterload = [1.5]\ncontractility = [1.2]\n");
  const auto members = case_file::family(c.study);
  std::vector<std::string> names;
  for (const case_file::Member& m : members)
    names.push_back(m.name);
  CHECK(names == std::vector<std::string>{"case", "preload_0.8", "preload_1.2", "afterload_1.5",
                                          "contractility_1.2", "contractility_1.2_preload_0.8",
                                          "contractility_1.2_preload_1.2",
                                          "contractility_1.2_afterload_1.5"});
}

TEST_CASE("a member of a study is the case with what its factors multiply", "[unit][case_file]") {
  const auto c = studied("preload = [0.8]\n");
  const circulation::Factors all{0.5, 2.0, 1.25, 1.1};
  const auto changed = case_file::under(all, c);
  CHECK(changed.circulation.windkessel.p_ven == Approx(0.5 * c.circulation.windkessel.p_ven));
  CHECK(changed.circulation.windkessel.R_p == Approx(2.0 * c.circulation.windkessel.R_p));
  CHECK(changed.land2017.T_ref == Approx(1.25 * c.land2017.T_ref));
  CHECK(changed.circulation.period == Approx(c.circulation.period / 1.1));
  CHECK_FALSE(changed.study.asked());
  CHECK(changed.origin.at("circulation.windkessel.p_ven") == "case.toml:9");
  const auto loop = studied("preload = [0.8]\n", "closed_loop");
  const auto bled = case_file::under({.preload = 0.9, .afterload = 1.5}, loop);
  CHECK(bled.circulation.closed_loop.blood == Approx(0.9 * 1617.876 * units::ml).epsilon(1e-6));
  auto known = loop;
  known.circulation.closed_loop.blood = 1700.0 * units::ml;
  CHECK(case_file::under({.preload = 0.9}, known).circulation.closed_loop.blood ==
        Approx(0.9 * 1700.0 * units::ml));
  CHECK(bled.circulation.closed_loop.systemic.R_ar ==
        Approx(1.5 * loop.circulation.closed_loop.systemic.R_ar));
}

TEST_CASE("a faster heart's chambers have times of their own that fit, set or not",
          "[unit][case_file]") {
  const auto loop = [](const std::string& more) {
    return case_file::parse_case("[circulation]\nkind = \"closed_loop\"\n" + more, "case.toml")
        .circulation;
  };
  const circulation::ClosedLoopParameters usual = loop("").closed_loop;
  CHECK(usual.left_atrium.t_C == 0.72);
  CHECK(usual.right_ventricle.T_R == 0.4);
  const auto fast = loop("period = \"0.4 s\"\nclosed_loop.left_atrium.t_C = \"0.3 s\"\n");
  CHECK(fast.closed_loop.right_ventricle.T_C == Approx(0.25 * 0.5946).epsilon(1e-3));
  CHECK(fast.closed_loop.right_atrium.t_C == Approx(0.5 - 0.18 * 0.5946).epsilon(1e-3));
  CHECK(fast.closed_loop.left_atrium.t_C == 0.3);
  const auto c = case_file::parse_case(
      "[circulation]\nkind = \"closed_loop\"\nclosed_loop.right_ventricle.T_R = \"0.35 s\"\n"
      "closed_loop.left_atrium.t_C = \"0.7 s\"\n",
      "case.toml");
  const circulation::CircuitParameters faster =
      case_file::under({.heart_rate = 2.0}, c).circulation;
  CHECK(faster.closed_loop.right_ventricle.T_R == Approx(0.35 * 0.5946).epsilon(1e-3));
  CHECK(faster.closed_loop.left_atrium.t_C == Approx(0.5 - 0.2 * 0.5946).epsilon(1e-3));
  CHECK(faster.closed_loop.right_atrium.t_C == Approx(0.5 - 0.18 * 0.5946).epsilon(1e-3));
}

TEST_CASE("a factor that makes a case which cannot be run is refused at its line",
          "[unit][case_file]") {
  const auto c = studied("heart_rate = [2.5]\n");
  CHECK_THROWS_WITH(case_file::under({.heart_rate = 2.5}, c),
                    Contains("case.toml:9") && Contains("shorter than the calcium of a beat"));
  CHECK_THROWS_WITH(
      case_file::under({.preload = 1000.0}, c),
      Contains("circulation.windkessel.p_ven, multiplied by 1000") && Contains("at most 100 mmHg"));
}
