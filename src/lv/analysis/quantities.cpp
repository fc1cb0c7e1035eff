#include "lv/analysis/quantities.hpp"

#include "lv/base/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::analysis {
namespace {

using Cell = const CellFields&;
using Strain = const CellStrain&;

constexpr double strain_floor = 0.005;
constexpr double stress_floor = 0.1;  // [kPa]
constexpr const char* strain_help =
    "Green-Lagrange strain; up to end-diastole from early diastole (or the wall without load, "
    "where that was sought), after it from end-diastole. Negative: shorter.";
constexpr const char* radial_help =
    "Green-Lagrange strain; up to end-diastole from early diastole (or the wall without load, "
    "where that was sought), after it from end-diastole. Negative: shorter. Positive across the "
    "wall: thicker.";

constexpr Quantity shown_strain(const char* name, const char* title, double (*of)(Cell, Strain),
                                const char* field, const char* help = strain_help) {
  return {name, title, "1", of, field, true, true, true, 0.0, strain_floor, help};
}

constexpr Quantity shown_stress(const char* name, const char* title, double (*of)(Cell, Strain),
                                const char* help) {
  return {name, title, "kPa", of, name, false, true, false, 0.0, stress_floor, help};
}

/// In regions.csv; `field` is empty for those that the VTU files do not hold.
constexpr Quantity other(const char* name, const char* title, const char* unit,
                         double (*of)(Cell, Strain), const char* field) {
  return {name, title, unit, of, field};
}

constexpr std::array<Quantity, 18> list{
    shown_stress(
        "active_tension", "active tension", [](Cell c, Strain) { return c.tension; },
        "Tension T along the fibre that the muscle makes."),
    shown_stress(
        "fibre_stress", "fibre stress", [](Cell c, Strain) { return c.fibre_stress(); },
        "Total Cauchy stress along the deformed fibre: passive and active, less the pressure p of "
        "the incompressible wall (in regions.csv fibre_stress = fibre_stress_passive + "
        "fibre_stress_active - pressure)."),
    shown_stress(
        "fibre_stress_passive", "passive fibre stress",
        [](Cell c, Strain) { return c.fibre_stress_passive; },
        "The passive law's share of the Cauchy stress along the fibre, without the pressure."),
    other(
        "fibre_stress_active", "active fibre stress", "kPa",
        [](Cell c, Strain) { return c.fibre_stress_active; }, "fibre_stress_active"),
    other(
        "fibre_stretch", "fibre stretch", "1", [](Cell c, Strain) { return c.fibre_stretch; },
        "fibre_stretch"),
    shown_strain(
        "fibre_strain", "fibre strain", [](Cell, Strain e) { return e.fibre; }, "E_fibre"),
    shown_strain(
        "circumferential_strain", "circumferential strain",
        [](Cell, Strain e) { return e.circumferential; }, "E_circumferential"),
    shown_strain(
        "radial_strain", "radial strain", [](Cell, Strain e) { return e.radial; }, "E_radial",
        radial_help),
    shown_strain(
        "longitudinal_strain", "longitudinal strain", [](Cell, Strain e) { return e.longitudinal; },
        "E_longitudinal"),
    other(
        "circumferential_radial_strain", "circumferential-radial shear", "1",
        [](Cell, Strain e) { return e.circumferential_radial; }, ""),
    other(
        "circumferential_longitudinal_strain", "circumferential-longitudinal shear", "1",
        [](Cell, Strain e) { return e.circumferential_longitudinal; }, ""),
    other(
        "radial_longitudinal_strain", "radial-longitudinal shear", "1",
        [](Cell, Strain e) { return e.radial_longitudinal; }, ""),
    other(
        "thickening", "thickening", "1", [](Cell, Strain e) { return e.thickening; }, ""),
    Quantity{"J", "volume ratio J", "1", [](Cell c, Strain) { return c.J; }, "J", false, true, true,
             1.0, 0.0005,
             "Deformed over undeformed volume; muscle is nearly incompressible, so anything but 1 "
             "is the model's error."},
    other(
        "pressure", "pressure p", "kPa", [](Cell c, Strain) { return c.pressure; }, "pressure"),
    Quantity{"activation_time", "activation time", "ms",
             [](Cell c, Strain) { return 1e3 * c.activation_time; }, "activation_time", false, true,
             false, 0.0, 0.0, "How long after the beginning of a beat's calcium it rises here."},
    Quantity{"work_density", "work density of the muscle", "kPa",
             [](Cell c, Strain) { return c.work_density; }, "work_density", false, true, true, 0.0,
             stress_floor,
             "Work that active tension did over the last heartbeat, by the undeformed volume (kPa "
             "= mJ/ml): the area of its loop of stress and stretch. Negative: stretched while it "
             "was tense."},
    Quantity{"contractility", "factor of contractility", "1",
             [](Cell c, Strain) { return c.contractility; }, "contractility", false, true, true,
             1.0, 0.005,
             "By what the active tension of each AHA segment is multiplied: as the case says, or "
             "fitted from strain where muscle.contractility is marked as fitted."}};

constexpr Quantity infarct{"infarct",
                           "infarct M",
                           "1",
                           nullptr,
                           "",
                           false,
                           true,
                           false,
                           0.0,
                           0.005,
                           "Extent of the infarct: 1 in it, falling to 0 across the border zone; "
                           "it does not change with time."};

}  // namespace

const Quantity& infarct_extent() {
  return infarct;
}

std::string label(const Quantity& quantity) {
  const std::string title = quantity.title;
  return std::string_view(quantity.unit) == "1" ? title : title + " [" + quantity.unit + "]";
}

std::span<const Quantity> quantities() {
  return list;
}

bool is_known(const Quantity& quantity, std::span<const CellFields> cells) {
  return std::none_of(cells.begin(), cells.end(),
                      [&](Cell c) { return std::isnan(quantity.of(c, {})); });
}

const Quantity& quantity(std::string_view name) {
  const auto* found =
      std::find_if(list.begin(), list.end(), [&](const Quantity& q) { return q.name == name; });
  LV_CHECK(found != list.end());
  return *found;
}

}  // namespace lv::analysis
