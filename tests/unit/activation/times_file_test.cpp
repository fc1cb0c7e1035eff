#include "lv/activation/times_file.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/mesh/refine.hpp"

#include "support/block_mesh.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <filesystem>

namespace {

using namespace lv;
using activation::read_times;
using mesh::CellKind;

std::filesystem::path written(const std::string& name, const std::string& text) {
  auto file = std::filesystem::temp_directory_path() / name;
  write_file(file, text);
  return file;
}

/// One number a line.
std::string lines_of(const std::vector<double>& numbers) {
  std::string text = "# ms\n";
  for (const double number : numbers)
    text += fmt::format("{}\n", number);
  return text;
}

/// Milliseconds, even in space.
double field(const Vec3& x) {
  return 20.0 + 2.0 * x.x() + 3.0 * x.y() + x.z();
}

}  // namespace

TEST_CASE("times stand at nodes, cells, corners or elements", "[unit][activation]") {
  for (const CellKind kind : {CellKind::hexahedron, CellKind::tetrahedron}) {
    const mesh::Mesh coarse = test::cubes(kind, 2);
    const mesh::Mesh fine = mesh::refine(coarse);
    const auto check = [&](const std::vector<double>& numbers) {
      const auto file = written("lv_times.dat", lines_of(numbers));
      const auto times = read_times({file.string(), "", 1e-3}, fine);
      REQUIRE(times.size() == fine.nodes.size());
      for (std::size_t a = 0; a < times.size(); ++a)
        CHECK(times[a] == Approx(1e-3 * field(fine.nodes[a])));
    };
    std::vector<double> at_nodes, at_corners;
    for (const Vec3& X : fine.nodes)
      at_nodes.push_back(field(X));
    for (const Vec3& X : coarse.nodes)
      at_corners.push_back(field(X));
    check(at_nodes);
    check(at_corners);
    for (const int count : {fine.cell_count(), coarse.cell_count()}) {
      const auto file = written("lv_times.dat", lines_of(std::vector<double>(count, 7.0)));
      for (const double time : read_times({file.string(), "", 1e-3}, fine))
        CHECK(time == Approx(7e-3));
    }
  }
}

TEST_CASE("times of another mesh, and muscle that is never activated, are refused in words",
          "[unit][activation]") {
  const mesh::Mesh m = mesh::refine(test::cubes(CellKind::hexahedron, 1));
  const auto refused = [&](const std::string& text) {
    const auto file = written("lv_times.dat", text);
    try {
      static_cast<void>(read_times({file.string(), "", 1e-3}, m));
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  CHECK_THAT(refused(lines_of({1.0, 2.0, 3.0})),
             Catch::Contains("has 3 times, but the wall has 27 nodes and 8 cells, of 1 quadratic "
                             "elements with 8 corners"));
  CHECK_THAT(refused(lines_of({0, 1, 2, 3, -1, 5, 6, 7})),
             Catch::Contains("lv_times.dat:6") && Catch::Contains("the time is -1, which is no"));
  CHECK_THAT(refused("# ms\n1.0\n\nnan\n"),
             Catch::Contains("lv_times.dat:4") && Catch::Contains("the time is nan"));
  CHECK_THAT(refused("1.0\nsoon\n"),
             Catch::Contains("lv_times.dat:2") && Catch::Contains("\"soon\" is no number"));
}

TEST_CASE("times are read from an array of a VTK file", "[unit][activation]") {
  const mesh::Mesh m = test::cubes(CellKind::hexahedron, 1);
  std::string text =
      "# vtk DataFile Version 3.0\nwall\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n";
  for (const Vec3& X : m.nodes)
    text += fmt::format("{} {} {}\n", X.x(), X.y(), X.z());
  text += fmt::format(
      "CELLS 1 9\n8 {}\nCELL_TYPES 1\n12\nPOINT_DATA 8\nSCALARS act double 1\nLOOKUP_TABLE "
      "default\n0 1 2 3 4 5 6 7\n",
      fmt::join(m.cells, " "));
  const auto file = written("lv_times.vtk", text);
  std::string negative = text;
  negative.replace(text.rfind("6 7"), 1, "-6");
  const auto bad = written("lv_times_bad.vtk", negative);
  CHECK_THROWS_WITH(read_times({bad.string(), "act", 1e-3}, m),
                    Catch::Contains("act of point 6 (counted from 0, as ParaView does) is -6"));
  CHECK(read_times({file.string(), "act", 1e-3}, m)[5] == Approx(5e-3));
  CHECK(read_times({file.string(), "", 1e-3}, m)[5] == Approx(5e-3));
  CHECK_THROWS_WITH(read_times({file.string(), "lat", 1e-3}, m), Catch::Contains("lat"));
}
