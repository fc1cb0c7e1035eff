#include "lv/proposal/propose_case.hpp"

#include "lv/anatomy/moments.hpp"
#include "lv/base/check.hpp"
#include "lv/case_file/read_case.hpp"
#include "lv/proposal/list_images.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using Catch::Matchers::Contains;

/// A short-axis stack of `frames` rings whose cavities have these radii [mm]; cavity 3, muscle 2,
/// right ventricle 1.
std::string label_stack(const std::vector<double>& radii) {
  test::NiftiSpec spec;
  spec.size = {70, 70, 6, static_cast<int>(radii.size())};
  spec.sform = {{{-1.5, 0.0, 0.0, 0.0}, {0.0, -1.5, 0.0, 0.0}, {0.0, 0.0, 8.0, 0.0}}};
  for (const double radius : radii)
    for (int k = 0; k < 6; ++k)
      for (int j = 0; j < 70; ++j)
        for (int i = 0; i < 70; ++i) {
          const double r = std::hypot(1.5 * (i - 40), 1.5 * (j - 35));
          const double right = std::hypot(1.5 * (i - 20), 1.5 * (j - 35));
          spec.values.push_back(r < radius ? 3 : r < 34.0 ? 2 : right < 25.0 ? 1 : 0);
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

TEST_CASE("a case from images alone is refused until it names what was drawn on them",
          "[unit][proposal]") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "dicom");
  test::DicomSpec spec;
  spec.plane.columns = 4;
  spec.plane.rows = 4;
  spec.pixels.assign(16, 7);
  test::write_bytes(folder / "dicom" / "a", test::dicom_bytes(spec));
  CHECK_THROWS_WITH(parsed(folder / "dicom", folder / "case.toml"),
                    Contains("anatomy.sunnybrook.contours is to be filled in"));
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
