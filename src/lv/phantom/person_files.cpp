#include "lv/base/json_file.hpp"
#include "lv/base/units.hpp"
#include "lv/geometry/contour_table.hpp"
#include "lv/phantom/files.hpp"
#include "lv/phantom/person.hpp"

#include <fmt/format.h>

namespace lv::phantom {
namespace {

namespace fs = std::filesystem;
using units::degree;
using units::mmHg;

std::string septum_line(const Person& p) {
  const double middle = 0.4 * p.apex();
  const double r = std::sqrt(p.radius_squared(geometry::Side::epi, 0.0, middle));
  const Vec3 x = pose(Scan{}).to_image({r, 0.0, middle});
  return fmt::format("septum_point = [\"{:.3f} mm\", \"{:.3f} mm\", \"{:.3f} mm\"]\n", x.x(), x.y(),
                     x.z());
}

/// All but the anatomy: what people have besides images.
std::string measurements(const Person& p, const PersonStudy& study) {
  std::string text = fmt::format(
      "\n[unloaded]\npressure = \"{0:.1f} mmHg\"\n\n[protocol]\ned_pressure = \"{0:.1f} mmHg\"\n"
      "cuff_systolic = \"{1:.0f} mmHg\"\n\n[calibrate]\npassive = \"klotz\"\nactive = true\n"
      "esv = \"{2:.1f} ml\"  # of the labels at end-systole\n",
      p.ed_pressure / mmHg, p.cuff_systolic / mmHg, 1e-3 * study.label_volume[1]);
  if (!study.scar.empty())
    text += fmt::format(
        "\n[infarct]\nsource = \"labels\"\n\n[infarct.labels]\nfile = \"scar.nii.gz\"\nscar = "
        "[{}]\nmuscle = [{}]\nin_plane = true\n",
        static_cast<int>(person_scar), static_cast<int>(person_muscle));
  return text;
}

std::string header(const Person& p) {
  return fmt::format(
      "# A made-up person ({}): what is true is in truth.json.\nname = \"person {}\"\n"
      "engine = \"quasi_static\"\n\n",
      name(p.kind), p.seed);
}

std::string case_of_labels(const Person& p, const PersonStudy& study) {
  return header(p) +
         fmt::format(
             "[anatomy]\nsource = \"labels\"\n\n[anatomy.labels]\nfile = \"labels.nii.gz\"\n"
             "cavity = [{}]\nmuscle = [{}]\nright_ventricle = [{}]\nframe = 1  # end-diastole\n\n"
             "[anatomy.contours]\nalign_slices = true\n",
             static_cast<int>(person_cavity), static_cast<int>(person_muscle),
             static_cast<int>(person_rv)) +
         measurements(p, study);
}

std::string case_of_contours(const Person& p, const PersonStudy& study) {
  return header(p) +
         "[anatomy]\nsource = \"contours\"\n\n[anatomy.contours]\n"
         "short_axis = \"contours/ed_short_axis.csv\"\n"
         "es_short_axis = \"contours/es_short_axis.csv\"\nalign_slices = true\n"
         "base_at = \"slab\"  # as esv is counted\n" +
         septum_line(p) + measurements(p, study);
}

std::string truth_json(const Person& p, const PersonStudy& study, const PersonVolumes& v) {
  nlohmann::ordered_json json{{"person", p.seed},
                              {"kind", name(p.kind)},
                              {"edv_ml", 1e-3 * v.edv},
                              {"esv_ml", 1e-3 * v.esv},
                              {"ejection_fraction", 1.0 - v.esv / v.edv},
                              {"label_edv_ml", 1e-3 * study.label_volume[0]},
                              {"label_esv_ml", 1e-3 * study.label_volume[1]},
                              {"wall_volume_ml", 1e-3 * v.wall},
                              {"scar_volume_ml", 1e-3 * v.scar},
                              {"endo_radius_mm", p.shape.endo_radius},
                              {"endo_length_mm", p.shape.endo_length},
                              {"thickness_mm", p.shape.epi_radius - p.shape.endo_radius},
                              {"apical_thickness_mm", p.shape.epi_length - p.shape.endo_length},
                              {"septal_thickening", p.septal},
                              {"bend_mm", p.bend},
                              {"tilt_deg", p.tilt / degree},
                              {"ed_pressure_mmHg", p.ed_pressure / mmHg},
                              {"cuff_systolic_mmHg", p.cuff_systolic / mmHg},
                              {"slice_spacing_mm", p.slice_spacing},
                              {"pixel_mm", p.pixel}};
  for (const ScanPlane& plane : study.slices)
    json["slices"].push_back({{"height_mm", plane.height},
                              {"shift_mm", {plane.shift.x(), plane.shift.y(), plane.shift.z()}}});
  return json.dump(2) + "\n";
}

}  // namespace

std::string write_person(std::uint32_t seed, const fs::path& folder) {
  make_study_folder(folder);
  const Person p = person(seed);
  const PersonStudy study = study_of(p);
  const PersonVolumes v = volumes(p);
  write_nifti({study.labels[0], study.labels[1]}, 0.3, folder / "labels.nii.gz");
  if (!study.scar.empty())
    write_nifti({study.scar}, 1.0, folder / "scar.nii.gz");
  geometry::contour_table(study.contours[0], 4).write_csv(folder / "contours/ed_short_axis.csv");
  geometry::contour_table(study.contours[1], 4).write_csv(folder / "contours/es_short_axis.csv");
  write_file(folder / "case.toml", case_of_labels(p, study));
  write_file(folder / "case_contours.toml", case_of_contours(p, study));
  write_file(folder / "truth.json", truth_json(p, study, v));
  return fmt::format(
      "wrote {}: {} ventricle of {:.0f} ml at end-diastole ({:.1f} mmHg) and {:.0f} ml at "
      "end-systole, wall {:.0f} ml, scar {:.1f} ml, {} slices every {:.1f} mm\n",
      folder.string(), name(p.kind), 1e-3 * v.edv, p.ed_pressure / mmHg, 1e-3 * v.esv,
      1e-3 * v.wall, 1e-3 * v.scar, study.slices.size(), p.slice_spacing);
}

}  // namespace lv::phantom
