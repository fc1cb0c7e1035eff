#include "lv/geometry/spline_wall.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

using lv::Mat3;
using lv::Vec3;
using namespace lv::geometry;

/// The real ventricle HV01 of GlasgowHeart, if its folder is there: not part of the project.
std::filesystem::path hv01() {
  const char* set = std::getenv("VENTRICLE_DATA");
  return std::filesystem::path(set != nullptr ? set : LV_DATA_DIR) / "glasgow_HV01" / "text_export";
}

bool there() {
  if (std::filesystem::exists(hv01()))
    return true;
  WARN("skipped: no folder " << hv01() << "; set VENTRICLE_DATA to the folder of glasgow_HV01");
  return false;
}

Contours read(const std::string& short_axis) {
  return read_contours({hv01() / short_axis,
                        hv01() / "contours_la.csv",
                        {hv01() / "apex_endo.csv", hv01() / "apex_epi.csv"}});
}

std::string text(const std::optional<Residual>& r) {
  return r ? fmt::format("mean {:.2f} rms {:.2f} max {:.2f} mm", r->mean, r->rms, r->max) : "none";
}

std::string text(const FitReport& report) {
  std::string lines =
      fmt::format("cavity {:.2f} ml, wall {:.2f} ml, thickness {:.1f} to {:.1f} mm\n",
                  report.volume_cavity / 1e3, report.volume_wall / 1e3, report.thinnest.value,
                  report.thickest.value);
  for (const auto& s : report.short_axis)
    lines += fmt::format("short axis {}: endo {}; epi {}; shift {:.2f} mm\n", s.slice, text(s.endo),
                         text(s.epi), s.shift.norm());
  for (const auto& s : report.long_axis)
    lines += fmt::format("long axis {}: endo {}; epi {}\n", s.slice, text(s.endo), text(s.epi));
  for (const auto& note : report.notes)
    lines += "note: " + note + "\n";
  return lines;
}

double smallest_jacobian(const lv::mesh::Mesh& mesh) {
  constexpr int next[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                              {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  double least = 1.0;
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int k = 0; k < 8; ++k) {
      const auto cell = mesh.cell(c);
      const auto edge = [&](int i) -> Vec3 {
        return (mesh.nodes[cell[next[k][i]]] - mesh.nodes[cell[k]]).normalized();
      };
      least = std::min(least, edge(0).cross(edge(1)).dot(edge(2)));
    }
  return least;
}

}  // namespace

TEST_CASE("the base plane of a basal slice reproduces the published frame of HV01",
          "[unit][geometry][data]") {
  if (!there())
    return;
  const Frame frame = fit_spline_wall(read("contours_sa_aligned_long_axis.csv"),
                                      [] {
                                        SplineFitParameters p;
                                        p.frame.base_plane = BasePlane::basal_slice;
                                        p.correct_shifts = false;
                                        return p;
                                      }())
                          .frame();
  Mat3 rows;
  std::ifstream rotation(hv01() / "rotation_matrix.txt");
  Vec3 centre;
  std::ifstream base(hv01() / "base_and_apex_centre_mm.txt");
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      rotation >> rows(i, j);
    base >> centre[i];
  }
  CHECK((frame.axes.transpose() - rows).cwiseAbs().maxCoeff() < 1e-4);
  CHECK((frame.origin - centre).norm() < 1e-3);
}

// The published mesh of this ventricle encloses 53.66 ml and has 84.48 ml of elements: by the
// divergence theorem and by adding up its sections. A one-layer mesh of coarse, smoothed surfaces
// that are 1 to 1.5 mm from the contours, so 3 per cent is what can be asked. The contours
// themselves allow no more: within the accuracy of their drawing, cavities of 52.5 ml (short axes
// only, as segmented, smoothing length 5 mm) to 54.3 ml (aligned, 3 mm) fit them.
TEST_CASE("the fitted wall of HV01 has the volumes of its published mesh",
          "[unit][geometry][data]") {
  if (!there())
    return;
  const auto* const file =
      GENERATE("contours_sa_aligned_long_axis.csv", "contours_sa_as_segmented.csv");
  const SplineWall wall = fit_spline_wall(read(file), {});
  const FitReport& report = wall.report();
  WARN(file << "\n" << text(report));
  CHECK(report.volume_cavity == Approx(53.66e3).epsilon(0.03));
  CHECK(report.volume_wall == Approx(84.48e3).epsilon(0.03));
  CHECK(report.thinnest.value > 4.0);

  const auto map = [&](double u, double theta, double t) { return wall.point(u, theta, t); };
  const auto mesh = lv::mesh::wall_mesh(map, {1.4, 0});
  const double least = smallest_jacobian(mesh);
  WARN(mesh.cell_count() << " elements, smallest scaled Jacobian " << least);
  CHECK(least > 0.3);
}
