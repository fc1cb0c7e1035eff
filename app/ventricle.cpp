#include "lv/anatomy/segmentation.hpp"
#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/launch.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/printable.hpp"
#include "lv/base/processors.hpp"
#include "lv/base/table.hpp"
#include "lv/base/units.hpp"
#include "lv/case_file/read_case.hpp"
#include "lv/draw/draw.hpp"
#include "lv/phantom/person.hpp"
#include "lv/phantom/study.hpp"
#include "lv/pipeline/run.hpp"
#include "lv/pipeline/study.hpp"
#include "lv/pipeline/validate.hpp"
#include "lv/proposal/list_images.hpp"
#include "lv/proposal/propose_case.hpp"
#include "lv/verify/run.hpp"
#include "lv/work/version.hpp"

#include "documents.hpp"
#include "help.hpp"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <optional>
#include <system_error>

namespace {

// exit codes; 0: done
constexpr int wrong_input = 1;  // or a failed verification
constexpr int no_way_on = 2;    // a run that could not go on
constexpr int defect = 3;       // of the program
constexpr int interrupted = lv::interrupt::exit_code;

constexpr int usual_ranks = 8;    // that are started at most, unless more are asked for
constexpr int most_ranks = 1024;  // that may be asked for

/// What the command line asks for.
struct Command {
  std::string case_file;
  std::string new_file = "case.toml";
  std::string source;  ///< that a new case is made from
  std::string filter;  ///< of the parameters to list
  std::string until;
  std::vector<std::filesystem::path> works;
  std::string page;
  lv::pipeline::RunOptions run;
  int ranks = 0;
  bool markdown = false;
  lv::pipeline::BenchOptions bench;
  lv::proposal::ListOptions images;
  bool list = false;
  lv::verify::Options verify;
  lv::phantom::Ventricle ventricle;
  lv::phantom::Scan scan;
  lv::phantom::StudyFiles study;
  std::uint32_t person = 0;  ///< 0: the study of the other options
  std::string folder;
  lv::draw::Options draw;
  bool no_browser = false;
  std::string solve_in;  ///< folder for the findings of one problem, see verify::solve_option
};

/// Does something that may be asked to stop, as all ranks are together; the exit code.
template <class Work>
int until_stopped(const Work& work) {
  try {
    work();
    return 0;
  } catch (const lv::Interrupted& stop) {
    if (lv::parallel::is_root())
      fmt::print(stderr, "ventricle: {}\n", lv::printable_lines(stop.what()));
    return interrupted;
  }
}

void write_new_case(const std::string& file, const std::string& source) {
  if (std::filesystem::exists(std::filesystem::symlink_status(file)))
    throw lv::InputError(file, "exists already", "Choose another name");
  lv::write_file(file, source.empty()
                           ? lv::case_file::starter_case(std::filesystem::path(file).stem())
                           : lv::proposal::proposed_case(source, file));
  lv::print(fmt::format("wrote {}; next: ventricle validate {}\n", file, file));
}

/// Refuses more ranks than the computation can be divided among, and two answers to how many.
void check_ranks(const std::string& how, int ranks, int most) {
  if (ranks > most)
    throw lv::InputError(
        how, fmt::format("the box can be divided among {} ranks at most", most),
        fmt::format("Use at most {} ranks, or more box.cells along x and z", most));
}

/// Runs this program under mpirun if it is to run on several ranks. Its exit code; nothing if this
/// process is to do the work itself. Mistakes are told before any rank starts.
std::optional<int> run_on_ranks(const Command& command, int most, int argc, char** argv) {
  const int started = lv::launch::world_size();
  if (started > 1) {
    if (command.ranks > 0 && command.ranks != started)
      throw lv::InputError(fmt::format("--ranks {}", command.ranks),
                           fmt::format("mpirun has started {} ranks", started),
                           "Leave out --ranks, or mpirun");
    check_ranks(fmt::format("mpirun -n {}", started), started, most);
    return {};
  }
  check_ranks(fmt::format("--ranks {}", command.ranks), command.ranks, most);
  const int usual =
      lv::launch::hindrance().empty() ? std::min({lv::processors(), usual_ranks, most}) : 1;
  const int ranks = command.ranks > 0 ? command.ranks : usual;
  if (ranks == 1)
    return {};
  return lv::launch::run_in_front(ranks, {argv + 1, argv + argc});
}

int bench(const Command& command, int argc, char** argv) {
  const std::vector<int>& n = command.bench.cells;
  const int most = lv::pipeline::most_ranks({n.at(0), n.at(1), n.at(2)});
  if (const auto code = run_on_ranks(command, most, argc, argv))
    return *code;
  const lv::parallel::Session session(&argc, &argv);
  const std::string result = lv::pipeline::bench(command.bench);
  if (lv::parallel::is_root())
    lv::print(result);
  return 0;
}

/// Runs a case, or the family that its [study] asks for.
template <class Run>
int run_parallel(Command& command, const Run& run, int argc, char** argv) {
  const lv::case_file::Case c = lv::case_file::read_case(command.case_file);
  const int most = c.engine == lv::case_file::EngineChoice::immersed
                       ? lv::pipeline::most_ranks(c.box.cells)
                       : most_ranks;
  if (!command.run.dry_run)  // which is done at once
    if (const auto code = run_on_ranks(command, most, argc, argv))
      return *code;
  const lv::parallel::Session session(&argc, &argv);
  if (!command.until.empty())
    command.run.until = command.until;
  return until_stopped([&] { run(c, command.run); });
}

int validate(const Command& command, int argc, char** argv) {
  const lv::parallel::Session session(&argc, &argv);
  lv::print(lv::pipeline::validate(lv::case_file::read_case(command.case_file)));
  return 0;
}

/// Runs the stages up to one that needs one rank.
int run_alone(Command& command, const std::string& stage, int argc, char** argv) {
  const lv::case_file::Case c = lv::case_file::read_case(command.case_file);
  const lv::parallel::Session session(&argc, &argv);
  command.run.until = stage;
  return until_stopped([&] { lv::pipeline::run(c, command.run); });
}

int segment(const Command& command) {
  const lv::case_file::Case c = lv::case_file::read_case(command.case_file);
  std::filesystem::path folder = command.folder;
  if (folder.empty())
    folder = c.file.parent_path() / (c.file.stem().string() + ".segment");
  lv::interrupt::install();
  return until_stopped([&] { lv::print(lv::anatomy::segment_case(c, folder)); });
}

int draw(Command& command) {
  command.draw.browser = !command.no_browser;
  command.draw.folder = command.folder;
  const lv::case_file::Case c = lv::case_file::read_case(command.case_file);
  lv::interrupt::install();
  return until_stopped([&] { lv::draw::run(c, command.draw); });
}

int verify(const Command& command, int argc, char** argv) {
  if (command.list) {
    lv::print(lv::verify::list());
    return 0;
  }
  lv::interrupt::install();
  if (command.solve_in.empty())
    return lv::verify::run(command.verify) ? 0 : wrong_input;
  const lv::parallel::Session session(&argc, &argv);
  return until_stopped([&] { lv::verify::solve(command.verify.names.at(0), command.solve_in); });
}

int phantom(const Command& command) {
  lv::interrupt::install();
  if (command.person > 0) {
    lv::print(lv::phantom::write_person(command.person, command.folder));
    return 0;
  }
  lv::print(
      lv::phantom::write_study(command.ventricle, command.scan, command.study, command.folder));
  return 0;
}

void add_page(CLI::App& app, Command& command, const char* name, const char* help, int works) {
  auto* page = app.add_subcommand(name, help);
  page->add_option("WORK", command.works, "work folders of ventricle run")
      ->required()
      ->expected(works);
  page->add_option("--output", command.page,
                   fmt::format("the page to write (default: {}.html, unless that is the page of "
                               "another run)",
                               name));
}

int write_page(const Command& command, const std::string& name, int argc, char** argv) {
  const lv::parallel::Session session(&argc, &argv);
  const std::string file = command.page.empty() ? name + ".html" : command.page;
  lv::pipeline::write_page(command.works, file,
                           command.page.empty() ? lv::pipeline::Replaces::page_of_same_runs
                                                : lv::pipeline::Replaces::any_page);
  lv::print(fmt::format("wrote {}\n", file));
  return 0;
}

void add_ranks(CLI::App& app, Command& command) {
  app.add_option("--ranks", command.ranks,
                 fmt::format("MPI ranks (default: the processors that it may use, at most {})",
                             usual_ranks))
      ->check(CLI::Range(1, most_ranks));
}

/// Options of the commands that compute in a work folder.
void add_run_options(CLI::App& app, Command& command) {
  app.add_option("CASE", command.case_file, "the case file")->required();
  app.add_option("--work", command.run.work,
                 "work folder (default: the case file's name with .work)");
  app.add_flag("--explain", command.run.explain, "say why each stage runs or does not");
  app.add_flag("--dry-run", command.run.dry_run, "say what would run and why, and run nothing");
}

void add_verify(CLI::App& app, Command& command) {
  auto* verify = app.add_subcommand("verify", "solve problems with known answers and compare");
  verify->add_option("NAME", command.verify.names, "problems (default: all but the nightly ones)");
  verify->add_flag("--list", command.list, "list the problems and what each proves");
  verify->add_flag("--json", command.verify.json, "print one JSON object a line per quantity");
  verify->add_flag("--nightly", command.verify.nightly, "the long problems too");
  verify
      ->add_option("--ranks", command.verify.ranks,
                   "MPI ranks of the problems that are solved on several (default: as listed)")
      ->check(CLI::Range(1, most_ranks));
  verify->add_option("--constants", command.verify.constants,
                     "table (CSV: constant, value) of other constants, for the arostica problems");
  verify->add_option("--tables", command.verify.tables,
                     "folder that gets the tables which problems make");
  verify->add_option(lv::verify::solve_option, command.solve_in)->group("");
}

void add_documents(CLI::App& app) {
  app.add_subcommand("man", "print the manual page, for man -l -");
  app.add_subcommand("completion", "print a script that completes commands and options in bash");
}

/// As CLI::Range, but NaN lies in no range.
CLI::Validator within(double low, double high) {
  const std::string range = fmt::format("in [{:g} - {:g}]", low, high);
  const auto check = [=](const std::string& text) {
    double value = 0.0;
    const bool is_within = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
    return is_within ? "" : fmt::format("Value {} not {}", text, range);
  };
  return {[check](std::string& text) { return std::string(check(text)); }, "FLOAT " + range};
}

/// Options that say how the phantom's images are made.
void add_scan_options(CLI::App& app, lv::phantom::Scan& scan) {
  const auto number = [&](const char* name, double& value, const char* help, double low,
                          double high) {
    app.add_option(name, value, help)->check(within(low, high))->capture_default_str();
  };
  number("--snr", scan.snr, "mean signal of muscle / deviation of the Rician noise; 0: no noise",
         0.0, 1e4);
  number("--shift", scan.shift, "root mean square of the slices' breath-hold shifts [mm]", 0.0,
         30.0);
  number("--pixel", scan.pixel, "spacing of pixels [mm]", 0.3, 5.0);
  number("--field-of-view", scan.field_of_view, "side of the images [mm]", 100.0, 600.0);
  number("--thickness", scan.thickness, "of slices [mm]", 1.0, 20.0);
  number("--gap", scan.gap, "between short-axis slices [mm]", 0.0, 20.0);
  number("--rr", scan.rr, "length of the heart's cycle [s]", 0.3, 3.0);
  number("--texture", scan.texture, "of muscle, deviation / mean", 0.0, 0.5);
  app.add_option("--phases", scan.phases, "images per cycle")
      ->check(CLI::Range(5, 200))
      ->capture_default_str();
  app.add_option("--oblique", scan.oblique,
                 "true: the heart lies as in a chest; false: along the scanner's z axis")
      ->capture_default_str();
  app.add_option("--seed", scan.seed, "of noise, shifts and texture")->capture_default_str();
}

/// Options that say what the phantom's heart is and does. Lengths in mm.
void add_heart_options(CLI::App& app, lv::phantom::Ventricle& v) {
  const auto number = [&](const char* name, double& value, const char* help, double low,
                          double high) {
    app.add_option(name, value, help)->check(within(low, high))->capture_default_str();
  };
  const auto angle = [&](const char* name, double& radians, const char* help) {
    app.add_option_function<double>(
           name, [&radians](double degrees) { radians = degrees * lv::units::degree; }, help)
        ->check(within(-360.0, 360.0))
        ->default_str(fmt::format("{:g}", radians / lv::units::degree));
  };
  number("--endo-radius", v.shape.endo_radius, "of the ellipsoid at end-diastole [mm]", 5, 60);
  number("--endo-length", v.shape.endo_length, "its long semi-axis [mm]", 10, 120);
  number("--epi-radius", v.shape.epi_radius, "[mm]", 6, 80);
  number("--epi-length", v.shape.epi_length, "[mm]", 12, 140);
  number("--squeeze", v.squeeze, "ejection fraction that healthy muscle would have", 0, 0.85);
  number("--shortening", v.shortening, "of the long axis at end-systole", 0, 0.4);
  angle("--rotation-base", v.rotation_base, "anticlockwise seen from the apex [deg]");
  angle("--rotation-apex", v.rotation_apex, "anticlockwise seen from the apex [deg]");
  angle("--scar-angle", v.scar.angle, "its middle, from the septum towards anterior [deg]");
  angle("--scar-width", v.scar.width, "[deg]");
  number("--scar-bottom", v.scar.bottom, "height below the base, negative [mm]", -150, 0);
  number("--scar-top", v.scar.top, "height below the base, negative [mm]", -150, 0);
  number("--scar-transmurality", v.scar.transmurality, "part of the wall; 0: no scar", 0, 1);
  number("--papillary", v.papillary, "radius of two papillary muscles, 0: none [mm]", 0, 8);
  number("--trabeculae", v.trabeculae, "depth of a rim of trabeculae, 0: none [mm]", 0, 8);
  number("--akinesia", v.akinesia, "part of the squeeze that the scar loses", 0, 1);
}

void add_phantom(CLI::App& app, Command& command) {
  auto* phantom = app.add_subcommand(
      "phantom", "make a synthetic study whose volumes, scar and strains are known");
  phantom->add_option("FOLDER", command.folder, "a new folder")->required();
  add_scan_options(*phantom, command.scan);
  add_heart_options(*phantom, command.ventricle);
  phantom->add_option("--dicom", command.study.dicom, "write DICOM files")->capture_default_str();
  phantom->add_option("--nifti", command.study.nifti, "write NIfTI files")->capture_default_str();
  const std::vector<CLI::Option*> others = phantom->get_options([&](const CLI::Option* o) {
    return o->get_lnames().size() == 1 && o->get_lnames().front() != "help";
  });
  auto* person = phantom
                     ->add_option("--person", command.person,
                                  "a made-up person instead, by number: shape, wall, infarct, "
                                  "pressures and slices are drawn from what is seen in people; "
                                  "end-diastole and end-systole as label map and contours")
                     ->check(CLI::Range(1, 1000000));
  for (CLI::Option* other : others)
    person->excludes(other);
}

void add_images(CLI::App& app, Command& command) {
  auto* images = app.add_subcommand(
      "images", "list series, slices, phases, labels and volumes of images, to fill in a case");
  images->add_option("WHERE", command.images.where, "a folder of DICOM files, or any file")
      ->required();
  images->add_option("--contours", command.images.contours,
                     "folder of Sunnybrook contours: volumes per phase");
  images->add_option("--series", command.images.series, "series that the contours were drawn on");
  images->add_option("--cavity", command.images.cavity,
                     "labels of the cavity: volume at each time of a label map");
}

/// Of the ranks that mpirun has started, one tells that the command is for one; the exit code of
/// the others.
int refuse_ranks(const std::string& command) {
  if (lv::launch::world_rank() == 0)
    throw lv::InputError(command, "runs on one rank", "Run it without mpirun");
  return wrong_input;
}

void add_draw(CLI::App& app, Command& command) {
  auto* draw = app.add_subcommand(
      "draw", "look at the borders of a case's cine in a browser and correct them");
  draw->add_option("CASE", command.case_file, "the case file")->required();
  draw->add_option("--to", command.folder,
                   "folder of the drawing (default: the case file's name with .draw)");
  draw->add_flag("--no-browser", command.no_browser, "print the address only");
  auto* page = draw->add_option("--export", command.draw.page,
                                "write one page with the images inside instead of serving it");
  draw->add_option("--import", command.draw.drawing,
                   "keep the drawing that such a page let download")
      ->excludes(page);
}

/// Commands that take a case file.
void add_cases(CLI::App& app, Command& command) {
  auto* start =
      app.add_subcommand("new", "write a case: a commented starter, or one that images fill in");
  start->add_option("FILE", command.new_file, "the case file to write")->capture_default_str();
  start->add_option("--from", command.source,
                    "a label map (.nii, .nii.gz), a folder of DICOM files or of Sunnybrook "
                    "contours, contours (.csv), guide points, or a mesh (.inp, .msh, .vtk, .vtu)");

  auto* check =
      app.add_subcommand("validate", "check a case, its anatomy and its mesh without running it");
  check->add_option("CASE", command.case_file, "the case file")->required();

  auto* run =
      app.add_subcommand("run", "run all stages of a case, skipping those that are up to date");
  add_run_options(*run, command);
  add_ranks(*run, command);
  run->add_option(
      "--until", command.until,
      "last stage: circulation, strain, anatomy, mesh, calibrate, unload, beat, results or report");

  auto* study = app.add_subcommand(
      "study", "run a family of heartbeats: other preloads, afterloads, contractility, heart rate");
  add_run_options(*study, command);
  add_ranks(*study, command);

  auto* fit =
      app.add_subcommand("calibrate", "fit parameters to measured volumes, as the case asks");
  add_run_options(*fit, command);
  add_ranks(*fit, command);

  auto* segment =
      app.add_subcommand("segment", "draw both borders in the short-axis cine that a case names");
  segment->add_option("CASE", command.case_file, "the case file")->required();
  segment->add_option("--to", command.folder,
                      "a new folder (default: the case file's name with .segment)");
  add_draw(app, command);
  add_run_options(*app.add_subcommand(
                      "circulation", "run the circulation of a case by itself, to its limit cycle"),
                  command);
  add_run_options(
      *app.add_subcommand("strain", "measure strain from the cine images that a case names"),
      command);
}

void add_parameters(CLI::App& app, Command& command) {
  auto* list = app.add_subcommand("parameters",
                                  "list every parameter: default, range, meaning, paper equation");
  list->add_option("FILTER", command.filter,
                   "only those whose name or meaning contains this, such as calcium or mesh.");
  list->add_flag("--markdown", command.markdown, "as the manual page");
}

void add_bench(CLI::App& app, Command& command) {
  auto* time = app.add_subcommand("bench", "time the kernels of a step on this machine");
  time->add_option("--cells", command.bench.cells, "cells of the box along x, y and z")
      ->expected(3)
      ->check(CLI::Range(8, 2048))
      ->capture_default_str();
  time->add_option("--edge", command.bench.edge_length, "target length of element edges [mm]")
      ->check(within(0.2, 10.0))
      ->capture_default_str();
  time->add_flag("--quadrature", command.bench.quadrature, "the paper's coupling instead of nodal");
  add_ranks(*time, command);
  time->add_flag("--json", command.bench.json, "one JSON object instead of a table");
}

/// Every command and option, once: read from the command line, printed by --help, man and
/// completion.
void declare(CLI::App& app, Command& command) {
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", "ventricle " + lv::work::version());
  add_cases(app, command);
  add_phantom(app, command);
  add_verify(app, command);
  add_images(app, command);
  add_page(app, command, "report", "write one page that shows a run, finished or not", 1);
  add_page(app, command, "compare", "write one page that shows two runs side by side", 2);
  add_parameters(app, command);
  add_bench(app, command);
  add_documents(app);
  app.footer(help::program);
  for (const auto& [name, text] : help::commands)
    app.get_subcommand(name)->footer(text);
}

/// What a command only prints.
std::string printed(const CLI::App& app, const Command& command, const std::string& name) {
  if (name == "images")
    return lv::proposal::list_images(command.images);
  if (name == "parameters")
    return lv::case_file::manual(command.markdown, command.filter);
  if (name == "man")
    return man_page(app, lv::work::version(), lv::case_file::manual(false));
  return bash_completion(app);
}

int perform(const CLI::App& app, Command& command, int argc, char** argv) {
  const std::string name = app.get_subcommands().front()->get_name();
  const bool divides = name == "run" || name == "study" || name == "calibrate" ||
                       name == "strain" || name == "bench" || !command.solve_in.empty();
  if (lv::launch::world_size() > 1 && !divides)
    return refuse_ranks(name);
  if (name == "validate")
    return validate(command, argc, argv);
  if (name == "strain" || name == "circulation")
    return run_alone(command, name, argc, argv);
  if (name == "calibrate")
    command.until = "calibrate";
  if (name == "run" || name == "calibrate")
    return run_parallel(command, lv::pipeline::run, argc, argv);
  if (name == "study")
    return run_parallel(command, lv::pipeline::run_study, argc, argv);
  if (name == "phantom")
    return phantom(command);
  if (name == "segment")
    return segment(command);
  if (name == "draw")
    return draw(command);
  if (name == "bench")
    return bench(command, argc, argv);
  if (name == "report" || name == "compare")
    return write_page(command, name, argc, argv);
  if (name == "verify")
    return verify(command, argc, argv);
  if (name == "new")
    write_new_case(command.new_file, command.source);
  else
    lv::print(printed(app, command, name));
  return 0;
}

int dispatch(int argc, char** argv) {
  Command command;
  CLI::App app{"ventricle: left-ventricular mechanics from cardiac magnetic resonance"};
  declare(app, command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0 && lv::launch::world_rank() > 0)
      return 0;  // help and version are told once
    return app.exit(error) == 0 ? 0 : wrong_input;
  }
  if (!app.get_subcommands().empty())
    return perform(app, command, argc, argv);
  if (lv::launch::world_rank() == 0)
    lv::print(app.help());
  return 0;
}

constexpr const char* no_memory =
    "the memory is exhausted. Allow more, close other programs, or give smaller images, coarser "
    "meshes "
    "or fewer box.cells";

/// Reports a failure once, after some seconds if this is not the root, and ends all ranks.
int fail(const std::string& message, int code, unsigned patience = 2) {
  int running = 0;
  int finished = 0;
  int rank = 0;
  int size = 1;
  MPI_Initialized(&running);
  MPI_Finalized(&finished);
  const bool parallel = running != 0 && finished == 0;
  if (parallel) {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
  }
  std::signal(SIGTERM, SIG_DFL);  // from here on mpirun may end this rank
  if (rank != 0)
    sleep(patience);  // the root says it, unless the trouble is this rank's alone
  fmt::print(stderr, "ventricle: {}\n", lv::printable_lines(message));
  std::fflush(nullptr);
  if (parallel)
    size > 1 ? MPI_Abort(MPI_COMM_WORLD, code) : MPI_Finalize();
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file that may not grow is told of as one that cannot be written
  try {
    return dispatch(argc, argv);
  } catch (const lv::InputError& error) {
    return fail(error.what(), wrong_input);
  } catch (const lv::FailedElsewhere& error) {
    return fail(error.what(), defect, 30);  // the rank that failed ends this one before
  } catch (const lv::RunError& error) {
    return fail(error.what(), no_way_on);
  } catch (const lv::Interrupted& stop) {
    return fail(stop.what(), interrupted);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(fmt::format("{}: {}. Check the path and its permissions", error.path1().string(),
                            error.code().message()),
                no_way_on);
  } catch (const std::system_error& error) {
    return fail(fmt::format("the system refuses something: {}. Are memory, processes or open files "
                            "limited?",
                            error.what()),
                no_way_on);
  } catch (const std::bad_alloc&) {
    return fail(no_memory, no_way_on);
  } catch (const std::length_error&) {
    return fail(no_memory, no_way_on);
  } catch (const std::exception& error) {
    return fail(error.what(), defect);
  }
}
