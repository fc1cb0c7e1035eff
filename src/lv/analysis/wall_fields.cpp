#include "lv/analysis/wall_fields.hpp"

#include "lv/analysis/wall_pressure.hpp"
#include "lv/base/parallel.hpp"
#include "lv/mesh/quadratic.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>

namespace lv::analysis {
namespace {

/// Calls f for every number of the fields, in a fixed order.
template <class Fields, class F>
void for_numbers(Fields& c, const F& f) {
  const auto all = [&](auto& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i)
      f(matrix.data()[i]);
  };
  f(c.volume);
  all(c.reference);
  all(c.position);
  f(c.transmural);
  f(c.infarct);
  f(c.J);
  f(c.fibre_stretch);
  all(c.F);
  all(c.fibre_frame);
  all(c.axes.circumferential);
  all(c.axes.longitudinal);
  all(c.axes.radial);
  for (double& number : c.as_numbers())
    f(number);
}

void add(CellFields& cell, const solid::PointSample& p) {
  const double w = p.volume;
  cell.volume += w;
  cell.reference += w * p.reference;
  cell.position += w * p.position;
  cell.transmural += w * p.transmural;
  cell.infarct += w * p.infarct;
  cell.J += w * p.F.determinant();
  cell.fibre_stretch += w * (p.F * p.fibre_frame.col(0)).norm();
  cell.F += w * p.F;
  cell.fibre_frame += w * p.fibre_frame;
  cell.axes.circumferential += w * p.axes.circumferential;
  cell.axes.longitudinal += w * p.axes.longitudinal;
  cell.axes.radial += w * p.axes.radial;
  cell.add(w, p.stress);
}

/// Sums to means; averaged directions are made orthonormal again.
void finish(CellFields& cell) {
  const double volume = cell.volume;
  for_numbers(cell, [&](double& number) { number /= volume; });
  Vec3 f = cell.fibre_frame.col(0).normalized();
  Vec3 s = cell.fibre_frame.col(1);
  s = (s - s.dot(f) * f).normalized();
  cell.fibre_frame << f, s, f.cross(s);
  cell.axes = mesh::wall_axes(cell.axes.radial);
}

CellFields zero_fields() {
  CellFields cell;
  for_numbers(cell, [](double& number) { number = 0.0; });
  for (Vec3* axis : {&cell.axes.circumferential, &cell.axes.longitudinal, &cell.axes.radial})
    axis->setZero();
  return cell;
}

CellStrain strain_in(const Mat3& F, const Vec3& f, const mesh::WallAxes& axes) {
  const Mat3 E = 0.5 * (F.transpose() * F - Mat3::Identity());
  const auto& [c, l, r] = axes;
  return {
      f.dot(E * f), c.dot(E * c), r.dot(E * r), l.dot(E * l),
      c.dot(E * r), c.dot(E * l), r.dot(E * l), 1.0 / (F.inverse().transpose() * r).norm() - 1.0};
}

}  // namespace

std::vector<CellFields> cell_fields(const solid::Wall& wall, const heartbeat::Snapshot& snapshot,
                                    std::span<const double> volumes,
                                    std::span<const double> pressure) {
  std::vector<double> numbers;
  CellFields cell = zero_fields();
  int present = -1;
  const auto flush = [&] {
    if (present < 0)
      return;
    finish(cell);
    for_numbers(cell, [&](double& number) { numbers.push_back(number); });
  };
  for (const solid::PointSample& p : wall.sample(snapshot.positions, snapshot.tension)) {
    if (p.cell != present) {
      flush();
      cell = zero_fields();
      present = p.cell;
    }
    add(cell, p);
  }
  flush();

  const std::vector<double> all = parallel::gather(numbers);
  std::vector<CellFields> cells(parallel::is_root() ? volumes.size() : 0);
  const double* next = all.data();
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for_numbers(cells[c], [&](double& number) { number = *next++; });
    cells[c].volume = volumes[c];
    cells[c].pressure = pressure.empty() ? 0.0 : pressure[c];
  }
  return cells;
}

namespace {

material::Myocardium without_penalty(material::Myocardium material) {
  material.volumetric.beta_s = material.stabilisation.beta_s = 0.0;
  return material;
}

}  // namespace

FieldAnalysis::FieldAnalysis(const mesh::Mesh& mesh, const solid::CardiacModel& model,
                             std::vector<double> activation_times)
    : mesh_(mesh),
      activation_times_(std::move(activation_times)),
      contractility_(mesh::at_nodes(mesh, model.contractility)),
      volumes_(mesh::cell_volumes(mesh)),
      wall_(mesh, without_penalty(model.myocardium)),
      supports_(mesh, model.base, model.surroundings) {}

std::vector<CellFields> FieldAnalysis::fields(const heartbeat::Snapshot& snapshot) const {
  if (snapshot.stress.empty())
    return completed(
        cell_fields(wall_, snapshot, volumes_, wall_pressure(mesh_, wall_, supports_, snapshot)));
  std::vector<CellFields> cells = shape_fields(wall_, volumes_, snapshot.positions);
  for (std::size_t c = 0; c < cells.size(); ++c)
    static_cast<solid::CellStress&>(cells[c]) = snapshot.stress[c];
  return completed(std::move(cells));
}

std::vector<CellFields> FieldAnalysis::at_rest() const {
  return completed(shape_fields(wall_, volumes_, mesh_.nodes));
}

std::vector<CellFields> FieldAnalysis::completed(std::vector<CellFields> cells) const {
  const auto set = [&](double CellFields::*field, const std::vector<double>& of_nodes) {
    for (std::size_t c = 0; !of_nodes.empty() && c < cells.size(); ++c) {
      const auto nodes = mesh_.cell(static_cast<int>(c));
      cells[c].*field = 0.0;
      for (const int node : nodes)
        cells[c].*field += of_nodes[node] / static_cast<double>(nodes.size());
    }
  };
  set(&CellFields::activation_time, activation_times_);
  set(&CellFields::contractility, contractility_);
  return cells;
}

std::vector<CellFields> shape_fields(const solid::Wall& wall, std::span<const double> volumes,
                                     const std::vector<Vec3>& positions) {
  heartbeat::Snapshot s;
  s.positions = positions;
  s.tension.assign(positions.size(), 0.0);
  return cell_fields(wall, s, volumes, {});
}

void set_work_density(std::span<const double> of_elements, std::vector<CellFields>& cells) {
  if (of_elements.empty())
    return;
  const std::size_t parts = std::max<std::size_t>(1, cells.size() / of_elements.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    cells[c].work_density = of_elements[c / parts];
}

CellStrain strain(const CellFields& now) {
  return strain_in(now.F, now.fibre_frame.col(0), now.axes);
}

CellStrain strain(const CellFields& now, const CellFields& then) {
  const Mat3 inverse = then.F.inverse();
  const Vec3 f = (then.F * then.fibre_frame.col(0)).normalized();
  return strain_in(now.F * inverse, f, mesh::wall_axes(inverse.transpose() * then.axes.radial));
}

}  // namespace lv::analysis
