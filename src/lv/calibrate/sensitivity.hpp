#pragma once

#include "lv/calibrate/model.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace lv::calibrate {

/// A fitted parameter: its name and place.
struct Fitted {
  std::string name;
  double FitParameters::*member;
};

/// A volume that the model should have under loads, and how its target follows from what was
/// measured.
struct ObservedVolume {
  std::string name;
  solid::Loads loads;
  double target = 0.0;  ///< [mm^3]
  double weight = 1.0;
  double pressure_ratio = 1.0;      ///< to the measured pressure of its phase
  double target_by_edv = 0.0;       ///< dV_k/dEDV
  double target_by_unloaded = 0.0;  ///< dV_k/dV_0, V_0 the model's volume without load
};

/// Errors that the measurements are taken to have, independent of each other (standard deviations).
struct Errors {
  double volume = 0.02;  ///< as a fraction
  double strain = 0.03;  ///< of a segment's mean
  double shape = 2.0;    ///< of the mean distance from a drawn part of a surface [mm]
};

/// How volumes follow from parameters, and parameters from measurements, near a fit. By central
/// differences of the model: parameters by +-1%, pressures by +-0.25 mmHg
/// (from 0 upwards alone); from one side where the other has no equilibrium.
struct Sensitivity {
  std::vector<Fitted> parameters;
  Eigen::MatrixXd by_parameter;  ///< d ln (V_k/target_k) / d ln x_j
  Eigen::VectorXd by_pressure;   ///< dV_k/dp [mm^3/kPa]
  /// d ln x_j by d ln EDV, d ln ESV, dp_ED and dp_ES [1/kPa], for the weighted least-squares fit.
  Eigen::Matrix<double, Eigen::Dynamic, 4> by_data;
  /// Of the errors of ln x_i and ln x_j when all volumes carry independent errors of equal size (of
  /// the stated sizes, where strains or a shape are fitted besides); near +-1 the data cannot tell
  /// the two apart.
  Eigen::MatrixXd correlation;

  // where strains or a shape are fitted besides
  Eigen::MatrixXd strain_by_parameter;    ///< dE_i / d ln x_j
  Eigen::MatrixXd distance_by_parameter;  ///< dd_i / d ln x_j [mm]
  /// Of the errors of ln x_i and ln x_j for the stated errors of all that is fitted to; not yet
  /// scaled by how well the model fits.
  Eigen::MatrixXd covariance;
};

/// What was measured besides the observed volumes. Without `Model::strains` and `distances`, loads
/// and errors mean nothing.
struct Measured {
  double edv = 0.0;     ///< [mm^3]
  solid::Loads ed, es;  ///< between which strains are measured; the second is the shape's
  Errors errors;
};

[[nodiscard]] Sensitivity sensitivity(const Model& model, const FitParameters& at,
                                      const std::vector<Fitted>& parameters,
                                      const std::vector<ObservedVolume>& observations,
                                      const Measured& measured);

/// C_ij/(C_ii C_jj)^(1/2)
[[nodiscard]] Eigen::MatrixXd correlation(const Eigen::MatrixXd& covariance);

}  // namespace lv::calibrate
