#include "lv/bench/bench.hpp"

#include "lv/base/units.hpp"
#include "lv/bench/bare_transforms.hpp"
#include "lv/bench/machine.hpp"
#include "lv/bench/stopwatch.hpp"
#include "lv/fluid/advect.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace lv::bench {
namespace {

constexpr double dt = 1e-4;
constexpr double word = sizeof(double);

/// Operations per point of the wall's kernels, counted in the sources.
constexpr double flops_per_transfer =
    3.0 * 64.0 * 3.0 + 300.0;                    // a node's weights and 3 x 64 points
constexpr double flops_per_gauss_point = 700.0;  // F, the law with exponentials, forces
constexpr double gauss_points = 9.0;             // 8 and one for the volume
constexpr double flops_per_sarcomere = 350.0;    // with its exponentials

/// A model's parts, each ready to be timed alone.
class Kernels {
 public:
  Kernels(const mesh::Mesh& mesh, const immersed::ModelParameters& p,
          const material::Myocardium& material)
      : mesh_(mesh),
        p_(p),
        slab_(fluid::slab_of(p.grid, parallel::rank(), parallel::size())),
        wall_(mesh, material),
        endocardium_(mesh),
        strength_(solid::strength(mesh, material.infarct)),
        contraction_({}, {mesh.nodes, wall_.nodal_volumes(), strength_}, p.blood.density,
                     p.grid.spacing.minCoeff()),
        coupling_(immersed::make_coupling(p.coupling, mesh, p.grid, slab_)),
        transform_(p.grid, slab_),
        stokes_(p.grid, transform_, p.blood),
        velocity_(p.grid, slab_),
        force_(p.grid, slab_),
        convection_(p.grid, slab_),
        modes_(transform_.zero_modes()),
        force_modes_(transform_.zero_modes()),
        forces_(mesh.nodes.size(), Vec3::Constant(1e-3)),
        velocities_(mesh.nodes.size(), Vec3::Zero()),
        stretch_(mesh.nodes.size(), 1.0) {
    contraction_.relax(0.5);
  }

  double stokes() {
    return median_seconds([&] {
      transform_.to_modes(force_, force_modes_);
      stokes_.advance(modes_, force_modes_, dt, 0.0);
      transform_.to_points(modes_, velocity_);
      fluid::fill_ghosts(velocity_, slab_);
    });
  }
  double advect() {
    return median_seconds([&] {
      fluid::convection_force(velocity_, p_.grid, p_.blood.density, {}, convection_, force_);
    });
  }
  double spread() {
    return median_seconds([&] { coupling_->spread(mesh_.nodes, forces_, force_); });
  }
  double interpolate() {
    return median_seconds([&] { coupling_->interpolate(velocity_, mesh_.nodes, velocities_); });
  }
  double elastic() {
    return median_seconds([&] {
      std::fill(forces_.begin(), forces_.end(), Vec3::Zero());
      wall_.add_elastic_forces(mesh_.nodes, contraction_.tension(), forces_);
      endocardium_.add_gradient(1.0, mesh_.nodes, forces_);
      parallel::sum({forces_.data()->data(), 3 * forces_.size()});
    });
  }
  double active() {
    return median_seconds([&] {
      wall_.nodal_stretch(mesh_.nodes, stretch_);
      contraction_.advance(stretch_, 0.5, 0.5, dt);
    });
  }

 private:
  const mesh::Mesh& mesh_;
  const immersed::ModelParameters& p_;
  fluid::Slab slab_;
  solid::Wall wall_;
  solid::EndocardialSurface endocardium_;
  std::vector<double> strength_;
  solid::Contraction contraction_;
  std::unique_ptr<immersed::Coupling> coupling_;
  fluid::BoxTransform transform_;
  fluid::Stokes stokes_;
  fluid::FaceField velocity_, force_, convection_;
  fluid::ModeField modes_, force_modes_;
  std::vector<Vec3> forces_, velocities_;
  std::vector<double> stretch_;
};

double whole_step(const mesh::Mesh& mesh, const immersed::ModelParameters& p,
                  const material::Myocardium& material) {
  immersed::Model model(mesh, {material, {}}, p);
  model.relax(0.01);
  double calcium = 0.01;
  return median_seconds(
      [&] {
        calcium = std::min(1.0, calcium + 0.05);
        static_cast<void>(model.step({1.0 * units::mmHg, 0.0, calcium}, dt));
      },
      11);
}

}  // namespace

Bench measure(const mesh::Mesh& mesh, const immersed::ModelParameters& p,
              const material::Myocardium& material) {
  Bench bench{p.grid.cells,
              parallel::size(),
              mesh.cell_count(),
              static_cast<int>(mesh.nodes.size()),
              measure_machine(),
              {},
              0.0};
  const double n = 1.0 * p.grid.cells[0] * p.grid.cells[1] * p.grid.cells[2];
  const double nodes = bench.nodes;
  const double gauss = gauss_points * bench.elements;
  const auto add = [&](const char* kernel, double seconds, double bytes, double flops) {
    const double least = std::max(bytes / bench.machine.bandwidth, flops / bench.machine.peak);
    bench.rows.push_back({kernel, seconds, bytes, flops, least});
  };
  // a transform reads and writes its field once per axis at least; 2.5 n log2 n operations each
  const double transform_bytes = 6.0 * 3.0 * 2.0 * word * n;
  const double transform_flops = 6.0 * 2.5 * n * std::log2(n);
  add("transforms", bare_transforms(p.grid), transform_bytes, transform_flops);
  {
    Kernels kernels(mesh, p, material);
    add("stokes", kernels.stokes(), transform_bytes + 9.0 * word * n, transform_flops + 40.0 * n);
    add("advect", kernels.advect(), 12.0 * word * n, 3.0 * 60.0 * n);
    add("spread", kernels.spread(), 2.0 * word * 3.0 * n, flops_per_transfer * nodes);
    add("interpolate", kernels.interpolate(), word * 3.0 * n, flops_per_transfer * nodes);
    add("elastic", kernels.elastic(), word * 60.0 * gauss_points * bench.elements,
        flops_per_gauss_point * gauss);
    add("active", kernels.active(), word * 10.0 * gauss_points * bench.elements,
        200.0 * gauss + flops_per_sarcomere * nodes);
  }
  add("step", whole_step(mesh, p, material), 0.0, 0.0);
  bench.peak_memory = peak_memory();
  return bench;
}

std::string text(const Bench& b) {
  std::string out = fmt::format(
      "grid {} x {} x {}, {} elements, {} nodes, {} rank{}\n"
      "bandwidth {:.1f} GB/s, peak {:.1f} Gflop/s\n\n"
      "  {:<12}{:>14}{:>14}{:>12}\n",
      b.cells[0], b.cells[1], b.cells[2], b.elements, b.nodes, b.ranks, b.ranks == 1 ? "" : "s",
      1e-9 * b.machine.bandwidth, 1e-9 * b.machine.peak, "kernel", "seconds/step", "roofline",
      "of it");
  for (const Row& row : b.rows)
    out += row.roofline > 0.0
               ? fmt::format("  {:<12}{:>14.5f}{:>14.5f}{:>11.0f}%\n", row.kernel, row.seconds,
                             row.roofline, 100.0 * row.roofline / row.seconds)
               : fmt::format("  {:<12}{:>14.5f}\n", row.kernel, row.seconds);
  return out +
         fmt::format("\na step takes {:.2f} times the six bare transforms; peak memory {:.2f} GB\n",
                     b.rows.back().seconds / b.rows.front().seconds, 1e-9 * b.peak_memory);
}

std::string json(const Bench& b) {
  nlohmann::ordered_json out{
      {"grid", b.cells}, {"ranks", b.ranks}, {"elements", b.elements}, {"nodes", b.nodes}};
  for (const Row& row : b.rows)
    out[row.kernel] = row.seconds;
  out["peak_memory_bytes"] = b.peak_memory;
  out["bandwidth_bytes_per_s"] = b.machine.bandwidth;
  out["peak_flops_per_s"] = b.machine.peak;
  for (const Row& row : b.rows)
    if (row.roofline > 0.0)
      out["roofline_s"][row.kernel] = row.roofline;
  return out.dump() + "\n";
}

}  // namespace lv::bench
