// All declarations of parameters: each is read by a stage, is refused where it does nothing, and is
// in the record of every stage that sees it.
#include "lv/case_file/parameters.hpp"

#include "lv/analysis/wall_fields.hpp"
#include "lv/base/check.hpp"
#include "lv/case_file/read_case.hpp"
#include "lv/circulation/cycle.hpp"
#include "lv/heartbeat/protocol.hpp"
#include "lv/pipeline/calibration.hpp"
#include "lv/pipeline/stages.hpp"
#include "lv/scar/infarct.hpp"
#include "lv/work/ingredients.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <sstream>

namespace {

using namespace lv;
using case_file::Case;
using case_file::Parameter;
using case_file::Stage;

/// The lines of a case file: parameter and value.
using Lines = std::map<std::string, std::string>;

std::string text_of(const Lines& lines) {
  std::string text;
  for (const auto& [name, value] : lines)
    text += fmt::format("{} = {}\n", name, value);
  return text;
}

Case parsed(const Lines& lines) {
  return case_file::parse_case(text_of(lines), "case.toml");
}

Lines with(Lines lines, const std::string& name, const std::string& value) {
  lines[name] = value;
  return lines;
}

const Lines static_engine{{"engine", "\"quasi_static\""}};
/// A case of heartbeats with these lines too.
Lines beating(Lines lines) {
  for (const auto& [name, value] : Lines{{"engine", "\"quasi_static\""},
                                         {"protocol.kind", "\"cycle\""},
                                         {"circulation.kind", "\"windkessel\""}})
    lines.emplace(name, value);
  return lines;
}
/// The same with the immersed engine.
const Lines beating_immersed{{"protocol.kind", "\"cycle\""},
                             {"circulation.kind", "\"windkessel\""}};
/// The immersed engine's wall held by springs.
const Lines held_immersed{{"base.support", "\"elastic\""},
                          {"base.tangential_stiffness", "\"1 kPa/mm\""},
                          {"base.normal_stiffness", "\"2 kPa/mm\""},
                          {"pericardium.normal_stiffness", "\"3 kPa/mm\""},
                          {"pericardium.weight", "\"sigmoid\""}};
const Lines given_mesh{{"anatomy.source", "\"mesh\""}, {"anatomy.mesh.file", "\"wall.vtk\""}};
const Lines labelled_scar{{"infarct.source", "\"labels\""},
                          {"infarct.labels.file", "\"scar.nii\""},
                          {"infarct.labels.in_plane", "true"}};
const Lines lge_scar{{"infarct.source", "\"lge\""},
                     {"infarct.lge.image", "\"dicom\""},
                     {"infarct.lge.in_plane", "true"}};

const Lines strain_fit{{"calibrate.passive", "\"scale_and_exponent\""},
                       {"calibrate.edv", "\"120 ml\""},
                       {"calibrate.active", "true"},
                       {"calibrate.esv", "\"60 ml\""},
                       {"calibrate.strains", "\"strains.csv\""}};

/// Cases of every engine, law, source and protocol.
const std::vector<Lines>& bases() {
  static const std::vector<Lines> all{
      {},
      static_engine,
      with(static_engine, "quasi_static.order", "1"),
      with(static_engine, "quasi_static.linear_solver", "\"iterative\""),
      {{"coupling.kind", "\"quadrature\""}},
      {{"calcium.mode", "\"transient\""}},
      {{"active.law", "\"cauchy\""}},
      {{"active.law", "\"land2017\""}, {"calcium.shape", "\"double_exponential\""}},
      with(static_engine, "active.law", "\"land2017\""),
      with(static_engine, "active.law", "\"second_piola\""),
      {{"passive.law", "\"guccione\""}},
      {{"passive.law", "\"neo_hookean\""}},
      {{"anatomy.source", "\"contours\""}, {"anatomy.contours.short_axis", "\"loops.csv\""}},
      {{"anatomy.source", "\"labels\""}},
      {{"anatomy.source", "\"sunnybrook\""}},
      {{"anatomy.source", "\"guide_points\""}},
      {{"anatomy.source", "\"cine\""}},
      {{"anatomy.source", "\"contour_file\""}},
      {{"anatomy.source", "\"surfaces\""}},
      given_mesh,
      with(given_mesh, "anatomy.mesh.sides", "\"geometry\""),
      with(given_mesh, "anatomy.mesh.fibres", "\"f0\""),
      with(with(given_mesh, "infarct.source", "\"elements\""), "infarct.elements.set", "\"scar\""),
      {{"infarct.source", "\"described\""}},
      {{"infarct.source", "\"surface\""}},
      labelled_scar,
      {{"infarct.source", "\"labels\""}, {"infarct.labels.file", "\"scar.vti\""}},
      {{"infarct.source", "\"strain\""}, {"infarct.strain.file", "\"strains.csv\""}},
      lge_scar,
      with(with(lge_scar, "infarct.lge.threshold", "\"fwhm\""), "infarct.lge.image", "\"a.nii\""),
      {{"calibrate.passive", "\"C_a\""}, {"calibrate.edv", "\"120 ml\""}},
      strain_fit,
      with(with(strain_fit, "calibrate.contractility", "\"segments\""), "calibrate.shape", "true"),
      {{"calibrate.passive", "\"klotz\""}, {"unloaded.pressure", "\"8 mmHg\""}},
      {{"unloaded.pressure", "\"2 mmHg\""}},
      {{"circulation.kind", "\"windkessel\""}},
      with(with(static_engine, "protocol.kind", "\"cycle\""), "circulation.kind", "\"windkessel\""),
      beating({{"base.support", "\"elastic\""},
               {"base.tangential_stiffness", "\"1 kPa/mm\""},
               {"base.normal_stiffness", "\"1 kPa/mm\""},
               {"pericardium.normal_stiffness", "\"1 kPa/mm\""},
               {"pericardium.weight", "\"sigmoid\""},
               {"cycle.inertia", "true"},
               {"activation.kind", "\"eikonal\""}}),
      beating({{"activation.kind", "\"file\""}, {"activation.file", "\"times.dat\""}}),
      beating({{"base.motion", "\"table\""}, {"base.motion_file", "\"motion.csv\""}}),
      with(beating({}), "circulation.kind", "\"closed_loop\""),
      beating_immersed,
      held_immersed,
      beating({{"calibrate.cycle", "true"}, {"calibrate.edv", "\"120 ml\""}}),
      {{"circulation.kind", "\"closed_loop\""}, {"circulation.valves.law", "\"arctangent\""}},
      {{"strain.cine", "\"cine\""}, {"strain.contours", "\"loops.csv\""}},
      {{"strain.cine", "\"cine\""}, {"strain.long_axis_cine", "[\"view\"]"}},
      {{"strain.measured", "\"measured.csv\""}, {"strain.measured_column", "\"es\""}}};
  return all;
}

std::string quantity(double value, const Parameter& p) {
  return *p.unit == '\0' ? fmt::format("{:.17g}", value)
                         : fmt::format("\"{:.17g} {}\"", value, p.unit);
}

/// A number that the range allows, near another.
double other_than(double value, const Parameter& p, double step) {
  for (const double part : {1.0, -1.0, 0.1, -0.1, 0.01, 0.001})
    if (p.range.contains(value + part * step))
      return value + part * step;
  FAIL("no other value of " << p.name);
  return value;
}

/// Another value than a case has, as a case file writes it.
struct OtherValue {
  const Parameter& p;
  const Case& c;

  std::string operator()(double* x) const {
    const double value = *x / (*p.unit == '\0' ? 1.0 : units::parse_unit(p.unit).factor);
    return quantity(other_than(value, p, value == 0.0 ? 20.0 : 0.05 * std::abs(value)), p);
  }
  std::string operator()(int* x) const { return fmt::format("{:g}", other_than(*x, p, 1.0)); }
  std::string operator()(bool* x) const { return *x ? "false" : "true"; }
  std::string operator()(std::string* x) const { return fmt::format("\"other_{}\"", *x); }
  std::string operator()(const case_file::Choice& x) const {
    std::istringstream words(p.words);
    std::string first;
    std::string second;
    words >> first >> second;
    return fmt::format("\"{}\"", x.get(x.at) == 0 ? second : first);
  }
  std::string operator()(std::array<double, 3>* x) const {
    const double factor = units::parse_unit(p.unit).factor;
    return fmt::format("[{0}, {1}, {1}]", quantity((*x)[0] / factor + 1.0, p),
                       quantity((*x)[1] / factor + 2.0, p));
  }
  std::string operator()(std::array<int, 3>* x) const {
    return fmt::format("[{}, {}, {}]", (*x)[0] + 1, (*x)[1] + 2, (*x)[2] + 3);
  }
  std::string operator()(std::optional<std::array<double, 3>>*) const {
    return R"(["1 mm", "2 mm", "3 mm"])";
  }
  std::string operator()(std::vector<int>*) const { return "[1, 7]"; }
  std::string operator()(std::vector<double>*) const { return "[0.5, 1.5]"; }
  std::string operator()(std::vector<std::string>*) const { return "[\"one\", \"another\"]"; }
};

std::string other_value(const Parameter& p, const Case& c) {
  return std::visit(OtherValue{p, c}, p.slot(const_cast<Case&>(c)));
}

bool counts_somewhere(const Parameter& p, const Case& c) {
  return std::any_of(case_file::all_stages.begin(), case_file::all_stages.end(),
                     [&](Stage stage) { return case_file::counts(p, c, stage); });
}

/// What a case file with a line more is refused for; empty if it is read.
std::string refusal(const Lines& base, const std::string& name, const std::string& value) {
  try {
    static_cast<void>(parsed(with(base, name, value)));
    return "";
  } catch (const InputError& mistake) {
    return mistake.what();
  }
}

/// The values of a stage's view, as texts: also those that are not numbers.
std::map<std::string, std::string> seen(const Case& c, Stage stage) {
  const Case view = work::stage_view(c, stage);
  std::map<std::string, std::string> values;
  for (const Parameter& p : case_file::parameters())
    values[p.name] = p.get(view);
  return values;
}

work::Ingredients record(const Case& c, Stage stage) {
  work::FileContents files;
  return work::ingredients(c, stage, files);
}

/// What is told of a case for each stage before its results.
template <class Told>
auto by_stage(const Case& c, const Told& told) {
  std::map<Stage, decltype(told(c, Stage::mesh))> result;
  for (const Stage stage : case_file::all_stages)
    if (stage < Stage::results)
      result.emplace(stage, told(c, stage));
  return result;
}

}  // namespace

TEST_CASE("every parameter says what it means, and its default is a value that may be written",
          "[unit][case_file]") {
  std::set<std::string> names;
  for (const Parameter& p : case_file::parameters()) {
    INFO(p.name);
    CHECK(names.insert(p.name).second);
    CHECK(std::string(p.help).size() > 5);
    if (std::string(p.unit) != "")
      CHECK_NOTHROW(units::parse_unit(p.unit));
    if (p.may_be_empty && p.get({}) != "[]")
      CHECK(refusal({}, p.name, p.get({})).find("must be") == std::string::npos);
  }
}

TEST_CASE("every parameter is read by a stage of some case", "[unit][case_file]") {
  for (const Parameter& p : case_file::parameters()) {
    INFO(p.name);
    CHECK_FALSE(p.read_by.empty());
    CHECK(std::any_of(bases().begin(), bases().end(),
                      [&](const Lines& base) { return counts_somewhere(p, parsed(base)); }));
  }
}

TEST_CASE("a parameter that is set and that no stage of the case reads is refused with the reason",
          "[unit][case_file]") {
  for (const Lines& base : bases())
    for (const Parameter& p : case_file::parameters()) {
      const std::string name = p.name;
      if (base.contains(name) || name == "strain.cine" || name == "circulation.kind")
        continue;  // these two bring their stages with them
      const Case c = parsed(base);
      const std::string words = case_file::counts_only(p, c);
      INFO(p.name << " in\n" << text_of(base));
      CHECK(words.empty() == counts_somewhere(p, c));
      const std::string message = refusal(base, p.name, other_value(p, c));
      const std::string expected =
          fmt::format("{} does nothing here: it counts only {}", p.name, words);
      if (std::string(p.name).starts_with("mesh."))
        CHECK(parsed(with(base, p.name, other_value(p, c))).without_effect.empty() ==
              words.empty());
      else if (!words.empty())
        CHECK_THAT(message, Catch::Contains(expected));
      else
        CHECK_THAT(message, !Catch::Contains(std::string(p.name) + " does nothing here"));
    }
}

TEST_CASE("what does nothing is named with what it counts with", "[unit][case_file]") {
  struct Row {
    Lines base;
    std::string name, value, reason;
  };
  const Lines second_piola{{"active.law", "\"second_piola\""}};
  const std::vector<Row> rows{
      {static_engine, "calcium.mode", "\"transient\"", "with engine = \"immersed\""},
      {static_engine, "calcium.tau", "\"0.1 s\"", "with engine = \"immersed\""},
      {static_engine, "protocol.filling_drag", "\"1 1/s\"", "with engine = \"immersed\""},
      {static_engine, "box.cells", "[64, 64, 64]", "with engine = \"immersed\""},
      {static_engine, "time.longest_step", "\"1e-4 s\"", "with engine = \"immersed\""},
      {static_engine, "output.checkpoint_interval", "\"1 s\"", "with engine = \"immersed\""},
      {static_engine, "active.A_1", "-30", "with engine = \"immersed\""},
      {static_engine, "blood.density", "\"1.1 g/ml\"", "with engine = \"immersed\""},
      {{}, "quasi_static.tolerance", "\"1e-5 mm\"", "with engine = \"quasi_static\", with a fit"},
      {static_engine, "muscle.viscosity", "\"1 kPa s\"", "for without time nothing has a rate"},
      {static_engine, "pericardium.normal_viscosity", "\"1 kPa s/mm\"",
       "for without time nothing has a rate"},
      {static_engine, "base.normal_stiffness", "\"1 kPa/mm\"", "with base.support = \"elastic\""},
      {held_immersed, "base.stiffness", "\"100 kPa/mm\"", "\"sliding\" or \"fixed\""},
      {beating_immersed, "cycle.step", "\"1 ms\"", "with engine = \"quasi_static\""},
      {beating_immersed, "activation.v_f", "\"1 m/s\"", "with activation.kind = \"eikonal\""},
      {beating_immersed, "calcium.mode", "\"transient\"", "with protocol.kind = \"paper\""},
      {beating({}), "protocol.filling_ramp", "\"0.2 s\"", "with engine = \"immersed\""},
      {static_engine, "activation.v_f", "\"1 m/s\"", "with protocol.kind = \"cycle\""},
      {beating({}), "activation.v_f", "\"1 m/s\"", "with activation.kind = \"eikonal\""},
      {beating({}), "cycle.spectral_radius", "0.8", "with cycle.inertia = true"},
      {{}, "passive.guccione.C", "\"1 kPa\"", "with passive.law = \"guccione\""},
      {{}, "active.tension", "\"50 kPa\"", "with active.law = \"second_piola\" or \"cauchy\""},
      {second_piola, "active.T_scale", "3", "with active.law = \"niederer\""},
      {{}, "anatomy.labels.cavity", "[1]", "with anatomy.source = \"labels\""},
      {given_mesh, "anatomy.ellipsoid.endo_radius", "\"20 mm\"", "anatomy.source = \"ellipsoid\""},
      {{}, "anatomy.contours.margin", "\"4 mm\"", "for a wall that is drawn"},
      {{}, "infarct.stiffening", "9", "with an infarct"},
      {{}, "infarct.described.width", "\"90 deg\"", "with infarct.source = \"described\""},
      {lge_scar, "infarct.shift", "[\"1 mm\", \"0 mm\", \"0 mm\"]", ""},
      {{}, "coupling.points_per_cell", "2", "with coupling.kind = \"quadrature\""},
      {{{"calcium.mode", "\"transient\""}},
       "protocol.contraction_drag",
       "\"1 1/s\"",
       "with calcium.mode = \"hold\""},
      {{}, "calibrate.tolerance", "0.02", "with a fit"},
      {{}, "unloaded.iterations", "10", "with unloaded.pressure above 0"},
      {{}, "strain.margin", "\"5 mm\"", "with the images of strain.cine"},
      {{}, "strain.measured_kind", "\"engineering\"", "with strain.measured"}};
  for (const Row& row : rows) {
    INFO(row.name);
    const std::string message = refusal(row.base, row.name, row.value);
    if (row.reason.empty())
      CHECK(message.empty());
    else
      CHECK_THAT(message, Catch::Contains(row.name + " does nothing here: it counts only ") &&
                              Catch::Contains(row.reason) && Catch::Contains("Remove this line"));
  }
}

TEST_CASE("mistakes are told in the order of their lines, and twenty at most",
          "[unit][case_file]") {
  std::string text = "zebra = 1\n";
  for (int i = 0; i < 30; ++i)
    text += fmt::format("aardvark_{} = 1\n", i);
  try {
    (void)case_file::parse_case(text, "case.toml");
    FAIL("nothing was refused");
  } catch (const InputError& error) {
    const std::string what = error.what();
    CHECK(what.find("zebra is not") < what.find("aardvark_0 is not"));
    CHECK(what.find("aardvark_2 is not") < what.find("aardvark_10 is not"));
    CHECK_THAT(what, Catch::Contains("aardvark_18 is not") &&
                         !Catch::Contains("aardvark_19 is not") &&
                         Catch::Contains("and 11 more mistakes"));
  }
}

TEST_CASE("of calcium without a transient nothing more is told", "[unit][case_file]") {
  try {
    (void)case_file::parse_case(
        "engine = \"quasi_static\"\nprotocol.kind = \"cycle\"\nactive.law = \"land2017\"\n"
        "circulation.kind = \"windkessel\"\ncalcium.Ca_max = \"0.1 uM\"\n"
        "calcium.Ca_0 = \"0.1 uM\"\n",
        "case.toml");
    FAIL("nothing was refused");
  } catch (const InputError& error) {
    CHECK_THAT(error.what(), Catch::Contains("case.toml:5: calcium.Ca_max must be larger") &&
                                 !Catch::Contains("nan"));
  }
}

TEST_CASE("a mesh that is asked for and not made is warned of", "[unit][case_file]") {
  const auto warned = [](const Lines& base, const std::string& name, const std::string& value) {
    return parsed(with(base, name, value)).without_effect;
  };
  CHECK(warned({}, "mesh.edge_length", "\"2 mm\"").empty());
  REQUIRE(warned(static_engine, "mesh.edge_length", "\"2 mm\"").size() == 1);
  CHECK_THAT(warned(static_engine, "mesh.edge_length", "\"2 mm\"").front(),
             Catch::Contains("mesh.edge_length does nothing here") &&
                 Catch::Contains("with quasi_static.order = 1"));
  REQUIRE(warned(given_mesh, "mesh.layers", "4").size() == 1);
  CHECK_THAT(warned(given_mesh, "mesh.layers", "4").front(),
             Catch::Contains("of every anatomy.source but \"mesh\""));
}

TEST_CASE("the record of a stage changes with whatever the stage sees, and with nothing else",
          "[unit][case_file]") {
  for (const Lines& base : bases()) {
    const Case before = parsed(base);
    const auto records = by_stage(before, record);
    const auto seen_before = by_stage(before, seen);
    for (const Parameter& p : case_file::parameters()) {
      if (base.contains(p.name) || *p.words != '\0' || p.text == case_file::Text::perhaps_path)
        continue;  // choices change which parameters count; what may name a file is one
      if (!refusal(base, p.name, other_value(p, before)).empty())
        continue;
      const Case after = parsed(with(base, p.name, other_value(p, before)));
      for (const auto& [stage, recorded] : records) {
        if (!case_file::has_stage(before, stage))
          continue;
        INFO(p.name << ", stage " << lv::stage_names.at(static_cast<std::size_t>(stage)));
        const bool sees = seen_before.at(stage) != seen(after, stage);
        const bool may_differ = sees && p.changes_results;
        if (p.text != case_file::Text::path)  // whose files count, not their names
          CHECK(may_differ == (recorded != record(after, stage)));
      }
    }
  }
}

TEST_CASE("that a parameter is set is in the record of the stages that may ask, and of no other",
          "[unit][case_file]") {
  std::set<std::string> untried;
  for (const Parameter& p : case_file::parameters())
    if (p.whether_set_counts || !p.remark_whether_set.empty())
      untried.insert(p.name);
  CHECK(untried.size() >= 3);
  for (const Lines& base : bases()) {
    const Case silent = parsed(base);
    const auto records = by_stage(silent, record);
    for (const Parameter& p : case_file::parameters()) {
      const bool may_be_said = !base.contains(p.name) && counts_only(p, silent).empty() &&
                               refusal(base, p.name, p.get(silent)).empty();
      if (!may_be_said)
        continue;
      const Case said = parsed(with(base, p.name, p.get(silent)));
      CHECK_FALSE(is_set(silent, p.name, Stage::results));
      CHECK(is_set(said, p.name, Stage::results));
      CHECK(record(silent, Stage::results) != record(said, Stage::results));
      for (const auto& [stage, recorded] : records) {
        const bool is_remark = p.remark_whether_set.contains(stage);
        const bool may_ask = counts(p, silent, stage) && (p.whether_set_counts || is_remark);
        INFO(p.name << ", stage " << lv::stage_names.at(static_cast<std::size_t>(stage)));
        CHECK(may_ask == (recorded != record(said, stage)));
        if (is_remark)
          CHECK(work::fingerprint_of_result(recorded) ==
                work::fingerprint_of_result(record(said, stage)));
        if (may_ask)
          untried.erase(p.name);
      }
    }
  }
  CHECK(untried == std::set<std::string>{});
}

TEST_CASE("the name of the case file is in no record, the lines of what it sets are",
          "[unit][case_file]") {
  const std::string text = "[protocol]\nes_pressure = \"150 mmHg\"\n";
  const auto named = [&](const char* file, const std::string& before) {
    return record(case_file::parse_case(before + text, file), Stage::results);
  };
  CHECK(named("study/heart.toml", "") == named("elsewhere/link.toml", ""));
  CHECK(named("heart.toml", "") != named("heart.toml", "\n"));
  const Case c = case_file::parse_case(text, "study/heart.toml");
  CHECK(work::place_alone(c, c.origin.at("protocol.es_pressure")) == "line 2");
  CHECK(work::place_alone(c, "study/heart.work/02b_calibrate/calibrated.toml") ==
        "calibrated.toml");
}

TEST_CASE("the pressure's error is at most half of a small pressure, unless it is set",
          "[unit][case_file]") {
  const Lines small{{"calibrate.passive", "\"klotz\""},
                    {"unloaded.pressure", "\"5 mmHg\""},
                    {"protocol.ed_pressure", "\"5 mmHg\""}};
  const auto error = [](const Lines& lines) {
    return parsed(lines).calibration.pressure_error / units::mmHg;
  };
  CHECK(error(small) == Approx(2.5));
  CHECK(error(with(small, "calibrate.pressure_error", "\"3 mmHg\"")) == Approx(3.0));
  CHECK(parsed({}).calibration.pressure_error / units::mmHg == Approx(4.0));
}

TEST_CASE("the anatomy sees whether its shape bears a pressure, of which it warns",
          "[unit][case_file]") {
  CHECK_FALSE(is_loaded(work::stage_view(parsed({}), Stage::anatomy)));
  const Case loaded = parsed({{"unloaded.pressure", "\"8 mmHg\""}});
  CHECK(is_loaded(work::stage_view(loaded, Stage::anatomy)));
}

TEST_CASE("a number that a stage does not read is no number there", "[unit][case_file]") {
  const Case c = parsed({});
  CHECK(std::isnan(work::stage_view(c, Stage::mesh).protocol.es_pressure));
  CHECK(std::isnan(work::stage_view(c, Stage::beat).anatomy.ellipsoid.endo_radius));
  CHECK(work::stage_view(c, Stage::results).protocol.es_pressure == c.protocol.es_pressure);
}

TEST_CASE("the results' record holds names of files without folders, and lines of the case file",
          "[unit][case_file]") {
  const Lines lines{{"strain.measured", "\"/home/anna/measured.csv\""},
                    {"strain.measured_column", "\"es\""}};
  const work::Ingredients all = record(parsed(lines), Stage::results);
  CHECK(all.at("strain.measured") == "\"measured.csv\"");
  CHECK(all != record(parsed(with(lines, "active.T_scale", "3.0")), Stage::results));
}

// What the stages' functions make of a case, as numbers.
namespace {

using Numbers = std::vector<double>;

Numbers anatomy_of(const Case& c) {
  Numbers numbers;
  const anatomy::Shape shape = anatomy::make_anatomy(c);
  for (const double u : {0.0, 0.3, 0.7, 1.0})
    for (const double t : {0.0, 1.0}) {
      const Vec3 x = shape.wall(u, 0.4, t);
      numbers.insert(numbers.end(), x.begin(), x.end());
    }
  return numbers;
}

Numbers mesh_of(const Case& shown, const Case& c) {
  const anatomy::MeshResult made = pipeline::make_mesh(c, anatomy::make_anatomy(shown));
  Numbers numbers;
  for (const Vec3& X : made.mesh.nodes)
    numbers.insert(numbers.end(), X.begin(), X.end());
  numbers.insert(numbers.end(), made.mesh.infarct.begin(), made.mesh.infarct.end());
  numbers.insert(numbers.end(), made.infarcted.begin(), made.infarcted.end());
  for (const auto* regions : {&made.regions.slice, &made.regions.sector, &made.regions.aha})
    numbers.insert(numbers.end(), regions->begin(), regions->end());
  const analysis::FieldAnalysis analysis(made.mesh, {});
  for (const analysis::CellFields& cell : analysis.at_rest())
    numbers.insert(numbers.end(), cell.fibre_frame.data(), cell.fibre_frame.data() + 9);
  if (c.scar.source == mesh::InfarctSource::described)
    for (const double grams : scar::infarct_table(c, made).numbers("infarct_g"))
      numbers.push_back(grams);
  return numbers;
}

void add_muscle(const Case& c, Numbers& numbers) {
  const material::Myocardium wall = case_file::myocardium(c);
  Tensor<double> F = Mat3::Identity();
  F << 1.1, 0.05, -0.02, 0.03, 0.95, 0.04, 0.01, 0.02, 0.97;
  for (const Tensor<double>& stretched : {F, Tensor<double>(F.inverse())}) {  // fibres, then sheets
    const Mat3 P =
        std::visit([&](const auto& law) { return Mat3(law.stress(stretched)); }, wall.passive);
    numbers.insert(numbers.end(), P.data(), P.data() + 9);
  }
  numbers.push_back(wall.infarct.passive(0.5));
  numbers.push_back(static_cast<double>(wall.active_form));
  if (const auto* prescribed = std::get_if<material::PrescribedTension>(&wall.active))
    numbers.push_back(prescribed->T_max);
  numbers.push_back(static_cast<double>(c.base.kind));
  const solid::Surroundings surroundings = case_file::cardiac_model(c).surroundings;
  for (const solid::Support& s : {surroundings.epicardium, surroundings.base}) {
    numbers.insert(numbers.end(), {s.normal_stiffness, s.tangential_stiffness, s.normal_viscosity,
                                   s.tangential_viscosity});
    for (const double h : {0.0, 0.1, 0.3, 1.0})
      numbers.push_back(s.weight.at(h));
  }
}

Numbers static_muscle_of(const Case& c) {
  Numbers numbers;
  add_muscle(c, numbers);
  const implicit::StaticModel model = case_file::static_model(c);
  for (const double stretch : {0.7, 0.9, 1.05, 1.2})
    for (const double activation : {0.0, 0.6})
      numbers.push_back(model.contractility.at(stretch, activation).value);
  numbers.insert(numbers.end(), {model.compressibility.kappa, model.heart.myocardium.viscosity.eta,
                                 model.density});
  const implicit::SolverParameters& solver = c.quasi_static.solver;
  numbers.insert(numbers.end(), {model.stabilisation.beta_s, solver.first_step,
                                 solver.newton.tolerance, solver.newton.linear.tolerance});
  return numbers;
}

Numbers static_beat_of(const Case& c) {
  Numbers numbers = static_muscle_of(c);
  const heartbeat::Protocol& p = c.protocol;
  numbers.insert(numbers.end(), {p.ed_pressure, p.es_pressure, p.filling_ramp, p.contraction_ramp,
                                 c.output.frame_interval});
  if (p.kind == heartbeat::ProtocolKind::cycle) {
    const activation::Speeds& v = c.activation.speeds;
    numbers.insert(numbers.end(), {p.cycle.spectral_radius, v.v_f, v.v_s, v.v_n, v.endocardium,
                                   static_cast<double>(c.activation.sites.size())});
  }
  return numbers;
}

void add_kinetics(const Case& c, Numbers& numbers) {
  if (c.active_law == case_file::ActiveChoice::niederer)
    for (const double rate : {-5.0, 0.0, 20.0}) {
      material::Sarcomere<double> state = c.active.steady_state(1.0, 0.7 + 0.01 * rate);
      for (int step = 1; step <= 20; ++step)
        c.active.advance(state, state.stretch + 1e-3 * rate, 0.5, 1.0, 1e-3);
      numbers.insert(numbers.end(), {state.tension, state.z, state.Ca_trpn, state.Q[0]});
    }
  if (c.active_law == case_file::ActiveChoice::land2017)
    for (const double rate : {-5.0, 20.0}) {
      material::CrossBridges<double> state = c.land2017.steady_state(0.3, 1.0);
      for (int step = 1; step <= 20; ++step)
        c.land2017.advance(state, state.stretch + 1e-3 * rate, 0.5, 1.0, 1e-3);
      numbers.insert(numbers.end(), {state.tension, state.B, state.CaTRPN});
    }
}

/// What a fit of heartbeats runs.
Numbers fitted_beats_of(const Case& c) {
  Numbers numbers = static_muscle_of(c);
  add_kinetics(c, numbers);
  const heartbeat::Protocol& p = c.protocol;
  for (const double time : {0.01, 0.05, 0.15})
    numbers.push_back(p.calcium.at(time));
  const activation::Speeds& v = c.activation.speeds;
  const circulation::WindkesselParameters& w = c.circulation.windkessel;
  const circulation::ValveParameters& valves = c.circulation.valves;
  numbers.insert(numbers.end(), {static_cast<double>(p.cycle.beats),
                                 p.cycle.tolerance,
                                 p.cycle.step,
                                 p.cycle.spectral_radius,
                                 v.v_f,
                                 v.v_s,
                                 v.v_n,
                                 v.endocardium,
                                 w.R_mv,
                                 w.R_ao,
                                 w.R_c,
                                 w.R_p,
                                 w.C,
                                 w.p_ven,
                                 valves.closed_resistance,
                                 valves.smoothing,
                                 c.circulation.period,
                                 c.circulation.start.p_ar_sys,
                                 c.calibration.edv,
                                 c.calibration.esv,
                                 c.calibration.cuff_systolic,
                                 c.calibration.cuff_diastolic,
                                 c.calibration.factor.low,
                                 c.calibration.factor.high,
                                 c.calibration.tolerance});
  return numbers;
}

Numbers immersed_beat_of(const Case& c) {
  Numbers numbers;
  add_muscle(c, numbers);
  const material::Myocardium wall = case_file::myocardium(c);
  numbers.insert(numbers.end(), {wall.volumetric.beta_s, wall.stabilisation.beta_s});
  const heartbeat::Protocol& p = c.protocol;
  for (const heartbeat::Phase& phase : heartbeat::phases(p)) {
    numbers.insert(numbers.end(), {phase.drag, phase.settled});
    for (const double time : {0.01, 0.05, 0.15, 1.0}) {
      const solid::Loads loads = phase.loads(time);
      numbers.insert(numbers.end(), {loads.pressure, loads.calcium, loads.activation});
    }
  }
  add_kinetics(c, numbers);
  mesh::Mesh point;
  point.nodes = {Vec3::Zero()};
  const immersed::ModelParameters model = case_file::model_parameters(c, point);
  const Vec3& h = model.grid.spacing;
  const Vec3& lower = model.grid.lower;
  numbers.insert(numbers.end(), h.begin(), h.end());
  numbers.insert(numbers.end(), lower.begin(), lower.end());
  numbers.insert(
      numbers.end(),
      {model.blood.density, model.blood.viscosity, model.coupling.points_per_cell,
       case_file::cardiac_model(c).base.stiffness, p.filling_tolerance, p.filling_window,
       p.filling_longest, p.contraction_tolerance, p.contraction_window, p.contraction_longest,
       c.time.longest, c.time.courant, c.time.velocity_limit, static_cast<double>(c.time.halvings),
       c.output.frame_interval, c.output.curve_interval, c.output.checkpoint_interval,
       c.output.blood ? 1.0 : 0.0});
  return numbers;
}

/// A beat of the circuit by itself, and how long it would beat.
Numbers circuit_of(const Case& c) {
  circulation::CircuitParameters circuit = c.circulation;
  Numbers numbers{static_cast<double>(circuit.beats), circuit.tolerance};
  circuit.beats = 1;
  for (const circulation::Sample& sample : circulation::run_alone(circuit).samples) {
    const circulation::Signals& seen = sample.signals;
    numbers.insert(numbers.end(), {sample.time, seen.volume, seen.pressure, seen.aortic_pressure});
    numbers.insert(numbers.end(), seen.others.begin(), seen.others.end());
  }
  return numbers;
}

/// Everything of a case without files, from the whole case or from what each stage sees.
Numbers computed(const Case& c, bool by_views) {
  const auto seen_by = [&](Stage stage) { return by_views ? work::stage_view(c, stage) : c; };
  Numbers numbers = anatomy_of(seen_by(Stage::anatomy));
  const auto add = [&](const Numbers& more) {
    numbers.insert(numbers.end(), more.begin(), more.end());
  };
  add(mesh_of(seen_by(Stage::anatomy), seen_by(Stage::mesh)));
  if (has_stage(c, Stage::circulation))
    add(circuit_of(seen_by(Stage::circulation)));
  const Case beat = seen_by(Stage::beat);
  add(c.engine == case_file::EngineChoice::immersed ? immersed_beat_of(beat)
                                                    : static_beat_of(beat));
  if (c.calibration.cycle)
    add(fitted_beats_of(pipeline::for_calibration(seen_by(Stage::calibrate))));
  if (!is_loaded(c))
    return numbers;
  const Case unload = pipeline::for_calibration(seen_by(Stage::unload));
  add(mesh_of(seen_by(Stage::anatomy), unload));
  add(static_muscle_of(unload));
  return numbers;
}

/// What is computed, or what stands for the reason why it cannot be.
Numbers outcome(const Case& c, bool by_views) {
  try {
    return computed(c, by_views);
  } catch (const RunError& failure) {
    return {static_cast<double>(std::hash<std::string>{}(failure.what()))};
  }
}

/// Bit for bit, where even what is not a number is itself.
bool same(const Numbers& a, const Numbers& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

const Lines coarse{{"mesh.edge_length", "\"9 mm\""}};

std::vector<Lines> cases_without_files() {
  std::vector<Lines> all{
      coarse,
      with(coarse, "coupling.kind", "\"quadrature\""),
      with(coarse, "active.law", "\"cauchy\""),
      with(with(coarse, "active.law", "\"land2017\""), "calcium.shape", "\"double_exponential\""),
      with(coarse, "calcium.mode", "\"transient\""),
      with(coarse, "infarct.source", "\"described\""),
      with(coarse, "unloaded.pressure", "\"2 mmHg\""),
      with(with(coarse, "infarct.source", "\"described\""), "unloaded.pressure", "\"2 mmHg\"")};
  for (const char* law : {"guccione", "neo_hookean"})
    all.push_back(with(coarse, "passive.law", fmt::format("\"{}\"", law)));
  Lines quasi_static = with(static_engine, "quasi_static.edge_length", "\"18 mm\"");
  all.push_back(quasi_static);
  all.push_back(with(quasi_static, "infarct.source", "\"described\""));
  all.push_back(with(quasi_static, "active.law", "\"second_piola\""));
  all.push_back(with(quasi_static, "active.law", "\"land2017\""));
  all.push_back(with(quasi_static, "quasi_static.linear_solver", "\"iterative\""));
  all.push_back(beating({{"quasi_static.edge_length", "\"18 mm\""},
                         {"base.support", "\"elastic\""},
                         {"base.tangential_stiffness", "\"1 kPa/mm\""},
                         {"base.normal_stiffness", "\"2 kPa/mm\""},
                         {"pericardium.normal_stiffness", "\"3 kPa/mm\""},
                         {"pericardium.weight", "\"sigmoid\""},
                         {"activation.kind", "\"eikonal\""},
                         {"cycle.inertia", "true"}}));
  for (const char* law : {"niederer", "land2017"})
    all.push_back(beating({{"quasi_static.edge_length", "\"18 mm\""},
                           {"active.law", fmt::format("\"{}\"", law)},
                           {"activation.kind", "\"eikonal\""},
                           {"cycle.inertia", "true"},
                           {"calibrate.cycle", "true"},
                           {"calibrate.edv", "\"120 ml\""}}));
  all.push_back(
      with(with(static_engine, "quasi_static.order", "1"), "mesh.edge_length", "\"9 mm\""));
  for (const char* law : {"quadratic", "arctangent"})
    all.push_back(with(with(coarse, "circulation.kind", "\"closed_loop\""),
                       "circulation.valves.law", fmt::format("\"{}\"", law)));
  for (const Lines& immersed : {beating_immersed, held_immersed})
    all.push_back(with(immersed, "mesh.edge_length", "\"9 mm\""));
  return all;
}

/// Parameters of files and images, fits, tables, heartbeats and segments, which have tests of their
/// own; one that is a choice in effect; and two of an infarct, which change by less than a coarse
/// element.
bool is_tried_elsewhere(const std::string& name) {
  static const std::vector<std::string> tables{"anatomy.contours.",
                                               "anatomy.labels.",
                                               "anatomy.sunnybrook.",
                                               "anatomy.guide_points.",
                                               "anatomy.contour_file.",
                                               "anatomy.surfaces.",
                                               "anatomy.mesh.",
                                               "segment.",
                                               "infarct.elements.",
                                               "infarct.surface.",
                                               "infarct.labels.",
                                               "infarct.lge.",
                                               "infarct.strain.",
                                               "infarct.shift",
                                               "infarct.length_unit",
                                               "calibrate.",
                                               "cycle.beats",
                                               "cycle.tolerance",
                                               "cycle.step",
                                               "cycle.leap",
                                               "cycle.begin",
                                               "circulation.closed_loop.blood",
                                               "activation.sites",
                                               "activation.file",
                                               "activation.array",
                                               "activation.time_unit",
                                               "base.motion_",
                                               "strain.",
                                               "study.",
                                               "unloaded.",
                                               "muscle.contractility",
                                               "septum.",
                                               "quasi_static.order",
                                               "infarct.described.angle",
                                               "infarct.described.bottom"};
  return std::any_of(tables.begin(), tables.end(),
                     [&](const std::string& table) { return name.starts_with(table); });
}

}  // namespace

TEST_CASE("what a stage sees of a case is all that its functions read", "[unit][case_file]") {
  for (const Lines& base : cases_without_files()) {
    Lines all = base;  // every number that counts is another one than the default
    const Case c = parsed(base);
    for (const Parameter& p : case_file::parameters())
      if (*p.words == '\0' && p.text != case_file::Text::path && counts_somewhere(p, c) &&
          !is_tried_elsewhere(p.name) && refusal(all, p.name, other_value(p, c)).empty())
        all[p.name] = other_value(p, c);
    INFO(text_of(base));
    const Case changed = parsed(all);
    CHECK(all.size() > base.size() + 25);
    CHECK(same(outcome(changed, true), outcome(changed, false)));
  }
}

TEST_CASE("every number that is declared changes what a stage computes", "[unit][case_file]") {
  std::set<std::string> idle;
  for (const Parameter& p : case_file::parameters())
    if (*p.words == '\0' && std::string(p.name) != "name" && !is_tried_elsewhere(p.name))
      idle.insert(p.name);
  for (const Lines& base : cases_without_files()) {
    const Case c = parsed(base);
    const Numbers before = outcome(c, true);
    for (const Parameter& p : case_file::parameters()) {
      if (!idle.contains(p.name) || !counts_somewhere(p, c) ||
          !refusal(base, p.name, other_value(p, c)).empty())
        continue;
      if (!same(before, outcome(parsed(with(base, p.name, other_value(p, c))), true)))
        idle.erase(p.name);
    }
  }
  CHECK(idle == std::set<std::string>{});
}
