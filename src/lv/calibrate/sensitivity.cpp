#include "lv/calibrate/sensitivity.hpp"

#include "lv/base/units.hpp"

#include <Eigen/QR>

#include <cmath>

namespace lv::calibrate {
namespace {

constexpr double parameter_step = 0.01;               // of the logarithm
constexpr double pressure_step = 0.25 * units::mmHg;  // [kPa]

Parameters scaled(Parameters p, const Fitted& which, double factor) {
  p.*which.member *= factor;
  return p;
}

}  // namespace

Sensitivity sensitivity(const Model& model, const Parameters& at,
                        const std::vector<Fitted>& parameters,
                        const std::vector<Observation>& observations, double edv) {
  const auto n = static_cast<Eigen::Index>(parameters.size());
  const auto m = static_cast<Eigen::Index>(observations.size());
  Sensitivity s{parameters, Eigen::MatrixXd(m, n), Eigen::VectorXd(m), {}, {}};
  Eigen::MatrixXd by_data = Eigen::MatrixXd::Zero(m, 4);  // of ln V_target - ln V, at fixed x
  Eigen::VectorXd weight(m);
  for (Eigen::Index k = 0; k < m; ++k) {
    const Observation& o = observations[k];
    for (Eigen::Index j = 0; j < n; ++j)
      s.by_parameter(k, j) =
          std::log(model(scaled(at, parameters[j], std::exp(parameter_step)), o.loads) /
                   model(scaled(at, parameters[j], std::exp(-parameter_step)), o.loads)) /
          (2.0 * parameter_step);
    const auto under = [&](double p) { return model(at, {p, o.loads.activation}); };
    s.by_pressure[k] =
        (under(o.loads.pressure + pressure_step) - under(o.loads.pressure - pressure_step)) /
        (2.0 * pressure_step);
    const bool systolic = o.loads.activation > 0.0;
    by_data(k, 0) = o.target_by_edv * edv / o.target;
    by_data(k, 1) = systolic ? 1.0 : 0.0;
    by_data(k, systolic ? 3 : 2) = -o.pressure_ratio * s.by_pressure[k] / o.target;
    weight[k] = o.weight;
  }
  const Eigen::MatrixXd J = weight.asDiagonal() * s.by_parameter;
  s.by_data = J.completeOrthogonalDecomposition().solve(weight.asDiagonal() * by_data);
  const Eigen::MatrixXd covariance = (s.by_parameter.transpose() * s.by_parameter)
                                         .completeOrthogonalDecomposition()
                                         .pseudoInverse();
  const Eigen::VectorXd deviation = covariance.diagonal().cwiseSqrt();
  s.correlation = covariance.cwiseQuotient(deviation * deviation.transpose());
  return s;
}

}  // namespace lv::calibrate
