#include "lv/draw/enhancement.hpp"

#include "lv/base/check.hpp"
#include "lv/draw/enhancement_json.hpp"
#include "lv/draw/study_json.hpp"

#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace lv;
using Catch::Matchers::Contains;
using geometry::Contour;
using geometry::Side;
using nlohmann::json;
using scar::Tissue;

namespace {

constexpr double slices_apart = 8.0;

bool in_bright_sector(const Vec3& x) {
  return x.x() > 0.0 && std::abs(x.y()) < 0.5 * x.x();
}

/// Four slices: bright blood within 20 mm, a scar as bright in a sector of the muscle up to 30 mm.
std::string enhanced_file() {
  return test::nifti_bytes(
      test::label_map({50, 50, 4}, Mat3::Identity(), Vec3(2.0, 2.0, slices_apart),
                      Vec3(-49.0, -49.0, 0.0), [](const Vec3& x) {
                        const double r = x.head<2>().norm();
                        return r < 20.0 ? 120 : r < 30.0 ? in_bright_sector(x) ? 100 : 12 : 40;
                      }));
}

Contour ring(int slice, Side side, double radius) {
  Contour line{.slice = slice, .side = side, .points = {}, .file = "", .lines = {}};
  for (int i = 0; i < 72; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 72.0;
    line.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                             slices_apart * (slice - 1));
  }
  line.drawn = {"proposed", "", ""};
  return line;
}

/// A study whose cine lies on the planes of the enhanced slices.
draw::Study enhanced_study(const test::TemporaryFolder& folder) {
  test::write_bytes(folder / "lge.nii", enhanced_file());
  draw::Study study;
  study.settings.file = folder / "case.toml";
  study.settings.scar.source = mesh::InfarctSource::lge;
  study.settings.scar.lge.image = "lge.nii";
  study.settings.scar.lge.threshold = mesh::ScarThreshold::fwhm;
  study.folder = folder / "heart.draw";
  study.drawing.lines.resize(6);
  for (int slice = 1; slice <= 4; ++slice) {
    image::CineSlice cine;
    image::Picture picture;
    picture.plane.origin = {-49.0, -49.0, slices_apart * (slice - 1)};
    picture.plane.spacing_i = picture.plane.spacing_j = 2.0;
    picture.plane.columns = picture.plane.rows = 50;
    picture.values.assign(2500, 0.0F);
    cine.frames.assign(6, picture);
    study.cine.slices.push_back(cine);
    for (const Side side : {Side::endo, Side::epi})
      study.drawing.lines[2].push_back(ring(slice, side, side == Side::endo ? 20.0 : 30.0));
  }
  study.spacing = slices_apart;
  study.proposal.lines.resize(6);
  study.enhancement =
      draw::open_enhancement(study.settings, study.folder, 3, study.drawing.lines[2]);
  return study;
}

std::size_t count(const scar::ScarMap& map, Tissue tissue) {
  std::size_t n = 0;
  for (const scar::SliceMap& slice : map.slices)
    n += static_cast<std::size_t>(std::count(slice.pixels.begin(), slice.pixels.end(), tissue));
  return n;
}

/// What a page sends that has changed nothing.
json sent_scar(const draw::Study& study) {
  const json told = json::parse(draw::study_json(study))["scar"];
  return {{"walls", told["walls"]}, {"proposed", told["proposed"]}, {"drawn", told["drawn"]}};
}

}  // namespace

TEST_CASE("scar is proposed in the wall that the borders show", "[draw]") {
  const test::TemporaryFolder folder;
  const draw::Study study = enhanced_study(folder);
  REQUIRE(study.enhancement);
  const scar::ScarMap& map = study.enhancement->scar.proposed;
  CHECK(map.threshold == 50.0);  // half of 100: the blood is outside the wall
  const double area = std::numbers::pi * (30.0 * 30.0 - 20.0 * 20.0);
  const double pixels = static_cast<double>(count(map, Tissue::scar));
  CHECK(4.0 * pixels == Approx(4.0 * area * std::atan(0.5) / std::numbers::pi).epsilon(0.05));
  CHECK(4.0 * static_cast<double>(count(map, Tissue::muscle)) ==
        Approx(4.0 * area - 4.0 * pixels).epsilon(0.05));
}

TEST_CASE("lines that lie on the enhanced slices but for their last digits show the wall",
          "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = enhanced_study(folder);
  std::vector<Contour> lines = study.drawing.lines[2];
  for (Contour& line : lines)
    for (std::size_t i = 0; i < line.points.size(); ++i)
      line.points[i].z() += 5e-4 * std::sin(7.0 * static_cast<double>(i * i));
  for (const auto& wall : draw::walls_on(study.settings, study.enhancement->image, lines)) {
    REQUIRE(wall);
    CHECK_FALSE(wall->endo.empty());
  }
}

TEST_CASE("the threshold follows remote muscle that is painted", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = enhanced_study(folder);
  const draw::Enhancement& e = *study.enhancement;
  draw::ScarWish wish;
  wish.rule = draw::ScarRule::remote;
  wish.walls = e.scar.walls;
  wish.remote.assign(4, std::vector<char>(2500, 0));
  CHECK_THROWS_WITH(draw::propose_scar(study.settings, e.image, wish),
                    Contains("no remote muscle is shown"));
  for (int j = 0; j < 50; ++j)
    for (int i = 0; i < 20; ++i)  // all of that half, of which the wall alone counts
      wish.remote[1][static_cast<std::size_t>(50 * j + i)] = 1;
  CHECK(draw::propose_scar(study.settings, e.image, wish).threshold == Approx(12.0));
  study.settings.scar.lge.threshold = mesh::ScarThreshold::sd;
  const auto unknown =
      draw::open_enhancement(study.settings, study.folder, 3, study.drawing.lines[2]);
  CHECK_THAT(unknown->note, Contains("Paint it"));
  CHECK(count(unknown->scar.drawn, Tissue::scar) == 0);
  CHECK(count(unknown->scar.drawn, Tissue::muscle) > 0);
}

TEST_CASE("why half of the brightest says nothing is told without the image's name", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = enhanced_study(folder);
  std::string bytes = enhanced_file();
  for (std::size_t n = 352; n < bytes.size(); ++n)
    bytes[n] = static_cast<char>(static_cast<unsigned char>(bytes[n]) + 80U);
  test::write_bytes(folder / "lge.nii", bytes);
  const auto e = draw::open_enhancement(study.settings, study.folder, 3, study.drawing.lines[2]);
  CHECK_THAT(e->note, Contains("the image has an offset") && !Contains("lge.nii"));
}

TEST_CASE("scar that a page sends back is kept, and read again", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = enhanced_study(folder);
  draw::ScarDrawing scar = draw::said_scar(sent_scar(study), study);
  for (std::size_t s = 0; s < 4; ++s)
    CHECK(scar.drawn.slices[s].pixels == study.enhancement->scar.drawn.slices[s].pixels);
  auto& pixels = scar.drawn.slices[2].pixels;
  std::replace(pixels.begin(), pixels.end(), Tissue::scar, Tissue::remote);
  scar.drawn.slices[2].drawn = {"corrected", "KL", "2026-01-31T12:00:00Z"};
  draw::save(study, study.drawing, scar);
  const auto again = draw::open_enhancement(study.settings, study.folder, 1, {});
  REQUIRE(again);
  CHECK(again->saved);
  CHECK(again->scar.drawn.phase == 3);
  for (std::size_t s = 0; s < 4; ++s) {
    CHECK(again->scar.drawn.slices[s].pixels == scar.drawn.slices[s].pixels);
    CHECK(again->scar.proposed.slices[s].pixels == scar.proposed.slices[s].pixels);
    REQUIRE(again->scar.walls[s]);
    CHECK(again->scar.walls[s]->endo.size() == scar.walls[s]->endo.size());
  }
  CHECK(again->scar.drawn.slices[2].drawn.by == "KL");
  CHECK(again->scar.drawn.slices[1].drawn.how == "proposed");
}

TEST_CASE("scar that no page of ours would send is refused", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = enhanced_study(folder);
  const auto refusal = [&](json scar) {
    try {
      static_cast<void>(draw::said_scar(scar, study));
    } catch (const InputError& error) {
      return std::string(error.what());
    } catch (const json::exception&) {
      return std::string("no drawing");
    }
    return std::string();
  };
  json scar = sent_scar(study);
  CHECK(refusal(scar).empty());
  scar["drawn"]["slices"][0]["scar"].push_back({50, 0, 1});
  CHECK_THAT(refusal(scar), Contains("outside the enhanced image"));
  scar = sent_scar(study);
  scar["drawn"]["slices"][0]["muscle"].push_back(scar["drawn"]["slices"][0]["scar"][0]);
  CHECK_THAT(refusal(scar), Contains("a pixel is there twice"));
  scar = sent_scar(study);
  scar["walls"].erase(0);
  CHECK_THAT(refusal(scar), Contains("other enhanced slices"));
  scar = sent_scar(study);
  scar["drawn"].erase("threshold");
  CHECK(refusal(scar) == "no drawing");
  study.enhancement.reset();
  CHECK_THAT(refusal(sent_scar(enhanced_study(folder))), Contains("no late enhancement"));
}

TEST_CASE("the shift of the case moves the wall on the enhanced slices", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = enhanced_study(folder);
  study.settings.scar.shift = {6.0, 0.0, 0.0};
  const draw::Walls moved =
      draw::walls_on(study.settings, study.enhancement->image, study.drawing.lines[2]);
  REQUIRE(moved[1]);
  const double before = study.enhancement->scar.walls[1]->epi.front().x();
  CHECK(moved[1]->epi.front().x() == Approx(before - 6.0).margin(1e-6));
}
