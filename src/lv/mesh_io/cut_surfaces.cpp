#include "lv/mesh_io/cut_surfaces.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/surface.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

namespace lv::mesh_io {
namespace {

using Edge = std::array<int, 2>;
using geometry::Contour;
using geometry::Side;

Edge edge_of(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

[[noreturn]] void fail_surface(const Triangles& t, const std::string& what,
                               const std::string& remedy) {
  throw InputError(t.file, what, remedy);
}

/// Twice the area of a face, along its normal.
Vec3 area_vector(const Triangles& t, int face) {
  const auto n = t.faces.face(face);
  return (t.nodes[n[1]] - t.nodes[n[0]]).cross(t.nodes[n[2]] - t.nodes[n[0]]);
}

/// Edges with one triangle only.
std::vector<Edge> open_edges(const Triangles& t) {
  std::map<Edge, int> count;
  for (int f = 0; f < t.faces.size(); ++f) {
    const auto n = t.faces.face(f);
    for (int i = 0; i < 3; ++i)
      if (n[i] != n[(i + 1) % 3])
        ++count[edge_of(n[i], n[(i + 1) % 3])];
  }
  std::vector<Edge> open;
  for (const auto& [edge, faces] : count)
    if (faces == 1)
      open.push_back(edge);
  return open;
}

/// A plane n x = d.
struct CutPlane {
  Vec3 normal;
  double offset;
};

/// The plane in which most of a surface's area lies, to a fiftieth of a radian and half a mm.
CutPlane largest_plane(const Triangles& t) {
  std::map<std::array<long, 4>, std::pair<double, CutPlane>> planes;
  for (int f = 0; f < t.faces.size(); ++f) {
    const Vec3 area = area_vector(t, f);
    if (!(area.norm() > 0.0))
      continue;
    Vec3 n = area.normalized();
    if (n.z() < 0.0 || (n.z() == 0.0 && (n.y() < 0.0 || (n.y() == 0.0 && n.x() < 0.0))))
      n = -n;
    const double d = n.dot(t.nodes[t.faces.face(f)[0]]);
    auto& plane = planes[{std::lround(50.0 * n.x()), std::lround(50.0 * n.y()),
                          std::lround(50.0 * n.z()), std::lround(2.0 * d)}];
    plane.first += area.norm();
    plane.second = {n, d};
  }
  if (planes.empty())
    fail_surface(t, "has triangles without area alone", "Export the surface again");
  return std::max_element(
             planes.begin(), planes.end(),
             [](const auto& a, const auto& b) { return a.second.first < b.second.first; })
      ->second.second;
}

/// Takes the flat lid off a closed surface.
Triangles without_lid(const Triangles& t) {
  constexpr double flat = 0.3;         // [mm]
  constexpr double least_part = 0.05;  // of the area
  constexpr double beyond = 1.0;       // what may lie on the lid's other side [mm]
  const CutPlane lid = largest_plane(t);
  const auto height = [&](int node) { return lid.normal.dot(t.nodes[node]) - lid.offset; };
  Triangles open{t.file, t.nodes, {.nodes_per_face = 3, .nodes = {}}};
  double taken = 0.0;
  double all = 0.0;
  for (int f = 0; f < t.faces.size(); ++f) {
    const auto n = t.faces.face(f);
    const double area = area_vector(t, f).norm();
    all += area;
    const bool in_lid =
        std::all_of(n.begin(), n.end(), [&](int node) { return std::abs(height(node)) < flat; });
    if (in_lid)
      taken += area;
    else
      open.faces.nodes.insert(open.faces.nodes.end(), n.begin(), n.end());
  }
  double low = 0.0;
  double high = 0.0;
  for (std::size_t n = 0; n < t.nodes.size(); ++n) {
    low = std::min(low, height(static_cast<int>(n)));
    high = std::max(high, height(static_cast<int>(n)));
  }
  if (!(taken > least_part * all) || std::min(-low, high) > beyond || open.faces.size() == 0)
    fail_surface(t, "is closed without a flat lid at the base, so that nothing shows the base",
                 "Cut the surface open across the valves, or close it there by a plane");
  return open;
}

/// "163 mm around at (1.2, 3.4, 5.6) mm, ..." of the longest openings.
std::string places_of(const Triangles& t, const std::vector<std::vector<Edge>>& openings) {
  constexpr std::size_t most = 4;
  std::vector<std::pair<double, Vec3>> found;
  for (const std::vector<Edge>& edges : openings) {
    double around = 0.0;
    Vec3 middle = Vec3::Zero();
    for (const auto& [a, b] : edges) {
      around += (t.nodes[b] - t.nodes[a]).norm();
      middle += 0.5 / static_cast<double>(edges.size()) * (t.nodes[a] + t.nodes[b]);
    }
    found.emplace_back(around, middle);
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> words;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i)
    words.push_back(fmt::format("{:.3g} mm around at ({:.1f}, {:.1f}, {:.1f}) mm", found[i].first,
                                found[i].second.x(), found[i].second.y(), found[i].second.z()));
  return fmt::format("{}{}", fmt::join(words, ", "), found.size() > most ? ", ..." : "");
}

/// A surface that is open at the base.
struct OpenSurface {
  Triangles triangles;
  std::vector<Vec3> rim;
  Vec3 middle;  ///< of the rim
  bool had_lid = false;
};

OpenSurface open_at_base(const Triangles& t) {
  OpenSurface open{t, {}, Vec3::Zero(), false};
  std::vector<Edge> edges = open_edges(t);
  if (edges.empty()) {
    open.triangles = without_lid(t);
    open.had_lid = true;
    edges = open_edges(open.triangles);
  }
  if (const auto openings = mesh::boundary_loops(open.triangles.faces); openings.size() != 1)
    fail_surface(t, fmt::format("has {} openings: {}", openings.size(), places_of(t, openings)),
                 "A surface may be open at the base alone: close the other holes");
  double length = 0.0;
  for (const Edge& e : edges) {
    const Vec3& a = open.triangles.nodes[e[0]];
    const Vec3& b = open.triangles.nodes[e[1]];
    open.middle += 0.5 * (b - a).norm() * (a + b);
    length += (b - a).norm();
    open.rim.push_back(a);
    open.rim.push_back(b);
  }
  open.middle /= length;
  return open;
}

/// The lowest of points along a direction.
double lowest_height(const std::vector<Vec3>& points, const Vec3& up) {
  double low = up.dot(points.front());
  for (const Vec3& x : points)
    low = std::min(low, up.dot(x));
  return low;
}

/// The nodes that triangles use, for those of a lid may be left.
std::vector<Vec3> used_nodes(const Triangles& t) {
  std::vector<Vec3> used;
  for (const int n : t.faces.nodes)
    used.push_back(t.nodes[n]);
  return used;
}

/// The closed loops in which a plane cuts triangles. A node in the plane counts as above it, so
/// that every triangle is cut in two edges or none.
std::vector<std::vector<Vec3>> loops_at(const Triangles& t, const CutPlane& plane) {
  const auto height = [&](int node) { return plane.normal.dot(t.nodes[node]) - plane.offset; };
  std::map<Edge, std::vector<Edge>> beside;
  for (int f = 0; f < t.faces.size(); ++f) {
    const auto n = t.faces.face(f);
    std::vector<Edge> cut;
    for (int i = 0; i < 3; ++i)
      if ((height(n[i]) >= 0.0) != (height(n[(i + 1) % 3]) >= 0.0))
        cut.push_back(edge_of(n[i], n[(i + 1) % 3]));
    if (cut.size() != 2 || cut[0] == cut[1])  // of no area
      continue;
    beside[cut[0]].push_back(cut[1]);
    beside[cut[1]].push_back(cut[0]);
  }
  const auto point = [&](const Edge& e) -> Vec3 {
    const double a = height(e[0]);
    return t.nodes[e[0]] + a / (a - height(e[1])) * (t.nodes[e[1]] - t.nodes[e[0]]);
  };
  std::vector<std::vector<Vec3>> loops;
  while (!beside.empty()) {
    std::vector<Vec3> loop;
    Edge at = beside.begin()->first;
    for (auto found = beside.find(at); found != beside.end(); found = beside.find(at)) {
      if (found->second.size() != 2)
        fail_surface(t,
                     fmt::format("has a hole, or sheets that touch, at ({:.4g}, {:.4g}, {:.4g}) mm",
                                 point(at).x(), point(at).y(), point(at).z()),
                     "Repair the surface in the program that made it");
      loop.push_back(point(at));
      const std::vector<Edge> next = found->second;
      beside.erase(found);
      at = beside.contains(next[0]) ? next[0] : next[1];
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

double area_of(const std::vector<Vec3>& loop) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t p = 0; p < loop.size(); ++p)
    sum += (loop[p] - loop[0]).cross(loop[(p + 1) % loop.size()] - loop[0]);
  return 0.5 * sum.norm();
}

/// So many points at equal distances along a loop.
std::vector<Vec3> evenly(const std::vector<Vec3>& loop, int count) {
  std::vector<double> at{0.0};
  for (std::size_t p = 0; p < loop.size(); ++p)
    at.push_back(at.back() + (loop[(p + 1) % loop.size()] - loop[p]).norm());
  std::vector<Vec3> points;
  std::size_t p = 0;
  for (int i = 0; i < count; ++i) {
    const double s = at.back() * i / count;
    while (at[p + 1] < s)
      ++p;
    const double length = at[p + 1] - at[p];
    const double u = length > 0.0 ? (s - at[p]) / length : 0.0;
    points.emplace_back((1.0 - u) * loop[p] + u * loop[(p + 1) % loop.size()]);
  }
  return points;
}

Contour loop_at(const Triangles& t, const CutPlane& plane, int slice, Side side) {
  constexpr double small_part = 0.2;
  constexpr int points = 60;
  auto loops = loops_at(t, plane);
  if (loops.empty())
    fail_surface(t, fmt::format("is not there {} slices below the base", slice - 1),
                 "Endocardium and epicardium must lie in the same place, in one unit and space");
  std::sort(loops.begin(), loops.end(),
            [](const auto& a, const auto& b) { return area_of(a) > area_of(b); });
  if (loops.size() > 1 && area_of(loops[1]) > small_part * area_of(loops[0]))
    fail_surface(t,
                 fmt::format("is cut into {} parts across the long axis, in slice {} from the base",
                             loops.size(), slice),
                 "Give the endocardium and the epicardium of the left ventricle alone, without "
                 "papillary muscles, atrium or aorta");
  return {slice, side, evenly(loops.front(), points), t.file, {}};
}

/// The point of a surface that is lowest along a direction.
Contour tip_of(const Triangles& t, const Vec3& up, int slice, Side side) {
  const auto used = used_nodes(t);
  const Vec3 tip = *std::min_element(used.begin(), used.end(), [&](const Vec3& a, const Vec3& b) {
    return up.dot(a) < up.dot(b);
  });
  return {slice, side, {tip}, t.file, {}};
}

void note_base(const OpenSurface& s, const Vec3& up, double base, std::vector<std::string>& notes) {
  double high = base;
  for (const Vec3& x : s.rim)
    high = std::max(high, up.dot(x));
  notes.push_back(
      fmt::format("{}: {}; up to {:.1f} mm of it lie above the base plane, which goes through the "
                  "lowest point of both rims, and are not used",
                  s.triangles.file,
                  s.had_lid ? "its flat lid is taken off" : "it is open at the base", high - base));
}

/// Whether a triangle runs from a to b.
bool runs(std::span<const int> triangle, int a, int b) {
  const auto from = std::find(triangle.begin(), triangle.end(), a) - triangle.begin();
  return from < 3 && triangle[(from + 1) % 3] == b;
}

/// The triangles, turned so that two run through the edge between them in opposite ways: not all
/// programs see to that.
mesh::Surface turned_alike(mesh::Surface faces) {
  std::map<Edge, std::vector<int>> beside;
  for (int f = 0; f < faces.size(); ++f)
    for (int i = 0; i < 3; ++i)
      beside[edge_of(faces.face(f)[i], faces.face(f)[(i + 1) % 3])].push_back(f);
  std::vector<bool> done(static_cast<std::size_t>(faces.size()), false);
  for (int first = 0; first < faces.size(); ++first) {
    std::vector<int> open;
    if (!done[first])
      open.push_back(first);
    done[first] = true;
    while (!open.empty()) {
      const int f = open.back();
      open.pop_back();
      const std::array<int, 3> n{faces.face(f)[0], faces.face(f)[1], faces.face(f)[2]};
      for (int i = 0; i < 3; ++i)
        for (const int other : beside.at(edge_of(n[i], n[(i + 1) % 3]))) {
          if (done[other])
            continue;
          if (runs(faces.face(other), n[i], n[(i + 1) % 3]))
            std::swap(faces.nodes[3 * static_cast<std::size_t>(other)],
                      faces.nodes[3 * static_cast<std::size_t>(other) + 1]);
          done[other] = true;
          open.push_back(other);
        }
    }
  }
  return faces;
}

/// The part of a triangle below a plane, as a polygon.
std::vector<Vec3> part_below(const std::array<Vec3, 3>& triangle, const CutPlane& plane) {
  std::vector<Vec3> part;
  for (int i = 0; i < 3; ++i) {
    const Vec3& a = triangle[i];
    const Vec3& b = triangle[(i + 1) % 3];
    const double height_a = plane.normal.dot(a) - plane.offset;
    const double height_b = plane.normal.dot(b) - plane.offset;
    if (height_a <= 0.0)
      part.push_back(a);
    if ((height_a <= 0.0) != (height_b <= 0.0))
      part.emplace_back(a + height_a / (height_a - height_b) * (b - a));
  }
  return part;
}

/// int (x - o).n dA / 3 over the part of a surface below a plane, o in the plane, which closes it
/// [mm^3].
double volume_below(const std::vector<Vec3>& nodes, const mesh::Surface& faces,
                    const CutPlane& plane) {
  const Vec3 o = plane.offset * plane.normal;
  double six_V = 0.0;
  for (int f = 0; f < faces.size(); ++f) {
    const auto n = faces.face(f);
    const std::vector<Vec3> part = part_below({nodes[n[0]], nodes[n[1]], nodes[n[2]]}, plane);
    for (std::size_t i = 2; i < part.size(); ++i)
      six_V += (part[0] - o).dot((part[i - 1] - o).cross(part[i] - o));
  }
  return std::abs(six_V) / 6.0;
}

/// Says how much of the cavity lies above the base plane, as a note or a warning. Throws InputError
/// where it is too much.
void tell_left_out(const OpenSurface& inner, const Triangles& lowest, const CutPlane& base,
                   CutSurfaces& cut) {
  constexpr double worth_a_warning = 0.05;
  constexpr double too_much = 1.0 / 3.0;
  const std::vector<Vec3>& nodes = inner.triangles.nodes;
  const mesh::Surface faces = turned_alike(inner.triangles.faces);
  const double whole = std::abs(mesh::signed_volume(nodes, faces, inner.middle));
  const double left_out = std::max(0.0, whole - volume_below(nodes, faces, base));
  const double share = left_out / whole;
  const std::string text = fmt::format(
      "the endocardium, closed at its rim, holds {:.1f} ml; {:.1f} ml of it ({:.0f}%) lie above "
      "the base plane, which goes across the long axis through the lowest point of both rims (that "
      "of {})",
      1e-3 * whole, 1e-3 * left_out, 100.0 * share, lowest.file);
  constexpr const char* remedy =
      "cut both surfaces open in one plane across the long axis, as high as there is muscle all "
      "round";
  if (share > too_much)
    fail_surface(inner.triangles, text + ": they would be left out",
                 fmt::format("The rims must lie at one height: {}", remedy));
  if (share > worth_a_warning)
    cut.warning = fmt::format("{}, and are left out: {}", text, remedy);
  else
    cut.notes.push_back(text);
}

}  // namespace

CutSurfaces cut_across(const Triangles& endo, const Triangles& epi) {
  constexpr double usual_step = 4.0;  // [mm]
  constexpr int fewest = 12;
  constexpr int most = 200;
  constexpr double below = 1e-3;  // of a step: the rim itself is no closed loop
  const OpenSurface inner = open_at_base(endo);
  const OpenSurface outer = open_at_base(epi);
  const auto used = used_nodes(inner.triangles);
  const Vec3 far = *std::max_element(used.begin(), used.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - inner.middle).norm() < (b - inner.middle).norm();
  });
  const Vec3 up = (inner.middle - far).normalized();
  const double inner_rim = lowest_height(inner.rim, up);
  const double outer_rim = lowest_height(outer.rim, up);
  const double base = std::min(inner_rim, outer_rim);
  const double tip = lowest_height(used, up);
  if (!(lowest_height(used_nodes(outer.triangles), up) < tip && tip < base))
    fail_surface(epi, "does not reach below the endocardium at the apex",
                 "Exchange anatomy.surfaces.endo and anatomy.surfaces.epi if this is the "
                 "endocardium; else give both surfaces of one ventricle, in one unit and space");
  const int count = std::clamp(static_cast<int>((base - tip) / usual_step), fewest, most);
  const double step = (base - tip) / count;
  CutSurfaces cut;
  tell_left_out(inner, inner_rim <= outer_rim ? endo : epi, {up, base}, cut);
  for (int s = 0; s < count; ++s) {
    const CutPlane plane{up, base - (s == 0 ? below : s) * step};
    for (const auto& [surface, side] : {std::pair(&inner, Side::endo), {&outer, Side::epi}})
      cut.contours.short_axis.push_back(loop_at(surface->triangles, plane, s + 1, side));
  }
  cut.contours.apex = {tip_of(inner.triangles, up, count + 1, Side::endo),
                       tip_of(outer.triangles, up, count + 1, Side::epi)};
  note_base(inner, up, base, cut.notes);
  note_base(outer, up, base, cut.notes);
  return cut;
}

}  // namespace lv::mesh_io
