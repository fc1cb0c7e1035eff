#include "lv/scar/slice_moves.hpp"

#include "lv/base/log.hpp"
#include "lv/base/time_left.hpp"
#include "lv/image/lookup.hpp"
#include "lv/image/slice_registration.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace lv::scar {
namespace {

/// The wall's outlines through the slab of a slice, from `below` to `above` its plane.
std::vector<WallOutlines> outlines_in_slab(const Triangles& endo, const Triangles& epi,
                                           const image::Plane& plane, double below, double above) {
  constexpr int levels = 6;
  std::vector<WallOutlines> all;
  for (int k = 0; k < levels; ++k) {
    image::Plane level = plane;
    level.origin += (-below + (k + 0.5) / levels * (below + above)) * plane.normal();
    if (const auto found = wall_outlines(endo, epi, level))
      all.push_back(*found);
  }
  return all;
}

/// What the wall says of a slice, up to 10 mm around it, on points half a pixel apart.
image::SliceTissue tissue_of(const std::vector<WallOutlines>& slab, const image::Plane& plane) {
  constexpr double around = 10.0;  // [mm]
  Eigen::AlignedBox2d box;
  for (const WallOutlines& level : slab)
    for (const Eigen::Vector2d& x : level.epi)
      box.extend(x);
  const Eigen::Vector2d step(0.5 * plane.spacing_i, 0.5 * plane.spacing_j);
  const Eigen::Vector2d first = box.min().array() - around;
  const Eigen::Vector2d last = box.max().array() + around;
  image::SliceTissue tissue{{}, step.prod()};
  for (double y = first.y(); y <= last.y(); y += step.y())
    for (double x = first.x(); x <= last.x(); x += step.x()) {
      image::SliceTissue::Point point{plane.origin + x * plane.along_row + y * plane.along_column,
                                      {}};
      for (const WallOutlines& level : slab)
        point.parts[part_at(level, {x, y})] += 1.0 / static_cast<double>(slab.size());
      tissue.points.push_back(point);
    }
  return tissue;
}

/// From the plane of a slice to the ends of its slab, half way to its neighbours [mm].
struct Slab {
  double below, above;
};

Slab slab_of(const image::Cine& stack, std::size_t s) {
  constexpr double alone = 5.0;
  const auto height = [&](std::size_t k) {
    const Vec3 d =
        stack.slices[k].frames.front().plane.origin - stack.slices[s].frames.front().plane.origin;
    return d.dot(stack.slices[s].frames.front().plane.normal());
  };
  Slab slab{0.0, 0.0};
  for (const std::size_t k : {s - 1, s + 1})  // s - 1 of the first is no slice
    if (k < stack.slices.size()) {
      const double half = 0.5 * height(k);
      (half < 0.0 ? slab.below : slab.above) = std::abs(half);
    }
  if (slab.below == 0.0)
    slab.below = slab.above;
  if (slab.above == 0.0)
    slab.above = slab.below;
  return slab.above > 0.0 ? slab : Slab{alone, alone};
}

SliceMove move_of(const image::Picture& picture, const std::vector<WallOutlines>& slab,
                  double largest) {
  const double clear = std::min(3.0, 0.5 * largest);  // doubt [mm]
  constexpr double at_limit = 0.25;                   // [mm]
  if (slab.empty())
    return {Vec3::Zero(), 0.0, Evidence::no_wall};
  const image::SliceTissue tissue = tissue_of(slab, picture.plane);
  const image::Registration found = image::register_slice(picture, tissue, largest);
  if (found.doubt > clear)
    return {Vec3::Zero(), found.doubt, Evidence::weak};
  if (found.move.norm() > largest - at_limit)
    return {Vec3::Zero(), found.doubt, Evidence::at_limit};
  return {found.move, found.doubt, Evidence::clear};
}

/// A sum of places by their weights.
struct Balance {
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  double weight = 0.0;

  void add(const Eigen::Vector2d& x, double w) {
    moment += w * x;
    weight += w;
  }
};

/// Adds sign times the area that a line encloses.
void add_area(const geometry::Polygon& line, double sign, Balance& balance) {
  double signed_area = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Eigen::Vector2d& a = line[k];
    const Eigen::Vector2d& b = line[(k + 1) % line.size()];
    const double twice = a.x() * b.y() - a.y() * b.x();
    signed_area += 0.5 * twice;
    moment += twice / 6.0 * (a + b);
  }
  const double turn = signed_area < 0.0 ? -sign : sign;
  balance.moment += turn * moment;
  balance.weight += turn * signed_area;
}

Balance section_of(const WallOutlines& lines) {
  Balance wall;
  add_area(lines.epi, 1.0, wall);
  add_area(lines.endo, -1.0, wall);
  return wall;
}

Balance pixels_of(const image::Picture& picture, const std::vector<int>& labels) {
  const image::Plane& plane = picture.plane;
  Balance pixels;
  for (int j = 0; j < plane.rows; ++j)
    for (int i = 0; i < plane.columns; ++i)
      if (image::is_one_of(picture.at(i, j), labels))
        pixels.add({i * plane.spacing_i, j * plane.spacing_j}, 1.0);
  return pixels;
}

}  // namespace

const char* name(Evidence evidence) {
  switch (evidence) {
    case Evidence::clear:
      return "clear";
    case Evidence::weak:
      return "weak";
    case Evidence::at_limit:
      return "at_limit";
    default:
      return "no_wall";
  }
}

std::vector<SliceMove> register_slices(const image::Cine& stack, const Triangles& endo,
                                       const Triangles& epi, double largest) {
  std::vector<SliceMove> moves;
  Progress progress("moving slices onto the wall", stack.slices.size());
  for (std::size_t s = 0; s < stack.slices.size(); ++s) {
    const image::Picture& picture = stack.slices[s].frames.front();
    const Slab slab = slab_of(stack, s);
    moves.push_back(move_of(
        picture, outlines_in_slab(endo, epi, picture.plane, slab.below, slab.above), largest));
    progress.add();
  }
  return moves;
}

std::vector<Vec3> moves_of_labels(const image::Cine& stack, const std::vector<int>& labels,
                                  const Triangles& endo, const Triangles& epi) {
  std::vector<Vec3> moves(stack.slices.size(), Vec3::Zero());
  for (std::size_t s = 0; s < stack.slices.size(); ++s) {
    const image::Picture& picture = stack.slices[s].frames.front();
    const auto lines = wall_outlines(endo, epi, picture.plane);
    const Balance shown = pixels_of(picture, labels);
    if (!lines || shown.weight == 0.0)
      continue;
    const Balance wall = section_of(*lines);
    const Eigen::Vector2d move = wall.moment / wall.weight - shown.moment / shown.weight;
    moves[s] = move.x() * picture.plane.along_row + move.y() * picture.plane.along_column;
  }
  return moves;
}

void report_moves(const image::Cine& image, const std::vector<SliceMove>& moves) {
  for (std::size_t s = 0; s < moves.size(); ++s) {
    const std::string slice = "late enhancement, " + image.slices[s].name;
    const SliceMove& m = moves[s];
    if (m.evidence == Evidence::clear)
      log::info("{}: moved by {:.1f} mm", slice, m.move.norm());
    else if (m.evidence == Evidence::no_wall)
      log::info("{}: shows no ring of the wall and stays", slice);
    else if (m.evidence == Evidence::weak)
      log::warn("{} stays where it is: a move {:.0f} mm from the best fits it as well", slice,
                m.doubt);
    else
      log::warn("{} stays where it is: its best move is as long as infarct.lge.largest_shift",
                slice);
  }
}

Table table_of(const image::Cine& image, const std::vector<SliceMove>& moves) {
  Table table({"slice", "x_mm", "y_mm", "z_mm", "move_mm", "doubt_mm", "evidence"});
  for (std::size_t s = 0; s < moves.size(); ++s) {
    const SliceMove& m = moves[s];
    table.add_row({image.slices[s].name, Table::number(m.move.x(), 4), Table::number(m.move.y(), 4),
                   Table::number(m.move.z(), 4), Table::number(m.move.norm(), 4),
                   Table::number(m.doubt, 4), name(m.evidence)});
  }
  return table;
}

}  // namespace lv::scar
