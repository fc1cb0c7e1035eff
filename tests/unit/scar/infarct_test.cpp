#include "lv/scar/infarct.hpp"

#include "lv/base/files.hpp"
#include "lv/base/log.hpp"
#include "lv/geometry/contours.hpp"
#include "lv/image/volume_file.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/infarct.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/scar/slice_moves.hpp"
#include "lv/scar/strain_infarct.hpp"
#include "lv/work/ingredients.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace {

using namespace lv;
using Catch::Matchers::Contains;
using mesh::InfarctSource;

// An image space in which the ventricle lies askew, and a box of scar in it.
const geometry::Frame frame{
    Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix(),
    Vec3(120.0, -35.0, 410.0)};
const Vec3 lower(100.3, -60.2, 370.1);
const Vec3 upper(135.1, -35.7, 405.6);

bool in_box(const Vec3& x) {
  return (x.array() > lower.array()).all() && (x.array() < upper.array()).all();
}

/// The box as six faces.
std::string box_surface() {
  std::string corners;
  for (int i = 0; i < 8; ++i)
    corners +=
        fmt::format("{} {} {}\n", (i & 1) != 0 ? upper.x() : lower.x(),
                    (i & 2) != 0 ? upper.y() : lower.y(), (i & 4) != 0 ? upper.z() : lower.z());
  return fmt::format(
      "# vtk DataFile Version 3.0\nbox\nASCII\nDATASET POLYDATA\nPOINTS 8 double\n{}POLYGONS 6 "
      "30\n4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 1 3 7 5\n4 3 2 6 7\n4 2 0 4 6\n",
      corners);
}

/// The box as voxels of 1 mm with the label 2 in a picture of the whole wall.
std::string box_labels() {
  constexpr int n = 160;
  const Vec3 origin(40.0, -115.0, 330.0);
  std::string values;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        values += in_box(origin + Vec3(i, j, k)) ? "2 " : "0 ";
  return fmt::format(
      "# vtk DataFile Version 3.0\nbox\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS {} {} {}\n"
      "ORIGIN {} {} {}\nSPACING 1 1 1\nPOINT_DATA {}\nSCALARS tissue int 1\nLOOKUP_TABLE "
      "default\n{}\n",
      n, n, n, origin.x(), origin.y(), origin.z(), n * n * n, values);
}

double longest_diagonal(const mesh::Mesh& mesh) {
  double longest = 0.0;
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (const int a : mesh.cell(c))
      for (const int b : mesh.cell(c))
        longest = std::max(longest, (mesh.nodes[a] - mesh.nodes[b]).norm());
  return longest;
}

}  // namespace

TEST_CASE("a surface and a labelled volume in image space mean the region that they were made from",
          "[unit][scar]") {
  const mesh::Mesh wall = test::ellipsoid_mesh({}, 4.0);
  const auto box = [](const Vec3& X, double) { return in_box(frame.to_image(X)); };
  const auto expected = mesh::infarct_field(wall, mesh::infarcted_where(wall, box), 10.0);
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "surface.vtk", box_surface());
  test::write_bytes(folder / "labels.vtk", box_labels());
  case_file::Case c;
  c.file = folder / "case.toml";
  anatomy::Shape shape;
  shape.frame = frame;
  c.scar.source = InfarctSource::surface;
  c.scar.surface = "surface.vtk";
  CHECK(scar::infarct_extent(c, shape, wall).M == expected);
  c.scar.source = InfarctSource::labels;
  c.scar.labels = "labels.vtk";
  c.scar.scar = {2};
  const auto M = scar::infarct_extent(c, shape, wall).M;
  double furthest = 0.0;
  for (std::size_t a = 0; a < M.size(); ++a)
    furthest = std::max(furthest, 10.0 * std::abs(M[a] - expected[a]));
  // an element whose centre lies between voxels may change sides, and its far node with it
  CHECK(furthest < longest_diagonal(wall));
  CHECK(furthest > 0.0);
}

TEST_CASE("a NIfTI map and the brightness of an image mean the region that they were made from",
          "[unit][scar]") {
  const mesh::Mesh wall = test::ellipsoid_mesh({}, 5.0);
  const auto box = [](const Vec3& X, double) { return in_box(frame.to_image(X)); };
  const auto expected = mesh::infarct_field(wall, mesh::infarcted_where(wall, box), 10.0);
  const test::TemporaryFolder folder;
  const Vec3 origin(40.0, -115.0, 330.0);
  const auto write = [&](const std::string& name, const std::function<int(const Vec3&)>& value) {
    test::write_bytes(folder / name,
                      test::nifti_bytes(test::label_map({80, 80, 80}, Mat3::Identity(),
                                                        Vec3(2, 2, 2), origin, value)));
  };
  // a core without contrast agent in the scar; brightness of muscle between 10 and 12
  const auto core = [](const Vec3& x) { return x.z() > 380.0 && x.z() < 390.0; };
  write("labels.nii", [&](const Vec3& x) { return in_box(x) ? core(x) ? 3 : 2 : 1; });
  write("lge.nii", [&](const Vec3& x) {
    return in_box(x) ? 100 : 10 + static_cast<int>(std::abs(x.x())) % 3;
  });
  case_file::Case c;
  c.file = folder / "case.toml";
  anatomy::Shape shape;
  shape.frame = frame;
  const auto furthest = [&] {
    const auto M = scar::infarct_extent(c, shape, wall).M;
    double most = 0.0;
    for (std::size_t a = 0; a < M.size(); ++a)
      most = std::max(most, 10.0 * std::abs(M[a] - expected[a]));
    return most;
  };
  c.scar.source = InfarctSource::labels;
  c.scar.labels = "labels.nii";
  c.scar.scar = {2};
  c.scar.no_reflow = {3};
  CHECK(furthest() < longest_diagonal(wall));
  c.scar.no_reflow = {4};
  CHECK_THROWS_WITH(
      furthest(), Catch::Matchers::Contains("has the label 4") && Catch::Matchers::Contains("1 ("));
  c.scar.source = InfarctSource::lge;
  c.scar.lge.image = "lge.nii";
  c.scar.lge.threshold = mesh::ScarThreshold::fwhm;
  CHECK(furthest() < longest_diagonal(wall));
  c.scar.lge.threshold = mesh::ScarThreshold::sd;
  CHECK_THROWS_WITH(furthest(), Catch::Matchers::Contains("infarct.lge.remote is not set"));
  const auto part = mesh::infarcted_part(wall, box);
  for (const auto& s : mesh::infarct_by_segment(wall, part, mesh::divide(wall, {}), {}))
    if (s.infarct == 0.0)
      c.scar.lge.remote.push_back(s.segment);
  c.scar.lge.deviations = 20.0;  // the edge of the scar is half as bright in a voxel
  CHECK(furthest() < longest_diagonal(wall));
  c.scar.shift = {500.0, 0.0, 0.0};
  CHECK_THROWS_WITH(furthest(), Catch::Matchers::Contains("shows nothing of the wall"));
}

TEST_CASE("of a scar map of several frames one is meant: the chosen, or the only one with scar",
          "[unit][scar]") {
  const mesh::Mesh wall = test::ellipsoid_mesh({}, 6.0);
  const test::TemporaryFolder folder;
  test::NiftiSpec map =
      test::label_map({40, 40, 40}, Mat3::Identity(), Vec3(4, 4, 4), Vec3(40.0, -115.0, 330.0),
                      [](const Vec3& x) { return in_box(x) ? 2 : 0; });
  const std::vector<double> scar = map.values;
  const std::size_t n = scar.size();
  map.size[3] = 3;
  map.values.assign(3 * n, 0.0);
  std::copy(scar.begin(), scar.end(), map.values.begin() + static_cast<std::ptrdiff_t>(n));
  case_file::Case c;
  c.file = folder / "case.toml";
  anatomy::Shape shape;
  shape.frame = frame;
  c.scar.source = InfarctSource::labels;
  c.scar.labels = "map.nii";
  c.scar.scar = {2};
  const auto scar_volume = [&] {
    test::write_bytes(folder / "map.nii", test::nifti_bytes(map));
    double V = 0.0;
    for (const double part : scar::infarct_extent(c, shape, wall).part)
      V += part;
    return V;
  };
  const double only = scar_volume();
  CHECK(only > 0.0);
  c.scar.frame = 2;
  CHECK(scar_volume() == only);
  c.scar.frame = 4;
  CHECK_THROWS_WITH(scar_volume(), Catch::Matchers::Contains("there is no frame 4"));
  c.scar.frame = 0;
  map.values.back() = 2.0;
  CHECK_THROWS_WITH(scar_volume(), Catch::Matchers::Contains("there is scar in the frames 2, 3"));
}

TEST_CASE(
    "where a slice was not drawn the wall has the scar of the nearest, and a healthy one stays",
    "[unit][scar]") {
  const mesh::Mesh wall = test::ellipsoid_mesh({}, 6.0);
  const test::TemporaryFolder folder;
  case_file::Case c;
  c.file = folder / "case.toml";
  anatomy::Shape shape;
  c.scar.source = InfarctSource::labels;
  c.scar.labels = "map.nii";
  c.scar.scar = {4};
  constexpr double gap = -40.0;  // the middle of a slice of 8 mm
  const auto volume = [&](int in_gap, int muscle) {
    test::write_bytes(folder / "map.nii",
                      test::nifti_bytes(test::label_map(
                          {60, 60, 14}, Mat3::Identity(), Vec3(2.0, 2.0, 8.0),
                          Vec3(-59.0, -59.0, -104.0), [&](const Vec3& x) {
                            if (x.head<2>().norm() > 45.0 || x.z() < -96.0 || x.z() > -8.0)
                              return 0;
                            if (in_gap >= 0 && std::abs(x.z() - gap) < 1.0)
                              return in_gap;
                            return x.y() > 5.0 ? 4 : muscle;
                          })));
    const auto log = folder / fmt::format("log{}_{}.txt", in_gap, muscle);
    log::to_file(log, {});
    const auto part = scar::infarct_extent(c, shape, wall).part;
    return std::pair(mesh::infarct_volumes(wall, part).infarct, read_file(log));
  };
  const auto [whole, silent] = volume(-1, 2);
  CHECK_THAT(silent, !Contains("no ventricle"));
  const auto [filled, said] = volume(0, 2);
  CHECK(filled == Approx(whole).epsilon(1e-9));
  CHECK_THAT(said, Contains("slice 9 of ") && Contains("shows no ventricle"));
  const auto [healthy, drawn] = volume(2, 2);
  CHECK(healthy < 0.95 * whole);
  CHECK_THAT(drawn, !Contains("no ventricle"));
  const auto [alone, doubted] = volume(0, 0);  // a map of scar alone tells no gap from health
  CHECK(alone == Approx(healthy).epsilon(1e-9));
  CHECK_THAT(doubted, Contains("slice 9 of ") && Contains("the wall is taken as healthy"));
}

TEST_CASE("half of the brightest is taken from the grey value of no signal", "[unit][scar]") {
  const mesh::Mesh wall = test::ellipsoid_mesh({}, 5.0);
  const test::TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::function<int(const Vec3&)>& value) {
    test::NiftiSpec image = test::label_map({60, 60, 30}, Mat3::Identity(), Vec3(2.0, 2.0, 4.0),
                                            Vec3(-59.0, -59.0, -100.0), value);
    image.floating = true;  // grey values beyond a byte's
    test::write_bytes(folder / name, test::nifti_bytes(image));
  };
  const auto scar = [](const Vec3& X) { return X.y() > 5.0 && X.z() > -40.0; };
  write("magnitude.nii", [&](const Vec3& X) {
    return scar(X) ? 800 : X.head<2>().norm() < 45.0 ? 60 : 5;
  });
  write("offset.nii", [&](const Vec3& X) {
    return 2048 + (scar(X) ? 800 : X.head<2>().norm() < 45.0 ? 60 : 5);
  });
  case_file::Case c;
  c.file = folder / "case.toml";
  c.scar.source = InfarctSource::lge;
  c.scar.lge.threshold = mesh::ScarThreshold::fwhm;
  const auto volume = [&](const std::string& image) {
    c.scar.lge.image = image;
    return mesh::infarct_volumes(wall, scar::infarct_extent(c, {}, wall).part).infarct;
  };
  const double expected = volume("magnitude.nii");
  CHECK_THROWS_WITH(volume("offset.nii"),
                    Catch::Matchers::Contains("the image has an offset") &&
                        Catch::Matchers::Contains("Set infarct.lge.zero") &&
                        Catch::Matchers::Contains("the edge of the image is 2053"));
  c.scar.lge.zero = 2048.0;
  c.origin["infarct.lge.zero"] = "case.toml:3";
  CHECK(volume("offset.nii") == Approx(expected).epsilon(1e-6));
  c.scar.lge.zero = 5000.0;
  CHECK_THROWS_WITH(volume("offset.nii"), Catch::Matchers::Contains("is brighter than 5000"));
  write("constant.nii", [](const Vec3&) { return 50; });
  CHECK_THROWS_WITH(
      volume("constant.nii"),
      Catch::Matchers::Contains("is constant: all its pixels have the grey value 50"));
  write("inverted.nii", [&](const Vec3& X) { return scar(X) ? 5 : 60; });
  c.scar.lge.threshold = mesh::ScarThreshold::sd;
  c.scar.lge.remote = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17};
  CHECK_THROWS_WITH(
      volume("inverted.nii"),
      Catch::Matchers::Contains("nothing of the wall is brighter than the threshold") &&
          Catch::Matchers::Contains("the brightest is 60"));
}

TEST_CASE("a scar of more than half of the wall is asked about, and each remote segment told",
          "[unit][scar]") {
  const mesh::Mesh wall = test::ellipsoid_mesh({}, 5.0);
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "lge.nii",
                    test::nifti_bytes(test::label_map(
                        {60, 60, 60}, Mat3::Identity(), Vec3(2.0, 2.0, 2.0),
                        Vec3(-59.0, -59.0, -100.0), [](const Vec3& X) {
                          return X.x() < -15.0 ? 10 + static_cast<int>(std::abs(X.y())) % 3 : 200;
                        })));
  case_file::Case c;
  c.file = folder / "case.toml";
  c.scar.source = InfarctSource::lge;
  c.scar.lge.image = "lge.nii";
  c.scar.lge.threshold = mesh::ScarThreshold::fwhm;
  c.scar.lge.fill_no_reflow = false;
  CHECK_THROWS_WITH(scar::infarct_extent(c, {}, wall),
                    Catch::Matchers::Contains("% of the wall is scar") &&
                        Catch::Matchers::Contains("raise infarct.lge.largest_part"));
  c.scar.lge.largest_part = 0.9;
  CHECK_NOTHROW(scar::infarct_extent(c, {}, wall));
  c.scar.lge.threshold = mesh::ScarThreshold::sd;
  CHECK_THROWS_WITH(scar::infarct_extent(c, {}, wall),
                    Catch::Matchers::Contains("one segment as remote would make is 1: ") &&
                        Catch::Matchers::Contains(", 17: "));
}

TEST_CASE("slices of a late-enhancement image are moved onto the wall", "[unit][scar]") {
  const geometry::Ellipsoid ellipsoid;
  const mesh::Mesh wall = test::ellipsoid_mesh(ellipsoid, 3.0);
  const auto inside = [&](geometry::Side side, const Vec3& X) {
    const bool endo = side == geometry::Side::endo;
    const double a = endo ? ellipsoid.endo_radius : ellipsoid.epi_radius;
    const double c = endo ? ellipsoid.endo_length : ellipsoid.epi_length;
    const double z = X.z() + ellipsoid.base_height;
    return X.head<2>().squaredNorm() / (a * a) + z * z / (c * c) < 1.0;
  };
  const auto brightness = [&](const Vec3& X) {
    if (X.z() < 2.0 && inside(geometry::Side::endo, X))
      return 100;
    if (X.z() < 2.0 && inside(geometry::Side::epi, X))
      return X.y() > 0.0 && std::abs(X.x()) < 12.0 && X.z() > -50.0 ? 200 : 15;
    return X.x() > 0.0 && X.z() < 0.0 && X.norm() < 45.0 ? 100 : 10;
  };
  // each breath-hold another; voxels of 1 x 1 x 8 mm
  const auto breath = [](double z) {
    return Vec3(3.0 * std::sin(z), 4.0 * std::cos(2.0 * z), 0.0);
  };
  const test::TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::function<int(const Vec3&)>& value) {
    test::write_bytes(folder / name, test::nifti_bytes(test::label_map(
                                         {120, 120, 14}, Mat3::Identity(), Vec3(1.0, 1.0, 8.0),
                                         Vec3(-59.5, -59.5, -92.0), value)));
  };
  write("held.nii", brightness);
  write("shifted.nii", [&](const Vec3& x) { return brightness(x - breath(x.z())); });
  write("flat.nii", [](const Vec3&) { return 7; });
  case_file::Case c;
  c.file = folder / "case.toml";
  c.scar.source = InfarctSource::lge;
  c.scar.lge.threshold = mesh::ScarThreshold::fwhm;
  const auto volume = [&](const std::string& image, bool in_plane) {
    c.scar.lge.image = image;
    c.scar.lge.in_plane = in_plane;
    return mesh::infarct_volumes(wall, scar::infarct_extent(c, {}, wall).part).infarct;
  };
  const double held = volume("held.nii", false);
  CHECK(std::abs(volume("shifted.nii", false) / held - 1.0) > 0.05);
  CHECK(volume("held.nii", true) == Approx(held).epsilon(0.01));
  CHECK(volume("shifted.nii", true) == Approx(held).epsilon(0.02));
  const Table moves = *scar::infarct_extent(c, {}, wall).slice_moves;
  const auto evidence = moves.words("evidence");
  CHECK(std::count(evidence.begin(), evidence.end(), "clear") >= 9);
  for (std::size_t s = 0; s < evidence.size(); ++s)
    if (evidence[s] == "clear") {
      const Vec3 move(moves.numbers("x_mm")[s], moves.numbers("y_mm")[s], moves.numbers("z_mm")[s]);
      CHECK((move + breath(-92.0 + 8.0 * static_cast<double>(s))).norm() < 0.6);
    }
  c.scar.lge.largest_shift = 3.0;
  const Table bounded = *scar::infarct_extent(c, {}, wall).slice_moves;
  for (std::size_t s = 0; s < evidence.size(); ++s)
    if (evidence[s] == "clear" && moves.numbers("move_mm")[s] > 3.5) {
      CHECK(bounded.words("evidence")[s] == "at_limit");
      CHECK(bounded.numbers("move_mm")[s] == 0.0);
    }
  CHECK_THROWS_WITH(volume("flat.nii", true),
                    Catch::Matchers::Contains("shows the wall clearly within 3 mm"));
}

TEST_CASE("slices of labels are moved onto the wall, whatever its elements and its base",
          "[unit][scar]") {
  const geometry::Ellipsoid ellipsoid;
  // slices lie askew to the wall by 12 degrees, so that one at the base cuts one side of it
  const Mat3 turn = Eigen::AngleAxisd(0.21, Vec3::UnitX()).toRotationMatrix();
  const auto inside = [&](double a, double c, const Vec3& X) {
    const double z = X.z() + ellipsoid.base_height;
    return X.head<2>().squaredNorm() / (a * a) + z * z / (c * c) < 1.0;
  };
  const auto breath = [](double z) {
    return Vec3(3.0 * std::sin(z), 4.0 * std::cos(2.0 * z), 0.0);
  };
  const Vec3 first(-59.5, -59.5, -92.0);
  const auto label = [&](const Vec3& image) {
    const Vec3 X = turn.transpose() * (image - breath(image.z()));
    if (!inside(ellipsoid.epi_radius, ellipsoid.epi_length, X) ||
        inside(ellipsoid.endo_radius, ellipsoid.endo_length, X))
      return 0;
    return X.y() > 0.0 && std::abs(X.x()) < 12.0 ? 4 : 2;
  };
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "scar.nii",
                    test::nifti_bytes(test::label_map({120, 120, 14}, Mat3::Identity(),
                                                      Vec3(1.0, 1.0, 8.0), first, label)));
  const image::Cine stack = image::cine_of(image::read_volume(folder / "scar.nii"));
  for (const double edge : {4.0, 13.0}) {
    const mesh::Mesh wall = test::ellipsoid_mesh(ellipsoid, edge);
    const auto side = [&](const mesh::Surface& surface) {
      scar::Triangles triangles;
      for (int f = 0; f < surface.size(); ++f)
        mesh::for_triangles(surface.face(f), [&](int a, int b, int c) {
          triangles.push_back({turn * wall.nodes[a], turn * wall.nodes[b], turn * wall.nodes[c]});
        });
      return triangles;
    };
    const auto moves = scar::moves_of_labels(stack, {2, 4}, side(wall.endo), side(wall.epi));
    int moved = 0;
    for (std::size_t s = 0; s < moves.size(); ++s) {
      const double z = first.z() + 8.0 * static_cast<double>(s);
      if (moves[s].norm() == 0.0)
        continue;
      ++moved;
      INFO("slice " << s + 1 << " at " << z << " mm, elements of " << edge << " mm");
      CHECK((moves[s] + breath(z)).norm() < 0.1 * edge);
    }
    CHECK(moved >= 8);
  }
}

TEST_CASE("late enhancement that shows no scar, bright blood or the wall elsewhere is warned of",
          "[unit][scar]") {
  const geometry::Ellipsoid ellipsoid;
  const mesh::Mesh wall = test::ellipsoid_mesh(ellipsoid, 4.0);
  const auto inside = [&](double a, double c, const Vec3& X) {
    const double z = X.z() + ellipsoid.base_height;
    return X.head<2>().squaredNorm() / (a * a) + z * z / (c * c) < 1.0;
  };
  const auto brightness = [&](const Vec3& X, int blood, int scar) {
    if (inside(ellipsoid.endo_radius, ellipsoid.endo_length, X))
      return blood;
    if (inside(ellipsoid.epi_radius, ellipsoid.epi_length, X))
      return X.y() > 0.0 && std::abs(X.x()) < 12.0 && X.z() > -50.0 ? scar : 15;
    return 40;
  };
  const test::TemporaryFolder folder;
  case_file::Case c;
  c.file = folder / "case.toml";
  c.scar.source = InfarctSource::lge;
  c.scar.lge.threshold = mesh::ScarThreshold::fwhm;
  c.scar.lge.image = "lge.nii";
  const auto said = [&](int blood, int scar, const Vec3& shift) {
    test::write_bytes(
        folder / "lge.nii",
        test::nifti_bytes(test::label_map(
            {100, 100, 14}, Mat3::Identity(), Vec3(1.4, 1.4, 8.0), Vec3(-69.3, -69.3, -92.0),
            [&](const Vec3& x) { return brightness(x - shift, blood, scar); })));
    const auto log = folder / fmt::format("log{}_{}_{}.txt", blood, scar, shift.x());
    log::to_file(log, {});
    static_cast<void>(scar::infarct_extent(c, {}, wall));
    return read_file(log);
  };
  const std::string as_it_should = said(100, 200, Vec3::Zero());
  CHECK_THAT(as_it_should, !Contains("warning"));
  CHECK_THAT(said(200, 15, Vec3::Zero()), Contains("the blood is brighter (200"));
  CHECK_THAT(said(250, 120, Vec3::Zero()), Contains("the blood is brighter (250"));
  CHECK_THAT(said(100, 200, Vec3(20.0, 0.0, 0.0)),
             Contains("does not show the wall where it lies"));
  CHECK_THAT(said(100, 200, Vec3(7.0, 0.0, 0.0)), Contains("does not show the wall where it lies"));
  c.scar.border = 40.0;
  CHECK_THAT(said(100, 201, Vec3::Zero()), Contains("warning the border zone is "));
}

TEST_CASE("the infarct's file is among what the mesh depends on", "[unit][scar]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "surface.vtk", "one");
  case_file::Case c;
  c.file = folder / "case.toml";
  c.scar.surface = "surface.vtk";
  const auto has_contents = [&] {
    work::FileContents files;
    return work::ingredients(c, case_file::Stage::mesh, files);
  };
  CHECK_FALSE(has_contents().contains("contents of infarct.surface.file"));  // the source: the mesh
  c.scar.source = InfarctSource::surface;
  const auto before = has_contents();
  CHECK(before.contains("contents of infarct.surface.file"));
  test::write_bytes(folder / "surface.vtk", "two");
  CHECK(before != has_contents());
}

TEST_CASE("without an infarct nothing is said of it", "[unit][scar]") {
  const case_file::Case c;
  anatomy::MeshResult wall{test::coarse_mesh(mesh::CellKind::tetrahedron), {}, {}};
  wall.infarcted.assign(wall.mesh.cell_count(), 0.0);
  CHECK(scar::describe_infarct(c, wall).empty());
}

TEST_CASE("the part of the wall that a map does not show is measured by volume", "[unit][scar]") {
  const mesh::Mesh wall = test::ellipsoid_mesh({}, 6.0);
  const auto above = [&](int cell) { return mesh::cell_centre(wall, cell).z() > -50.0; };
  double below = 0.0;
  double all = 0.0;
  for (int cell = 0; cell < wall.cell_count(); ++cell) {
    all += mesh::cell_volume(wall, cell);
    below += above(cell) ? 0.0 : mesh::cell_volume(wall, cell);
  }
  CHECK(below > 0.0);
  CHECK(scar::unseen_part(wall, above) == Approx(below / all));
  CHECK(scar::unseen_part(wall, [](int) { return true; }) == 0.0);
}

TEST_CASE("from strain alone parts that hardly shorten are the infarct, and near ones undecided",
          "[unit][scar]") {
  const mesh::Mesh wall = test::ellipsoid_mesh({}, 6.0);
  const mesh::Regions regions = mesh::divide(wall, {});
  const test::TemporaryFolder folder;
  case_file::Case c;
  c.file = folder / "case.toml";
  c.scar.source = InfarctSource::strain;
  CHECK_THROWS_WITH(scar::infarct_extent(c, {}, wall), Contains("infarct.strain.file is not set"));
  c.scar_strain.file = "strains.csv";
  // shortening by 2, 5 and 19%: (1 - 0.02)^2 = 1 + 2 E and so on
  test::write_bytes(folder / "strains.csv",
                    "slice,segment,strain\naha,7,-0.0198\naha,8,-0.04875\naha,9,-0.17195\n");
  const auto verdicts = scar::strain_verdicts(c, regions);
  REQUIRE(verdicts.size() == 3);
  CHECK(verdicts[0].shortening == Approx(-0.02));
  CHECK((verdicts[0].is_infarct && !verdicts[0].is_undecided));
  CHECK((verdicts[1].is_infarct && verdicts[1].is_undecided));
  CHECK((!verdicts[2].is_infarct && !verdicts[2].is_undecided));
  CHECK_THAT(scar::describe(c, verdicts), Contains("from strain, not from late enhancement") &&
                                              Contains("undecided: 8 mid anteroseptal"));
  const scar::InfarctExtent extent = scar::infarct_extent(c, {}, wall);
  for (int cell = 0; cell < wall.cell_count(); ++cell) {
    const bool expected = regions.aha[cell] == 7 || regions.aha[cell] == 8;
    CHECK(extent.part[cell] == (expected ? 1.0 : 0.0));
    for (const int node : wall.cell(cell))
      CHECK((!expected || extent.M[node] == 1.0));
  }
  CHECK(scar::strain_infarct_table(c, verdicts).words("infarct") ==
        std::vector<std::string>{"yes", "yes", "no"});
  c.scar_strain.threshold = 0.0;  // all of the wall shortens
  const scar::InfarctExtent none = scar::infarct_extent(c, {}, wall);
  CHECK(std::all_of(none.M.begin(), none.M.end(), [](double M) { return M == 0.0; }));
}
