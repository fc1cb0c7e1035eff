// Case files, tables of strains and the results of earlier stages, damaged: see
// support/mutations.hpp.
#include "support/mutations.hpp"

#include "lv/base/lines.hpp"
#include "lv/case_file/read_case.hpp"
#include "lv/cine/strain_targets.hpp"
#include "lv/mesh/quality.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/pipeline/calibration.hpp"
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
  const auto fit = [](const std::filesystem::path& file) {
    static_cast<void>(pipeline::calibrated({}, file));
  };
  try_damaged("calibration.json",
              "{\"parameters\": {\"C_a\": 1.5, \"scale\": 1.0, \"exponent\": 1.0, \"T_scale\": 5}}",
              fit);
  const auto beats = [](const std::filesystem::path& file) {
    static_cast<void>(pipeline::with_values({}, pipeline::read_heartbeats(file), file));
  };
  try_damaged("heartbeats.json",
              "{\"data\": [{\"name\": \"EDV\", \"unit\": \"ml\", \"measured\": 120.5, \"model\": "
              "120}],\n\"parameters\": [{\"parameter\": \"circulation.windkessel.p_ven\", "
              "\"words\": \"filling pressure\",\n\"unit\": \"mmHg\", \"fitted_to\": \"EDV\", "
              "\"before\": 8, \"value\": 9.5}],\n\"left_alone\": [\"that\"], \"tolerance\": "
              "0.01, \"evaluations\": 7, \"beats\": 20}\n",
              beats);
  const auto unloading = [](const std::filesystem::path& file) {
    static_cast<void>(pipeline::unloaded_shape(file.parent_path()));
  };
  try_damaged("unloaded.json",
              "{\"pressure_mmHg\": 2, \"seen_volume_ml\": 100.5, \"unloaded_volume_ml\": 90,\n"
              "\"loaded_again_volume_ml\": 100.4, \"largest_distance_mm\": 0.1,\n"
              "\"rms_distance_mm\": 0.02, \"klotz_volume_ml\": 79.0, \"smoothing\": 0.0,\n"
              "\"dent_deg\": 3.0, \"nearest_to_itself\": 0.7, \"largest_stretch\": 1.3}\n",
              unloading);
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
