#include "lv/cine/cine.hpp"

#include "lv/base/check.hpp"

#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace {

using namespace lv;
using Catch::Matchers::Contains;

constexpr double pi = std::numbers::pi;

/// A ventricle that narrows downwards, on three slices of two images.
void write_images(const std::filesystem::path& folder) {
  std::filesystem::create_directory(folder);
  for (int s = 0; s < 3; ++s)
    for (int p = 0; p < 2; ++p) {
      test::DicomSpec spec;
      spec.plane = {Vec3(0, 0, -8 * s), Vec3::UnitX(), Vec3::UnitY(), 1.0, 1.0, 64, 64};
      spec.pixels.assign(64 * 64, 7);
      spec.instance = 2 * s + p + 1;
      spec.instance_uid = fmt::format("1.2.3.4.{}", spec.instance);
      spec.trigger_ms = 40.0 * p;
      test::write_bytes(folder / fmt::format("{}", spec.instance), test::dicom_bytes(spec));
    }
}

void write_loop(const std::filesystem::path& file, double radius) {
  std::string text;
  for (int i = 0; i < 24; ++i)
    text += fmt::format("{:.3f} {:.3f}\n", 30 + radius * std::cos(pi * i / 12),
                        30 + radius * std::sin(pi * i / 12));
  test::write_bytes(file, text);
}

/// Loops in the Sunnybrook form, drawn on the first images.
void write_contours(const std::filesystem::path& folder) {
  std::filesystem::create_directory(folder);
  for (int s = 0; s < 3; ++s) {
    const std::string name = fmt::format("IM-0001-{:04d}", 2 * s + 1);
    write_loop(folder / (name + "-icontour-manual.txt"), 18.0 - 3.0 * s);
    write_loop(folder / (name + "-ocontour-manual.txt"), 27.0 - 3.0 * s);
  }
}

/// Curves of endocardium and epicardium, moved along x.
void write_curves(const std::filesystem::path& file, double moved) {
  std::string text = "slice,contour,point,x_mm,y_mm,z_mm\n";
  for (int i = 0; i <= 20; ++i)
    for (const auto& [side, radius] : {std::pair("endo", 18.0), {"epi", 27.0}})
      text += fmt::format("1,{},{},{:.3f},30,{:.3f}\n", side, i,
                          30 + moved - radius * std::cos(pi * i / 20),
                          -(radius + 10.0) * std::sin(pi * i / 20));
  test::write_bytes(file, text);
}

}  // namespace

TEST_CASE("curves on long axes are read beside contours of Sunnybrook", "[unit][cine]") {
  const test::TemporaryFolder folder;
  write_images(folder / "dicom");
  write_contours(folder / "contours");
  write_curves(folder / "long_axis.csv", 0.0);
  write_curves(folder / "elsewhere.csv", 500.0);
  case_file::Case c;
  c.file = folder / "case.toml";
  c.strain.cine = "dicom";
  c.strain.contours = "contours";
  CHECK(cine::read_cine_study(c).drawn.long_axis.empty());
  c.strain.long_axis = "long_axis.csv";
  const cine::CineStudy study = cine::read_cine_study(c);
  REQUIRE(study.drawn.long_axis.size() == 2);
  CHECK(study.drawn.short_axis.size() == 6);
  CHECK(study.orientation.apex.z() == Approx(-28.0).margin(0.5));
  c.strain.long_axis = "elsewhere.csv";
  CHECK_THROWS_WITH(cine::read_cine_study(c), Contains("elsewhere.csv:2"));
  c.strain.long_axis = "absent.csv";
  CHECK_THROWS_AS(cine::read_cine_study(c), InputError);
}
