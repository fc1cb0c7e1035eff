// Case files, tables of strains and the results of earlier stages, damaged: see
// support/mutations.hpp.
#include "support/mutations.hpp"

#include "lv/base/lines.hpp"
#include "lv/case_file/read_case.hpp"
#include "lv/cine/strain.hpp"
#include "lv/cine/strain_targets.hpp"
#include "lv/mesh/quality.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/pipeline/calibration.hpp"
#include "lv/pipeline/confirmation.hpp"
#include "lv/pipeline/fit_archive.hpp"
#include "lv/pipeline/stages.hpp"
#include "lv/pipeline/unloading.hpp"
#include "lv/solid/endocardial_surface.hpp"
#include "lv/strain/agreement.hpp"
#include "lv/work/workspace.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/archive_bytes.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;
using test::try_damaged;

/// The files that it names are not there.
void read_case(const std::filesystem::path& file) {
  static_cast<void>(case_file::parse_case(read_text(file), file));
}

/// The file that some work leaves in a folder.
template <class Work>
std::string made(const std::string& name, const Work& work) {
  const test::TemporaryFolder folder;
  work(folder / "");
  return test::bytes_of(folder / name);
}

anatomy::MeshResult mesh_result() {
  anatomy::MeshResult result;
  result.mesh = test::ellipsoid_mesh({}, 25.0, 1);
  result.infarcted.assign(result.mesh.cell_count(), 0.0);
  result.regions = mesh::divide(result.mesh, {});
  return result;
}

solid::CellStress zero_stress() {
  solid::CellStress stress;
  stress.cauchy_passive.setZero();
  stress.cauchy_active.setZero();
  return stress;
}

}  // namespace

TEST_CASE("damaged case files are read or refused", "[unit][pipeline][mutations][records]") {
  std::string text = case_file::starter_case("a case");
  text +=
      "\n[infarct]\nsource = \"labels\"\nshift = [\"1 mm\", \"-2.5 mm\", \"0 cm\"]\n"
      "\n[infarct.labels]\nfile = \"labels.nii.gz\"\nscar = [1, 2]\n"
      "\n[calibrate]\npassive = \"C_a\"\nedv = \"1.2e2 ml\"\n";
  try_damaged("case.toml", text, read_case);
}

TEST_CASE("damaged tables of regional strains are read or refused", "[unit][pipeline][mutations]") {
  const auto read = [](const std::filesystem::path& file) {
    case_file::Case c;
    c.file = file.parent_path() / "case.toml";
    c.calibration.strains = file.filename().string();
    static_cast<void>(cine::strain_targets(c, {{3, 1}, {1, 5}, {7, 5}}));
  };
  try_damaged("strains.csv", "slice,segment,strain\n3,Ant,-0.2\n1,InfLat,-0.15\nAHA,7,-0.1\n",
              read);
}

TEST_CASE("damaged tables of measured strains are read or refused", "[unit][strain][mutations]") {
  const auto read = [](const std::filesystem::path& file) {
    static_cast<void>(strain::read_measured(file, "frame 2", strain::Measure::engineering));
  };
  try_damaged("measured.csv",
              "slice,component,segment,frame1,frame 2\n1,cir,Ant,0,-0.1\n1,rad,Ant,0,0.2\n"
              "2,cir,InfSept,0,-0.12\n2,rad,AntLat,0,\"0.3\"\n",
              read);
}

TEST_CASE("a damaged mesh of an earlier run is read or refused",
          "[unit][pipeline][mutations][records]") {
  const auto read = [](const std::filesystem::path& file) {
    static_cast<void>(anatomy::read_mesh_result(file.parent_path(), {}));
  };
  const std::string bytes = made(
      "mesh.bin", [](const auto& folder) { anatomy::write_mesh_result(mesh_result(), folder); });
  try_damaged("mesh.bin", bytes, read, {}, test::repair_checksum);
}

TEST_CASE("a damaged beat of an earlier run is read or refused",
          "[unit][pipeline][mutations][records]") {
  const mesh::Mesh mesh = mesh_result().mesh;
  const auto read = [&](const std::filesystem::path& file) {
    static_cast<void>(pipeline::read_beat(file.parent_path(), mesh));
  };
  heartbeat::Beat beat;
  beat.curves.resize(2);
  beat.moments.resize(2);
  beat.moments[0].name = heartbeat::end_diastole;
  beat.moments[0].wall.positions = mesh.nodes;
  beat.moments[0].wall.tension.resize(mesh.nodes.size());
  beat.moments[1].name = heartbeat::end_systole;
  beat.moments[1].wall.positions = mesh.nodes;
  beat.moments[1].wall.stress.resize(static_cast<std::size_t>(mesh.cell_count()), zero_stress());
  const std::string bytes =
      made("beat.bin", [&](const auto& folder) { pipeline::write_beat(beat, folder); });
  try_damaged("beat.bin", bytes, read, {}, test::repair_checksum);
}

TEST_CASE("damaged records of earlier stages are read or refused",
          "[unit][pipeline][mutations][records]") {
  const auto record = [](const std::filesystem::path& file) {
    const auto folder = file.parent_path();
    const work::StageFolder stage(folder.parent_path(), folder.filename().string(),
                                  {{"mesh.edge_length", "1.4 mm"}});
    static_cast<void>(stage.up_to_date());
    static_cast<void>(stage.reason());
  };
  try_damaged("stage.json",
              "{\n \"ingredients\": {\n  \"mesh.edge_length\": \"1.4 mm\"\n },\n"
              " \"bytes\": {\n  \"mesh.bin\": 1200\n }\n}\n",
              record);
}

TEST_CASE("damaged numbers of the images and the anatomy are read or refused",
          "[unit][pipeline][mutations][records]") {
  const auto read_phases = [](const std::filesystem::path& file) {
    static_cast<void>(cine::read_phases(file.parent_path()));
  };
  const std::string phases = made("phases.bin", [](const auto& folder) {
    cine::write_phases({3, 14}, folder);
    CHECK(cine::read_phases(folder).end_systole == 14);
  });
  try_damaged("phases.bin", phases, read_phases, {}, test::repair_checksum);

  const auto read_anatomy = [](const std::filesystem::path& file) {
    static_cast<void>(anatomy::anatomy_record(file.parent_path()));
  };
  const std::string anatomy = made("anatomy.bin", [](const auto& folder) {
    const case_file::Case ellipsoid;
    anatomy::Shape shape = anatomy::make_anatomy(ellipsoid);
    shape.is_in_images = true;
    shape.frame.origin = {1.0, -2.0, 1.0 / 3.0};
    shape.assumed = {{"septum", "nothing shows it"}};
    anatomy::write_anatomy(shape, folder);
    const anatomy::AnatomyRecord record = anatomy::anatomy_record(folder);
    REQUIRE(record.frame);
    CHECK(record.frame->origin == shape.frame.origin);
    CHECK(record.frame->axes == shape.frame.axes);
    REQUIRE(record.assumed.size() == 1);
    CHECK(record.assumed[0].part == "septum");
  });
  try_damaged("anatomy.bin", anatomy, read_anatomy, {}, test::repair_checksum);
}

TEST_CASE("damaged fits of an earlier run are read or refused",
          "[unit][pipeline][mutations][records]") {
  const auto& all = calibrate::all_parameters();
  const calibrate::RecordedFit fit{
      {1.0, 2.0, 1.5, 3.0},
      {all[1], all[3]},
      {{"EDV", 1.0, 12e4, 12e4, {{"scale", -1e4}, {"T_scale", 0.5}}}},
      1.2,
      {{2.0, {}, 0.0, "too soft"}, {0.5, {{1.0, 2.5, 1.5, 4.0}}, 9e4, ""}}};
  const auto read_fit = [](const std::filesystem::path& file) {
    static_cast<void>(pipeline::load_fit(heartbeat::Archive::read(file)));
    static_cast<void>(pipeline::calibrated({}, file));
  };
  const std::string fitted = made("calibration.bin", [&](const auto& folder) {
    heartbeat::Archive archive;
    pipeline::store(fit, archive);
    archive.write(folder / "calibration.bin");
  });
  try_damaged("calibration.bin", fitted, read_fit, {}, test::repair_checksum);

  const pipeline::Confirmation confirmation{
      {}, 0.01, {{{}, {{"EDV", 12e4, 12e4, 12e4}}, true}, {{}, {}, false}}};
  const auto read_confirmation = [](const std::filesystem::path& file) {
    static_cast<void>(pipeline::read_confirmation(file));
  };
  const std::string confirmed = made("confirmation.bin", [&](const auto& folder) {
    pipeline::write_confirmation(confirmation, folder / "confirmation.bin");
  });
  try_damaged("confirmation.bin", confirmed, read_confirmation, {}, test::repair_checksum);

  const beating_wall::HeartbeatFit beats{
      {{"EDV", "ml", 120.5, 120.0}},
      {{"circulation.windkessel.p_ven", "filling pressure", "mmHg", "EDV", 8.0, 9.5}},
      Eigen::MatrixXd::Constant(1, 1, 0.5),
      {"that"},
      0.01,
      7,
      20};
  const auto read_beats = [](const std::filesystem::path& file) {
    static_cast<void>(beating_wall::with_values({}, beating_wall::read_heartbeats(file), file));
  };
  const std::string heartbeats = made("heartbeats.bin", [&](const auto& folder) {
    beating_wall::write_heartbeats(beats, folder / "heartbeats.bin");
  });
  try_damaged("heartbeats.bin", heartbeats, read_beats, {}, test::repair_checksum);
}

TEST_CASE("a damaged result of an earlier unloading is read or refused",
          "[unit][pipeline][mutations][records]") {
  report::UnloadedShape shape{2.0, 1e5, 9e4, 1e5, 0.1, 0.02, 79e3, 0.0, {}};
  shape.folds.dent = 0.05;
  shape.warnings = {"it is a smooth one"};
  const auto read = [](const std::filesystem::path& file) {
    static_cast<void>(pipeline::unloaded_shape(file.parent_path()));
  };
  const test::TemporaryFolder folder;
  pipeline::write_shape(shape, folder / "");
  const auto found = pipeline::unloaded_shape(folder / "");
  REQUIRE(found);
  CHECK(found->rms == 0.02);
  CHECK(found->folds.dent == 0.05);
  CHECK(found->warnings == shape.warnings);
  try_damaged("unloading.bin", test::bytes_of(folder / "unloading.bin"), read, {},
              test::repair_checksum);
}

TEST_CASE("a damaged mesh of an earlier run that is read is one",
          "[unit][pipeline][mutations][records]") {
  const auto use = [](const std::filesystem::path& file) {
    const anatomy::MeshResult result = anatomy::read_mesh_result(file.parent_path(), {});
    static_cast<void>(mesh::quality(result.mesh));
    static_cast<void>(mesh::divide(result.mesh, {}));
    static_cast<void>(solid::EndocardialSurface(result.mesh).volume(result.mesh.nodes));
  };
  const std::string bytes = made(
      "mesh.bin", [](const auto& folder) { anatomy::write_mesh_result(mesh_result(), folder); });
  try_damaged("mesh.bin", bytes, use, {}, test::repair_checksum);
}
