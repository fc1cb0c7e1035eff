#include "lv/image/dicom_study.hpp"
#include "lv/image/nifti.hpp"
#include "lv/image/volume_file.hpp"
#include "lv/phantom/files.hpp"
#include "lv/phantom/study.hpp"

#include "support/temporary_folder.hpp"
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace lv;
using namespace lv::phantom;
using geometry::Side;

namespace {

/// Points of the wall at end-diastole, evenly from apex to base.
std::vector<Vec3> wall_points(const Ventricle& v) {
  std::vector<Vec3> points;
  for (int k = 0; k < 200; ++k) {
    const double Z = v.cavity_apex() * (0.02 + 0.9 * ((k * 37) % 200) / 200.0);
    const double t = ((k * 53) % 200) / 200.0;
    const double R = (1.0 - t) * std::sqrt(v.radius_squared(Side::endo, Z)) +
                     t * std::sqrt(v.radius_squared(Side::epi, Z));
    const double Theta = 2.0 * std::numbers::pi * k / 200.0;
    points.emplace_back(R * std::cos(Theta), R * std::sin(Theta), Z);
  }
  return points;
}

Ventricle strong() {
  Ventricle v;
  v.shortening = 0.15;
  return v;
}

}  // namespace

TEST_CASE("the phantom's motion keeps every volume and is undone by its inverse", "[phantom]") {
  const Ventricle v = strong();
  for (const double s : {0.3, 1.0}) {
    const Motion motion(v, s);
    for (const Vec3& X : wall_points(v)) {
      CHECK(motion.gradient(X).determinant() == Approx(1.0).margin(1e-12));
      CHECK((motion.inverse(motion.forward(X)) - X).norm() < 1e-10);
    }
  }
}

TEST_CASE("the phantom's deformation gradient is the derivative of its motion", "[phantom]") {
  const Ventricle v = strong();
  const Motion motion(v, 0.8);
  constexpr double h = 1e-4;  // central differences are good to h^2 and to rounding / h: 1e-8
  for (const Vec3& X : wall_points(v)) {
    Mat3 F;
    for (int d = 0; d < 3; ++d)
      F.col(d) = (motion.forward(X + h * Vec3::Unit(d)) - motion.forward(X - h * Vec3::Unit(d))) /
                 (2.0 * h);
    CHECK((F - motion.gradient(X)).norm() < 1e-6);
  }
}

TEST_CASE("without scar the phantom ejects just what it squeezes", "[phantom]") {
  Ventricle v = strong();
  v.scar.transmurality = 0.0;
  const double whole = v.shape.enclosed_volume(0.0);
  CHECK(Motion(v, 0.0).cavity_volume() == Approx(whole).epsilon(1e-6));
  CHECK(Motion(v, 1.0).cavity_volume() == Approx((1.0 - v.squeeze) * whole).epsilon(1e-6));
  CHECK(scar_volume(v) == 0.0);
}

TEST_CASE("the apex of the phantom turns anticlockwise seen from below", "[phantom]") {
  const Ventricle v;
  const Scan scan{.phases = 9};
  const Truth t = truth(v, scan, planes(v, scan));
  const auto& apical = t.slices.back();
  CHECK(apical.motion.at(t.end_systole - 1).rotation > 0.1);
}

TEST_CASE("labels of the phantom hold the volumes of its truth", "[phantom]") {
  const Ventricle v;
  const Scan scan{.thickness = 2.0, .shift = 3.0};
  const ScanPlanes all = planes(v, scan);
  const Scanner scanner(v, scan);
  std::array<double, 4> volume{};
  for (const ScanPlane& plane : all.short_axis)
    for (const std::uint8_t label : scanner.labels(plane, 0.0).values)
      volume.at(label) += scan.pixel * scan.pixel * scan.thickness;
  // pixels of 1.4 mm in slices of 2 mm, cut by the base somewhere within a slice: 1.5%
  CHECK(volume[cavity] == Approx(v.shape.enclosed_volume(0.0)).epsilon(0.015));
  CHECK(volume[muscle] + volume[scar] == Approx(wall_volume(v)).epsilon(0.015));
  CHECK(volume[scar] == Approx(scar_volume(v)).epsilon(0.03));
}

TEST_CASE("scar per AHA segment adds up to the whole scar", "[phantom]") {
  const Ventricle v;
  const Scan scan{.phases = 5};
  const Truth t = truth(v, scan, planes(v, scan));
  double sum = 0.0;
  for (const double part : t.scar_of_segment)
    sum += part;
  CHECK(sum == Approx(t.scar_volume).epsilon(0.02));
}

TEST_CASE("noise of the phantom has the asked signal-to-noise ratio", "[phantom]") {
  const Ventricle v;
  const Scan quiet{.field_of_view = 150};
  Scan noisy = quiet;
  noisy.snr = 20.0;
  const ScanPlane plane = planes(v, quiet).short_axis.at(7);
  const auto a = Scanner(v, quiet).picture(plane, 0.0, Contrast::cine, 1);
  const auto b = Scanner(v, noisy).picture(plane, 0.0, Contrast::cine, 1);
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    if (a.values[i] > 850.0F) {  // blood: far from zero, where Rician noise is Gaussian
      squares += std::pow(b.values[i] - a.values[i], 2);
      ++count;
    }
  CHECK(count > 500);
  CHECK(std::sqrt(squares / count) == Approx(300.0 / 20.0).epsilon(0.08));
}

TEST_CASE("the phantom's DICOM and NIfTI say the same place and values", "[phantom]") {
  const test::TemporaryFolder folder;
  const Ventricle v;
  const Scan scan{.pixel = 4.0, .gap = 2.0, .phases = 5};
  const ScanPlanes all = planes(v, scan);
  image::Cine cine = short_axis_cine(v, scan, all);
  std::filesystem::create_directories(folder / "dicom");
  write_dicom({1, scan.rr, scan.thickness, scan.thickness + scan.gap},
              {{1, "cine_short_axis", cine}}, folder / "dicom");
  write_nifti(cine, folder / "cine.nii.gz");
  const std::array<std::filesystem::path, 1> where{folder / "dicom"};
  const image::Cine dicom = image::read_dicom_cine(where);
  const image::Cine nifti = image::read_volume_cine(folder / "cine.nii.gz");
  REQUIRE(dicom.slices.size() == cine.slices.size());
  REQUIRE(nifti.slices.size() == cine.slices.size());
  for (const image::CineSlice& slice : cine.slices) {
    const image::Picture& made = slice.frames.at(2);
    for (const image::Cine* read : {&dicom, &nifti}) {
      bool found = false;
      for (const image::CineSlice& other : read->slices) {
        const image::Picture& picture = other.frames.at(2);
        const Vec3 pixel = picture.plane.pixel(made.plane.point(20, 13));
        if (std::abs(pixel.z()) > 0.1)
          continue;
        found = true;
        CHECK(other.times.at(2) == Approx(slice.times[2]).margin(1e-3));
        const int i = static_cast<int>(std::lround(pixel.x()));
        const int j = static_cast<int>(std::lround(pixel.y()));
        CHECK(std::abs(pixel.x() - i) + std::abs(pixel.y() - j) < 1e-3);
        CHECK(picture.at(i, j) == Approx(made.at(20, 13)).margin(0.51));
      }
      CHECK(found);
    }
  }
}
