#include "lv/phantom/study.hpp"

#include "lv/base/check.hpp"
#include "lv/base/processors.hpp"
#include "lv/base/table.hpp"
#include "lv/base/time_left.hpp"
#include "lv/geometry/contour_table.hpp"
#include "lv/phantom/files.hpp"

#include <fmt/format.h>

#include <string_view>

namespace lv::phantom {
namespace {

namespace fs = std::filesystem;
using geometry::Contour;
using geometry::Side;

/// Numbers of images, which tell their noise apart.
constexpr std::uint32_t first_of_short_axis = 1;
constexpr std::uint32_t first_of_long_axis = 500000;

image::Cine cine_of(const Scanner& scanner, const Scan& scan, const std::vector<ScanPlane>& planes,
                    std::uint32_t first_number) {
  const std::vector<double> times = phase_times(scan);
  image::Cine cine;
  for (const ScanPlane& plane : planes) {
    image::CineSlice slice{plane.name, std::vector<image::Picture>(times.size()), {}, scan.rr};
    for (const double time : times)
      slice.times.push_back(time * scan.rr);
    cine.slices.push_back(std::move(slice));
  }
  Progress progress("making images", planes.size() * times.size());
  in_threads(planes.size() * times.size(), [&](std::size_t n) {
    const std::size_t s = n / times.size();
    const std::size_t k = n % times.size();
    cine.slices[s].frames[k] = scanner.picture(planes[s], times[k], Contrast::cine,
                                               first_number + static_cast<std::uint32_t>(n));
    progress.add();
  });
  return cine;
}

/// Late enhancement is triggered at a time of the cycle (a fraction of it).
image::Cine late_enhancement(const Scanner& scanner, const Scan& scan, const ScanPlanes& planes,
                             double time) {
  constexpr std::uint32_t first_number = 1000000;
  image::Cine stack;
  for (const ScanPlane& plane : planes.short_axis)
    stack.slices.push_back({plane.name, {}, {time * scan.rr}, scan.rr});
  in_threads(planes.short_axis.size(), [&](std::size_t s) {
    stack.slices[s].frames = {scanner.picture(planes.short_axis[s], time,
                                              Contrast::late_enhancement,
                                              first_number + static_cast<std::uint32_t>(s))};
  });
  return stack;
}

std::vector<LabelPicture> label_stack(const Scanner& scanner, const ScanPlanes& planes,
                                      double time) {
  std::vector<LabelPicture> stack(planes.short_axis.size());
  in_threads(stack.size(),
             [&](std::size_t s) { stack[s] = scanner.labels(planes.short_axis[s], time); });
  return stack;
}

/// Scar is no label of a cine, which does not show it.
std::vector<LabelPicture> without_scar(std::vector<LabelPicture> stack) {
  for (LabelPicture& picture : stack)
    for (std::uint8_t& label : picture.values)
      label = label == scar ? std::uint8_t{muscle} : label;
  return stack;
}

void write_contours(std::vector<Contour> contours, std::string_view side, const fs::path& file) {
  std::erase_if(contours, [&](const Contour& c) { return !side.empty() && side != name(c.side); });
  geometry::contour_table(contours, 4).write_csv(file);
}

void write_all_contours(const Ventricle& v, const Scan& scan, const ScanPlanes& planes,
                        const Truth& truth, const fs::path& folder) {
  const std::vector<double> times = phase_times(scan);
  for (const auto& [state, phase] :
       {std::pair{"ed", truth.end_diastole}, std::pair{"es", truth.end_systole},
        std::pair{"early", truth.early_diastole}}) {
    const geometry::Contours drawn = contours(v, scan, planes, times.at(phase - 1));
    const auto file = [&, state = state](const char* what) {
      return folder / fmt::format("{}_{}.csv", state, what);
    };
    write_contours(drawn.short_axis, "", file("short_axis"));
    write_contours(drawn.long_axis, "", file("long_axis"));
    write_contours(drawn.apex, "endo", file("apex_endo"));
    write_contours(drawn.apex, "epi", file("apex_epi"));
  }
}

/// The wall from the label map of the cine, or from contours where there is none. Labels do not
/// show the annulus, contours of the long axes end at it. Without long axes, slices of different
/// breath-holds are moved to where the wall is smoothest.
std::string anatomy_of_case(const Scan& scan, const StudyFiles& files, const Truth& truth,
                            const std::string& septum) {
  if (files.nifti)
    return fmt::format(
               "[anatomy]\nsource = \"labels\"\n\n[anatomy.labels]\n"
               "file = \"nifti/cine_short_axis_labels.nii.gz\"\n"
               "cavity = [{}]\nmuscle = [{}]\nframe = {}  # early diastole\n\n"
               "[anatomy.contours]\n",
               static_cast<int>(cavity), static_cast<int>(muscle), truth.early_diastole) +
           (scan.shift > 0.0 ? "align_slices = true\n" : "") + septum;
  return "[anatomy]\nsource = \"contours\"\n\n[anatomy.contours]  # early diastole\n"
         "short_axis = \"contours/early_short_axis.csv\"\n"
         "long_axis = \"contours/early_long_axis.csv\"\n"
         "apex_endo = \"contours/early_apex_endo.csv\"\n"
         "apex_epi = \"contours/early_apex_epi.csv\"\n"
         "base_at = \"annulus\"\n" +
         septum;
}

/// The scar from its labels, or from the enhanced image: brighter than half of the brightest, for
/// nulled muscle without noise deviates so little that every pixel with a trace of scar would
/// count.
std::string infarct_of_case(const Scan& scan, const StudyFiles& files, const Truth& truth) {
  if (truth.scar_volume == 0.0 || (!files.dicom && !files.nifti))
    return "";
  if (files.nifti)
    return fmt::format(
               "\n[infarct]\nsource = \"labels\"\n\n[infarct.labels]\n"
               "file = \"nifti/late_enhancement_labels.nii.gz\"\nscar = [{}]\n",
               static_cast<int>(scar)) +
           (scan.shift > 0.0
                ? fmt::format("muscle = [{}]\nin_plane = true\n", static_cast<int>(muscle))
                : "");
  return fmt::format(
      "\n[infarct]\nsource = \"lge\"\n\n[infarct.lge]\nimage = \"dicom\"\n"
      "series = [\"late_enhancement_short_axis\"]\nthreshold = \"fwhm\"\nin_plane = {}\n",
      scan.shift > 0.0);
}

std::string strain_of_case(const StudyFiles& files, const Truth& truth, const std::string& septum) {
  if (!files.dicom && !files.nifti)
    return "";
  const std::string cine =
      files.dicom ? "cine = \"dicom\"\nseries = \"cine_short_axis\"\n"
                    "long_axis_cine = [\"cine_four chambers\", \"cine_two chambers\", "
                    "\"cine_three chambers\"]\n"
                  : "cine = \"nifti/cine_short_axis.nii.gz\"\n"
                    "long_axis_cine = [\"nifti/cine_long_axis_1.nii.gz\", "
                    "\"nifti/cine_long_axis_2.nii.gz\", \"nifti/cine_long_axis_3.nii.gz\"]\n";
  return "\n[strain]\n" + cine +
         fmt::format(
             "contours = \"contours/ed_short_axis.csv\"\n"
             "long_axis = \"contours/ed_long_axis.csv\"\n"
             "es_contours = \"contours/es_short_axis.csv\"\n"
             "end_diastole = {}\n",
             truth.end_diastole) +
         septum;
}

std::string case_file(const Ventricle& v, const Scan& scan, const StudyFiles& files,
                      const Truth& truth) {
  const double middle = 0.5 * v.cavity_apex();
  const Vec3 p =
      pose(scan).to_image({0.5 * (v.shape.endo_radius + v.shape.epi_radius), 0.0, middle});
  const std::string septum = fmt::format(
      "septum_point = [\"{:.3f} mm\", \"{:.3f} mm\", \"{:.3f} mm\"]\n", p.x(), p.y(), p.z());
  return "# A synthetic study: what is true of it is in truth.json and truth_segments.csv.\n"
         "name = \"phantom\"\n\n" +
         anatomy_of_case(scan, files, truth, septum) + infarct_of_case(scan, files, truth) +
         strain_of_case(files, truth, septum);
}

void check(const Ventricle& v, const Scan& scan) {
  const geometry::Ellipsoid& e = v.shape;
  const auto rule = [](bool holds, const std::string& what, const char* remedy) {
    if (!holds)
      throw InputError("phantom", what, remedy);
  };
  rule(e.endo_radius < e.epi_radius && e.endo_length < e.epi_length,
       "the endocardium is not inside the epicardium",
       "Give the epicardium the larger radius and length");
  rule(e.base_height < e.endo_length && e.base_height > -e.endo_length,
       "the base lies outside the ventricle", "Choose a base height within its length");
  rule(scan.field_of_view > 4.0 * e.epi_radius && scan.field_of_view > -1.5 * v.apex(),
       fmt::format("a field of view of {:g} mm does not hold the ventricle", scan.field_of_view),
       "Enlarge it to twice the heart's size");
  rule(v.scar.bottom < v.scar.top || v.scar.transmurality == 0.0,
       "the scar's bottom is not below its top", "Swap them");
}

image::Cine one(const image::CineSlice& slice) {
  image::Cine cine;
  cine.slices.push_back(slice);
  return cine;
}

/// Late enhancement is taken at `early` (a fraction of the cycle): in the shape from which the
/// model starts, so that the scar lies in the wall of the case without being carried there.
void write_images(const Scanner& scanner, const Scan& scan, const ScanPlanes& planes,
                  const StudyFiles& files, double early, const fs::path& folder) {
  const image::Cine sa = cine_of(scanner, scan, planes.short_axis, first_of_short_axis);
  const image::Cine la = cine_of(scanner, scan, planes.long_axis, first_of_long_axis);
  const image::Cine lge = late_enhancement(scanner, scan, planes, early);
  if (files.dicom) {
    fs::create_directories(folder / "dicom");
    const StudyHeader header{scan.seed, scan.rr, scan.thickness, scan.thickness + scan.gap};
    std::vector<Series> series{{1, "cine_short_axis", sa}, {5, "late_enhancement_short_axis", lge}};
    for (std::size_t k = 0; k < la.slices.size(); ++k)
      series.push_back(
          {static_cast<int>(k) + 2, fmt::format("cine_{}", la.slices[k].name), one(la.slices[k])});
    write_dicom(header, series, folder / "dicom");
  }
  if (!files.nifti)
    return;
  const fs::path nifti = folder / "nifti";
  fs::create_directories(nifti);
  write_nifti(sa, nifti / "cine_short_axis.nii.gz");
  for (std::size_t k = 0; k < la.slices.size(); ++k)
    write_nifti(one(la.slices[k]), nifti / fmt::format("cine_long_axis_{}.nii.gz", k + 1));
  write_nifti(lge, nifti / "late_enhancement.nii.gz");
  std::vector<std::vector<LabelPicture>> labels;
  const std::vector<double> times = phase_times(scan);
  Progress progress("making labels", times.size());
  for (const double time : times) {
    labels.push_back(without_scar(label_stack(scanner, planes, time)));
    progress.add();
  }
  write_nifti(labels, scan.rr / scan.phases, nifti / "cine_short_axis_labels.nii.gz");
  write_nifti({label_stack(scanner, planes, early)}, 1.0, nifti / "late_enhancement_labels.nii.gz");
}

}  // namespace

image::Cine short_axis_cine(const Ventricle& ventricle, const Scan& scan,
                            const ScanPlanes& planes) {
  return cine_of(Scanner(ventricle, scan), scan, planes.short_axis, first_of_short_axis);
}

image::Cine long_axis_cine(const Ventricle& ventricle, const Scan& scan, const ScanPlanes& planes) {
  return cine_of(Scanner(ventricle, scan), scan, planes.long_axis, first_of_long_axis);
}

std::string write_study(const Ventricle& v, const Scan& scan, const StudyFiles& files,
                        const fs::path& folder) {
  check(v, scan);
  make_study_folder(folder);
  const ScanPlanes all = planes(v, scan);
  const Truth t = truth(v, scan, all);
  write_images(Scanner(v, scan), scan, all, files, phase_times(scan).at(t.early_diastole - 1),
               folder);
  write_all_contours(v, scan, all, t, folder / "contours");
  write_file(folder / "truth.json", truth_json(t, v, scan, all));
  strain::segments_table(t.segments).write_csv(folder / "truth_segments.csv");
  write_file(folder / "case.toml", case_file(v, scan, files, t));
  strain::rotation_table(t.slices).write_csv(folder / "truth_rotation.csv");
  return fmt::format(
      "wrote {}: {} short-axis slices and {} long axes of {} phases; cavity {:.1f} ml at "
      "end-diastole, {:.1f} ml at end-systole (phase {}), wall {:.1f} ml, scar {:.1f} ml\n",
      folder.string(), all.short_axis.size(), all.long_axis.size(), scan.phases,
      1e-3 * t.cavity_volumes.front(), 1e-3 * t.cavity_volumes.at(t.end_systole - 1), t.end_systole,
      1e-3 * t.wall_volume, 1e-3 * t.scar_volume);
}

}  // namespace lv::phantom
