#include "lv/implicit/damped_newton.hpp"

#include <cmath>

namespace lv::implicit {

std::optional<std::vector<double>> solve(SparseMatrix& K, const std::vector<double>& b,
                                         NewtonReport& report) {
  const auto x = K.solve(b);
  ++report.linear_solves;
  report.linear_iterations += K.iterations();
  if (x)
    return *x;
  report.why = x.why().what;
  return {};
}

double rms_displacement(const std::vector<double>& correction, std::size_t nodes) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 3 * nodes; ++k)
    sum += correction[k] * correction[k];
  return std::sqrt(sum / static_cast<double>(nodes));
}

std::span<const double> add(std::span<const double> correction, double by,
                            std::vector<Vec3>& positions, std::vector<double>& pressures) {
  std::size_t next = 0;
  for (Vec3& x : positions)
    for (int i = 0; i < 3; ++i)
      x[i] += by * correction[next++];
  for (double& p : pressures)
    p += by * correction[next++];
  return correction.subspan(next);
}

}  // namespace lv::implicit
