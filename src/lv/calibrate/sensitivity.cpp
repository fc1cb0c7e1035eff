#include "lv/calibrate/sensitivity.hpp"

#include "lv/base/dense.hpp"
#include "lv/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace lv::calibrate {
namespace {

constexpr double parameter_step = 0.01;               // of the logarithm
constexpr double pressure_step = 0.25 * units::mmHg;  // [kPa]

FitParameters scaled(FitParameters p, const Fitted& which, double factor) {
  p.*which.member *= factor;
  return p;
}

/// df/ds at 0 by the values at `up` and -`down`; from one side alone where the other has none.
double slope(const Outcome<double>& above, const Outcome<double>& below, double up, double down,
             const std::function<Outcome<double>()>& at_0) {
  if (above && below)
    return (*above - *below) / (up + down);
  const double here = at_0().value();
  return below ? (here - *below) / down : (above.value() - here) / up;
}

/// ln V minus, where its target moves with the parameters, the part of ln target that does.
Outcome<double> misfit(const Model& model, const FitParameters& p, const ObservedVolume& o) {
  const Outcome<double> V = model.volume(p, o.loads);
  if (!V || o.target_by_unloaded == 0.0)
    return V ? Outcome<double>(std::log(*V)) : V;
  const Outcome<double> V_0 = model.unloaded_volume(p);
  return V_0 ? Outcome<double>(std::log(*V) - o.target_by_unloaded * *V_0 / o.target) : V_0;
}

/// d ln V_k minus, where its target moves with the parameters, d ln target_k. All volumes of one
/// muscle follow each other: a loaded shape is unloaded once for them.
Eigen::VectorXd by_parameter(const Model& model, const FitParameters& at, const Fitted& which,
                             const std::vector<ObservedVolume>& observations) {
  const auto misfits = [&](double s) {
    std::vector<Outcome<double>> all;
    for (const ObservedVolume& o : observations)
      all.push_back(misfit(model, scaled(at, which, std::exp(s)), o));
    return all;
  };
  const auto above = misfits(parameter_step);
  const auto below = misfits(-parameter_step);
  Eigen::VectorXd slopes(static_cast<Eigen::Index>(observations.size()));
  for (std::size_t k = 0; k < observations.size(); ++k)
    slopes[static_cast<Eigen::Index>(k)] =
        slope(above[k], below[k], parameter_step, parameter_step,
              [&] { return misfit(model, at, observations[k]); });
  return slopes;
}

/// dV/dp.
double by_pressure(const Model& model, const FitParameters& at, const ObservedVolume& o) {
  const auto under = [&](double dp) {
    return model.volume(at, {o.loads.pressure + dp, o.loads.activation});
  };
  const double down = std::min(pressure_step, o.loads.pressure);  // no suction on a free wall
  const Outcome<double> above = under(pressure_step);
  return slope(above, under(-down), pressure_step, down, [&] { return under(0.0); });
}

/// Derivatives of regional values y_i, strains or distances, by the parameters' logarithms and by
/// the two pressures.
struct RegionalRows {
  Eigen::MatrixXd by_parameter;                          ///< dy_i / d ln x_j
  Eigen::Matrix<double, Eigen::Dynamic, 2> by_pressure;  ///< dy_i/dp_ED, dy_i/dp_ES [./kPa]
};

using RegionalValues = std::function<Outcome<std::vector<double>>(
    const FitParameters&, const solid::Loads& ed, const solid::Loads& es)>;

RegionalRows regional_rows(const RegionalValues& model, const FitParameters& at,
                           const std::vector<Fitted>& parameters, const solid::Loads& ed,
                           const solid::Loads& es) {
  const auto values = [&](const FitParameters& p, double d_ed, double d_es) {
    return dense::as_vector(
        model(p, {ed.pressure + d_ed, ed.activation}, {es.pressure + d_es, es.activation}).value());
  };
  const auto difference = [](const Eigen::VectorXd& above, const Eigen::VectorXd& below,
                             double step) {
    return Eigen::VectorXd((above - below) / (2.0 * step));
  };
  RegionalRows rows;
  const double dp = pressure_step;
  const Eigen::VectorXd by_ed = difference(values(at, dp, 0.0), values(at, -dp, 0.0), dp);
  rows.by_parameter.resize(by_ed.size(), static_cast<Eigen::Index>(parameters.size()));
  rows.by_pressure.resize(by_ed.size(), 2);
  rows.by_pressure << by_ed, difference(values(at, 0.0, dp), values(at, 0.0, -dp), dp);
  for (std::size_t j = 0; j < parameters.size(); ++j)
    rows.by_parameter.col(static_cast<Eigen::Index>(j)) = difference(
        values(scaled(at, parameters[j], std::exp(parameter_step)), 0.0, 0.0),
        values(scaled(at, parameters[j], std::exp(-parameter_step)), 0.0, 0.0), parameter_step);
  return rows;
}

Eigen::MatrixXd below_each_other(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd both(a.rows() + b.rows(), a.cols());
  both << a, b;
  return both;
}

}  // namespace

Sensitivity sensitivity(const Model& model, const FitParameters& at,
                        const std::vector<Fitted>& parameters,
                        const std::vector<ObservedVolume>& observations, const Measured& measured) {
  const auto& [edv, ed, es, errors] = measured;
  const auto n = static_cast<Eigen::Index>(parameters.size());
  const auto m = static_cast<Eigen::Index>(observations.size());
  Sensitivity s{parameters, Eigen::MatrixXd(m, n), Eigen::VectorXd(m), {}, {}, {}, {}, {}};
  Eigen::MatrixXd by_data = Eigen::MatrixXd::Zero(m, 4);  // of ln V_target - ln V, at fixed x
  Eigen::VectorXd weight(m);
  for (Eigen::Index k = 0; k < m; ++k) {
    const ObservedVolume& o = observations[k];
    s.by_pressure[k] = by_pressure(model, at, o);
    const bool systolic = o.loads.activation > 0.0;
    by_data(k, 0) = o.target_by_edv * edv / o.target;
    by_data(k, 1) = systolic ? 1.0 : 0.0;
    by_data(k, systolic ? 3 : 2) = -o.pressure_ratio * s.by_pressure[k] / o.target;
    weight[k] = o.weight;
  }
  for (Eigen::Index j = 0; j < n; ++j)
    s.by_parameter.col(j) = by_parameter(model, at, parameters[j], observations);
  Eigen::MatrixXd J = weight.asDiagonal() * s.by_parameter;
  by_data = weight.asDiagonal() * by_data;
  Eigen::MatrixXd of_errors = s.by_parameter;
  const auto add_regions = [&](const RegionalValues& values, double error) {
    const RegionalRows rows = regional_rows(values, at, parameters, measured.ed, measured.es);
    Eigen::MatrixXd rows_by_data = Eigen::MatrixXd::Zero(rows.by_parameter.rows(), 4);
    rows_by_data.rightCols(2) = -rows.by_pressure / error;
    J = below_each_other(J, rows.by_parameter / error);
    by_data = below_each_other(by_data, rows_by_data);
    return rows.by_parameter;
  };
  if (model.strains || model.distances) {
    J /= errors.volume;
    by_data /= errors.volume;
    if (model.strains)
      s.strain_by_parameter = add_regions(model.strains, errors.strain);
    if (model.distances)
      s.distance_by_parameter =
          add_regions([&](const FitParameters& p, const solid::Loads&,
                          const solid::Loads& systole) { return model.distances(p, systole); },
                      errors.shape);
    of_errors = J;
  }
  s.by_data = dense::least_squares(J, by_data);
  s.covariance = dense::inverse_of_normal_matrix(of_errors);
  s.correlation = correlation(s.covariance);
  return s;
}

Eigen::MatrixXd correlation(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd deviation = covariance.diagonal().cwiseSqrt();
  return covariance.cwiseQuotient(deviation * deviation.transpose());
}

}  // namespace lv::calibrate
