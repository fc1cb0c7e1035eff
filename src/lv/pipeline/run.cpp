#include "lv/pipeline/run.hpp"

#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/log.hpp"
#include "lv/base/nearest.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/printable.hpp"
#include "lv/base/table.hpp"
#include "lv/beating_wall/base_motion.hpp"
#include "lv/beating_wall/heartbeat_fit.hpp"
#include "lv/bench/bench.hpp"
#include "lv/case_file/parameters.hpp"
#include "lv/cine/strain.hpp"
#include "lv/page/page.hpp"
#include "lv/page/place.hpp"
#include "lv/pipeline/calibration.hpp"
#include "lv/pipeline/circulation.hpp"
#include "lv/pipeline/measured_volumes.hpp"
#include "lv/pipeline/stages.hpp"
#include "lv/pipeline/study.hpp"
#include "lv/pipeline/unloading.hpp"
#include "lv/pipeline/validate.hpp"
#include "lv/report/paraview_script.hpp"
#include "lv/report/stage_facts.hpp"
#include "lv/report/table_figures.hpp"
#include "lv/report/work_folder.hpp"
#include "lv/scar/infarct.hpp"
#include "lv/work/ingredients.hpp"
#include "lv/work/version.hpp"
#include "lv/work/workspace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace lv::pipeline {
namespace {

using case_file::Case;
using case_file::Stage;
using parallel::on_root;
using parallel::root_says;

/// The stages in their order, each with what it depends on.
class Pipeline {
 public:
  Pipeline(const Case& c, const RunOptions& options)
      : case_(c),
        options_(options),
        work_(work_folder(c, options)),
        last_(last_stage()),
        files_({work_, c.file}) {}

  void run() {
    std::optional<work::WorkLock> lock;
    on_root([&] {
      lock.emplace(work_);
      std::filesystem::remove(reached());
    });
    on_root([&] { log::to_file(work_ / "log.txt", case_file::names_alone(case_, work_)); });
    on_root([&] { report::write_case_name(work_, case_.name); });
    log::info("{}: ventricle {} on {} rank{}, results in {}", case_.name, work::version(),
              parallel::size(), parallel::size() == 1 ? "" : "s", work_.string());
    warn_of(case_);
    if (const int members = check_study(case_); members > 0)
      log::info("this is the case of [study] as it stands; ventricle study runs its {} cases",
                members);
    if (!case_.strain.measured.empty())  // a mistake there must not come up after the beat
      on_root([&] { static_cast<void>(cine::measured_strains(case_)); });
    const std::vector<Planned> stages = plan();
    check_before(stages);
    for (const Planned& p : stages)
      run_stage(p);
  }

  /// A page of what a case has come to whose fit or beat was refused; its banner says why.
  void show_reached() const {
    if (!parallel::is_root() || !underway_ || *underway_ < Stage::calibrate)
      return;
    write_page({work_}, reached(), Replaces::any_page);
    log::info("page of what was reached: {}", reached().string());
  }

  /// What would run and why, a line a stage; known to the root.
  [[nodiscard]] std::string describe() {
    std::string text;
    warn_of(case_);
    const std::vector<Planned> stages = plan();
    check_before(stages);
    for (const Planned& p : stages) {
      const work::StageFolder stage = folder_of(p);
      text += stage.up_to_date()
                  ? fmt::format("{:<10} is up to date\n", name_of(p.stage))
                  : fmt::format("{:<10} would run, because {}\n", name_of(p.stage), stage.reason());
    }
    return text;
  }

 private:
  /// A stage of the case with what its result depends on, which the root knows.
  struct Planned {
    Stage stage;
    work::Ingredients ingredients;
  };

  /// The stages in their order. Each takes the results of all before it but the circulation's,
  /// which runs by itself, and strain's, which the results look at and fits and beats whose base
  /// moves as the cine shows; what stands for a result is known before it is there.
  [[nodiscard]] std::vector<Planned> plan() {
    std::vector<Planned> stages;
    work::Ingredients before;  // the last result that leads to the next stage
    work::Ingredients strain;
    for (const Stage stage : case_file::all_stages) {
      if (stage > last_ || !case_file::has_stage(case_, stage))
        continue;
      work::Ingredients all;
      on_root([&] { all = work::ingredients(case_, stage, files_); });
      all.insert(before.begin(), before.end());
      if (stage == Stage::results || takes_base_of_cine(stage))
        all.insert(strain.begin(), strain.end());
      work::Ingredients result;
      result["result of " + name_of(stage)] = work::fingerprint_of_result(all);
      if (stage == Stage::strain)
        strain = std::move(result);
      else if (stage != Stage::circulation)
        before = std::move(result);
      stages.push_back({stage, std::move(all)});
    }
    return stages;
  }

  [[nodiscard]] bool takes_base_of_cine(Stage stage) const {
    return case_.base_motion.source == heartbeat::BaseMotionSource::cine &&
           case_file::counts(*case_file::find_parameter("base.motion"), case_, stage);
  }

  [[nodiscard]] work::StageFolder folder_of(const Planned& p) const {
    return {work_, folder(p.stage).filename().string(), p.ingredients};
  }

  /// What validate would refuse of fits and heartbeats must not be found out after the stages
  /// before them.
  void check_before(const std::vector<Planned>& stages) {
    const auto is_due = [&](Stage s) {
      return std::any_of(stages.begin(), stages.end(), [&](const Planned& p) {
        return p.stage == s && !folder_of(p).up_to_date();
      });
    };
    on_root([&] {
      if (!is_due(Stage::calibrate) && !is_due(Stage::beat))
        return;
      if (is_due(Stage::mesh)) {
        CheckedCase checked = check_case(case_);
        shape_ = std::move(checked.shape);
        wall_ = std::move(checked.wall);
      } else {
        if (is_due(Stage::calibrate))
          check_measured_volumes(case_, shape());
        check_on_wall(case_, anatomy::read_mesh_result(folder(Stage::mesh), case_.fibres));
      }
      if (!is_due(Stage::calibrate))
        return;
      if (const std::string little = little_ejection(case_, shape()); !little.empty())
        log::warn("{}", little);
    });
  }

  [[nodiscard]] Stage last_stage() const {
    if (!options_.until)
      return case_file::all_stages.back();
    if (*options_.until == "circulation" && !case_.circulation.asked())
      throw InputError(case_.file.string(), "has no circulation",
                       "Set circulation.kind to \"windkessel\" or \"closed_loop\"");
    if (*options_.until == "strain" && !case_.strain.asked())
      throw InputError(case_.file.string(), "has no cine images",
                       "Name them with strain.cine, and the contours with strain.contours");
    if (*options_.until == "calibrate" && !case_.calibration.asked())
      throw InputError(case_.file.string(), "asks for no calibration",
                       "Set calibrate.passive, calibrate.active or calibrate.cycle, and what was "
                       "measured");
    if (*options_.until == "unload" && !case_file::is_loaded(case_))
      throw InputError(case_.file.string(), "takes the shape of its anatomy as free of stress",
                       "Set unloaded.pressure to the pressure under which it was seen");
    const auto found = std::find(stage_names.begin(), stage_names.end(), *options_.until);
    if (found == stage_names.end()) {
      const std::string nearest = nearest_name(*options_.until, stage_names);
      throw InputError("--until " + *options_.until, "is not a stage",
                       fmt::format("The stages are {}{}", fmt::join(stage_names, ", "),
                                   nearest.empty() ? "" : "; did you mean " + nearest + "?"));
    }
    return static_cast<Stage>(found - stage_names.begin());
  }

  [[nodiscard]] std::filesystem::path folder(Stage stage) const {
    return work_ / stage_folder(static_cast<std::size_t>(stage));
  }

  static const std::string& name_of(Stage stage) {
    return stage_names.at(static_cast<std::size_t>(stage));
  }

  void run_stage(const Planned& planned) {
    interrupt::check_together();
    const Stage s = planned.stage;
    const work::StageFolder stage = folder_of(planned);
    if (root_says(stage.up_to_date())) {
      if (options_.explain)
        log::info("{} is up to date: nothing it depends on has changed", name_of(s));
      show(s);
      return;
    }
    if (options_.explain)
      log::info("{} runs, because {}", name_of(s), stage.reason());
    else
      log::info("{} ...", name_of(s));
    on_root([&] { static_cast<void>(stage.begin()); });
    Case seen = work::stage_view(case_, s);
    if (takes_base_of_cine(s))
      seen = beating_wall::with_base_of_cine(std::move(seen), folder(Stage::strain));
    underway_ = s;
    make(s, seen, stage.unfinished());
    on_root([&] { stage.finish(); });
    underway_.reset();
    show(s);
  }

  /// `c` is the case as the stage sees it.
  void make(Stage s, const Case& c, const std::filesystem::path& part) {
    switch (s) {
      case Stage::circulation:
        on_root([&] { make_circulation(c, part); });
        break;
      case Stage::strain:
        on_root([&] { cine::make_strain(c, part); });
        break;
      case Stage::anatomy:
        on_root([&] {
          for (const geometry::Assumption& a : shape().warnings)
            log::warn("{}", a.text);
          anatomy::write_anatomy(shape(), part);
        });
        break;
      case Stage::mesh:
        on_root([&] {
          const anatomy::MeshResult mesh = wall_ ? *wall_ : make_mesh(c, shape());
          check_room(case_, mesh.mesh);
          anatomy::write_mesh_result(mesh, part);
          report::write_facts(report::MeshFacts{c.regions.septum_angle, mesh.mesh.order,
                                                c.engine == case_file::EngineChoice::immersed},
                              part);
        });
        draw_seen(anatomy::read_mesh_result(part, c.fibres), c, part);
        break;
      case Stage::calibrate:
        calibrate(for_calibration(c), part);
        break;
      case Stage::unload: {
        const auto elements = part / elements_name;
        on_root([&] {
          std::filesystem::create_directories(elements);
          anatomy::write_mesh_result(make_mesh(for_calibration(c), shape()), elements);
        });
        unload(part, elements);
        break;
      }
      case Stage::beat:
        run_beat(c, part);
        break;
      case Stage::results: {
        const auto beat = folder(Stage::beat);
        const auto wall = wall_of(beat);
        const anatomy::MeshResult mesh = anatomy::read_mesh_result(wall, c.fibres);
        text_ = make_results(fitted(c, calibration(), beat), mesh, read_beat(beat, mesh.mesh),
                             fit_record(case_, calibration(), beat), unloaded_shape(wall), part);
        on_root([&] { write_file(part / "summary.txt", text_); });
        break;
      }
      case Stage::report:
        on_root([&] {
          write_page({work_}, part / "report.html", Replaces::any_page);
          report::write_figures(work_, part / "figures");
          write_file(part / "paraview.py",
                     report::paraview_script("../" + folder(Stage::beat).filename().string(),
                                             report::orientation_of(work_)));
        });
        break;
    }
  }

  void draw_seen(const anatomy::MeshResult& mesh, const Case& c,
                 const std::filesystem::path& part) {
    const auto began = std::chrono::steady_clock::now();
    show_mesh(mesh, c, part);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - began;
    seconds_of_pictures_ = elapsed.count();
  }

  void calibrate(const Case& fitting, const std::filesystem::path& part) {
    on_root([&] { anatomy::write_mesh_result(make_mesh(fitting, shape()), part); });
    const auto of_muscle = part / coarse_name;
    const auto of_beats = part / beating_wall::coarse_wall_name;
    make_calibration(fitting, anatomy::read_mesh_result(part, fitting.fibres),
                     {coarse_wall(on_coarse_wall(fitting), of_muscle),
                      coarse_wall(beating_wall::with_coarse_wall(fitting), of_beats)},
                     part);
    on_root([&] {
      std::filesystem::remove_all(of_muscle);
      std::filesystem::remove_all(of_beats);
    });
  }

  /// Where a fit may be tried before, its mesh in a folder of its own; nothing where the mesh comes
  /// from elsewhere, or where a wall so coarse cannot be made.
  std::optional<anatomy::MeshResult> coarse_wall(const std::optional<Case>& coarse,
                                                 const std::filesystem::path& elements) {
    if (!coarse)
      return {};
    on_root([&] {
      if (shape().given)
        return;
      try {
        const anatomy::MeshResult mesh = make_mesh(*coarse, shape());
        std::filesystem::create_directories(elements);
        anatomy::write_mesh_result(mesh, elements);
      } catch (const InputError& failure) {
        log::info("there is no coarse wall for a first fit: {}", failure.what());
      }
    });
    if (!root_says(std::filesystem::exists(elements)))
      return {};
    return anatomy::read_mesh_result(elements, coarse->fibres);
  }

  void run_beat(const Case& c, const std::filesystem::path& part) {
    if (root_says(std::filesystem::exists(part / beat_name))) {
      // finished, but the folder had not got its name yet
      on_root([&] { std::filesystem::remove(part / heartbeat::checkpoint_name); });
      return;
    }
    on_root([&] {
      check_room(case_, anatomy::read_mesh_result(wall_of(part), c.fibres).mesh);
    });  // the box may be new
    heartbeat::Beat beat;
    bool again = false;
    do {
      if (case_file::is_loaded(case_) &&
          root_says(std::filesystem::exists(part / confirmation_name)))
        unload(part,
               folder(Stage::unload) / elements_name);  // with corrected parameters
      const anatomy::MeshResult mesh = anatomy::read_mesh_result(wall_of(part), c.fibres);
      beat = make_beat(fitted(c, calibration(), part), mesh, part);
      log::info("beat: {} steps in {}", beat.steps, log::duration(beat.wall_clock));
      on_root([&] {
        again = c.calibration.fits_muscle() && correct(c, calibration(), beat, part);
        if (again)
          std::filesystem::remove_all(part / "fields");  // the next beat may have fewer
      });
    } while (root_says(again));
    on_root([&] {
      write_beat(beat, part);
      std::filesystem::remove(part / heartbeat::checkpoint_name);
    });
  }

  /// The wall without load for the parameters in use, into a folder.
  void unload(const std::filesystem::path& part, const std::filesystem::path& elements) const {
    const Case c = with_muscle(work::stage_view(case_, Stage::unload), calibration(), part);
    make_unloading(
        c, anatomy::read_mesh_result(folder(Stage::mesh), c.fibres),
        anatomy::read_mesh_result(elements, c.fibres).mesh, part,
        case_.calibration.asked() ? calibration() / unloaded_shape_name : std::filesystem::path(),
        seconds_of_pictures_);
  }

  /// Where the stress-free wall of a beat is.
  [[nodiscard]] std::filesystem::path wall_of(const std::filesystem::path& beat) const {
    if (!case_file::is_loaded(case_))
      return folder(Stage::mesh);
    return unloaded_shape(beat) ? beat : folder(Stage::unload);
  }

  /// Made once, by the first stage that needs it; of the root alone.
  const anatomy::Shape& shape() {
    if (!shape_)
      shape_ = anatomy::make_anatomy(work::stage_view(case_, Stage::anatomy));
    return *shape_;
  }

  [[nodiscard]] std::filesystem::path calibration() const { return folder(Stage::calibrate); }
  [[nodiscard]] std::filesystem::path reached() const { return work_ / "report.html"; }

  /// What a user looks at first.
  void show(Stage stage) const {
    if (!parallel::is_root() || options_.quiet)
      return;
    if (stage == Stage::anatomy && std::filesystem::exists(folder(stage) / "quality.txt"))
      print(fmt::format("\n{}\n", read_file(folder(stage) / "quality.txt")));
    if (stage == Stage::calibrate)
      print(fmt::format("\n{}\nparameters in {}\n\n", read_file(folder(stage) / "calibration.txt"),
                        (folder(stage) / "calibrated.toml").string()));
    if (stage == Stage::circulation)
      print(options_.until == "circulation"
                ? fmt::format("\n{}\ntables and figures in {}\n\n",
                              read_file(folder(stage) / "circulation.txt"), folder(stage).string())
                : fmt::format("the circulation with an elastance instead of this wall: {}\n",
                              (folder(stage) / "circulation.txt").string()));
    if (stage == Stage::strain)
      print(fmt::format("\n{}\nstrain in {}\n\n", read_file(folder(stage) / "strain.txt"),
                        folder(stage).string()));
    if (stage == Stage::results)
      print(fmt::format("\n{}\nresults in {}\n", read_file(folder(stage) / "summary.txt"),
                        folder(stage).string()));
    if (stage == Stage::report)
      print(fmt::format("page: {}\n", (folder(stage) / "report.html").string()));
  }

  const Case& case_;
  RunOptions options_;
  std::filesystem::path work_;
  Stage last_;
  work::FileContents files_;
  std::string text_;
  std::optional<anatomy::Shape> shape_;
  std::optional<anatomy::MeshResult> wall_;  ///< where a check has made it
  std::optional<Stage> underway_;
  double seconds_of_pictures_ = 0.0;  ///< of the seen mesh; 0 where another run made it
  static constexpr const char* coarse_name = "coarse";  ///< folder of the mesh for a first fit
  static constexpr const char* elements_name = "quasi_static";  ///< folder of the mesh for fits
};

}  // namespace

std::filesystem::path work_folder(const Case& c, const RunOptions& options) {
  return options.work.empty() ? c.file.parent_path() / (c.file.stem().string() + ".work")
                              : options.work;
}

void run(const Case& c, const RunOptions& options) {
  if (options.dry_run) {
    const std::string text = Pipeline(c, options).describe();
    if (parallel::is_root())
      print(text);
    return;
  }
  interrupt::install();
  Pipeline pipeline(c, options);
  try {
    pipeline.run();
  } catch (const std::exception& failure) {
    log::keep(fmt::format("the run ended early: {}", failure.what()));  // the program tells it
    if (dynamic_cast<const NoSolution*>(&failure) != nullptr ||
        dynamic_cast<const InputError*>(&failure) != nullptr)
      pipeline.show_reached();
    throw;
  }
}

void write_page(const std::vector<std::filesystem::path>& works, const std::filesystem::path& file,
                Replaces replaces) {
  page::require_place(file);
  if (replaces == Replaces::page_of_same_runs)
    page::require_same_runs(file, works);
  std::vector<page::PageCase> cases;
  for (const std::filesystem::path& work : works) {
    const std::vector<std::string> state = work::state_of(work);
    cases.push_back({work, state.empty(), state});
  }
  if (const std::string unlike = page::unlike_moments(cases); !unlike.empty())
    log::warn("{}", unlike);
  write_file(file, page::page(cases, work::version()));
}

int most_ranks(const std::array<int, 3>& cells) {
  return fluid::most_ranks(cells);
}

std::string bench(const BenchOptions& options) {
  Case c;
  c.file = "bench --cells, --edge";
  std::copy(options.cells.begin(), options.cells.end(), c.box.cells.begin());
  c.mesh.edge_length = options.edge_length;
  if (options.quadrature)
    c.coupling.kind = immersed::CouplingKind::quadrature;
  const anatomy::MeshResult result = make_mesh(c, anatomy::make_anatomy(c));
  check_room(c, result.mesh);
  const lv::bench::Bench measured = lv::bench::measure(
      result.mesh, case_file::model_parameters(c, result.mesh), case_file::myocardium(c));
  return options.json ? lv::bench::json(measured) : lv::bench::text(measured);
}

}  // namespace lv::pipeline
