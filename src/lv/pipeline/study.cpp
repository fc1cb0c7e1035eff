#include "lv/pipeline/study.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/printable.hpp"
#include "lv/base/table.hpp"
#include "lv/base/time_left.hpp"
#include "lv/beating_wall/base_motion.hpp"
#include "lv/case_file/family.hpp"
#include "lv/case_file/parameters.hpp"
#include "lv/circulation/circuit.hpp"
#include "lv/circulation/cycle.hpp"
#include "lv/heartbeat/cycle.hpp"
#include "lv/pipeline/beat_result.hpp"
#include "lv/pipeline/calibration.hpp"
#include "lv/pipeline/validate.hpp"
#include "lv/report/study_tables.hpp"
#include "lv/work/workspace.hpp"

#include <fmt/format.h>

#include <chrono>

namespace lv::pipeline {
namespace {

namespace fs = std::filesystem;
using case_file::Case;
using case_file::Member;
using case_file::Stage;

fs::path folder_in(const fs::path& work, Stage stage) {
  return work / stage_folder(static_cast<std::size_t>(stage));
}

bool has_beat(const fs::path& work) {
  return fs::exists(folder_in(work, Stage::beat) / beat_name);
}

/// Walls and what images show do not depend on loads: those of one member serve the next, whose run
/// looks whether they do.
void take_walls(const fs::path& from, const fs::path& to) {
  for (const Stage stage : {Stage::strain, Stage::anatomy, Stage::mesh, Stage::unload}) {
    const fs::path there = folder_in(from, stage);
    const fs::path here = folder_in(to, stage);
    if (!fs::exists(there) || fs::exists(here))
      continue;
    const fs::path half = here.string() + ".copy";
    fs::remove_all(half);
    fs::create_directories(to);
    fs::copy(there, half, fs::copy_options::recursive);
    fs::rename(half, here);
  }
}

bool came_to_limit(const fs::path& work) {
  return read_cycle(folder_in(work, Stage::beat)).is_limit;
}

/// The last beat of a member that has run.
circulation::LoadedBeat loaded_beat(const Member& member, const fs::path& work) {
  const circulation::Cycle cycle = read_cycle(folder_in(work, Stage::beat));
  const int beats = static_cast<int>(cycle.beats.size());
  circulation::LoadedBeat beat{member.name,    member.factors,     beats,
                               cycle.is_limit, cycle.beats.back(), {}};
  for (const circulation::Sample& s : circulation::samples_of(cycle, beats - 1))
    beat.loop.push_back({s.signals.volume, s.signals.pressure});
  return beat;
}

class StudyRun {
 public:
  StudyRun(const Case& c, const RunOptions& options)
      : case_(c),
        options_(options),
        members_(case_file::family(c.study)),
        work_(work_folder(c, options)) {
    if (!c.study.asked())
      throw InputError(c.file.string(), "asks for no study",
                       "Add a list of factors, such as preload = [0.8, 1.2], under [study]");
    static_cast<void>(check_study(c));
  }

  void run() {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      report_progress(i);
      try_member(i);
      parallel::on_root([&] { write(i + 1); });
    }
    if (parallel::is_root())
      print(fmt::format("\n{}\ntable and figure in {}\n", read_file(folder() / "study.txt"),
                        folder().string()));
  }

  /// Which members would run, a line each.
  [[nodiscard]] std::string describe() const {
    std::string text;
    for (std::size_t i = 0; i < members_.size(); ++i)
      text += fmt::format(
          "{:<40} {}\n", members_[i].name,
          has_beat(work_of(i)) ? "has run; its stages are looked at again" : "would run");
    return text;
  }

 private:
  [[nodiscard]] fs::path folder() const { return work_ / "study"; }
  [[nodiscard]] fs::path work_of(std::size_t i) const {
    return i == 0 ? work_ : folder() / members_[i].name;
  }

  /// A member without a solution is marked, and the family goes on; the case itself must have one.
  void try_member(std::size_t i) {
    try {
      run_member(i);
    } catch (const NoSolution& failure) {
      if (i == 0)
        throw;
      log::warn("study: {} has no beat: {}", members_[i].name, failure.what());
      missing_.push_back({members_[i].name, members_[i].factors, failure.what()});
    }
  }

  void run_member(std::size_t i) {
    RunOptions options = options_;
    options.work = work_of(i);
    options.quiet = true;
    const bool is_new = parallel::root_says(!has_beat(options.work));
    const auto begun = std::chrono::steady_clock::now();
    if (i == 0)
      pipeline::run(case_, options);
    else {
      parallel::on_root([&] { take_walls(work_of(0), options.work); });
      pipeline::run(member_case(i), options);
    }
    if (is_new) {
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
      seconds_ += taken.count();
      ++ran_;
    }
  }

  /// Its beats begin where those of the one that it comes from have ended, if they came to a limit
  /// cycle: after fewer, a beat of its own would still be that of the other's load.
  [[nodiscard]] Case member_case(std::size_t i) const {
    Case c = case_file::under(members_[i].factors, with_its_fit());
    if (c.engine == case_file::EngineChoice::immersed)
      return c;
    for (const std::size_t from : {origin_of(i), std::size_t{0}}) {
      const fs::path end = folder_in(work_of(from), Stage::beat) / heartbeat::end_of_beats;
      if (!parallel::root_says(fs::exists(end) && came_to_limit(work_of(from))))
        continue;
      c.protocol.cycle.begin = fs::absolute(end).string();
      return c;
    }
    return c;
  }

  /// The same contractility and heart rate under the case's own load; of that the case itself. So
  /// another factor in a list changes nothing for those that are there.
  [[nodiscard]] std::size_t origin_of(std::size_t i) const {
    const circulation::Factors& f = members_[i].factors;
    for (std::size_t k = 0; k < i; ++k) {
      const circulation::Factors& other = members_[k].factors;
      if (other.preload == 1.0 && other.afterload == 1.0 &&
          other.contractility == f.contractility && other.heart_rate == f.heart_rate)
        return k;
    }
    return 0;
  }

  /// The case with what its own run has fitted, and with the blood that it had.
  [[nodiscard]] Case with_its_fit() const {
    const fs::path beat = folder_in(work_, Stage::beat);
    Case c = fitted(case_, folder_in(work_, Stage::calibrate), beat);
    double& blood = c.circulation.closed_loop.blood;
    if (c.circulation.kind == circulation::Kind::closed_loop && blood == 0.0)
      blood = circulation::blood_of(c.circulation, read_cycle(beat).samples.front().signals);
    return c;
  }

  void report_progress(std::size_t i) const {
    double left = 0.0;
    for (std::size_t k = i; k < members_.size(); ++k)
      left += has_beat(work_of(k)) ? 0.0 : 1.0;
    log::info("study: {} ({} of {}){}", members_[i].name, i + 1, members_.size(),
              time_left(ran_ > 0 ? left * seconds_ / ran_ : -1.0));
  }

  void write(std::size_t done) const {
    std::vector<circulation::LoadedBeat> beats;
    for (std::size_t i = 0; i < done; ++i)
      if (has_beat(work_of(i)))
        beats.push_back(loaded_beat(members_[i], work_of(i)));
    const auto family = circulation::by_contractility(beats);
    fs::create_directories(folder());
    report::study_table(family, missing_).write_csv(folder() / "study.csv");
    drawing::write(report::study_figure(family), folder() / "study.svg");
    write_file(folder() / "study.txt", report::study_text(family, missing_));
  }

  const Case& case_;
  RunOptions options_;
  std::vector<Member> members_;
  std::vector<circulation::MissingBeat> missing_;
  fs::path work_;
  double seconds_ = 0.0;  ///< that members took which this process ran
  int ran_ = 0;
};

}  // namespace

int check_study(const Case& c) {
  const std::vector<Member> members = case_file::family(c.study);
  for (const Member& member : members) {
    const Case there = case_file::under(member.factors, c);
    if (!there.base_motion.file.empty())  // of one period, if it has times in seconds
      static_cast<void>(beating_wall::measured_base_motion(there));
  }
  return c.study.asked() ? static_cast<int>(members.size()) : 0;
}

void run_study(const Case& c, const RunOptions& options) {
  StudyRun study(c, options);
  if (!options.dry_run)
    study.run();
  else if (parallel::is_root()) {
    warn_of(c);
    static_cast<void>(check_case(c));
    print(study.describe());
  }
}

}  // namespace lv::pipeline
