#include "lv/strain/reslice.hpp"

#include "lv/base/check.hpp"
#include "lv/strain/grey_image.hpp"

#include <algorithm>
#include <utility>

namespace lv::strain {
namespace {

/// A stack's slices in order of height above one of them.
class Heights {
 public:
  Heights(const std::vector<image::CineSlice>& stack, std::size_t slice) {
    const image::Plane& plane = stack[slice].frames.front().plane;
    for (std::size_t s = 0; s < stack.size(); ++s)
      order_.emplace_back(plane.pixel(stack[s].frames.front().plane.origin).z(), s);
    std::sort(order_.begin(), order_.end());
  }

  [[nodiscard]] double lowest() const { return order_.front().first; }
  [[nodiscard]] double highest() const { return order_.back().first; }

  /// Slices and their weights at a height: Lagrange's polynomials.
  void weights_at(double z, std::vector<std::pair<std::size_t, double>>& weights) const {
    const double at = std::clamp(z, lowest(), highest());
    const auto above = std::upper_bound(order_.begin() + 1, order_.end() - 1, at,
                                        [](double a, const auto& b) { return a < b.first; });
    const bool inside = above - order_.begin() >= 2 && order_.end() - above >= 2;
    const auto first = above - (inside ? 2 : 1);
    const auto last = above + (inside ? 2 : 1);
    weights.clear();
    for (auto i = first; i < last; ++i) {
      double weight = 1.0;
      for (auto j = first; j < last; ++j)
        if (j != i)
          weight *= (at - j->first) / (i->first - j->first);
      weights.emplace_back(i->second, weight);
    }
  }

 private:
  std::vector<std::pair<double, std::size_t>> order_;
};

}  // namespace

image::Picture moved(const image::Picture& picture, const Vec3& shift) {
  const image::Plane& p = picture.plane;
  const GreyImage::Pointer image = cropped(picture, {0, 0, p.columns, p.rows});
  const Interpolator::Pointer values = interpolated(image, 0.0);
  const double across = shift.dot(p.along_row);
  const double down = shift.dot(p.along_column);
  image::Picture result{p, {}};
  result.values.reserve(picture.values.size());
  for (int j = 0; j < p.rows; ++j)
    for (int i = 0; i < p.columns; ++i) {
      itk::Point<double, 2> x;
      x[0] = std::clamp(i * p.spacing_i - across, 0.0, (p.columns - 1) * p.spacing_i);
      x[1] = std::clamp(j * p.spacing_j - down, 0.0, (p.rows - 1) * p.spacing_j);
      result.values.push_back(static_cast<float>(values->Evaluate(x)));
    }
  return result;
}

MuscleSlice follow_muscle(const std::vector<image::CineSlice>& stack, std::size_t slice, int drawn,
                          const NormalMotion& u) {
  LV_CHECK(stack.size() >= 2);
  const Heights heights(stack, slice);
  MuscleSlice result{stack[slice], 0.0};
  const image::Plane& plane = stack[slice].frames.front().plane;
  const auto images = static_cast<int>(stack[slice].frames.size());
  std::vector<std::pair<std::size_t, double>> weights;
  for (int step = 1; step < images; ++step) {
    const int k = (drawn + step) % images;
    const double middle = u(plane.middle(), step);
    result.beyond =
        std::max({result.beyond, middle - heights.highest(), heights.lowest() - middle});
    auto value = result.images.frames[k].values.begin();
    for (int j = 0; j < plane.rows; ++j)
      for (int i = 0; i < plane.columns; ++i) {
        heights.weights_at(u(plane.point(i, j), step), weights);
        double sum = 0.0;
        for (const auto& [s, weight] : weights)
          sum += weight * stack[s].frames[k].at(i, j);
        *value++ = static_cast<float>(sum);
      }
  }
  return result;
}

}  // namespace lv::strain
