#include "lv/cine/outlines.hpp"

#include "lv/base/bounds.hpp"
#include "lv/base/table.hpp"
#include "lv/drawing/overlay.hpp"
#include "lv/drawing/picture_files.hpp"
#include "lv/drawing/wall_surface.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/mesh/curved.hpp"
#include "lv/strain/measures.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

namespace lv::cine {
namespace {

namespace fs = std::filesystem;
using geometry::Contour;
using geometry::Side;

/// Index of the image of a view, of `count`, that is nearest to a phase of `images` in the cycle.
std::size_t nearest_image(int phase, int diastole, std::size_t images, std::size_t count) {
  const auto n = static_cast<int>(images);
  const int step = (phase - diastole + n) % n;
  const auto later = std::lround(static_cast<double>(step) * static_cast<double>(count) / n);
  return (static_cast<std::size_t>(diastole - 1) + static_cast<std::size_t>(later)) % count;
}

/// The model's two surfaces at one time, in image space, curved as its elements are.
struct Surfaces {
  std::vector<std::array<Vec3, 3>> endo, epi;
};

Surfaces surfaces(const mesh::CurvedMesh& curved, const std::optional<geometry::Frame>& frame,
                  const std::vector<Vec3>& positions) {
  if (!frame)
    return {};
  const std::vector<Vec3> nodes = curved.at_nodes(positions);
  const auto triangles = [&](const mesh::Surface& side) {
    const drawing::Patch patch = drawing::wall_surface(curved.mesh, nodes, side).patch;
    std::vector<std::array<Vec3, 3>> all;
    for (const auto& t : patch.triangles)
      all.push_back({frame->to_image(patch.points[t[0]]), frame->to_image(patch.points[t[1]]),
                     frame->to_image(patch.points[t[2]])});
    return all;
  };
  return {triangles(curved.mesh.endo), triangles(curved.mesh.epi)};
}

std::vector<Vec3> closed(std::vector<Vec3> loop) {
  loop.push_back(loop.front());
  return loop;
}

std::string title(const DrawnImage& image) {
  return fmt::format("{}{}, phase {}", image.closed ? "slice " : "", image.slice, image.phase);
}

/// A, S, I and L towards the walls of the model.
std::vector<drawing::EdgeLetter> edge_letters(const ModelledBeat& model) {
  std::vector<drawing::EdgeLetter> letters;
  if (!model.frame)
    return letters;
  for (const auto& [letter, direction] : model.orientation.walls())
    letters.push_back({letter, model.frame->axes * direction});
  return letters;
}

/// Draws one state's outlines over the images and measures their distance from contours.
class Outlines {
 public:
  explicit Outlines(const ModelledBeat& model)
      : is_laid_(model.frame.has_value()),
        letters_(edge_letters(model)),
        points_({"state", "slice", "source", "contour", "line", "point", "x_mm", "y_mm", "z_mm"}),
        distances_({"state", "slice", "contour", "points", "mean_mm", "rms_mm", "largest_mm"}) {}

  void add(const std::string& state, const Surfaces& model, const std::vector<DrawnImage>& images,
           const fs::path& picture) {
    std::vector<drawing::Overlay> overlays;
    for (const DrawnImage& image : images) {
      overlays.push_back({title(image), image.picture, lines_over(state, model, image), letters_});
      std::vector<Vec3> around;
      for (const drawing::OverlayLine& line : overlays.back().lines)
        around.insert(around.end(), line.points.begin(), line.points.end());
      pictures_.push_back(
          {state, image.slice, image.phase, drawing::cut_around(*image.picture, around)});
    }
    drawing::write_overlays(overlays,
                            is_laid_ ? "Outlines of the model (solid) and contours drawn (dashed)"
                                     : "Contours drawn (dashed); the model does not lie in the "
                                       "space of these images",
                            picture);
  }

  void write(const fs::path& folder) const {
    points_.write_csv(folder / "outlines.csv");
    distances_.write_csv(folder / "outline_distances.csv");
    drawing::write_pictures(pictures_, folder / "pictures");
  }

  [[nodiscard]] std::string words(const std::string& state) const {
    const auto found = means_.find(state);
    if (found == means_.end())
      return "";
    double sum = 0.0;
    for (const double mean : found->second)
      sum += mean;
    return fmt::format("outlines of the model lie {:.1f} mm from the contours at {} in the mean\n",
                       sum / static_cast<double>(found->second.size()), state);
  }

 private:
  /// The lines of the model and of the contours on an image, which are written down as well.
  std::vector<drawing::OverlayLine> lines_over(const std::string& state, const Surfaces& model,
                                               const DrawnImage& image) {
    const image::Plane& plane = image.picture->plane;
    std::vector<drawing::OverlayLine> over;
    for (const Side side : {Side::endo, Side::epi}) {
      const auto lines =
          strain::cut(side == Side::endo ? model.endo : model.epi, plane.origin, plane.normal());
      for (const auto& line : lines)
        over.push_back({line, drawing::hex(0xe69f00), false, false});
      write(state, image.slice, "model", side, lines);
      const Contour* contour = side == Side::endo ? image.endo : image.epi;
      if (contour == nullptr)
        continue;
      over.push_back({contour->points, drawing::hex(0x56b4e9), image.closed, true});
      write(state, image.slice, "contours", side,
            {image.closed ? closed(contour->points) : contour->points});
      if (is_laid_)
        measure(state, image.slice, *contour, lines);
    }
    return over;
  }

  void write(const std::string& state, const std::string& slice, const std::string& source,
             Side side, const std::vector<std::vector<Vec3>>& lines) {
    const auto coordinate = [](double x) { return fmt::format("{:.3f}", x); };
    for (std::size_t n = 0; n < lines.size(); ++n)
      for (std::size_t i = 0; i < lines[n].size(); ++i)
        points_.add_row({state, slice, source, name(side), std::to_string(n + 1),
                         std::to_string(i + 1), coordinate(lines[n][i].x()),
                         coordinate(lines[n][i].y()), coordinate(lines[n][i].z())});
  }

  void measure(const std::string& state, const std::string& slice, const Contour& contour,
               const std::vector<std::vector<Vec3>>& lines) {
    const strain::Distance d = strain::distance(contour.points, lines, false);
    distances_.add_row({state, slice, name(contour.side), std::to_string(contour.points.size()),
                        Table::number(d.mean, 4), Table::number(d.rms, 4),
                        Table::number(d.largest, 4)});
    if (std::isfinite(d.mean))
      means_[state].push_back(d.mean);
  }

  bool is_laid_;
  std::vector<drawing::EdgeLetter> letters_;
  Table points_, distances_;
  std::vector<drawing::PictureFile> pictures_;
  std::map<std::string, std::vector<double>> means_;
};

}  // namespace

std::vector<DrawnImage> images_at(const CineStudy& study, int phase, int diastole) {
  const bool diastolic = phase == diastole;
  const std::vector<Contour>& drawn = diastolic ? study.drawn.short_axis : study.systolic;
  const auto& loops = study.drawn.short_axis;
  std::vector<DrawnImage> images;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const int slice = loops[l].slice;
    if (loops[l].side == Side::endo)
      images.push_back({std::to_string(slice), phase,
                        &study.cine.slices[study.slice_of[l]].frames.at(phase - 1), true,
                        geometry::find(drawn, slice, Side::endo),
                        geometry::find(drawn, slice, Side::epi)});
  }
  const std::size_t count = study.cine.slices[study.slice_of.front()].frames.size();
  for (std::size_t v = 0; v < study.long_axis.size(); ++v) {
    const LongAxisView& view = study.long_axis[v];
    const auto& frames = view.cine.slices.front().frames;
    const std::size_t k = nearest_image(phase, diastole, count, frames.size());
    images.push_back({fmt::format("long axis {}", v + 1), static_cast<int>(k) + 1, &frames[k],
                      false, diastolic ? &view.endo : nullptr, diastolic ? &view.epi : nullptr});
  }
  return images;
}

bool lies_in_images(const ModelledBeat& model, const CineStudy& study) {
  if (!model.frame)
    return false;
  const auto box = bounds(model.beat.at(heartbeat::end_diastole).positions);
  const double radius = box.sizes().head<2>().maxCoeff();
  int loops = 0;
  int inside = 0;
  for (const Contour& loop : study.drawn.short_axis) {
    if (loop.side != Side::endo)
      continue;
    const Vec3 x = model.frame->to_model(geometry::mean_of(loop.points));
    ++loops;
    inside += x.z() > box.min().z() && x.z() < box.max().z() + study.spacing &&
                      std::hypot(x.x(), x.y()) < 0.5 * radius
                  ? 1
                  : 0;
  }
  return 2 * inside > loops;
}

std::string write_outlines(const ModelledBeat& model, const CineStudy& study, int diastole,
                           int systole, const fs::path& folder) {
  const mesh::CurvedMesh curved = mesh::curved(model.mesh.mesh);
  const auto surfaces_at = [&](const char* moment) {
    return surfaces(curved, model.frame, model.beat.at(moment).positions);
  };
  Outlines outlines(model);
  outlines.add(heartbeat::end_diastole, surfaces_at(heartbeat::end_diastole),
               images_at(study, diastole, diastole), folder / "outlines_ed.png");
  outlines.add(heartbeat::end_systole, surfaces_at(heartbeat::end_systole),
               images_at(study, systole, diastole), folder / "outlines_es.png");
  outlines.write(folder);
  return outlines.words(heartbeat::end_diastole) + outlines.words(heartbeat::end_systole);
}

}  // namespace lv::cine
