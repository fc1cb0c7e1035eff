#include "lv/case_file/family.hpp"

#include "lv/case_file/read_case.hpp"
#include "lv/circulation/circuit.hpp"
#include "lv/circulation/heart_rate.hpp"

#include <fmt/format.h>

namespace lv::case_file {
namespace {

using circulation::Factors;

/// The list of a study that one of the factors is from, and what it multiplies.
struct Lever {
  const char* name;  ///< of the list
  double Factors::*factor;
  std::vector<double> Study::*list;
};

constexpr Lever preload{"preload", &Factors::preload, &Study::preload};
constexpr Lever afterload{"afterload", &Factors::afterload, &Study::afterload};
constexpr Lever contractility{"contractility", &Factors::contractility, &Study::contractility};
constexpr Lever heart_rate{"heart_rate", &Factors::heart_rate, &Study::heart_rate};

/// The factors themselves, and those with each value of two lists.
std::vector<Factors> with_each(const Factors& from, const Study& study, const Lever& one,
                               const Lever& other) {
  std::vector<Factors> all{from};
  for (const Lever& lever : {one, other})
    for (const double value : study.*lever.list) {
      all.push_back(from);
      all.back().*lever.factor = value;
    }
  return all;
}

std::string name_of(const Factors& factors) {
  std::vector<std::string> parts;
  for (const Lever& lever : {contractility, heart_rate, preload, afterload})
    if (const double value = factors.*lever.factor; value != 1.0)
      parts.push_back(fmt::format("{}_{:g}", lever.name, value));
  return parts.empty() ? "case" : fmt::format("{}", fmt::join(parts, "_"));
}

/// What a factor multiplies in a case, and by how much.
std::pair<const char*, double> target(const Lever& lever, double factor, const Case& c) {
  if (lever.factor == preload.factor)
    return {levers(c).filling, factor};
  if (lever.factor == afterload.factor)
    return {levers(c).resistance, factor};
  if (lever.factor == contractility.factor)
    return {levers(c).contractility, factor};
  return {"circulation.period", 1.0 / factor};
}

}  // namespace

Levers levers(const Case& c) {
  const char* contractility =
      c.active_law == ActiveChoice::land2017 ? "active.land2017.T_ref" : "active.T_scale";
  if (c.circulation.kind == circulation::Kind::closed_loop)
    return {"circulation.closed_loop.blood", "circulation.closed_loop.systemic.R_ar",
            "circulation.closed_loop.systemic.C_ar", contractility};
  return {"circulation.windkessel.p_ven", "circulation.windkessel.R_p", "circulation.windkessel.C",
          contractility};
}

Case with_blood_around(double volume, Case c) {
  circulation::CircuitParameters& p = c.circulation;
  if (p.kind != circulation::Kind::closed_loop || p.closed_loop.blood > 0.0)
    return c;
  circulation::Circuit circuit(p);
  circuit.start_around(volume);
  p.closed_loop.blood = circuit.blood();
  return c;
}

std::vector<Member> family(const Study& study) {
  std::vector<Member> members;
  for (const Factors& state : with_each({}, study, contractility, heart_rate))
    for (const Factors& factors : with_each(state, study, preload, afterload))
      members.push_back({name_of(factors), factors});
  return members;
}

Case under(const Factors& factors, Case c) {
  if (factors.preload != 1.0)
    c = with_blood_around(c.circulation.start.V_lv, c);
  c.circulation =
      circulation::with_times_at(c.circulation.period / factors.heart_rate, c.circulation);
  std::vector<Change> changes;
  for (const Lever& lever : {preload, afterload, contractility, heart_rate}) {
    if (factors.*lever.factor == 1.0)
      continue;
    const auto [parameter, factor] = target(lever, factors.*lever.factor, c);
    changes.push_back({parameter, factor, place_of(c, fmt::format("study.{}", lever.name))});
  }
  c.study = {};
  c.calibration = {};
  std::erase_if(c.origin, [](const auto& set) {
    return set.first.starts_with("study.") || set.first.starts_with("calibrate.");
  });
  return changed(c, changes);
}

}  // namespace lv::case_file
