#include "lv/draw/said.hpp"

#include "lv/base/printable.hpp"

#include <fmt/format.h>

#include <cmath>

namespace lv::draw {

using geometry::Contour;
using geometry::Side;
using nlohmann::json;

json plane_json(const image::CineSlice& slice) {
  const image::Plane& plane = slice.frames.front().plane;
  const auto exact = [](const Vec3& x) { return json{x.x(), x.y(), x.z()}; };
  return {{"columns", plane.columns},
          {"rows", plane.rows},
          {"origin", exact(plane.origin)},
          {"along_row", exact(plane.along_row)},
          {"along_column", exact(plane.along_column)},
          {"spacing", {plane.spacing_i, plane.spacing_j}}};
}

json planes_json(const image::Cine& cine) {
  json all = json::array();
  for (const image::CineSlice& slice : cine.slices)
    all.push_back(plane_json(slice));
  return all;
}

Vec3 said_point(const json& x) {
  if (!x.is_array() || x.size() != 3)
    throw InputError(what_page, "a point has not three coordinates", reload);
  Vec3 p(x[0].get<double>(), x[1].get<double>(), x[2].get<double>());
  if (!p.allFinite())
    throw InputError(what_page, "a coordinate is no number", reload);
  return p;
}

int said_number(const json& object, const char* name, std::size_t most) {
  const int n = object.at(name).get<int>();
  if (n < 1 || n > static_cast<int>(most))
    throw InputError(what_page, fmt::format("there is no {} {}", name, n), reload);
  return n;
}

std::string said_word(const json& object, const char* name) {
  constexpr std::size_t longest = 60;
  return printable(object.at(name).get<std::string>()).substr(0, longest);
}

geometry::Provenance said_provenance(const json& object) {
  const std::string how = object.at("how").get<std::string>();
  if (how != "proposed" && how != "corrected" && how != "drawn")
    throw InputError(what_page, "a line does not say how it was drawn", reload);
  return {how, said_word(object, "by"), said_word(object, "when")};
}

Side said_side(const json& object) {
  const std::string side = object.at("side").get<std::string>();
  if (side != "endo" && side != "epi")
    throw InputError(what_page, "a line is neither endo nor epi", reload);
  return side == "endo" ? Side::endo : Side::epi;
}

void check_on_slice(const Vec3& x, int number, const Study& study) {
  constexpr double farthest = 1.0;  // [mm]
  const image::Plane& plane = study.picture(number).frames.front().plane;
  const Vec3 pixel = plane.pixel(x);
  if (std::abs(pixel.z()) > farthest || pixel.x() < -plane.columns ||
      pixel.x() > 2 * plane.columns || pixel.y() < -plane.rows || pixel.y() > 2 * plane.rows)
    throw InputError(what_page, fmt::format("a point lies off slice {}", number), reload);
}

std::vector<Vec3> said_points(const json& all, int slice, const Study& study, std::size_t fewest,
                              std::size_t most) {
  if (all.size() < fewest || all.size() > most)
    throw InputError(what_page, fmt::format("a line of slice {} has {} points", slice, all.size()),
                     reload);
  std::vector<Vec3> points;
  for (const json& x : all) {
    points.push_back(said_point(x));
    check_on_slice(points.back(), slice, study);
  }
  return points;
}

Contour said_line(const json& object, const Study& study) {
  Contour line;
  line.slice = said_number(object, "slice", study.cine.slices.size());
  line.side = said_side(object);
  line.drawn = said_provenance(object);
  line.points = said_points(object.at("points"), line.slice, study, fewest_of_line, most_of_line);
  return line;
}

}  // namespace lv::draw
