#include "lv/image/slice_registration.hpp"

#include "lv/image/lookup.hpp"

#include <algorithm>
#include <cmath>

namespace lv::image {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr int tissues = 3;
constexpr int bins = 16;
using Histogram = std::array<std::array<double, bins>, tissues>;

/// Mutual information of rows and columns [nats]; 0 without entries.
double mutual_information(const Histogram& joint) {
  std::array<double, bins> grey{};
  std::array<double, tissues> tissue{};
  double all = 0.0;
  for (int L = 0; L < tissues; ++L)
    for (int g = 0; g < bins; ++g) {
      grey[g] += joint[L][g];
      tissue[L] += joint[L][g];
      all += joint[L][g];
    }
  double sum = 0.0;
  for (int L = 0; L < tissues; ++L)
    for (int g = 0; g < bins; ++g)
      if (joint[L][g] > 0.0)
        sum += joint[L][g] / all * std::log(joint[L][g] * all / (tissue[L] * grey[g]));
  return sum;
}

/// How well a picture, moved in its plane, shows the tissue.
class Match {
 public:
  Match(const Picture& picture, const SliceTissue& tissue) : picture_(picture), tissue_(tissue) {
    std::vector<double> greys;
    for (const SliceTissue::Point& point : tissue.points)
      if (const double grey = sample(picture, point.x); !std::isnan(grey))
        greys.push_back(grey);
    if (greys.empty())
      return;
    std::sort(greys.begin(), greys.end());
    // a few very bright pixels (fat) would leave one bin to all others
    const std::size_t hundredth = greys.size() / 100;
    darkest_ = greys[hundredth];
    const double brightest = greys[greys.size() - 1 - hundredth];
    const double rounding = 1e-6 * std::max(std::abs(brightest), 1e-6);
    width_ = std::max((brightest - darkest_) / (bins - 1), rounding);
  }

  [[nodiscard]] Vec3 in_space(const Vec2& move) const {
    return move.x() * picture_.plane.along_row + move.y() * picture_.plane.along_column;
  }

  /// n I
  [[nodiscard]] double log_likelihood(const Vec2& move) const {
    const Vec3 shift = in_space(move);
    Histogram joint{};
    double n = 0.0;
    for (const SliceTissue::Point& point : tissue_.points) {
      const double grey = sample(picture_, point.x - shift);
      if (std::isnan(grey))
        continue;
      const double place = std::clamp((grey - darkest_) / width_, 0.0, bins - 1.0);
      const int g = std::min(static_cast<int>(place), bins - 2);
      for (int L = 0; L < tissues; ++L) {
        joint[L][g] += (g + 1 - place) * point.parts[L];
        joint[L][g + 1] += (place - g) * point.parts[L];
        n += point.parts[L];
      }
    }
    const double pixel = picture_.plane.spacing_i * picture_.plane.spacing_j;
    return n * tissue_.area / pixel * mutual_information(joint);
  }

 private:
  const Picture& picture_;
  const SliceTissue& tissue_;
  double darkest_ = 0.0, width_ = 1.0;  ///< of the histogram's axis
};

struct Trial {
  Vec2 move = Vec2::Zero();
  double log_likelihood = 0.0;
};

/// All moves of a grid in a circle.
std::vector<Trial> trials(const Match& match, double largest, double step) {
  std::vector<Trial> all;
  const int n = static_cast<int>(largest / step);
  for (int j = -n; j <= n; ++j)
    for (int i = -n; i <= n; ++i)
      if (const Vec2 move(i * step, j * step); move.norm() <= largest)
        all.push_back({move, match.log_likelihood(move)});
  return all;
}

/// From the best of a grid to the maximum, by ever smaller steps.
Trial refined(const Match& match, Trial best, double largest, double step) {
  constexpr double finest = 0.05;  // [mm]
  for (double h = 0.5 * step; h > finest; h *= 0.5) {
    const Vec2 middle = best.move;
    for (const int j : {-1, 0, 1})
      for (const int i : {-1, 0, 1}) {
        const Vec2 move = middle + h * Vec2(i, j);
        if (move.norm() > largest)
          continue;
        if (const double value = match.log_likelihood(move); value > best.log_likelihood)
          best = {move, value};
      }
  }
  return best;
}

}  // namespace

Registration register_slice(const Picture& picture, const SliceTissue& tissue, double largest) {
  constexpr double step = 1.0;  // [mm]
  const double chance = 3.1 * std::sqrt((tissues - 1) * (bins - 1));
  const Match match(picture, tissue);
  const std::vector<Trial> all = trials(match, largest, step);
  const auto least = [](const Trial& a, const Trial& b) {
    return a.log_likelihood < b.log_likelihood;
  };
  const Trial best =
      refined(match, *std::max_element(all.begin(), all.end(), least), largest, step);
  Registration found{match.in_space(best.move), 0.0};
  for (const Trial& trial : all)
    if (trial.log_likelihood >= best.log_likelihood - chance)
      found.doubt = std::max(found.doubt, (trial.move - best.move).norm());
  return found;
}

}  // namespace lv::image
