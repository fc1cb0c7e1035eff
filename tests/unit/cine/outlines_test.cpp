#include "lv/cine/outlines.hpp"

#include "lv/base/table.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/wall_mesh.hpp"
#include "lv/pipeline/stages.hpp"

#include "support/temporary_folder.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <optional>

namespace {

using namespace lv;
using cine::CineStudy;
using geometry::Contour;
using geometry::Side;

const geometry::Ellipsoid ellipsoid;

// An image space in which the ventricle lies askew.
const geometry::Frame frame{
    Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix(),
    Vec3(120.0, -35.0, 410.0)};

/// Empty images on a plane of the model frame, its middle at `centre`.
image::CineSlice cine_slice(const Vec3& centre, const Vec3& along_row, const Vec3& along_column,
                            int images) {
  constexpr int pixels = 70;
  constexpr double spacing = 2.0;
  const Vec3 corner = centre - 0.5 * (pixels - 1) * spacing * (along_row + along_column);
  const image::Plane plane{frame.to_image(corner),
                           frame.axes * along_row,
                           frame.axes * along_column,
                           spacing,
                           spacing,
                           pixels,
                           pixels};
  const image::Picture picture{plane, std::vector<float>(pixels * pixels, 1.0F)};
  return {"cine", std::vector<image::Picture>(images, picture), {}, 0.0};
}

/// The wall's side in the plane x = 0, from the base over the apex to the base.
Contour long_axis_curve(Side side) {
  Contour curve{1, side, {}, {}, {}};
  for (int i = -40; i <= 40; ++i)
    curve.points.push_back(
        frame.to_image(ellipsoid.point(std::abs(i) / 40.0, (i < 0 ? -0.5 : 0.5) * std::numbers::pi,
                                       side == Side::endo ? 0.0 : 1.0)));
  return curve;
}

Contour short_axis_loop(int slice, Side side, double u) {
  Contour loop{slice, side, {}, {}, {}};
  for (int i = 0; i < 40; ++i)
    loop.points.push_back(frame.to_image(ellipsoid.point(u, i * std::numbers::pi / 20.0, 0.0)));
  return loop;
}

/// A short axis of ten images, drawn on at end-diastole, and a long axis of twenty-five.
CineStudy study() {
  constexpr double u = 0.8;
  CineStudy s;
  const double z = ellipsoid.point(u, 0.0, 0.0).z();
  s.cine.slices = {cine_slice(Vec3(0.0, 0.0, z), Vec3::UnitX(), Vec3::UnitY(), 10)};
  s.drawn.short_axis = {short_axis_loop(4, Side::endo, u)};
  s.slice_of = {0};
  s.long_axis.push_back(
      {{{cine_slice(Vec3(0.0, 0.0, -40.0), Vec3::UnitY(), -Vec3::UnitZ(), 25)}, {}},
       long_axis_curve(Side::endo),
       long_axis_curve(Side::epi)});
  return s;
}

anatomy::MeshResult mesh_of(int order, double edge_length) {
  const auto wall = [](double u, double theta, double t) { return ellipsoid.point(u, theta, t); };
  return {mesh::wall_mesh(wall, {.edge_length = edge_length, .order = order}), {}, {}};
}

/// A beat of a wall that does not move.
heartbeat::Beat still(const anatomy::MeshResult& mesh) {
  heartbeat::Beat beat;
  for (const char* name : {heartbeat::end_diastole, heartbeat::end_systole}) {
    beat.moments.push_back({.name = name});
    beat.moments.back().wall.positions = mesh.mesh.nodes;
  }
  return beat;
}

/// What write_outlines leaves in `folder` for a wall that does not move, and says.
std::string outlined(const anatomy::MeshResult& mesh, const std::filesystem::path& folder,
                     const std::optional<geometry::Frame>& in_images = frame) {
  std::filesystem::create_directories(folder);
  const heartbeat::Beat beat = still(mesh);
  const analysis::BeatFields fields;
  return cine::write_outlines({mesh, beat, fields, in_images}, study(), 9, 3, folder);
}

/// The farthest that points of contours on the ellipsoid are from the model's outlines [mm].
double farthest(const std::filesystem::path& folder) {
  const auto largest = Table::read_csv(folder / "outline_distances.csv").numbers("largest_mm");
  return *std::max_element(largest.begin(), largest.end());
}

}  // namespace

TEST_CASE("a long axis with more images shows the one nearest in the cycle", "[cine]") {
  const CineStudy s = study();
  const auto diastolic = cine::images_at(s, 9, 9);
  REQUIRE(diastolic.size() == 2);
  CHECK(diastolic[0].slice == "4");
  CHECK(diastolic[1].slice == "long axis 1");
  CHECK(diastolic[1].phase == 9);
  CHECK(diastolic[1].endo == &s.long_axis[0].endo);
  CHECK(diastolic[1].epi == &s.long_axis[0].epi);

  const auto systolic = cine::images_at(s, 3, 9);  // 4 of 10 images later: 10 of 25
  CHECK(systolic[0].phase == 3);
  CHECK(systolic[1].phase == 19);
  CHECK(systolic[1].picture == &s.long_axis[0].cine.slices[0].frames[18]);
  CHECK(systolic[1].endo == nullptr);
  CHECK(cine::images_at(s, 7, 9)[1].phase == 4);  // over the end of the cycle: 20 of 25
}

TEST_CASE("outlines on a long axis are the ventricle's, beside those on short axes", "[cine]") {
  const test::TemporaryFolder temporary;
  const std::filesystem::path folder = temporary / "results";
  const std::string words = outlined(mesh_of(1, 6.0), folder);
  CHECK(words.find("at end_diastole") != std::string::npos);
  CHECK(words.find("at end_systole") == std::string::npos);  // nothing was drawn then

  const Table distances = Table::read_csv(folder / "outline_distances.csv");
  CHECK(distances.words("slice") == std::vector<std::string>{"4", "long axis 1", "long axis 1"});
  CHECK(farthest(folder) < 0.7);  // chords of 6 mm at the endocardial apex, of radius 6.3 mm

  const Table outlines = Table::read_csv(folder / "outlines.csv");
  const auto state = outlines.words("state");
  const auto slice = outlines.words("slice");
  const auto source = outlines.words("source");
  const auto count = [&](const std::string& s, const std::string& from) {
    int rows = 0;
    for (std::size_t i = 0; i < state.size(); ++i)
      rows += state[i] == s && slice[i] == "long axis 1" && source[i] == from ? 1 : 0;
    return rows;
  };
  CHECK(count("end_diastole", "contours") == 2 * 81);  // open: the first point is not repeated
  CHECK(count("end_systole", "contours") == 0);
  CHECK(count("end_diastole", "model") > 20);
  CHECK(count("end_systole", "model") == count("end_diastole", "model"));
  CHECK(std::filesystem::exists(folder / "pictures" / "end_systole_long_axis_1.png"));
  CHECK(std::filesystem::exists(folder / "outlines_ed.png"));
}

TEST_CASE("a wall lies in images whose loops are drawn around its cavity", "[cine]") {
  const anatomy::MeshResult mesh = mesh_of(1, 12.0);
  const heartbeat::Beat beat = still(mesh);
  const analysis::BeatFields fields;
  const auto lies = [&](const std::optional<geometry::Frame>& place) {
    return cine::lies_in_images({mesh, beat, fields, place}, study());
  };
  CHECK(lies(frame));
  CHECK_FALSE(lies({}));
  CHECK_FALSE(lies(geometry::Frame{}));
  CHECK_FALSE(lies(geometry::Frame{frame.axes, frame.origin + 40.0 * frame.axes.col(0)}));
  CHECK_FALSE(lies(geometry::Frame{-frame.axes, frame.origin}));  // its apex above its base
}

TEST_CASE("a wall that is in no images is not laid over them", "[cine]") {
  const test::TemporaryFolder temporary;
  const std::filesystem::path folder = temporary / "results";
  CHECK(outlined(mesh_of(1, 12.0), folder, {}).empty());
  const auto sources = Table::read_csv(folder / "outlines.csv").words("source");
  REQUIRE_FALSE(sources.empty());  // the contours
  CHECK(std::count(sources.begin(), sources.end(), "model") == 0);
  CHECK(Table::read_csv(folder / "outline_distances.csv").words("slice").empty());
  CHECK(std::filesystem::exists(folder / "pictures" / "end_diastole_long_axis_1.png"));
}

TEST_CASE("outlines follow the curve of quadratic elements", "[cine]") {
  const test::TemporaryFolder temporary;
  const anatomy::MeshResult curved = mesh_of(2, 12.0);
  anatomy::MeshResult straight = curved;  // the same nodes, their cells taken for straight elements
  straight.mesh.order = 1;
  static_cast<void>(outlined(curved, temporary / "curved"));
  static_cast<void>(outlined(straight, temporary / "straight"));
  // A chord half as long is a quarter as far from its arc. Near the apex such large elements are
  // themselves off the ellipsoid.
  const auto off = [&](const char* name) {
    return Table::read_csv(temporary / name / "outline_distances.csv").numbers("mean_mm").front();
  };
  CHECK(off("curved") < 0.4 * off("straight"));
}
