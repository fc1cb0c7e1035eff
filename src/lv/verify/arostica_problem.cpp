#include "lv/base/check.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/table.hpp"
#include "lv/base/units.hpp"
#include "lv/verify/arostica.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace lv::verify {
namespace {

/// Which values of a constant make sense.
struct Rule {
  bool (*holds)(double);
  const char* words;
};
constexpr Rule any{[](double) { return true; }, ""};
constexpr Rule positive{[](double x) { return x > 0.0; }, "must be above 0"};
constexpr Rule not_negative{[](double x) { return x >= 0.0; }, "must be at least 0"};
constexpr Rule share{[](double x) { return x >= 0.0 && x <= 1.0; }, "must be from 0 to 1"};
constexpr Rule part{[](double x) { return x >= 0.0 && x < 1.0; }, "must be from 0 to less than 1"};
constexpr Rule count{[](double x) { return x >= 1.0 && x == std::trunc(x); },
                     "must be a whole number from 1 on"};

struct Constant {
  double* value;
  const char* unit;
  Rule rule;
};

std::map<std::string, Constant> constants_of(ArosticaConstants& c) {
  return {{"a", {&c.muscle.a, "kPa", not_negative}},
          {"b", {&c.muscle.b, "", positive}},
          {"a_f", {&c.muscle.a_f, "kPa", not_negative}},
          {"b_f", {&c.muscle.b_f, "", positive}},
          {"a_s", {&c.muscle.a_s, "kPa", not_negative}},
          {"b_s", {&c.muscle.b_s, "", positive}},
          {"a_fs", {&c.muscle.a_fs, "kPa", not_negative}},
          {"b_fs", {&c.muscle.b_fs, "", positive}},
          {"k", {&c.muscle.k, "", positive}},
          {"kappa", {&c.kappa, "kPa", positive}},
          {"share_at_points", {&c.share_at_points, "", part}},
          {"eta", {&c.eta, "kPa s", not_negative}},
          {"rho", {&c.rho, "kg/mm^3", not_negative}},
          {"k_epi", {&c.k_epi, "kPa/mm", not_negative}},
          {"c_epi", {&c.c_epi, "kPa s/mm", not_negative}},
          {"facet_edge", {&c.facet_edge, "mm", not_negative}},
          {"k_base", {&c.k_base, "kPa/mm", not_negative}},
          {"c_base", {&c.c_base, "kPa s/mm", not_negative}},
          {"helix_endo", {&c.helix_endo, "rad", any}},
          {"helix_epi", {&c.helix_epi, "rad", any}},
          {"sigma_0", {&c.drive.sigma_0, "kPa", not_negative}},
          {"a_max", {&c.drive.a_max, "1/s", any}},
          {"a_min", {&c.drive.a_min, "1/s", any}},
          {"t_sys", {&c.drive.t_sys, "s", any}},
          {"t_dias", {&c.drive.t_dias, "s", any}},
          {"gamma", {&c.drive.gamma, "s", positive}},
          {"sigma_pre", {&c.drive.sigma_pre, "kPa", not_negative}},
          {"sigma_mid", {&c.drive.sigma_mid, "kPa", not_negative}},
          {"alpha_pre", {&c.drive.alpha_pre, "1/s", any}},
          {"alpha_mid", {&c.drive.alpha_mid, "1/s", any}},
          {"t_sys_pre", {&c.drive.t_sys_pre, "s", any}},
          {"t_dias_pre", {&c.drive.t_dias_pre, "s", any}},
          {"edge_length", {&c.edge_length, "mm", positive}},
          {"layers", {&c.layers, "", count}},
          {"time_step", {&c.time_step, "s", positive}},
          {"end", {&c.end, "s", positive}},
          {"spectral_radius", {&c.spectral_radius, "", share}}};
}

double quantity_of(const std::string& text, const Constant& constant, const std::string& where) {
  try {
    const units::Quantity quantity = units::parse_quantity(text);
    if (quantity.unit.dimension == units::parse_unit(constant.unit).dimension) {
      if (!constant.rule.holds(quantity.value))
        throw InputError(where, fmt::format("is {}; it {}", text, constant.rule.words), "");
      return quantity.value;
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(where, error.what(), "Write a number and its unit");
  }
  throw InputError(where, fmt::format("\"{}\" is no quantity of its kind", text),
                   fmt::format("Give it in {}",
                               *constant.unit != 0 ? constant.unit : "no unit: it is a number"));
}

/// The teams' mean and deviation, as far as they are known.
struct Teams {
  std::vector<ArosticaSample> mean, deviation;
};

void require_columns(const Table& table, const std::filesystem::path& file,
                     const std::vector<std::string>& names) {
  const auto& there = table.columns();
  for (const std::string& name : names)
    if (std::find(there.begin(), there.end(), name) == there.end())
      throw InputError(file.string(), fmt::format("has no column \"{}\"", name),
                       fmt::format("Its first line names {}", fmt::join(names, ",")));
}

/// Of one point: every row of a file of the benchmark's.
std::vector<Vec3> displacements(const Table& table, const std::string& what) {
  const auto x = table.numbers(what + "_x_mm");
  const auto y = table.numbers(what + "_y_mm");
  const auto z = table.numbers(what + "_z_mm");
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < x.size(); ++i)
    result.emplace_back(x[i], y[i], z[i]);
  return result;
}

Teams read_teams(const std::filesystem::path& folder, const std::string& name) {
  const auto read = [&](const char* point) {
    const std::filesystem::path file = folder / fmt::format("case_{}_{}.csv", name, point);
    Table table = Table::read_csv(file);
    require_columns(
        table, file,
        {"t_s", "mean_x_mm", "mean_y_mm", "mean_z_mm", "sd_x_mm", "sd_y_mm", "sd_z_mm"});
    return table;
  };
  const Table p0 = read("p0");
  const Table p1 = read("p1");
  const std::vector<double> times = p0.numbers("t_s");
  Teams teams;
  for (const auto& [what, to] :
       {std::pair("mean", &teams.mean), std::pair("sd", &teams.deviation)}) {
    const auto at_p0 = displacements(p0, what);
    const auto at_p1 = displacements(p1, what);
    for (std::size_t i = 0; i < std::min(at_p0.size(), at_p1.size()); ++i)
      to->push_back({times[i], at_p0[i], at_p1[i]});
  }
  return teams;
}

using AtPoint = Vec3 ArosticaSample::*;

const ArosticaSample* at_time(std::span<const ArosticaSample> samples, double time) {
  for (const ArosticaSample& s : samples)
    if (std::abs(s.time - time) < 1e-6)
      return &s;
  return nullptr;
}

/// Mean over the times of the means, from one on, of |u - mean|/|mean|.
double relative_error_difference(std::span<const ArosticaSample> mine,
                                 std::span<const ArosticaSample> means, AtPoint point,
                                 double from) {
  double sum = 0.0;
  int count = 0;
  for (const ArosticaSample& mean : means) {
    const ArosticaSample* here = at_time(mine, mean.time);
    if (mean.time < from - 1e-6 || here == nullptr || (mean.*point).norm() == 0.0)
      continue;
    sum += (here->*point - mean.*point).norm() / (mean.*point).norm();
    ++count;
  }
  return sum / count;
}

void write_histories(const std::filesystem::path& file, std::span<const ArosticaSample> mine,
                     const Teams& teams, AtPoint point) {
  Table table({"t_s", "x_mm", "y_mm", "z_mm", "mean_x_mm", "mean_y_mm", "mean_z_mm", "sd_x_mm",
               "sd_y_mm", "sd_z_mm"});
  for (const ArosticaSample& sample : mine) {
    std::vector<std::string> row{Table::number(sample.time)};
    for (const double u : sample.*point)
      row.push_back(Table::number(u));
    for (const auto& known : {teams.mean, teams.deviation}) {
      const ArosticaSample* there = at_time(known, sample.time);
      for (int d = 0; d < 3; ++d)
        row.push_back(there != nullptr ? Table::number((there->*point)[d]) : "");
    }
    table.add_row(std::move(row));
  }
  table.write_csv(file);
}

/// One of the benchmark's cases, and how far a team may be from the mean of all.
struct ArosticaCase {
  std::string name;
  ArosticaLoads loads;
  std::span<const ArosticaSample> means;
  double from;            ///< time from which teams are compared [s]
  double p0_red, p1_red;  ///< the teams' largest relative error difference
};

void solve_case(const ArosticaCase& which, Findings& found) {
  const std::filesystem::path file = found.scratch() / constants_file;
  const bool other = std::filesystem::exists(file);
  const ArosticaConstants constants = other ? ArosticaConstants::read(file) : ArosticaConstants{};
  Teams teams;  // before the run, which takes long
  if (!constants.teams.empty())
    teams = read_teams(constants.teams, which.name);
  else if (!other)
    teams.mean = {which.means.begin(), which.means.end()};
  const std::vector<ArosticaSample> mine = run_arostica(constants, which.loads);
  if (parallel::is_root()) {
    write_histories(found.scratch() / fmt::format("arostica_{}_p0.csv", which.name), mine, teams,
                    &ArosticaSample::p0);
    write_histories(found.scratch() / fmt::format("arostica_{}_p1.csv", which.name), mine, teams,
                    &ArosticaSample::p1);
  }
  const double lasted = mine.back().time;
  found.add("time that was reached", lasted, constants.end, 0.01, "s");
  if (teams.mean.empty())
    return;
  found.add_error(fmt::format("relative error difference at p0 from {} s on", which.from),
                  relative_error_difference(mine, teams.mean, &ArosticaSample::p0, which.from),
                  which.p0_red);
  found.add_error(fmt::format("relative error difference at p1 from {} s on", which.from),
                  relative_error_difference(mine, teams.mean, &ArosticaSample::p1, which.from),
                  which.p1_red);
  const ArosticaSample* mean = at_time(teams.mean, 0.48);
  const ArosticaSample* here = at_time(mine, 0.48);
  if (which.name == "1" && mean != nullptr && here != nullptr)
    found.add("p0's x at 0.48 s", here->p0.x(), mean->p0.x(), 1.0, "mm");
}

}  // namespace

ArosticaConstants ArosticaConstants::read(const std::filesystem::path& file) {
  const Table table = Table::read_csv(file);
  require_columns(table, file, {"constant", "value"});
  const auto names = table.words("constant");
  const auto values = table.words("value");
  ArosticaConstants result;
  auto known = constants_of(result);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string where = "constant " + names[i];
    if (names[i] == "teams") {
      result.teams = values[i];
      continue;
    }
    const auto found = known.find(names[i]);
    if (found == known.end()) {
      std::vector<std::string> all{"teams"};
      for (const auto& [name, constant] : known)
        all.push_back(name);
      throw InputError(where, "is not one of the benchmark's",
                       fmt::format("Known are {}", fmt::join(all, ", ")));
    }
    *found->second.value = quantity_of(values[i], found->second, where);
  }
  return result;
}

void arostica_0a(Findings& found) {
  solve_case({"0A", {.tension = true, .pressure = false}, teams_0a(), 0.16, 0.202, 0.329}, found);
}

void arostica_0b(Findings& found) {
  solve_case({"0B", {.tension = false, .pressure = true}, teams_0b(), 0.0, 0.316, 0.361}, found);
}

void arostica_1(Findings& found) {
  solve_case({"1", {.tension = true, .pressure = true}, teams_1(), 0.0, 0.183, 0.243}, found);
}

}  // namespace lv::verify
