// Files with headers and labels as public data sets of hearts have them, made here: what each kind
// says of itself is known from their descriptions and from the programs that read them.
#include "lv/base/check.hpp"
#include "lv/geometry/fit_report.hpp"
#include "lv/image/label_contours.hpp"
#include "lv/image/nifti.hpp"
#include "lv/image/volume_file.hpp"

#include "image/nifti_files.hpp"
#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <array>
#include <numbers>

namespace {

using namespace lv;
using namespace lv::image;
using Catch::Matchers::Contains;
using test::oblique;
using test::read_back;

constexpr double cavity_radius = 20.0;  // [mm]
constexpr double wall_radius = 30.0;
constexpr std::array<int, 3> size{60, 64, 8};
constexpr double pixels = 0.02;  // what a circle of pixels differs from one, relative

/// What the labels of a data set are.
struct DataSetLabels {
  int cavity, muscle, right_ventricle, scar;
};

/// A round ventricle on all slices, in the plane of the image, with a scar on one side.
test::NiftiSpec ventricle(const Mat3& directions, const Vec3& spacing, const DataSetLabels& labels,
                          double radius = cavity_radius) {
  const Vec3 origin(-40.0, 15.0, 60.0);
  const Vec3 middle(0.5 * size[0] * spacing.x(), 0.5 * size[1] * spacing.y(), 0.0);
  return test::label_map(size, directions, spacing, origin, [&](const Vec3& x) {
    const Vec3 local = directions.transpose() * (x - origin) - middle;
    const double r = local.head<2>().norm();
    if (r < radius)
      return labels.cavity;
    if (r < wall_radius)
      return local.x() > 0.0 && local.y() > 0.0 ? labels.scar : labels.muscle;
    return local.x() < -wall_radius && r < wall_radius + 8.0 ? labels.right_ventricle : 0;
  });
}

/// The columns of the sform as unit vectors, their lengths in pixdim.
test::NiftiSpec with_unit_vectors(test::NiftiSpec spec, const Vec3& spacing) {
  for (auto& row : spec.sform)
    for (int d = 0; d < 3; ++d)
      row[d] /= spacing[d];
  spec.pixdim = {spacing.x(), spacing.y(), spacing.z()};
  return spec;
}

double cylinder(const Vec3& spacing, double radius = cavity_radius) {
  return std::numbers::pi * radius * radius * spacing.z() * size[2];
}

}  // namespace

TEST_CASE("label maps of the ACDC kind: sizes stand in pixdim, by sform, by qform and by both",
          "[unit][image]") {
  const Vec3 spacing(1.5625, 1.5625, 10.0);
  const DataSetLabels labels{3, 2, 1, 2};
  for (const auto& [sform, qform] : {std::pair(1, 0), {2, 1}, {0, 1}}) {
    test::NiftiSpec spec = with_unit_vectors(ventricle(Mat3::Identity(), spacing, labels), spacing);
    spec.sform_code = sform;
    spec.qform_code = qform;
    spec.same_qform = true;
    const Volume v = read_back(spec);
    CHECK((v.spacing - spacing).norm() < 1e-5);
    CHECK(slice_axis(v) == 2);
    const LabelContours traced = trace_labels(v, {{3}, {2}, {1}}, 0);
    CHECK(traced.cavity == Approx(cylinder(spacing)).epsilon(pixels));
    CHECK(geometry::slab_volumes(traced.contours).cavity ==
          Approx(cylinder(spacing)).epsilon(pixels));
    CHECK(v.notes.size() == (sform > 0 ? 1U : 0U));
  }
}

TEST_CASE(
    "a four-dimensional cine of the ACDC kind is read; its second between frames is not taken",
    "[unit][image]") {
  const Vec3 spacing(1.5625, 1.5625, 10.0);
  test::NiftiSpec spec =
      with_unit_vectors(ventricle(Mat3::Identity(), spacing, {300, 100, 280, 100}), spacing);
  spec.floating = true;
  spec.size[3] = 30;
  spec.time_step = 1.0;
  const std::vector<double> frame = spec.values;
  for (int f = 1; f < 30; ++f)
    spec.values.insert(spec.values.end(), frame.begin(), frame.end());
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "cine.nii", test::nifti_bytes(spec));
  const Cine cine = read_volume_cine(folder / "cine.nii");
  REQUIRE(cine.slices.size() == 8);
  CHECK(cine.slices.front().frames.size() == 30);
  CHECK(cine.slices.front().times.empty());
  CHECK(cine.slices.front().frames.front().plane.spacing_i == Approx(1.5625));
  CHECK(cine.notes.size() == 2);
}

TEST_CASE("label maps of the EMIDEC kind: scar and no-reflow labels, sizes in pixdim",
          "[unit][image]") {
  const Vec3 spacing(1.458, 1.458, 10.0);
  const DataSetLabels labels{1, 2, 0, 3};
  const Volume v =
      read_back(with_unit_vectors(ventricle(Mat3::Identity(), spacing, labels), spacing));
  const auto volumes = label_volumes(v);
  CHECK(volumes.at(1) == Approx(cylinder(spacing)).epsilon(pixels));
  const double wall = cylinder(spacing, wall_radius) - cylinder(spacing);
  CHECK(volumes.at(3) == Approx(0.25 * wall).epsilon(3 * pixels));
  CHECK(trace_labels(v, {{1}, {2, 3, 4}, {}}, 0).muscle == Approx(wall).epsilon(pixels));
}

TEST_CASE("maps of the M&Ms kind: of many frames two are labelled, and they are the phases",
          "[unit][image]") {
  constexpr int diastole = 0;
  constexpr int systole = 9;
  const Vec3 spacing(1.2, 1.2, 9.2);
  const DataSetLabels labels{1, 2, 3, 2};
  test::NiftiSpec spec = ventricle(oblique(), spacing, labels);
  const std::vector<double> large = spec.values;
  const std::vector<double> small = ventricle(oblique(), spacing, labels, 14.0).values;
  spec.size[3] = 25;
  spec.floating = true;
  spec.qform_code = 1;
  spec.same_qform = true;
  spec.values.assign(25 * large.size(), 0.0);
  std::copy(large.begin(), large.end(), spec.values.begin() + diastole * large.size());
  std::copy(small.begin(), small.end(), spec.values.begin() + systole * large.size());
  const Volume v = read_back(spec);
  CHECK((v.directions - oblique()).norm() < 1e-5);
  const std::vector<double> curve = volume_curve(v, {1});
  CHECK(curve[diastole] == Approx(cylinder(spacing)).epsilon(pixels));
  CHECK(curve[systole] == Approx(cylinder(spacing, 14.0)).epsilon(pixels));
  const Phases phases = propose_phases(curve);
  CHECK(phases.end_diastole == diastole);
  CHECK(phases.end_systole == systole);
  CHECK(phases.early_diastole == systole);  // no frame shows it
  CHECK(frames_with(v, {1}) == std::vector<int>{1, 10});
  const Volume one = frame_of(v, 10, "case.toml:3");
  CHECK(one.frames == 1);
  CHECK(label_volumes(one).at(1) == Approx(cylinder(spacing, 14.0)).epsilon(pixels));
  CHECK_THROWS_WITH(frame_of(v, 26, "case.toml:3"),
                    Contains("case.toml:3") && Contains("there is no frame 26"));
}

TEST_CASE("phases are proposed among frames that show the cavity alone", "[unit][image]") {
  const Phases p = propose_phases({0, 120, 0, 50, 0, 60, 0, 110, 0});
  CHECK(p.end_diastole == 1);
  CHECK(p.end_systole == 3);
  CHECK(p.early_diastole == 5);
  const Phases none = propose_phases({0, 0});
  CHECK(none.end_diastole == 0);
  CHECK(none.end_systole == 0);
}
