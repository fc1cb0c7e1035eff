#include "lv/scar/scar_map.hpp"

#include "lv/base/check.hpp"
#include "lv/image/volume_file.hpp"
#include "lv/mesh/infarct.hpp"
#include "lv/scar/infarct.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/mutations.hpp"
#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace lv;
using Catch::Matchers::Contains;
using geometry::Contour;
using geometry::Side;
using scar::ScarMap;
using scar::Tissue;

/// Slices of 30 rows of 40 pixels, 1.5 x 2 mm, 8 mm apart, askew in space.
image::Cine enhanced(std::size_t slices = 3) {
  image::Cine image;
  for (std::size_t s = 0; s < slices; ++s) {
    image::Picture picture;
    picture.plane.along_row = Vec3(0.6, 0.8, 0.0);
    picture.plane.along_column = Vec3(-0.8, 0.6, 0.0);
    picture.plane.origin = Vec3(3.0, -20.0, 8.0 * static_cast<double>(s));
    picture.plane.spacing_i = 1.5;
    picture.plane.spacing_j = 2.0;
    picture.plane.columns = 40;
    picture.plane.rows = 30;
    picture.values.assign(1200, 10.0F);
    image.slices.push_back({"a slice", {picture}, {}, 0.0});
  }
  return image;
}

ScarMap some_map(const image::Cine& image) {
  ScarMap map{{}, 72.5, 4};
  for (const image::CineSlice& slice : image.slices)
    map.slices.push_back({std::vector<Tissue>(slice.frames.front().values.size(), Tissue::outside),
                          {"proposed", "", ""}});
  auto& pixels = map.slices[1].pixels;
  std::fill_n(pixels.begin() + 5 * 40 + 3, 10, Tissue::muscle);
  std::fill_n(pixels.begin() + 5 * 40 + 6, 4, Tissue::scar);
  std::fill_n(pixels.begin() + 29 * 40 + 36, 4, Tissue::remote);
  map.slices[1].drawn = {"corrected", "KL, \"me\"", "2026-01-31T12:00:00Z"};
  return map;
}

std::vector<Vec3> circle(double radius, double z) {
  std::vector<Vec3> points;
  for (int k = 0; k < 180; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 180.0;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return points;
}

Contour loop(int slice, Side side, double radius, double z) {
  return {.slice = slice, .side = side, .points = circle(radius, z), .file = "", .lines = {}};
}

/// The plane across z at a height, its first pixel in the middle.
image::Plane level(double z) {
  image::Plane plane;
  plane.origin.z() = z;
  return plane;
}

}  // namespace

TEST_CASE("a map of scar is read as it was written", "[unit][scar]") {
  const test::TemporaryFolder folder;
  const image::Cine image = enhanced();
  const ScarMap map = some_map(image);
  table_of(map, image).write_csv(folder / "scar.csv");
  const ScarMap read = scar::read_scar_map(folder / "scar.csv", image);
  REQUIRE(read.slices.size() == 3);
  for (std::size_t s = 0; s < 3; ++s)
    CHECK(read.slices[s].pixels == map.slices[s].pixels);
  CHECK(read.threshold == 72.5);
  CHECK(read.phase == 4);
  CHECK(read.slices[1].drawn.by == "KL, \"me\"");
  CHECK(read.slices[1].drawn.how == "corrected");
}

TEST_CASE("a map of another image, and one that was spoilt, is refused", "[unit][scar]") {
  const test::TemporaryFolder folder;
  const image::Cine image = enhanced();
  table_of(some_map(image), image).write_csv(folder / "scar.csv");
  image::Cine other = image;
  other.slices[1].frames.front().plane.origin.x() += 1.0;
  CHECK_THROWS_WITH(scar::read_scar_map(folder / "scar.csv", other),
                    Contains("1.0 mm from where the image has it") && Contains("another image"));
  other.slices.resize(1);
  CHECK_THROWS_WITH(scar::read_scar_map(folder / "scar.csv", other), Contains("slice \"2\""));
  const auto refusal = [&](const std::string& row) {
    test::write_bytes(folder / "bad.csv",
                      "slice,tissue,row,first,last,x_mm,y_mm,z_mm,phase,threshold,how,by,when\n"
                      "1,scar,1,1,2,3,-20,0,4,72.5,proposed,,\n" +
                          row + "\n");
    try {
      static_cast<void>(scar::read_scar_map(folder / "bad.csv", image));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal("1,muscle,1,3,3,4.8,-17.6,0,4,72.5,proposed,,").empty());
  CHECK_THAT(refusal("1,muscle,1,2,2,3.9,-18.8,0,4,72.5,proposed,,"),
             Contains("pixel 2 of row 1 stands there twice"));
  CHECK_THAT(refusal("1,bone,1,3,3,4.8,-17.6,0,4,72.5,proposed,,"), Contains("unknown tissue"));
  CHECK_THAT(refusal("1,scar,1,3,41,4.8,-17.6,0,4,72.5,proposed,,"), Contains("last \"41\""));
  CHECK_THAT(refusal("1,scar,1,3,3"), Contains("5 values in a table of 13 columns"));
  CHECK_THAT(refusal("1,scar,1,3,3,4.8,-17.6,nan,4,72.5,proposed,,"), Contains("z_mm \"nan\""));
}

TEST_CASE("damaged maps of scar are refused or read, and nothing else", "[unit][scar][mutations]") {
  const test::TemporaryFolder folder;
  const image::Cine image = enhanced();
  table_of(some_map(image), image).write_csv(folder / "scar.csv");
  test::try_damaged("scar.csv", test::bytes_of(folder / "scar.csv"),
                    [&](const std::filesystem::path& file) {
                      static_cast<void>(scar_stack(scar::read_scar_map(file, image), image));
                    });
}

TEST_CASE("a wall is cut between its slices, and half a slice beyond them", "[unit][scar]") {
  const std::vector<Contour> lines{loop(1, Side::endo, 20.0, 0.0), loop(2, Side::endo, 10.0, 8.0),
                                   loop(1, Side::epi, 30.0, 0.0), loop(2, Side::epi, 20.0, 8.0)};
  const scar::Triangles endo = scar::surface_through(lines, Side::endo);
  const scar::Triangles epi = scar::surface_through(lines, Side::epi);
  for (const auto& [z, radius] :
       {std::pair{4.0, 15.0}, std::pair{0.0, 20.0}, std::pair{-3.9, 20.0}, std::pair{11.9, 10.0}}) {
    const auto found = scar::wall_outlines(endo, epi, level(z));
    REQUIRE(found);
    for (const Eigen::Vector2d& x : found->endo)
      CHECK(x.norm() == Approx(radius).margin(0.05));
    CHECK(scar::part_at(*found, {radius - 0.5, 0.0}) == 0);
    CHECK(scar::part_at(*found, {radius + 0.5, 0.0}) == 1);
    CHECK(scar::part_at(*found, {radius + 10.5, 0.0}) == 2);
  }
  CHECK_FALSE(scar::wall_outlines(endo, epi, level(12.1)));
  CHECK_FALSE(scar::wall_outlines(endo, epi, level(-4.1)));
}

TEST_CASE("the dark core of a scar counts to it, muscle at the epicardium does not",
          "[unit][scar]") {
  image::Picture picture = enhanced(1).slices.front().frames.front();
  // columns 0 to 9 cavity, 10 to 19 wall, the rest surroundings
  std::vector<char> parts;
  for (int n = 0; n < 1200; ++n)
    parts.push_back(static_cast<char>(n % 40 < 10 ? 0 : n % 40 < 20 ? 1 : 2));
  for (int row = 10; row < 20; ++row)
    for (int i = 10; i < 18; ++i)
      picture.values[40 * static_cast<std::size_t>(row) + i] = 100.0F;
  for (int row = 13; row < 16; ++row)  // a core at the endocardium
    for (int i = 10; i < 13; ++i)
      picture.values[40 * static_cast<std::size_t>(row) + i] = 5.0F;
  const auto count = [&](bool fill) {
    const auto scar = scar::brighter(picture, parts, 50.0, fill);
    return std::count(scar.begin(), scar.end(), 1);
  };
  CHECK(count(false) == 80 - 9);
  CHECK(count(true) == 80);
}

TEST_CASE("pixels beside the mapped wall take what the nearest of the wall has", "[unit][scar]") {
  const image::Cine image = enhanced();
  const image::Cine stack = scar_stack(some_map(image), image);
  const image::Picture& slice = stack.slices[1].frames.front();
  CHECK(slice.at(7, 5) == 1.0F);
  CHECK(slice.at(7, 7) == 1.0F);  // 4 mm below
  CHECK(slice.at(7, 8) == 0.0F);  // 6 mm
  CHECK(slice.at(3, 5) == 0.0F);
  CHECK(slice.at(3, 4) == 0.0F);  // beside muscle
  CHECK(*std::max_element(stack.slices[0].frames.front().values.begin(),
                          stack.slices[0].frames.front().values.end()) == 0.0F);
}

TEST_CASE("scar that was drawn is taken in place of a threshold", "[unit][scar]") {
  const mesh::Mesh wall = test::ellipsoid_mesh({}, 4.0);
  const test::TemporaryFolder folder;
  const auto in_scar = [](const Vec3& X) { return X.y() > 5.0 && X.z() > -40.0 && X.z() < -8.0; };
  test::NiftiSpec spec = test::label_map({60, 60, 26}, Mat3::Identity(), Vec3(2.0, 2.0, 4.0),
                                         Vec3(-59.0, -59.0, -98.0),
                                         [&](const Vec3& X) { return in_scar(X) ? 200 : 10; });
  test::write_bytes(folder / "lge.nii", test::nifti_bytes(spec));
  case_file::Case c;
  c.file = folder / "case.toml";
  c.scar.source = mesh::InfarctSource::lge;
  c.scar.lge.image = "lge.nii";
  c.scar.lge.threshold = mesh::ScarThreshold::fwhm;
  const auto volume = [&] {
    return mesh::infarct_volumes(wall, scar::infarct_extent(c, {}, wall).part).infarct;
  };
  const double by_threshold = volume();
  const image::Cine image = image::read_volume_cine(folder / "lge.nii");
  ScarMap map{{}, 105.0, 1};
  for (const image::CineSlice& slice : image.slices) {
    const image::Picture& picture = slice.frames.front();
    auto& pixels = map.slices.emplace_back().pixels;
    for (int j = 0; j < picture.plane.rows; ++j)
      for (int i = 0; i < picture.plane.columns; ++i) {
        const double r = picture.plane.point(i, j).head<2>().norm();
        pixels.push_back(r > 32.0                   ? Tissue::outside
                         : picture.at(i, j) > 105.0 ? Tissue::scar
                                                    : Tissue::muscle);
      }
    map.slices.back().drawn = {"proposed", "", ""};
  }
  table_of(map, image).write_csv(folder / "scar.csv");
  c.scar.lge.drawn = "scar.csv";
  CHECK(volume() == Approx(by_threshold).epsilon(0.01));
  for (scar::SliceMap& slice : map.slices)
    std::replace(slice.pixels.begin(), slice.pixels.end(), Tissue::scar, Tissue::muscle);
  table_of(map, image).write_csv(folder / "scar.csv");
  CHECK_THROWS_WITH(volume(), Contains("drawn in") && Contains("holds the centre of no element"));
}
