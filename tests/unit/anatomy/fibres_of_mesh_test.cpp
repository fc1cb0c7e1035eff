#include "lv/anatomy/anatomy.hpp"
#include "lv/mesh/fibres.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/temporary_folder.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

using namespace lv;

namespace {

/// What is warned of the fibres of a mesh that has these at its nodes.
std::string warning_of(const mesh::Mesh& mesh, const std::vector<Vec3>& fibres) {
  const test::TemporaryFolder folder;
  test::write_bytes(
      folder / "wall.vtu",
      test::replaced(test::vtu_text(mesh, test::VtkTags::point_arrays), "<PointData>\n",
                     "<PointData>\n" + test::vtu_array("f0", fibres)));
  case_file::Case c;
  c.anatomy.source = case_file::AnatomySource::mesh;
  c.anatomy.mesh.import.file = (folder / "wall.vtu").string();
  c.anatomy.mesh.import.fibres = "f0";
  for (const geometry::Assumption& a : anatomy::make_anatomy(c).warnings)
    if (a.part == "fibres")
      return a.text;
  return "";
}

}  // namespace

TEST_CASE("fibres that lead through the wall are warned of", "[unit][anatomy]") {
  for (const mesh::CellKind kind : test::kinds) {
    const mesh::Mesh mesh = test::coarse_mesh(kind);
    const std::vector<Vec3> radial = mesh::radial_directions(mesh);
    std::vector<Vec3> around;
    for (const Vec3& r : radial)
      around.push_back(std::abs(r.z()) < 0.9 ? Vec3::UnitZ().cross(r) : Vec3::UnitX().cross(r));
    CHECK(warning_of(mesh, around).empty());
    CHECK_THAT(warning_of(mesh, radial), Catch::Contains("lead out of the wall's surface, by"));
    CHECK_FALSE(warning_of(mesh, std::vector<Vec3>(radial.size(), Vec3::UnitX())).empty());
  }
}
