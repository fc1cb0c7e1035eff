#include "lv/anatomy/named_points.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/landmarks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::anatomy {
namespace {

using geometry::Landmark;
using geometry::Side;

std::vector<Landmark> landmarks_of(const case_file::Case& c) {
  const std::string& file = c.anatomy.contours.landmarks;
  return file.empty() ? std::vector<Landmark>{}
                      : geometry::read_landmarks(case_file::beside(c, file));
}

void add_tip(const case_file::Case& c, const std::vector<Landmark>& landmarks, Side side,
             geometry::Contours& contours) {
  const std::string name = fmt::format("apex_{}", geometry::name(side));
  const Landmark* tip = geometry::find(landmarks, name);
  if (tip == nullptr)
    return;
  if (std::any_of(contours.apex.begin(), contours.apex.end(),
                  [&](const geometry::Contour& other) { return other.side == side; }))
    throw InputError(
        case_file::place_of(c, "anatomy.contours.landmarks"),
        fmt::format("{} is named there and shown by another file too", name),
        fmt::format("Leave anatomy.contours.{0} out, or {0} out of the landmarks", name));
  contours.apex.push_back({tip->slice, side, {tip->at}, "the landmarks", {}});
}

}  // namespace

std::optional<Vec3> named_septum(const case_file::Case& c, const geometry::Contours& contours,
                                 std::vector<std::string>& notes) {
  const std::vector<Landmark> landmarks = landmarks_of(c);
  const auto septum = geometry::septum_of(landmarks, contours,
                                          case_file::place_of(c, "anatomy.contours.landmarks"));
  if (!septum)
    return std::nullopt;
  if (septum->mirrored)
    notes.emplace_back(
        "the insertions of the septum seem to be exchanged: seen from the base the anterior one "
        "should follow the inferior one anticlockwise; or the images are mirrored");
  return septum->middle;
}

void add_landmarks(const case_file::Case& c, Drawn& drawn) {
  const std::vector<Landmark> landmarks = landmarks_of(c);
  if (landmarks.empty())
    return;
  if (const auto septum = named_septum(c, drawn.contours, drawn.notes))
    drawn.septum = {septum->x(), septum->y(), septum->z()};
  for (const Side side : {Side::endo, Side::epi})
    add_tip(c, landmarks, side, drawn.contours);
  std::vector<Vec3> annulus;
  for (const Landmark& mark : landmarks)
    if (mark.name.starts_with("annulus"))
      annulus.push_back(mark.at);
  if (!annulus.empty()) {
    drawn.contours.annulus = std::move(annulus);
    drawn.usual_base = geometry::BaseAt::annulus;
  }
}

}  // namespace lv::anatomy
