// Checkpoints, damaged: see support/mutations.hpp.
#include "support/mutations.hpp"

#include "lv/heartbeat/base_motion.hpp"
#include "lv/heartbeat/run_state.hpp"

#include "support/archive_bytes.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;
using namespace heartbeat;

std::string checkpoint() {
  const test::TemporaryFolder folder;
  RunState run;
  run.frames = 2;
  run.frame_times = {0.0, 0.5};
  run.steady.record(0.1, 100.0);
  run.beat.curves.resize(2);
  run.least.positions.resize(3, Vec3::Ones());
  run.least.stress.resize(2);
  run.beat.moments = {{end_diastole, "filling", true, run.least}};
  Archive archive;
  store(run, archive);
  archive.write(folder / "checkpoint.bin");
  return test::bytes_of(folder / "checkpoint.bin");
}

void read_base_motion(const std::filesystem::path& file) {
  static_cast<void>(read_motion({file.string(), 0.8}));
}

void read_run_state(const std::filesystem::path& file) {
  static_cast<void>(load_run_state(Archive::read(file), phases({})));
}

}  // namespace

TEST_CASE("damaged tables of a base's motion are read or refused", "[unit][heartbeat][mutations]") {
  test::try_damaged("motion.csv",
                    "time_s,axial_mm,septal_tilt_deg,anterior_tilt_deg,rotation_deg\n0,0,0,0,0\n"
                    "0.2,12,1,-1,3\n0.4,13,1,0,-2\n0.6,2,0,0,0\n0.8,0,0,0,0\n",
                    read_base_motion);
}

TEST_CASE("damaged checkpoints are read or refused", "[unit][heartbeat][mutations]") {
  test::try_damaged("checkpoint.bin", checkpoint(), read_run_state);
}

TEST_CASE("checkpoints that say anything are read or refused",
          "[unit][heartbeat][mutations][records]") {
  test::try_damaged("checkpoint.bin", checkpoint(), read_run_state, {}, test::repair_checksum);
}
