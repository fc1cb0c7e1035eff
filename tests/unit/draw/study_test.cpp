#include "lv/draw/study.hpp"

#include "lv/anatomy/segmentation.hpp"
#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/draw/study_json.hpp"
#include "lv/draw/whole_save.hpp"
#include "lv/geometry/contours.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <numbers>

using namespace lv;
using Catch::Matchers::Contains;
using geometry::Contour;
using geometry::Side;
using nlohmann::json;

namespace {

constexpr double spacing = 8.0;

/// Four slices of six phases, whose pixels hold their phase.
image::Cine small_cine() {
  image::Cine cine;
  for (int s = 0; s < 4; ++s) {
    image::CineSlice slice;
    slice.name = "Doe^Jane";  // what a header may bring stays out of the page
    for (int t = 0; t < 6; ++t) {
      image::Picture picture;
      picture.plane.origin = {-40.0, -40.0, spacing * s};
      picture.plane.spacing_i = picture.plane.spacing_j = 2.0;
      picture.plane.columns = picture.plane.rows = 40;
      picture.values.assign(1600, static_cast<float>(t));
      slice.frames.push_back(picture);
    }
    cine.slices.push_back(slice);
  }
  return cine;
}

Contour circle(int slice, Side side, double radius) {
  Contour line;
  line.slice = slice;
  line.side = side;
  for (int i = 0; i < 72; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 72.0;
    line.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                             spacing * (slice - 1));
  }
  line.drawn = {"proposed", "", ""};
  return line;
}

draw::Study small_study(const std::filesystem::path& folder) {
  draw::Study study;
  study.name = "heart";
  study.folder = folder;
  study.cine = small_cine();
  study.greys = {0.0F, 5.0F};
  study.spacing = spacing;
  study.proposal.lines.resize(6);
  for (int slice = 1; slice <= 4; ++slice)
    for (auto& lines : study.proposal.lines)
      for (const Side side : {Side::endo, Side::epi})
        lines.push_back(circle(slice, side, side == Side::endo ? 20.0 : 30.0));
  study.proposal.confidence = {{1, 1, 0.4, 0.9}};
  study.drawing = {study.proposal.lines, {}, study.proposal.confidence};
  return study;
}

/// What a page would send that has changed nothing.
json sent(const draw::Study& study) {
  const json all = json::parse(draw::study_json(study));
  return {{"revision", all["revision"]},
          {"contours", all["contours"]},
          {"landmarks", all["landmarks"]},
          {"confidence", all["confidence"]}};
}

std::string complaint(const json& text, const draw::Study& study) {
  try {
    static_cast<void>(draw::read_kept(text.dump(), study));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("what a page sends back unchanged is the drawing", "[draw]") {
  const test::TemporaryFolder folder;
  const draw::Study study = small_study(folder / "heart.draw");
  const draw::Kept kept = draw::read_kept(sent(study).dump(), study);
  REQUIRE(kept.drawing.lines.size() == 6);
  for (std::size_t t = 0; t < 6; ++t) {
    REQUIRE(kept.drawing.lines[t].size() == study.drawing.lines[t].size());
    for (std::size_t n = 0; n < kept.drawing.lines[t].size(); ++n)
      for (std::size_t i = 0; i < 72; ++i)
        CHECK((kept.drawing.lines[t][n].points[i] - study.drawing.lines[t][n].points[i]).norm() <
              1e-3);
  }
}

TEST_CASE("where borders lie is a number of a segmentation's table", "[draw]") {
  const test::TemporaryFolder folder;
  CHECK_FALSE(anatomy::kept_fall(folder / "absent"));
  const auto written = [&](const char* rows) {
    write_file(folder / "segmentation.csv", std::string("quantity,value\n") + rows);
    return anatomy::kept_fall(folder / "");
  };
  CHECK(written("end_diastole,3\nsegment.fall,0.725\n") == 0.725);
  CHECK_FALSE(written("end_diastole,3\n"));
  CHECK_THROWS_AS(written("segment.fall,much\n"), InputError);
}

TEST_CASE("a drawing is kept as contours that the program reads", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = small_study(folder / "heart.draw");
  draw::Drawing drawing = study.drawing;
  drawing.lines[1][2].drawn = {"corrected", "KL, \"the\" reader", "2026-01-31T12:00:00Z"};
  drawing.lines[5].clear();
  drawing.landmarks.push_back({"apex_endo", 4, {1.0, 2.0, 24.0}, "KL", "2026-01-31T12:00:00Z"});
  draw::save(study, drawing);
  CHECK(study.revision == 1);
  const auto contours = folder / "heart.draw" / "contours";
  const auto read = geometry::read_contours(
      {contours / "phase_02.csv", {}, {folder / "heart.draw/apex_endo.csv"}});
  const Contour* changed = geometry::find(read.short_axis, 2, Side::endo);
  REQUIRE(changed != nullptr);
  CHECK(changed->drawn.how == "corrected");
  CHECK(changed->drawn.by == "KL, \"the\" reader");
  CHECK(changed->drawn.when == "2026-01-31T12:00:00Z");
  CHECK(read.apex.size() == 1);
  CHECK_FALSE(std::filesystem::exists(contours / "phase_06.csv"));
  const Table volumes = Table::read_csv(folder / "heart.draw/volumes.csv");
  const double polygon =
      72.0 / 2.0 * std::sin(2.0 * std::numbers::pi / 72.0) * 400.0;  // within 72 corners
  CHECK(volumes.numbers("cavity_volume_ml")[0] ==
        Approx(1e-3 * 4.0 * spacing * polygon).epsilon(1e-4));
  CHECK(volumes.numbers("cavity_volume_ml")[5] == 0.0);
}

TEST_CASE(
    "a save that was cut off while files were moved is finished when the folder is opened next",
    "[draw]") {
  const test::TemporaryFolder folder;
  write_file(folder / "a.csv", "old");
  write_file(folder / "b.csv", "old");
  const auto written = draw::begin_save(folder / "");
  CHECK(written.filename() == "saving");
  std::filesystem::create_directories(written / "contours");
  write_file(written / "a.csv", "new");
  write_file(written / "contours" / "c.csv", "new");
  write_file(written / "b.csv", "");  // to be removed
  draw::finish_interrupted_save(folder / "");
  CHECK(read_file(folder / "a.csv") == "old");  // it was cut off while it was written
  std::filesystem::rename(written, folder / "saved");
  std::filesystem::rename(folder / "saved" / "a.csv", folder / "a.csv");  // one was moved already
  draw::finish_interrupted_save(folder / "");
  CHECK(read_file(folder / "a.csv") == "new");
  CHECK(read_file(folder / "contours" / "c.csv") == "new");
  CHECK_FALSE(std::filesystem::exists(folder / "b.csv"));
  CHECK_FALSE(std::filesystem::exists(folder / "saved"));
  write_file(folder / "saving", "in the way");
  CHECK(std::filesystem::is_empty(draw::begin_save(folder / "")));
}

TEST_CASE("a phase without borders loses its file", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = small_study(folder / "heart.draw");
  draw::save(study, study.drawing);
  CHECK(std::filesystem::exists(folder / "heart.draw" / "contours" / "phase_06.csv"));
  draw::Drawing drawing = study.drawing;
  drawing.lines[5].clear();
  draw::save(study, drawing);
  CHECK_FALSE(std::filesystem::exists(folder / "heart.draw" / "contours" / "phase_06.csv"));
}

TEST_CASE("what no page of ours would send is refused", "[draw]") {
  const test::TemporaryFolder folder;
  const draw::Study study = small_study(folder / "heart.draw");
  const json good = sent(study);
  REQUIRE(complaint(good, study).empty());
  const auto damaged = [&](const char* pointer, const json& value) {
    json bad = good;
    bad[json::json_pointer(pointer)] = value;
    return complaint(bad, study);
  };
  CHECK_THAT(damaged("/contours/0/slice", 5), Contains("no slice 5"));
  CHECK_THAT(damaged("/contours/0/phase", 0), Contains("no phase 0"));
  CHECK_THAT(damaged("/contours/0/side", "rv"), Contains("neither endo nor epi"));
  CHECK_THAT(damaged("/contours/0/how", "guessed"), Contains("how it was drawn"));
  CHECK_THAT(damaged("/contours/0/points", json::array()), Contains("has 0 points"));
  CHECK_THAT(damaged("/contours/0/points/3", {0.0, 0.0, 4.0}), Contains("off slice 1"));
  CHECK_THAT(damaged("/contours/0/points/3", {1e9, 0.0, 0.0}), Contains("off slice 1"));
  CHECK_THAT(damaged("/contours/0/points/3", nullptr), Contains("three coordinates"));
  CHECK_THAT(damaged("/contours/1", good["contours"][0]), Contains("twice"));
  CHECK_THAT(damaged("/contours", 7), Contains("no drawing"));
  CHECK_THAT(
      damaged("/landmarks",
              {{{"name", "../x"}, {"slice", 1}, {"at", {0, 0, 0}}, {"by", ""}, {"when", ""}}}),
      Contains("unknown name"));
  const json mark{{"name", "centre"}, {"slice", 1}, {"at", {0, 0, 0}}, {"by", ""}, {"when", ""}};
  CHECK_THAT(damaged("/landmarks", {mark, mark}), Contains("there twice"));
}

TEST_CASE("a wish to redraw a border is checked as a drawing is", "[draw]") {
  const test::TemporaryFolder folder;
  const draw::Study study = small_study(folder / "heart.draw");
  const json all = json::parse(draw::study_json(study));
  const json line = all["contours"][0]["points"];
  const json good{{"slice", 1},          {"phase", 2},   {"side", "endo"},
                  {"points", {line[3]}}, {"endo", line}, {"epi", json::array()}};
  const draw::Redrawn asked = draw::read_wish(good.dump(), study);
  CHECK(asked.slice == 0);
  CHECK(asked.wish.frame == 1);
  CHECK(asked.wish.points.size() == 1);
  CHECK(asked.wish.endo.size() == 72);
  CHECK(asked.wish.epi.empty());
  const auto refused = [&](const char* name, const json& value) {
    json bad = good;
    bad[name] = value;
    CHECK_THROWS_AS(draw::read_wish(bad.dump(), study), InputError);
  };
  refused("slice", 5);
  refused("phase", 7);
  refused("side", "rv");
  refused("points", json::array());
  refused("points", json::array({{0.0, 0.0, 4.0}}));
  refused("endo", json::array({line[0], line[1]}));
  refused("epi", 7);
}

TEST_CASE("the page is told no name of a person and no path", "[draw]") {
  const test::TemporaryFolder folder;
  const draw::Study study = small_study(folder / "heart.draw");
  const std::string told = draw::study_json(study);
  CHECK_THAT(told, !Contains("Doe"));
  CHECK_THAT(told, !Contains(std::filesystem::temp_directory_path().string()));
}

namespace {

/// A long-axis image of eight pictures in the plane x = 0, rows towards the base.
draw::LongAxisImage long_axis() {
  draw::LongAxisImage view;
  view.greys = {0.0F, 14.0F};
  for (int t = 0; t < 8; ++t) {
    image::Picture picture;
    picture.plane.origin = {0.0, -40.0, -20.0};
    picture.plane.along_row = Vec3::UnitY();
    picture.plane.along_column = Vec3::UnitZ();
    picture.plane.spacing_i = picture.plane.spacing_j = 2.0;
    picture.plane.columns = 40;
    picture.plane.rows = 30;
    picture.values.assign(1200, static_cast<float>(2 * t));
    view.cine.frames.push_back(picture);
  }
  return view;
}

}  // namespace

TEST_CASE("long-axis images count on after the slices, for pictures and landmarks", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = small_study(folder / "heart.draw");
  study.long_axis = {long_axis()};
  const json told = json::parse(draw::study_json(study));
  REQUIRE(told["long_axis"].size() == 1);
  CHECK(told["long_axis"][0]["phases"] == 8);
  CHECK(told["long_axis"][0]["rows"] == 30);
  const std::string bytes = draw::picture_bytes(study, 5);
  REQUIRE(bytes.size() == 8 * 1200);
  CHECK(static_cast<unsigned char>(bytes[7 * 1200]) == 255);  // of its own grey values

  json page = sent(study);
  page["landmarks"] = {
      {{"name", "apex_endo"}, {"slice", 5}, {"at", {0.0, 3.0, -11.0}}, {"by", ""}, {"when", ""}}};
  const draw::Kept kept = draw::read_kept(page.dump(), study);
  REQUIRE(kept.drawing.landmarks.size() == 1);
  CHECK(kept.drawing.landmarks[0].at == Vec3(0.0, 3.0, -11.0));
  page["landmarks"][0]["at"] = {4.0, 3.0, -11.0};
  CHECK_THAT(complaint(page, study), Contains("a point lies off slice 5"));
  page["landmarks"][0]["slice"] = 6;
  CHECK_THAT(complaint(page, study), Contains("there is no slice 6"));
  page = sent(study);
  page["contours"][0]["slice"] = 5;  // borders are drawn on slices alone
  CHECK_THAT(complaint(page, study), Contains("there is no slice 5"));
}

TEST_CASE("pictures are bytes between the study's darkest and brightest", "[draw]") {
  const test::TemporaryFolder folder;
  const std::string bytes = draw::picture_bytes(small_study(folder / "x"), 1);
  REQUIRE(bytes.size() == 6 * 1600);
  for (int t = 0; t < 6; ++t)
    CHECK(static_cast<unsigned char>(bytes[t * 1600]) == 51 * t);
}

TEST_CASE("a file of the drawing that another hand has changed is named", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = small_study(folder / "heart.draw");
  CHECK_FALSE(draw::changed_elsewhere(study));
  draw::save(study, study.drawing);
  CHECK_FALSE(draw::changed_elsewhere(study));
  const auto phase = folder / "heart.draw" / "contours" / "phase_01.csv";
  const std::string text = read_file(phase);
  SECTION("its content") {
    write_file(phase, text.substr(0, text.rfind('\n', text.size() - 2) + 1));
    CHECK(draw::changed_elsewhere(study) == phase);
  }
  SECTION("it is gone") {
    std::filesystem::remove(phase);
    CHECK(draw::changed_elsewhere(study) == phase);
  }
  SECTION("it is written again as it was") {
    write_file(phase, text);
    CHECK_FALSE(draw::changed_elsewhere(study));
  }
  SECTION("a file that no save replaces does not count") {
    write_file(folder / "heart.draw" / "notes.csv", "a\n");
    CHECK_FALSE(draw::changed_elsewhere(study));
  }
}

TEST_CASE("a second study of one folder sees what the first has saved", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study one = small_study(folder / "heart.draw");
  draw::Study other = small_study(folder / "heart.draw");
  draw::save(one, one.drawing);
  REQUIRE(draw::changed_elsewhere(other));
  draw::catch_up(other);
  CHECK_FALSE(draw::changed_elsewhere(other));
  CHECK(other.saved);
  CHECK(other.revision == 1);
  draw::catch_up(other);
  CHECK(other.revision == 1);
  draw::Drawing smaller = one.drawing;
  smaller.lines[2][1] = circle(1, Side::epi, 25.0);
  draw::save(one, smaller);
  draw::catch_up(other);
  const Contour* changed = geometry::find(other.drawing.lines[2], 1, Side::epi);
  REQUIRE(changed != nullptr);
  CHECK(changed->points[0].x() == Approx(25.0));
}

TEST_CASE("what another hand has spoilt is told each time, and never taken for read", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = small_study(folder / "heart.draw");
  draw::save(study, study.drawing);
  write_file(folder / "heart.draw" / "contours" / "phase_02.csv", "slice\n1\n");
  for (int again = 0; again < 2; ++again)
    CHECK_THROWS_AS(draw::catch_up(study), InputError);
  CHECK(draw::changed_elsewhere(study));
  CHECK(study.revision == 3);
}

TEST_CASE("borders of which no wall can be made are named by slice and phases", "[draw]") {
  const test::TemporaryFolder folder;
  draw::Study study = small_study(folder / "heart.draw");
  CHECK(draw::faults_of(study.drawing.lines).empty());
  draw::Lines lines = study.drawing.lines;
  for (const std::size_t t : {0U, 1U, 2U, 4U})
    for (Contour& line : lines[t])
      if (line.slice == 3)
        line.side = line.side == Side::endo ? Side::epi : Side::endo;
  std::swap(lines[5][0].points[10], lines[5][0].points[30]);
  CHECK(draw::faults_of(lines) ==
        std::vector<std::string>{
            "slice 1, phase 6: the endocardium crosses itself",
            "slice 3, phases 1-3, 5: the endocardium encloses the epicardium, as if they were "
            "exchanged"});
  draw::save(study, {lines, {}, {}});
  CHECK(json::parse(draw::study_json(study))["faults"].size() == 2);
}

TEST_CASE("a drawing is kept in no file", "[draw]") {
  const test::TemporaryFolder folder;
  write_file(folder / "a.toml", "name = \"heart\"\n");
  case_file::Case c;
  CHECK_THROWS_WITH(draw::open_study(c, folder / "a.toml"), Contains("is no folder"));
}
