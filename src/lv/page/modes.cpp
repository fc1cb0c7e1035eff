#include "lv/page/modes.hpp"

#include "lv/base/dense.hpp"

#include <algorithm>
#include <cmath>

namespace lv::page {
namespace {

using Field = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Field as_field(const NodalSeries& series) {
  Field field(series.size(), series.front().size());
  for (std::size_t t = 0; t < series.size(); ++t)
    for (std::size_t i = 0; i < series[t].size(); ++i)
      field(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(i)) = series[t][i];
  return field;
}

double largest(const Field& field) {
  return field.size() == 0 ? 0.0 : field.cwiseAbs().maxCoeff();
}

/// Courses as columns, the most important first, each at most 1.
Eigen::MatrixXd courses_of(const Field& field) {
  return dense::symmetric_eigenpairs(field * field.transpose()).vectors.rowwise().reverse();
}

}  // namespace

Modes modes(const NodalSeries& series, double tolerance) {
  Field field = as_field(series);
  const double offset = field.mean();
  field.array() -= offset;
  const Eigen::MatrixXd U = courses_of(field);
  Field rest = field;
  Field shapes(0, field.cols());
  while (shapes.rows() < field.rows() && largest(rest) > 0.5 * tolerance) {
    const Eigen::VectorXd u = U.col(shapes.rows());
    shapes.conservativeResize(shapes.rows() + 1, Eigen::NoChange);
    shapes.row(shapes.rows() - 1) = u.transpose() * rest;
    rest -= u * shapes.row(shapes.rows() - 1);
  }
  // rounding adds at most half a step per shape, and courses are at most 1
  constexpr double most = 32767.0;
  const auto count = static_cast<double>(std::max<Eigen::Index>(shapes.rows(), 1));
  Modes result;
  result.offset = offset;
  result.step = std::max(tolerance / count, largest(shapes) / most);
  for (Eigen::Index k = 0; k < shapes.rows(); ++k) {
    auto& course = result.courses.emplace_back();
    auto& shape = result.shapes.emplace_back();
    for (Eigen::Index t = 0; t < field.rows(); ++t)
      course.push_back(U(t, k));
    for (Eigen::Index i = 0; i < field.cols(); ++i) {
      shape.push_back(static_cast<std::int16_t>(std::lround(shapes(k, i) / result.step)));
      shapes(k, i) = result.step * shape.back();
    }
  }
  result.largest_error = largest(field - U.leftCols(shapes.rows()) * shapes);
  return result;
}

}  // namespace lv::page
