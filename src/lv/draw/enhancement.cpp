#include "lv/draw/enhancement.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/geometry/contour_table.hpp"
#include "lv/scar/late_enhancement.hpp"
#include "lv/scar/scar_threshold.hpp"
#include "lv/scar/slice_moves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lv::draw {
namespace {

namespace fs = std::filesystem;
using geometry::Contour;
using geometry::Side;
using scar::ScarMap;
using scar::Tissue;
using scar::WallOutlines;

const image::Plane& plane_of(const image::Cine& image, std::size_t slice) {
  return image.slices[slice].frames.front().plane;
}

std::vector<Vec3> in_space(const geometry::Polygon& line, const image::Plane& plane) {
  std::vector<Vec3> points;
  for (const Eigen::Vector2d& x : line)
    points.emplace_back(plane.origin + x.x() * plane.along_row + x.y() * plane.along_column);
  return points;
}

void write_walls(const Walls& walls, const image::Cine& image, const fs::path& file) {
  std::vector<Contour> lines;
  for (std::size_t s = 0; s < walls.size(); ++s)
    if (walls[s])
      for (const auto& [side, line] :
           {std::pair{Side::endo, &walls[s]->endo}, std::pair{Side::epi, &walls[s]->epi}})
        if (!line->empty())
          lines.push_back(
              {static_cast<int>(s) + 1, side, in_space(*line, plane_of(image, s)), {}, {}, {}});
  if (lines.empty())
    write_file(file, "");  // none: see whole_save
  else
    geometry::contour_table(lines).write_csv(file);
}

Walls read_walls(const fs::path& file, const image::Cine& image) {
  Walls walls(image.slices.size());
  if (!fs::exists(file))
    return walls;
  for (const Contour& line : geometry::read_curves(file)) {
    if (line.slice < 1 || line.slice > static_cast<int>(walls.size()))
      throw InputError(line.where(), fmt::format("the image has no slice {}", line.slice),
                       "It belongs to another image: move its folder away");
    const auto s = static_cast<std::size_t>(line.slice - 1);
    WallOutlines& wall = walls[s] ? *walls[s] : walls[s].emplace();
    (line.side == Side::endo ? wall.endo : wall.epi) =
        scar::in_plane(line.points, plane_of(image, s));
  }
  for (auto& wall : walls)
    if (wall && wall->epi.empty())
      wall.reset();
  return walls;
}

/// All grey values of the walls, and which of them are remote.
struct InWalls {
  scar::WallGreys greys;
  std::vector<char> remote;
};

InWalls greys_in(const image::Cine& image, const std::vector<std::vector<char>>& parts,
                 const std::vector<std::vector<char>>& remote) {
  InWalls all;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    const image::Picture& picture = image.slices[s].frames.front();
    for (std::size_t n = 0; n < parts[s].size(); ++n)
      if (parts[s][n] == 1) {
        all.greys.greys.push_back(picture.values[n]);
        all.greys.volumes.push_back(picture.plane.spacing_i * picture.plane.spacing_j);
        all.remote.push_back(remote.empty() ? char{0} : remote[s][n]);
      }
  }
  return all;
}

double threshold_of(const case_file::Case& c, const image::Cine& image, const ScarWish& wish,
                    const InWalls& all) {
  if (all.greys.greys.empty())
    throw InputError("the enhanced slices", "no borders show where the wall is on them",
                     "Draw both borders on the cine, of the phase that is chosen");
  if (wish.rule == ScarRule::level)
    return wish.level;
  if (wish.rule == ScarRule::brightest)
    return scar::half_of_brightest(c, image, all.greys.greys);
  const auto found = scar::above_remote(all.greys, all.remote, wish.deviations);
  if (!found)
    throw InputError("the enhanced slices", "no remote muscle is shown",
                     "Paint healthy muscle as remote, or take half of the brightest");
  return *found;
}

ScarMap empty_map(const image::Cine& image) {
  ScarMap map;
  for (const image::CineSlice& slice : image.slices)
    map.slices.push_back({std::vector<Tissue>(slice.frames.front().values.size(), Tissue::outside),
                          {"proposed", "", ""}});
  return map;
}

/// The muscle alone, where no threshold can be taken.
ScarMap wall_alone(const image::Cine& image, const Walls& walls) {
  ScarMap map = empty_map(image);
  for (std::size_t s = 0; s < walls.size(); ++s) {
    const std::vector<char> parts = scar::parts_of(plane_of(image, s), walls[s]);
    for (std::size_t n = 0; n < parts.size(); ++n)
      if (parts[n] == 1)
        map.slices[s].pixels[n] = Tissue::muscle;
  }
  map.threshold = grey_range(image.slices).high;
  return map;
}

/// No folder and no file in words for the page.
std::string without_names(const case_file::Case& c, std::string words) {
  const std::string& name = c.scar.lge.image;
  for (std::size_t at = 0; !name.empty() && (at = words.find(name)) != std::string::npos;)
    words.replace(at, name.size(), "the image");
  return words;
}

void propose_scar_first(const case_file::Case& c, Enhancement& e) {
  const bool by_remote = c.scar.lge.threshold == mesh::ScarThreshold::sd;
  try {
    if (by_remote)
      throw InputError("remote muscle", "is not shown on the slices yet",
                       "Paint it, and the threshold follows from it");
    ScarWish wish;
    wish.walls = e.scar.walls;
    e.scar.proposed = propose_scar(c, e.image, wish);
  } catch (const InputError& error) {
    e.scar.proposed = wall_alone(e.image, e.scar.walls);
    e.note = without_names(c, error.what());
  }
}

}  // namespace

std::optional<Enhancement> open_enhancement(const case_file::Case& c, const fs::path& folder,
                                            int phase, const std::vector<Contour>& lines) {
  if (c.scar.source != mesh::InfarctSource::lge || c.scar.lge.image.empty())
    return std::nullopt;
  Enhancement e;
  e.image = scar::read_late_enhancement(c);
  e.greys = grey_range(e.image.slices);
  e.saved = fs::exists(folder / scar_file);
  if (e.saved) {
    e.scar = {read_walls(folder / scar_walls_file, e.image),
              scar::read_scar_map(folder / proposed_scar_file, e.image),
              scar::read_scar_map(folder / scar_file, e.image)};
    return e;
  }
  e.scar.walls = walls_on(c, e.image, lines);
  propose_scar_first(c, e);
  e.scar.proposed.phase = phase;
  e.scar.drawn = e.scar.proposed;
  return e;
}

Walls walls_on(const case_file::Case& c, const image::Cine& image,
               const std::vector<Contour>& lines) {
  std::vector<Contour> shifted = lines;
  for (Contour& line : shifted)
    for (Vec3& x : line.points)
      x -= Vec3(c.scar.shift[0], c.scar.shift[1], c.scar.shift[2]);
  const scar::Triangles endo = scar::surface_through(shifted, Side::endo);
  const scar::Triangles epi = scar::surface_through(shifted, Side::epi);
  Walls walls(image.slices.size());
  if (epi.empty())
    return walls;
  std::vector<scar::SliceMove> moves(walls.size());
  if (c.scar.lge.in_plane)
    moves = scar::register_slices(image, endo, epi, c.scar.lge.largest_shift);
  for (std::size_t s = 0; s < walls.size(); ++s) {
    image::Plane plane = plane_of(image, s);
    // not through the corners of lines that lie on the same plane but for their last digits
    plane.origin += moves[s].move + 0.02 * plane.normal();
    walls[s] = scar::wall_outlines(endo, epi, plane);
    if (walls[s])
      for (geometry::Polygon* line : {&walls[s]->endo, &walls[s]->epi})
        if (!line->empty())
          line->pop_back();  // the first point again
  }
  return walls;
}

ScarMap propose_scar(const case_file::Case& c, const image::Cine& image, const ScarWish& wish) {
  std::vector<std::vector<char>> parts;
  for (std::size_t s = 0; s < wish.walls.size(); ++s)
    parts.push_back(scar::parts_of(plane_of(image, s), wish.walls[s]));
  ScarMap map = empty_map(image);
  map.threshold = threshold_of(c, image, wish, greys_in(image, parts, wish.remote));
  for (std::size_t s = 0; s < parts.size(); ++s) {
    const std::vector<char> bright = scar::brighter(image.slices[s].frames.front(), parts[s],
                                                    map.threshold, c.scar.lge.fill_no_reflow);
    for (std::size_t n = 0; n < bright.size(); ++n)
      if (parts[s][n] == 1)
        map.slices[s].pixels[n] = bright[n] != 0 ? Tissue::scar : Tissue::muscle;
  }
  return map;
}

void write_scar(const Enhancement& enhancement, const ScarDrawing& scar, const fs::path& folder) {
  table_of(scar.proposed, enhancement.image).write_csv(folder / proposed_scar_file);
  write_walls(scar.walls, enhancement.image, folder / scar_walls_file);
  table_of(scar.drawn, enhancement.image).write_csv(folder / scar_file);
}

void keep(Enhancement& enhancement, ScarDrawing scar) {
  enhancement.scar = std::move(scar);
  enhancement.saved = true;
  enhancement.note.clear();
}

}  // namespace lv::draw
