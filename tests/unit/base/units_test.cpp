#include "lv/base/units.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>

namespace {

using namespace lv;
using Catch::Matchers::Contains;

struct KnownUnit {
  const char* name;
  double factor;  ///< in mm, kg, s, uM, rad, from the definition of the unit
  const char* kind;
};

// 1 N = 1 kg m/s^2 = 1000 kg mm/s^2 (mN); 1 Pa = 1 N/m^2 = 1000 mN / 1e6 mm^2; 1 P = 0.1 Pa s
const KnownUnit known_units[] = {{"m", 1e3, "length"},
                                 {"cm", 10, "length"},
                                 {"mm", 1, "length"},
                                 {"um", 1e-3, "length"},
                                 {"kg", 1, "mass"},
                                 {"g", 1e-3, "mass"},
                                 {"mg", 1e-6, "mass"},
                                 {"s", 1, "time"},
                                 {"ms", 1e-3, "time"},
                                 {"min", 60, "time"},
                                 {"l", 1e6, "volume"},
                                 {"ml", 1e3, "volume"},
                                 {"N", 1e3, "force"},
                                 {"mN", 1, "force"},
                                 {"dyn", 1e-2, "force"},
                                 {"Pa", 1e-3, "pressure"},
                                 {"kPa", 1, "pressure"},
                                 {"MPa", 1e3, "pressure"},
                                 {"bar", 100, "pressure"},
                                 {"mmHg", 0.133322387415, "pressure"},
                                 {"cmH2O", 0.0980665, "pressure"},
                                 {"\u00b5m", 1e-3, "length"},
                                 {"\u03bcm", 1e-3, "length"},
                                 {"\u00b0", 0.017453292519943295, "angle"},
                                 {"P", 1e-4, "viscosity"},
                                 {"cP", 1e-6, "viscosity"},
                                 {"uM", 1, "concentration"},
                                 {"mM", 1e3, "concentration"},
                                 {"nM", 1e-3, "concentration"},
                                 {"rad", 1, "angle"},
                                 {"deg", 0.017453292519943295, "angle"},
                                 {"Hz", 1, "rate"},
                                 {"%", 0.01, "pure number"}};

/// The same quantity written in two ways.
void check_same(const char* one, const char* other) {
  const units::Quantity a = units::parse_quantity(one);
  const units::Quantity b = units::parse_quantity(other);
  INFO(one << " = " << other);
  CHECK(a.value == Approx(b.value).epsilon(1e-14));  // a handful of roundings
  CHECK(a.unit.dimension == b.unit.dimension);
}

}  // namespace

TEST_CASE("every unit has its factor and its kind", "[unit][base]") {
  for (const KnownUnit& known : known_units) {
    INFO(known.name);
    const units::Unit unit = units::parse_unit(known.name);
    CHECK(unit.factor == Approx(known.factor).epsilon(1e-15));  // the nearest double but one
    CHECK(units::kind_of(unit) == known.kind);
  }
}

TEST_CASE("products of units mean the same however they are written", "[unit][base]") {
  check_same("1 g/ml", "1e-6 kg/mm^3");
  check_same("1e6 dyn/cm^2", "100 kPa");
  check_same("4 cP", "0.04 g/(cm s)");
  check_same("4 cP", "4e-3 Pa s");
  check_same("1 N", "1 kg*m/s^2");
  check_same("1 Pa", "1 N/m^2");
  check_same("1 bar", "1e5 Pa");
  check_same("1 ml", "1 cm^3");
  check_same("100 1/(uM s)", "1e5 1/(mM s)");
  check_same("1 m/s/s", "1 m s^-2");
  check_same("1 Hz", "1 1/s");
  check_same("1 (mm)", "1 mm");
  check_same("1 kPa/mm", "1e6 N/m^3");
  check_same("50%", "0.5");
  check_same("10 cmH2O", "0.980665 kPa");
  check_same("10 mmHg/\u00b5m^2", "10 mmHg/um^2");
  check_same("180 deg", "3.141592653589793 rad");
  check_same(" 8\tmmHg ", "8 mmHg");
}

TEST_CASE("kinds of compound units are known by name", "[unit][base]") {
  const auto kind = [](const char* unit) { return units::kind_of(units::parse_unit(unit)); };
  CHECK(kind("") == "pure number");
  CHECK(kind("m/s") == "velocity");
  CHECK(kind("g/ml") == "density");
  CHECK(kind("1/s") == "rate");
  CHECK(kind("1/(uM s)") == "binding rate");
  CHECK(kind("kPa/mm") == "stiffness per area");
  CHECK(kind("mm^2") == "area");
  CHECK(kind("mm^3") == "volume");
  CHECK(kind("kPa s") == "viscosity");
  CHECK(kind("kPa^2") == "quantity of another kind");
}

TEST_CASE("a quantity knows whether a unit was written", "[unit][base]") {
  CHECK_FALSE(units::parse_quantity("8").has_unit);
  CHECK(units::parse_quantity("8 mmHg").has_unit);
  CHECK(units::parse_quantity("-60 deg").value == Approx(-3.141592653589793 / 3));
  CHECK(units::parse_quantity("1.2e-4 s").value == 1.2e-4);
}

TEST_CASE("text that is no quantity is refused with what is wrong", "[unit][base]") {
  using units::parse_quantity;
  CHECK_THROWS_WITH(parse_quantity("8 mmhg"), Contains("'mmhg'") && Contains("'mmHg'"));
  CHECK_THROWS_WITH(parse_quantity("8 kpa"), Contains("'kpa'") && Contains("'kPa'"));
  CHECK_THROWS_WITH(parse_quantity("8 degrees"), Contains("'degrees'"));
  CHECK_THROWS_WITH(parse_quantity("8 cmH20"), Contains("'cmH20'") && Contains("'cmH2O'"));
  CHECK_THROWS_WITH(parse_quantity("3 kPa/mm2"), Contains("'mm2'") && Contains("'mm^2'"));
  CHECK_THROWS_WITH(parse_quantity("8,5 mmHg"), Contains("write a decimal point"));
  CHECK_THROWS_WITH(parse_quantity("mmHg"), Contains("does not begin with a number"));
  CHECK_THROWS_WITH(parse_quantity(""), Contains("does not begin with a number"));
  CHECK_THROWS_WITH(parse_quantity("nan mm"), Contains("not a finite number"));
  CHECK_THROWS_WITH(parse_quantity("inf"), Contains("not a finite number"));
  CHECK_THROWS_WITH(parse_quantity("1e999 s"), Contains("not a finite number"));
  for (const char* text : {"1 kPa/", "1 mm^", "1 mm^x", "1 mm^2.5", "1 (mm", "1 mm)", "1 2 mm",
                           "1 mm2", "1 mm,5", "8,0 mmHg", "1 ()", "1 *mm"}) {
    INFO(text);
    CHECK_THROWS_AS(parse_quantity(text), std::invalid_argument);
  }
}

TEST_CASE("values are written with just the digits they need", "[unit][base]") {
  for (const auto& [text, unit] : {std::pair{"8 mmHg", "mmHg"},
                                   {"0.24 kPa", "kPa"},
                                   {"-60 deg", "deg"},
                                   {"4 cP", "cP"},
                                   {"0.000122 s", "s"},
                                   {"1e+06 Pa", "Pa"},
                                   {"100 %", "%"},
                                   {"0 kPa", "kPa"},
                                   {"143.7 ml", "ml"},
                                   {"33.3333 %", "%"},
                                   {"7", ""}})
    CHECK(units::format(units::parse_quantity(text).value, unit) == text);
}

TEST_CASE("what is written reads back as the same value", "[unit][base]") {
  for (const KnownUnit& known : known_units) {
    for (const double value : {1.0 / 3.0, -2.7182818284590452e-7, 123456.789}) {
      const std::string text = units::format(value, known.name);
      CHECK(units::parse_quantity(text).value == Approx(value).epsilon(1e-11));  // 12 digits
    }
  }
}

TEST_CASE("powers and parentheses beyond any unit's are refused", "[unit][base]") {
  CHECK(units::parse_unit("mm^-9").factor == 1.0);
  for (const std::string& text :
       {std::string("mm^10"), std::string("ml^2147483647"), std::string("mm^99999999999999999999"),
        std::string(100000, '('), std::string(20, '(').append("mm").append(20, ')')})
    CHECK_THROWS_AS(units::parse_unit(text), std::invalid_argument);
}

TEST_CASE("a quantity is decimal: hexadecimal digits are no number", "[unit][base]") {
  for (const char* text : {"0x10 mmHg", "-0X1p9 mmHg", "0x", "nan mmHg", "inf"})
    CHECK_THROWS_AS(lv::units::parse_quantity(text), std::invalid_argument);
  CHECK(lv::units::parse_quantity("0 mmHg").value == 0.0);
}
