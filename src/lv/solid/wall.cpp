#include "lv/solid/wall.hpp"

#include "lv/base/parallel.hpp"
#include "lv/mesh/undeformed_wall.hpp"
#include "lv/solid/element.hpp"

#include <Eigen/LU>

#include <limits>

namespace lv::solid {
namespace {

double lane(const Pack& pack, int i) {
  return pack.get(i);
}

template <class From>
Tensor<double> lane(const From& tensor, int i) {
  Mat3 result;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      result(r, c) = tensor(r, c).get(i);
  return result;
}

/// Smallest and largest of what it was shown, lane by lane.
struct PackRange {
  Pack lowest = Pack(std::numeric_limits<double>::max());
  Pack highest = Pack(std::numeric_limits<double>::lowest());

  void include(const Pack& value) {
    lowest = xsimd::min(lowest, value);
    highest = xsimd::max(highest, value);
  }
  [[nodiscard]] VolumeRange over_lanes() const {
    VolumeRange range{lane(lowest, 0), lane(highest, 0)};
    for (int i = 1; i < pack_size; ++i)
      range = {std::min(range.min_J, lane(lowest, i)), std::max(range.max_J, lane(highest, i))};
    return range;
  }
};

void set_lane(Pack& pack, int i, double value) {
  alignas(Pack) std::array<double, pack_size> values;
  pack.store_aligned(values.data());
  values[i] = value;
  pack = Pack::load_aligned(values.data());
}

}  // namespace

/// What Wall does, for elements of any kind.
class Wall::Elements {
 public:
  virtual ~Elements() = default;
  [[nodiscard]] virtual std::span<const double> nodal_volumes() const = 0;
  virtual void add_stretch(std::span<const Vec3> positions, std::span<double> integrals) const = 0;
  [[nodiscard]] virtual VolumeRange add_elastic_forces(std::span<const Vec3> positions,
                                                       std::span<const double> tension,
                                                       std::span<Vec3> forces) const = 0;
  [[nodiscard]] virtual std::vector<PointSample> sample(std::span<const Vec3> positions,
                                                        std::span<const double> tension) const = 0;
};

namespace {

/// Elements of kind E, pack_size of them side by side in every group; the last group repeats its
/// last element with weight zero.
template <class E>
class PackedElements final : public Wall::Elements {
 public:
  PackedElements(const mesh::Mesh& mesh, const material::Myocardium& material);

  [[nodiscard]] std::span<const double> nodal_volumes() const override { return nodal_volumes_; }
  void add_stretch(std::span<const Vec3> positions, std::span<double> integrals) const override;
  [[nodiscard]] VolumeRange add_elastic_forces(std::span<const Vec3> positions,
                                               std::span<const double> tension,
                                               std::span<Vec3> forces) const override;
  [[nodiscard]] std::vector<PointSample> sample(std::span<const Vec3> positions,
                                                std::span<const double> tension) const override;

 private:
  static constexpr auto rule = E::full_quadrature();
  /// The part of beta_s that a tetrahedron keeps to itself when the rest sees the volumes around
  /// nodes: without it single elements have next to no bulk stiffness and J alternates (M.A. Puso &
  /// J. Solberg, Int. J. Numer. Meth. Engng 67:841, 2006). Of the default 1000 kPa, the paper's
  /// 100.
  static constexpr double own_share = 0.1;
  [[nodiscard]] static double own_stiffness(const material::Myocardium& m) {
    return std::max(own_share * m.volumetric.beta_s, m.stabilisation.beta_s);
  }

  /// F' = (sum_a x_a (x) d phi_a/d xi) K with K = (d xi/dX) [f0 s0 n0]: F with its second index in
  /// the fibre frame.
  struct Point {
    Tensor<Pack> K;
    Pack volume;   ///< reference volume of the point
    Pack infarct;  ///< M
  };
  using Nodes = std::array<std::array<int, pack_size>, E::nodes>;
  struct Group {
    std::array<Point, E::points> points;
    std::array<Vector<Pack>, E::nodes> mean_gradient;  ///< int grad phi_a dX / int dX
    Pack volume;                                       ///< int dX
  };
  /// What the fibre stretch needs of a point, K f0 and its volume, once more by itself: read
  /// among all the rest, it would cost the memory traffic of the forces.
  struct FibrePoint {
    Vector<Pack> K_f0;
    Pack volume;
  };
  using FibrePoints = std::array<FibrePoint, E::points>;
  using Nodal = std::array<Vector<Pack>, E::nodes>;
  using NodalScalar = std::array<Pack, E::nodes>;
  using Gradients = std::array<std::array<double, 3>, E::nodes>;

  [[nodiscard]] int cell_of(int group, int i) const {
    return std::min(cells_.begin + group * pack_size + i, cells_.end - 1);
  }
  [[nodiscard]] mesh::ElementPoint element_point(int cell, int q) const {
    return {cell,
            mesh_.cell(cell),
            rule.value[q],
            {rule.gradient[q].front().data(), 3 * static_cast<std::size_t>(E::nodes)}};
  }
  void set_point(Point& point, int i, int cell, int q, double weight);
  void set_means(Group& group, int i, int cell, double weight);
  [[nodiscard]] static Nodal gather(const Nodes& nodes, std::span<const Vec3> positions);
  [[nodiscard]] static NodalScalar gather(const Nodes& nodes, std::span<const double> values);
  static void scatter(const Nodes& nodes, const Nodal& nodal, std::span<Vec3> forces);
  static void scatter(const Nodes& nodes, const NodalScalar& nodal, std::span<double> values);
  [[nodiscard]] static Tensor<Pack> dx_dxi(const Nodal& x, const Gradients& gradient);
  static void subtract_force(const Tensor<Pack>& P, const Point& point, const Gradients& gradient,
                             Nodal& force);
  template <class Law>
  [[nodiscard]] PackRange add_forces(const Law& law, std::span<const Vec3> positions,
                                     std::span<const double> tension, std::span<Vec3> forces) const;
  template <class Law>
  void point_forces(const Law& law, const Group& group, const Nodal& x, const NodalScalar& tension,
                    Nodal& force, PackRange& J_range) const;
  void add_volumes();
  [[nodiscard]] std::vector<double> nodal_pressure(std::span<const Vec3> positions) const;
  void volumetric_forces(const Group& group, const Nodal& x, const NodalScalar& pressure,
                         Nodal& force) const;
  [[nodiscard]] static Tensor<Pack> mean_deformation_gradient(const Group& group, const Nodal& x);
  [[nodiscard]] static Pack at_point(const NodalScalar& nodal, int q);
  [[nodiscard]] PointSample sample_point(int group, int q, int i, const Tensor<Pack>& F,
                                         double tension) const;

  const mesh::Mesh& mesh_;
  mesh::UndeformedWall undeformed_;
  material::Myocardium material_;
  parallel::Range cells_;
  std::vector<Nodes> nodes_;
  std::vector<Group> groups_;
  std::vector<FibrePoints> fibres_;
  std::vector<double> nodal_volumes_;
};

template <class E>
PackedElements<E>::PackedElements(const mesh::Mesh& mesh, const material::Myocardium& material)
    : mesh_(mesh),
      undeformed_(mesh),
      material_(material),
      cells_(parallel::share(mesh.cell_count(), parallel::rank(), parallel::size())) {
  groups_.resize((cells_.size() + pack_size - 1) / pack_size);
  nodes_.resize(groups_.size());
  for (int g = 0; g < static_cast<int>(groups_.size()); ++g) {
    for (int i = 0; i < pack_size; ++i) {
      const int cell = cell_of(g, i);
      const bool padding = cells_.begin + g * pack_size + i >= cells_.end;
      for (int a = 0; a < E::nodes; ++a)
        nodes_[g][a][i] = mesh.cell(cell)[a];
      for (int q = 0; q < E::points; ++q)
        set_point(groups_[g].points[q], i, cell, q, padding ? 0.0 : rule.weight[q]);
      set_means(groups_[g], i, cell, padding ? 0.0 : 1.0);
    }
    FibrePoints& fibres = fibres_.emplace_back();
    for (int q = 0; q < E::points; ++q)
      fibres[q] = {groups_[g].points[q].K.col(0), groups_[g].points[q].volume};
  }
  add_volumes();
}

template <class E>
void PackedElements<E>::set_point(Point& point, int i, int cell, int q, double weight) {
  const mesh::UndeformedPoint X = undeformed_.at(element_point(cell, q));
  const Mat3 K = X.dX_dxi.inverse() * X.frame;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      set_lane(point.K(r, c), i, K(r, c));
  set_lane(point.volume, i, weight * X.det);
  set_lane(point.infarct, i, X.M);
}

template <class E>
void PackedElements<E>::set_means(Group& group, int i, int cell, double weight) {
  std::array<Vec3, E::nodes> integral;
  integral.fill(Vec3::Zero());
  double volume = 0.0;
  for (int q = 0; q < E::points; ++q) {
    const Mat3 dX_dxi = mesh::jacobian(mesh_, element_point(cell, q));
    const double dX = rule.weight[q] * dX_dxi.determinant();
    const Mat3 to_X = dX_dxi.inverse().transpose();
    for (int a = 0; a < E::nodes; ++a)
      integral[a] += dX * to_X * Vec3(rule.gradient[q][a].data());
    volume += dX;
  }
  for (int a = 0; a < E::nodes; ++a)
    for (int d = 0; d < 3; ++d)
      set_lane(group.mean_gradient[a][d], i, integral[a][d] / volume);
  set_lane(group.volume, i, weight * volume);
}

template <class E>
typename PackedElements<E>::Nodal PackedElements<E>::gather(const Nodes& nodes,
                                                            std::span<const Vec3> positions) {
  Nodal x;
  alignas(Pack) std::array<std::array<double, pack_size>, 3> lanes;
  for (int a = 0; a < E::nodes; ++a) {
    for (int i = 0; i < pack_size; ++i) {
      const Vec3& p = positions[nodes[a][i]];
      for (int d = 0; d < 3; ++d)
        lanes[d][i] = p[d];
    }
    for (int d = 0; d < 3; ++d)
      x[a][d] = Pack::load_aligned(lanes[d].data());
  }
  return x;
}

template <class E>
typename PackedElements<E>::NodalScalar PackedElements<E>::gather(const Nodes& nodes,
                                                                  std::span<const double> values) {
  NodalScalar nodal;
  alignas(Pack) std::array<double, pack_size> lanes;
  for (int a = 0; a < E::nodes; ++a) {
    for (int i = 0; i < pack_size; ++i)
      lanes[i] = values[nodes[a][i]];
    nodal[a] = Pack::load_aligned(lanes.data());
  }
  return nodal;
}

template <class E>
void PackedElements<E>::scatter(const Nodes& nodes, const NodalScalar& nodal,
                                std::span<double> values) {
  alignas(Pack) std::array<double, pack_size> lanes;
  for (int a = 0; a < E::nodes; ++a) {
    nodal[a].store_aligned(lanes.data());
    for (int i = 0; i < pack_size; ++i)
      values[nodes[a][i]] += lanes[i];
  }
}

template <class E>
void PackedElements<E>::scatter(const Nodes& nodes, const Nodal& nodal, std::span<Vec3> forces) {
  alignas(Pack) std::array<std::array<double, pack_size>, 3> lanes;
  for (int a = 0; a < E::nodes; ++a) {
    for (int d = 0; d < 3; ++d)
      nodal[a][d].store_aligned(lanes[d].data());
    for (int i = 0; i < pack_size; ++i)
      forces[nodes[a][i]] += Vec3(lanes[0][i], lanes[1][i], lanes[2][i]);
  }
}

template <class E>
Tensor<Pack> PackedElements<E>::dx_dxi(const Nodal& x, const Gradients& gradient) {
  Tensor<Pack> result;
  for (int d = 0; d < 3; ++d) {
    for (int m = 0; m < 3; ++m) {
      Pack sum = x[0][d] * gradient[0][m];
      for (int a = 1; a < E::nodes; ++a)
        sum = xsimd::fma(x[a][d], Pack(gradient[a][m]), sum);
      result(d, m) = sum;
    }
  }
  return result;
}

/// F_a -= P : grad phi_a dX at one point.
template <class E>
void PackedElements<E>::subtract_force(const Tensor<Pack>& P, const Point& point,
                                       const Gradients& gradient, Nodal& force) {
  const Tensor<Pack> G = (P * point.K.transpose()) * point.volume;
  for (int a = 0; a < E::nodes; ++a)
    for (int d = 0; d < 3; ++d)
      for (int m = 0; m < 3; ++m)
        force[a][d] = xsimd::fnma(G(d, m), Pack(gradient[a][m]), force[a][d]);
}

template <class E>
void PackedElements<E>::add_volumes() {
  nodal_volumes_.assign(mesh_.nodes.size(), 0.0);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    NodalScalar volume;
    volume.fill(Pack(0.0));
    for (int q = 0; q < E::points; ++q)
      for (int a = 0; a < E::nodes; ++a)
        volume[a] += rule.value[q][a] * groups_[g].points[q].volume;
    scatter(nodes_[g], volume, nodal_volumes_);
  }
  parallel::sum(nodal_volumes_);
}

template <class E>
void PackedElements<E>::add_stretch(std::span<const Vec3> positions,
                                    std::span<double> integrals) const {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Nodal x = gather(nodes_[g], positions);
    NodalScalar nodal;
    nodal.fill(Pack(0.0));
    for (int q = 0; q < E::points; ++q) {
      const FibrePoint& point = fibres_[g][q];
      const Vector<Pack> f = dx_dxi(x, rule.gradient[q]) * point.K_f0;
      const Pack stretch = xsimd::sqrt(f.squaredNorm()) * point.volume;
      for (int a = 0; a < E::nodes; ++a)
        nodal[a] = xsimd::fma(Pack(rule.value[q][a]), stretch, nodal[a]);
    }
    scatter(nodes_[g], nodal, integrals);
  }
}

template <class E>
VolumeRange PackedElements<E>::add_elastic_forces(std::span<const Vec3> positions,
                                                  std::span<const double> tension,
                                                  std::span<Vec3> forces) const {
  const bool is_mean = material_.volumetric_points == material::VolumetricPoints::mean;
  const material::Volumetric beside{E::nodes == 4 ? 0.0 : material_.stabilisation.beta_s};
  return material::with_point_law(
      material_, is_mean ? beside : material_.volumetric,
      [&](const auto& law) { return add_forces(law, positions, tension, forces).over_lanes(); });
}

template <class E>
template <class Law>
PackRange PackedElements<E>::add_forces(const Law& law, std::span<const Vec3> positions,
                                        std::span<const double> tension,
                                        std::span<Vec3> forces) const {
  PackRange J;
  const bool mean_dilatation = material_.volumetric_points == material::VolumetricPoints::mean;
  const std::vector<double> pressure =
      mean_dilatation && E::nodes == 4 ? nodal_pressure(positions) : std::vector<double>{};
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Nodes& nodes = nodes_[g];
    const Nodal x = gather(nodes, positions);
    Nodal force;
    force.fill(Vector<Pack>(Pack(0.0), Pack(0.0), Pack(0.0)));
    point_forces(law, groups_[g], x, gather(nodes, tension), force, J);
    if (mean_dilatation)
      volumetric_forces(groups_[g], x, pressure.empty() ? NodalScalar{} : gather(nodes, pressure),
                        force);
    scatter(nodes, force, forces);
  }
  return J;
}

template <class E>
Pack PackedElements<E>::at_point(const NodalScalar& nodal, int q) {
  Pack sum = nodal[0] * rule.value[q][0];
  for (int a = 1; a < E::nodes; ++a)
    sum = xsimd::fma(nodal[a], Pack(rule.value[q][a]), sum);
  return sum;
}

/// Of the stresses at the quadrature points.
template <class E>
template <class Law>
[[gnu::flatten]] void PackedElements<E>::point_forces(const Law& law, const Group& group,
                                                      const Nodal& x, const NodalScalar& tension,
                                                      Nodal& force, PackRange& J_range) const {
  for (int q = 0; q < E::points; ++q) {
    const Point& point = group.points[q];
    const Tensor<Pack> F = dx_dxi(x, rule.gradient[q]) * point.K;
    const Pack J = determinant(F);
    J_range.include(J);
    subtract_force(law.stress(F, J, at_point(tension, q), point.infarct), point, rule.gradient[q],
                   force);
  }
}

/// int F dX / int dX over an element.
template <class E>
Tensor<Pack> PackedElements<E>::mean_deformation_gradient(const Group& group, const Nodal& x) {
  Tensor<Pack> F = x[0] * group.mean_gradient[0].transpose();
  for (int a = 1; a < E::nodes; ++a)
    F += x[a] * group.mean_gradient[a].transpose();
  return F;
}

/// Tension dU/dJ = 2 beta ln(J_a)/J_a at the nodes of tetrahedra, with the ratio J_a of the
/// present to the undeformed volume around a node (averaged nodal pressure: J. Bonet & A.J. Burton,
/// Commun. Numer. Meth. Engng 14:437, 1998). Collective.
template <class E>
std::vector<double> PackedElements<E>::nodal_pressure(std::span<const Vec3> positions) const {
  std::vector<double> J(nodal_volumes_.size(), 0.0);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Nodal x = gather(nodes_[g], positions);
    NodalScalar volume;
    volume.fill(determinant(mean_deformation_gradient(groups_[g], x)) * groups_[g].volume /
                E::nodes);
    scatter(nodes_[g], volume, J);
  }
  parallel::sum(J);
  const material::Volumetric shared{(1.0 - own_share) * material_.volumetric.beta_s};
  for (std::size_t a = 0; a < J.size(); ++a)
    J[a] = shared.tension(J[a] / nodal_volumes_[a]);
  return J;
}

/// The volumetric penalty. For hexahedra, of the element's mean deformation gradient, which is
/// exact for a uniform deformation whatever the element's shape (the gradient at its centre is not:
/// D.P. Flanagan & T. Belytschko, Int. J. Numer. Meth. Engng 17:679, 1981). For tetrahedra, the
/// mean of their nodes' `pressure`, and the element's own share.
template <class E>
void PackedElements<E>::volumetric_forces(const Group& group, const Nodal& x,
                                          const NodalScalar& pressure, Nodal& force) const {
  const Tensor<Pack> F = mean_deformation_gradient(group, x);
  Tensor<Pack> P;
  if constexpr (E::nodes == 4)
    P = cofactor(F) * (0.25 * (pressure[0] + pressure[1] + pressure[2] + pressure[3])) +
        material::Volumetric{own_stiffness(material_)}.stress(F);
  else
    P = material_.volumetric.stress(F);
  P *= group.volume;
  for (int a = 0; a < E::nodes; ++a)
    force[a] -= P * group.mean_gradient[a];
}

template <class E>
PointSample PackedElements<E>::sample_point(int group, int q, int i, const Tensor<Pack>& F,
                                            double tension) const {
  const Point& point = groups_[group].points[q];
  const mesh::UndeformedPoint X = undeformed_.at(element_point(cell_of(group, i), q));
  const Mat3 F_fibre = lane(F, i);
  PointSample s;
  s.cell = cell_of(group, i);
  s.volume = lane(point.volume, i);
  s.reference = X.X;
  s.transmural = X.t;
  s.infarct = X.M;
  s.axes = X.axes;
  s.fibre_frame = X.frame;
  s.F = F_fibre * s.fibre_frame.transpose();
  s.stress = material::with_point_law(material_, material_.volumetric, [&](const auto& law) {
    return point_stress(law, F_fibre, tension, X.M);
  });
  return s;
}

template <class E>
std::vector<PointSample> PackedElements<E>::sample(std::span<const Vec3> positions,
                                                   std::span<const double> tension) const {
  std::vector<PointSample> samples;
  samples.reserve(static_cast<std::size_t>(cells_.size()) * E::points);
  for (int g = 0; g < static_cast<int>(groups_.size()); ++g) {
    const Nodal x = gather(nodes_[g], positions);
    const NodalScalar nodal_tension = gather(nodes_[g], tension);
    for (int i = 0; i < pack_size && cells_.begin + g * pack_size + i < cells_.end; ++i) {
      for (int q = 0; q < E::points; ++q) {
        const Tensor<Pack> F = dx_dxi(x, rule.gradient[q]) * groups_[g].points[q].K;
        samples.push_back(sample_point(g, q, i, F, lane(at_point(nodal_tension, q), i)));
        samples.back().position = Vec3::Zero();
        for (int a = 0; a < E::nodes; ++a)
          samples.back().position += rule.value[q][a] * positions[nodes_[g][a][i]];
      }
    }
  }
  return samples;
}

std::unique_ptr<Wall::Elements> make_elements(const mesh::Mesh& mesh,
                                              const material::Myocardium& material) {
  if (mesh.kind == mesh::CellKind::hexahedron)
    return std::make_unique<PackedElements<Hex8>>(mesh, material);
  return std::make_unique<PackedElements<Tet4>>(mesh, material);
}

}  // namespace

Wall::Wall(const mesh::Mesh& mesh, const material::Myocardium& material)
    : elements_(make_elements(mesh, material)) {}
Wall::~Wall() = default;
Wall::Wall(Wall&&) noexcept = default;
Wall& Wall::operator=(Wall&&) noexcept = default;

void Wall::nodal_stretch(std::span<const Vec3> positions, std::span<double> stretch) const {
  std::fill(stretch.begin(), stretch.end(), 0.0);
  elements_->add_stretch(positions, stretch);
  parallel::sum(stretch);
  const auto volumes = nodal_volumes();
  for (std::size_t a = 0; a < stretch.size(); ++a)
    stretch[a] /= volumes[a];
}

std::span<const double> Wall::nodal_volumes() const {
  return elements_->nodal_volumes();
}

VolumeRange Wall::add_elastic_forces(std::span<const Vec3> positions,
                                     std::span<const double> tension,
                                     std::span<Vec3> forces) const {
  return elements_->add_elastic_forces(positions, tension, forces);
}

std::vector<PointSample> Wall::sample(std::span<const Vec3> positions,
                                      std::span<const double> tension) const {
  return elements_->sample(positions, tension);
}

}  // namespace lv::solid
