#include "lv/base/check.hpp"
#include "lv/segment/segment.hpp"

#include "segment/agreement.hpp"
#include "segment/variations.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

using namespace lv;
using geometry::Side;

namespace {

/// A line of the table per moment; what is absent is "-".
void tell_found(const test::KnownCine& known, const segment::Segmentation& found) {
  for (const int frame : {known.end_diastole, known.end_systole}) {
    const geometry::Contours drawn =
        segment::contours_at(known.cine, found, static_cast<std::size_t>(frame));
    const geometry::Contours& truth = known.truth.at(frame);
    const test::Agreement endo = test::agreement(drawn, truth, Side::endo);
    const test::Agreement epi = test::agreement(drawn, truth, Side::epi);
    fmt::print("{:42} {} {:.3f} {:+6.1f}% {:6.3f} {:6.3f} {:5.2f} {:2}/{:<2}",
               frame == known.end_diastole ? known.name : "",
               frame == known.end_diastole ? "ED" : "ES", found.fall, 100.0 * endo.volume,
               endo.dice, endo.pooled, endo.distance, endo.missed, endo.loops);
    if (epi.loops > 0)
      fmt::print(" {:6.3f} {:5.2f} {:+6.1f}% {:6.3f}\n", epi.dice, epi.distance, 100.0 * epi.volume,
                 test::dice_of_muscle(drawn, truth));
    else
      fmt::print("      -     -       -      -\n");
  }
}

void tell_row(const test::KnownCine& known) {
  try {
    tell_found(known, segment::segment(known.cine, {}, known.name));
  } catch (const InputError& error) {
    fmt::print("{:42} refused: {}\n", known.name, error.what());
  }
}

int seeds() {
  const char* set = std::getenv("VENTRICLE_SEEDS");
  return set != nullptr ? std::atoi(set) : 3;
}

void tell_hypertrophic() {
  struct Kind {
    double wall, papillary, trabeculae;
  };
  for (int seed = 1; seed <= seeds(); ++seed)
    for (const auto& [wall, papillary, trabeculae] :
         {Kind{16.0, 5.0, 0.0}, Kind{18.0, 6.0, 0.0}, Kind{16.0, 5.0, 2.0}, Kind{18.0, 6.0, 3.0}}) {
      phantom::Scan scan = test::noisy_scan(static_cast<std::uint32_t>(seed));
      scan.field_of_view = 180;
      tell_row(test::phantom_study(
          fmt::format("wall {}, papillary {}, rim {}, seed {}", wall, papillary, trabeculae, seed),
          scan, test::hypertrophic(wall, papillary, trabeculae)));
    }
}

void tell_patients() {
  for (const auto& known : {test::patient("sunnybrook_SC-HF-I-1", "cine", 19, 8),
                            test::patient("sunnybrook_SC-HF-I-4", "dicom", 20, 7)})
    if (known)
      tell_row(*known);
}

/// A study as it is, and as another scanner would show it.
void tell_variations(const test::KnownCine& known) {
  tell_row(known);
  for (const auto& variations : {test::other_storage(), test::other_images()})
    for (const test::Variation& variation : variations) {
      test::KnownCine changed = known;
      variation.apply(changed);
      changed.name = variation.name;
      tell_row(changed);
    }
}

void tell_header() {
  fmt::print("{:42} at fall   volume   Dice pooled  [mm] missed   epi  [mm]  within muscle\n", "");
}

}  // namespace

TEST_CASE("a table of what segmentation makes of phantoms and patients", "[.][segment_table]") {
  tell_header();
  for (int seed = 1; seed <= seeds(); ++seed)
    for (const double trabeculae : {0.0, 4.0})
      for (const double pixel : {1.0, 1.4, 1.8}) {
        phantom::Scan scan = test::noisy_scan(static_cast<std::uint32_t>(seed));
        scan.pixel = pixel;
        scan.gap = seed % 2 == 0 ? 2.0 : 0.0;
        tell_row(test::phantom_study(
            fmt::format("phantom {}, pixel {}, gap {}, rim {}", seed, pixel, scan.gap, trabeculae),
            scan, trabeculae));
      }
  for (const double deviation : {0.7, 1.2})
    for (const double trabeculae : {0.0, 4.0}) {
      test::KnownCine known = test::phantom_study(
          fmt::format("phantom 1, blurred by {} mm, rim {}", deviation, trabeculae),
          test::noisy_scan(1), trabeculae);
      test::blur(known.cine, deviation);
      tell_row(known);
    }
  tell_patients();
}

TEST_CASE("a table of what segmentation makes of hypertrophic phantoms",
          "[.][segment_hypertrophic]") {
  tell_header();
  tell_hypertrophic();
}

TEST_CASE("a table of what segmentation makes of patients", "[.][segment_patients]") {
  tell_header();
  tell_patients();
}

TEST_CASE("a table of what segmentation makes of other scanners' images",
          "[.][segment_variations]") {
  tell_header();
  tell_variations(test::phantom_study("phantom 1", test::noisy_scan(1), 0.0));
  for (const auto& known : {test::patient("sunnybrook_SC-HF-I-1", "cine", 19, 8),
                            test::patient("sunnybrook_SC-HF-I-4", "dicom", 20, 7)})
    if (known)
      tell_variations(*known);
}
