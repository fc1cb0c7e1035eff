#include "lv/solid/quadrature.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/gauss.hpp"

namespace lv::solid {
namespace {

using Points2 = std::vector<QuadraturePoint<2>>;
using Points3 = std::vector<QuadraturePoint<3>>;

/// The points of a line in every direction.
template <int Dim>
std::vector<QuadraturePoint<Dim>> product(const std::vector<mesh::LinePoint>& line) {
  const auto n = line.size();
  std::vector<QuadraturePoint<Dim>> points;
  for (std::size_t i = 0; i < (Dim == 2 ? n * n : n * n * n); ++i) {
    QuadraturePoint<Dim> point{{}, 1.0};
    std::size_t place = i;
    for (int d = 0; d < Dim; ++d, place /= n) {
      point.xi[d] = line[place % n].x;
      point.weight *= line[place % n].weight;
    }
    points.push_back(point);
  }
  return points;
}

/// Adds the places whose barycentric coordinates are `a` but for one of them, each once.
template <int Dim>
void add_near_corners(double a, double weight, std::vector<QuadraturePoint<Dim>>& points) {
  for (int corner = 0; corner <= Dim; ++corner) {
    QuadraturePoint<Dim> point{{}, weight};
    point.xi.fill(a);
    if (corner < Dim)
      point.xi[corner] = 1.0 - Dim * a;
    points.push_back(point);
  }
}

const Points2 triangle_of_degree_3{
    {{0.17855872826361642312, 0.15505102572168219018}, 0.15902069087198858470},
    {{0.07503111022260811818, 0.64494897427831780982}, 0.09097930912801141530},
    {{0.66639024601470138670, 0.15505102572168219018}, 0.15902069087198858470},
    {{0.28001991549907407200, 0.64494897427831780982}, 0.09097930912801141530}};

const Points3 tetrahedron_of_degree_3{
    {{0.16200149169852451, 0.18385035049209769, 0.012718366313681451}, 0.020387000459557516},
    {{0.010905212211189241, 0.28152380212354622, 0.3621268299455338}, 0.021344402118457815},
    {{0.19011700243928389, 0.011403329444557171, 0.35862072046688392}, 0.022094671190740867},
    {{0.170816925164989, 0.15281814309092731, 0.63849329996172666}, 0.023437401610067202},
    {{0.15868516322744061, 0.58566280565521578, 0.1308471689520965}, 0.037402527819592898},
    {{0.57122605214911515, 0.14691839008716959, 0.14037280579421069}, 0.042000663468250383}};

Points2 triangle_of_degree_5() {
  Points2 points{{{1.0 / 3.0, 1.0 / 3.0}, 0.1125}};
  add_near_corners(0.10128650732345633880, 0.062969590272413576298, points);
  add_near_corners(0.47014206410511508977, 0.066197076394253090369, points);
  return points;
}

Points3 tetrahedron_of_degree_5() {
  Points3 points;
  add_near_corners(0.31088591926330060980, 0.018781320953002641800, points);
  add_near_corners(0.092735250310891226402, 0.012248840519393658257, points);
  // the middles between two corners, moved towards the centre
  const double a = 0.045503704125649649492;
  const double b = 0.5 - a;
  for (const auto& xi :
       {std::array{a, a, b}, {a, b, a}, {a, b, b}, {b, a, a}, {b, a, b}, {b, b, a}})
    points.push_back({xi, 0.0070910034628469110730});
  return points;
}

}  // namespace

template <int Dim>
std::vector<QuadraturePoint<Dim>> quadrature(mesh::CellKind kind, int order) {
  LV_CHECK(order == 1 || order == 2);
  if (kind == mesh::CellKind::hexahedron)
    return product<Dim>(mesh::gauss(order + 1));
  if constexpr (Dim == 2)
    return order == 1 ? triangle_of_degree_3 : triangle_of_degree_5();
  else
    return order == 1 ? tetrahedron_of_degree_3 : tetrahedron_of_degree_5();
}

template std::vector<QuadraturePoint<2>> quadrature<2>(mesh::CellKind kind, int order);
template std::vector<QuadraturePoint<3>> quadrature<3>(mesh::CellKind kind, int order);

}  // namespace lv::solid
