#include "lv/anatomy/heart_size.hpp"

#include "lv/base/units.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>
#include <vector>

namespace lv::anatomy {

double mean_thickness(const mesh::WallMap& wall, double volume) {
  constexpr int along = 40;
  constexpr int around = 72;
  const auto middle = [&](int i, int j) -> Vec3 {
    return wall(static_cast<double>(i) / along, 2.0 * std::numbers::pi * j / around, 0.5);
  };
  double area = 0.0;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j)
      area +=
          0.5 *
          (middle(i + 1, j + 1) - middle(i, j)).cross(middle(i, j + 1) - middle(i + 1, j)).norm();
  return volume / area;
}

std::string odd_size(double cavity, double wall, std::optional<double> thickness) {
  std::vector<std::string> odd;
  const auto judge = [&](const char* what, double value, double low, double high,
                         const char* unit) {
    if (!(value >= low && value <= high))
      odd.push_back(fmt::format("{} {:.3g} {} (human left ventricles: {:g} to {:g} {})", what,
                                value, unit, low, high, unit));
  };
  judge("the cavity holds", cavity / units::ml, 20.0, 600.0, "ml");
  judge("the wall has", wall / units::ml, 40.0, 600.0, "ml");
  if (thickness)
    judge("the wall's mean thickness is", *thickness, 3.0, 30.0, "mm");
  if (odd.empty())
    return "";
  return fmt::format(
      "{}: check the voxel size that the file states, or the unit of its lengths, first; a heart "
      "that is no adult human's is taken as it is",
      fmt::join(odd, ", "));
}

}  // namespace lv::anatomy
