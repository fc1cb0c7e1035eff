#include "lv/proposal/propose_case.hpp"

#include "lv/anatomy/anatomy.hpp"
#include "lv/anatomy/moments.hpp"
#include "lv/anatomy/proposals.hpp"
#include "lv/base/check.hpp"
#include "lv/case_file/read_case.hpp"
#include "lv/image/volume_file.hpp"
#include "lv/proposal/list_images.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace lv;
using Catch::Matchers::Contains;

/// A short-axis stack of `frames` rings whose cavities have these radii [mm]; cavity 3, muscle 2,
/// right ventricle 1, scar 4 across the wall over an angle to either side of the lateral wall.
std::string label_stack(const std::vector<double>& radii, double half_scar = 0.0) {
  test::NiftiSpec spec;
  spec.size = {70, 70, 6, static_cast<int>(radii.size())};
  spec.sform = {{{-1.5, 0.0, 0.0, 0.0}, {0.0, -1.5, 0.0, 0.0}, {0.0, 0.0, 8.0, 0.0}}};
  for (const double radius : radii)
    for (int k = 0; k < 6; ++k)
      for (int j = 0; j < 70; ++j)
        for (int i = 0; i < 70; ++i) {
          const double r = std::hypot(1.5 * (i - 40), 1.5 * (j - 35));
          const double right = std::hypot(1.5 * (i - 20), 1.5 * (j - 35));
          const bool scarred = std::abs(std::atan2(j - 35, i - 40)) < half_scar;
          spec.values.push_back(r < radius     ? 3
                                : r < 34.0     ? (scarred ? 4 : 2)
                                : right < 25.0 ? 1
                                               : 0);
        }
  return test::nifti_bytes(spec);
}

case_file::Case parsed(const std::filesystem::path& source, const std::filesystem::path& file) {
  return case_file::parse_case(proposal::proposed_case(source, file), file);
}

}  // namespace

TEST_CASE("a case from a label map of a beat has its labels, early diastole and no load",
          "[unit][proposal]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "map.nii", label_stack({25, 22, 18, 15, 17, 21, 24}));
  const case_file::Case c = parsed(folder / "map.nii", folder / "case.toml");
  CHECK(c.name == "case");
  CHECK(c.anatomy.labels.file == "map.nii");
  CHECK(c.anatomy.labels.cavity == std::vector<int>{3});
  CHECK(c.anatomy.labels.muscle == std::vector<int>{2});
  CHECK(c.anatomy.labels.right_ventricle == std::vector<int>{1});
  CHECK(c.anatomy.labels.frame == 5);
  CHECK_FALSE(case_file::is_loaded(c));
}

TEST_CASE("a case from end-diastole and end-systole takes the loaded shape of end-diastole",
          "[unit][proposal]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "map.nii", label_stack({15, 25}));
  const case_file::Case c = parsed(folder / "map.nii", folder / "case.toml");
  CHECK(c.anatomy.labels.frame == 2);
  CHECK(c.unloaded.pressure == Approx(c.protocol.ed_pressure));
  const std::string text = proposal::proposed_case(folder / "map.nii", folder / "case.toml");
  CHECK_THAT(text, Contains("# [calibrate]") && Contains("# esv = ") && !Contains("# edv = "));
  CHECK(text.find("engine = ") < text.find("[anatomy]"));
  // a default that is written out would count as known
  CHECK_THAT(text,
             Contains("# ed_pressure = \"8 mmHg\"") && Contains("# es_pressure = \"150 mmHg\""));
}

TEST_CASE(
    "a label within the muscle is proposed as scar to be uncommented, and a case without is "
    "warned of",
    "[unit][proposal]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "map.nii", label_stack({22}, 0.5));
  const std::string text = proposal::proposed_case(folder / "map.nii", folder / "case.toml");
  CHECK_THAT(text, Contains("muscle = [2, 4]") && Contains("# [infarct]") &&
                       Contains("# scar = [4]  # may be scar"));
  CHECK_THAT(proposal::list_images({.where = folder / "map.nii"}), Contains("# scar = [4]"));
  case_file::Case c = case_file::parse_case(text, folder / "case.toml");
  const image::Volume map = image::read_labels(folder / "map.nii");
  CHECK_THAT(anatomy::unsaid_scar(c, map),
             Contains("[4] of anatomy.labels.muscle lies within the other muscle") &&
                 Contains("infarct.source = \"none\""));
  c.scar.source = mesh::InfarctSource::labels;
  CHECK(anatomy::unsaid_scar(c, map).empty());
  c.scar.source = mesh::InfarctSource::mesh;
  c.anatomy.labels.muscle = {2};
  CHECK(anatomy::unsaid_scar(c, map).empty());
}

TEST_CASE("a label that the file itself calls scar is proposed as infarct", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "map.nii", label_stack({22, 18}, 0.5));
  image::Volume map = image::read_labels(folder / "map.nii");
  map.names = {{2, "myocardium"}, {4, "Scar tissue"}};
  const auto lines = anatomy::scar_lines(map, "map.nii", {2, 4}, 2);
  REQUIRE(lines.size() == 4);
  CHECK(std::all_of(lines.begin(), lines.end(), [](const auto& line) { return line.active; }));
  CHECK(lines[2].parameter == "infarct.labels.scar");
  CHECK(lines[2].value == "[4]");
  CHECK(lines[3].parameter == "infarct.labels.frame");
  CHECK(lines[3].value == "2");
  CHECK(anatomy::scar_lines(map, "map.nii", {2}, 2).empty());
}

TEST_CASE("a case from a mesh reads the infarct that lies in its cells", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  const mesh::Mesh wall = test::coarse_mesh(mesh::CellKind::hexahedron);
  std::string values;
  for (int c = 0; c < wall.cell_count(); ++c)
    values += c < 7 ? "1 " : "0 ";
  test::write_bytes(folder / "wall.vtk", test::vtk_text(wall, test::VtkTags::none) + "CELL_DATA " +
                                             std::to_string(wall.cell_count()) +
                                             "\nSCALARS infarct double 1\nLOOKUP_TABLE default\n" +
                                             values + "\n");
  case_file::Case c = parsed(folder / "wall.vtk", folder / "case.toml");
  CHECK(c.scar.source == mesh::InfarctSource::elements);
  CHECK(c.scar.set == "infarct");
  const auto warned = [&] {
    const anatomy::Shape shape = anatomy::make_anatomy(c);
    return std::any_of(shape.warnings.begin(), shape.warnings.end(), [](const auto& warning) {
      return warning.part == "scar" && warning.text.find("set = \"infarct\"") != std::string::npos;
    });
  };
  CHECK_FALSE(warned());
  c.scar.source = mesh::InfarctSource::mesh;
  CHECK(warned());
  c.scar.source = mesh::InfarctSource::none;
  CHECK_FALSE(warned());
}

TEST_CASE("a case from contours names those that lie beside them", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  std::string csv = "slice,contour,point,x_mm,y_mm,z_mm\n";
  for (int slice = 1; slice <= 4; ++slice)
    for (const auto& [side, radius] : {std::pair("endo", 20.0), {"epi", 30.0}})
      for (int p = 0; p < 24; ++p)
        csv += std::to_string(slice) + "," + side + "," + std::to_string(p + 1) + "," +
               std::to_string(radius * std::cos(p * 0.2617994)) + "," +
               std::to_string(radius * std::sin(p * 0.2617994)) + "," +
               std::to_string(-8.0 * slice) + "\n";
  test::write_bytes(folder / "ed_short_axis.csv", csv);
  test::write_bytes(folder / "ed_long_axis.csv", csv);
  const case_file::Case c = parsed(folder / "ed_short_axis.csv", folder / "case.toml");
  CHECK(c.anatomy.contours.short_axis == "ed_short_axis.csv");
  CHECK(c.anatomy.contours.long_axis == "ed_long_axis.csv");
  CHECK(c.anatomy.contours.apex_endo.empty());
}

TEST_CASE("a case from a mesh finds its unit and, without tags, its sides", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  mesh::Mesh wall = test::coarse_mesh(mesh::CellKind::hexahedron);
  for (Vec3& X : wall.nodes)
    X *= 0.1;  // centimetres
  test::write_bytes(folder / "wall.vtk", test::vtk_text(wall, test::VtkTags::none));
  const case_file::Case c = parsed(folder / "wall.vtk", folder / "case.toml");
  CHECK(c.anatomy.mesh.import.unit == Approx(10.0));
  CHECK(c.anatomy.mesh.import.sides == mesh::SideSource::geometry);
}

/// A DICOM short-axis stack of three slices over time.
void write_dicom_stack(const std::filesystem::path& folder, int images) {
  std::filesystem::create_directory(folder);
  for (int slice = 0; slice < 3; ++slice)
    for (int image = 0; image < images; ++image) {
      test::DicomSpec spec;
      spec.plane.columns = 4;
      spec.plane.rows = 4;
      spec.plane.origin.z() = 10.0 * slice;
      spec.pixels.assign(16, 7);
      spec.instance = images * slice + image + 1;
      spec.instance_uid = "1.2.3.4." + std::to_string(spec.instance);
      spec.trigger_ms = 30.0 * image;
      test::write_bytes(folder / std::to_string(spec.instance), test::dicom_bytes(spec));
    }
}

TEST_CASE("a case from images of one moment is refused until it names what was drawn on them",
          "[unit][proposal]") {
  const test::TemporaryFolder folder;
  write_dicom_stack(folder / "dicom", 1);
  CHECK_THROWS_WITH(parsed(folder / "dicom", folder / "case.toml"),
                    Contains("anatomy.sunnybrook.contours is to be filled in"));
}

TEST_CASE("a case from a cine on which nothing is drawn has its borders drawn",
          "[unit][proposal]") {
  const test::TemporaryFolder folder;
  write_dicom_stack(folder / "dicom", 6);
  const case_file::Case c = parsed(folder / "dicom", folder / "case.toml");
  CHECK(c.anatomy.source == case_file::AnatomySource::cine);
  CHECK(c.anatomy.cine.images == "dicom");
  CHECK(c.anatomy.cine.series == "1");
  test::NiftiSpec spec;
  spec.size = {30, 30, 3, 6};
  spec.sform = {{{-1.5, 0.0, 0.0, 0.0}, {0.0, -1.5, 0.0, 0.0}, {0.0, 0.0, 8.0, 0.0}}};
  spec.floating = true;
  for (int value = 0; value < 30 * 30 * 3 * 6; ++value)
    spec.values.push_back(0.5 + value);
  test::write_bytes(folder / "cine.nii", test::nifti_bytes(spec));
  const case_file::Case n = parsed(folder / "cine.nii", folder / "other.toml");
  CHECK(n.anatomy.source == case_file::AnatomySource::cine);
  CHECK(n.anatomy.cine.images == "cine.nii");
}

/// A cine of one plane, of pixels of 1 mm round a place.
void write_view(const std::filesystem::path& folder, int series, const Vec3& middle,
                const Vec3& along_row, const Vec3& along_column, const std::string& kind = "M") {
  constexpr int size = 4;
  for (int image = 0; image < 6; ++image) {
    test::DicomSpec spec;
    spec.plane.columns = spec.plane.rows = size;
    spec.plane.along_row = along_row;
    spec.plane.along_column = along_column;
    spec.plane.origin = middle - 0.5 * (size - 1) * (along_row + along_column);
    spec.pixels.assign(size * size, 7);
    spec.kind = kind;
    spec.series_number = series;
    spec.series_uid = "1.2.3." + std::to_string(10 * series);
    spec.instance = image + 1;
    spec.instance_uid = spec.series_uid + "." + std::to_string(spec.instance);
    spec.trigger_ms = 30.0 * image;
    test::write_bytes(folder / (spec.instance_uid + ".dcm"), test::dicom_bytes(spec));
  }
}

TEST_CASE("a case from an exam names its long-axis cines, and no others", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  write_dicom_stack(folder / "dicom", 6);
  const Vec3 middle(1.5, 1.5, 10.0);
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  write_view(folder / "dicom", 4, middle, x, z);
  write_view(folder / "dicom", 5, middle + 20.0 * x, y, z);
  write_view(folder / "dicom", 6, middle, x, y);             // as the short-axis slices lie
  write_view(folder / "dicom", 7, middle + 40.0 * y, x, z);  // beside the heart
  write_view(folder / "dicom", 8, middle, y, z, "P");        // velocities
  write_view(folder / "dicom", 9, middle, (x + y).normalized(), z);
  write_view(folder / "dicom", 10, middle, x, (y + 3.0 * z).normalized());
  const case_file::Case c = parsed(folder / "dicom", folder / "case.toml");
  CHECK(c.anatomy.cine.series == "1");
  CHECK(c.anatomy.cine.long_axis == std::vector<std::string>{"4", "5", "9", "10"});
}

TEST_CASE("what is nothing that is read is refused with a list of what is", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "letter.txt", "Dear colleague,\n");
  CHECK_THROWS_WITH(
      proposal::propose(folder / "letter.txt", "letter.txt"),
      Contains(".nii.gz") && Contains("DICOM") && Contains(".csv") && Contains(".inp"));
  CHECK_THROWS_WITH(proposal::propose(folder / "absent", "absent"), Contains("absent"));
}

TEST_CASE("a list of images ends with the lines for a case", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "map.nii", label_stack({25, 15}));
  const std::string text = proposal::list_images({.where = folder / "map.nii"});
  CHECK_THAT(text, Contains("labels of frame 1") && Contains("cavity = [3]") &&
                       Contains("frame = 1") && Contains("ventricle new --from"));
}

TEST_CASE("the end-diastolic shape of several is worth a warning unless it is unloaded",
          "[unit][proposal]") {
  case_file::Case c;
  const anatomy::Moments m{{1, 2, 3}, {90e3, 140e3, 60e3}, 2, 3, {}};
  CHECK(anatomy::end_diastole_note(c, m, 1).empty());
  CHECK_THAT(anatomy::end_diastole_note(c, m, 2), Contains("unloaded.pressure"));
  CHECK_THAT(anatomy::end_diastole_note(c, "time 1 is end-diastole, as x.mat marks it"),
             Contains("as x.mat marks it, and its shape is taken as free of stress"));
  c.unloaded.pressure = 1.0;
  CHECK(anatomy::end_diastole_note(c, m, 2).empty());
  CHECK(anatomy::end_diastole_note(c, "time 1 is end-diastole, as x.mat marks it").empty());
}
