#include "lv/implicit/smooth_fields.hpp"

#include "lv/base/check.hpp"
#include "lv/base/dense.hpp"

#include <cmath>
#include <vector>

namespace lv::implicit {
namespace {

/// All monomials up to a total degree, one a column, in coordinates of order one.
Eigen::MatrixXd monomials(std::span<const Vec3> places, int degree) {
  double size = 0.0;
  for (const Vec3& X : places)
    size = std::max(size, X.cwiseAbs().maxCoeff());
  std::vector<Eigen::VectorXd> columns;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= degree; ++k) {
        Eigen::VectorXd& column = columns.emplace_back(static_cast<Eigen::Index>(places.size()));
        for (Eigen::Index a = 0; a < column.size(); ++a) {
          const Vec3 X = places[static_cast<std::size_t>(a)] / size;
          column[a] = std::pow(X[0], i) * std::pow(X[1], j) * std::pow(X[2], k);
        }
      }
  Eigen::MatrixXd all(columns.front().size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t m = 0; m < columns.size(); ++m)
    all.col(static_cast<Eigen::Index>(m)) = columns[m];
  return all;
}

Eigen::MatrixXd basis_of(const Eigen::MatrixXd& fields) {
  LV_CHECK(fields.rows() > fields.cols());
  return dense::orthonormal(fields);
}

}  // namespace

SmoothFields::SmoothFields(std::span<const Vec3> places, int degree)
    : across_(basis_of(monomials(places, degree))) {
  Eigen::MatrixXd along = monomials(places, degree - 1);
  for (Eigen::Index a = 0; a < along.rows(); ++a)
    along.row(a) *= places[static_cast<std::size_t>(a)].z();
  along_ = basis_of(along);
}

Eigen::VectorXd SmoothFields::nearest(const Eigen::VectorXd& displacement) const {
  const Eigen::Map<const Eigen::Matrix3Xd> given(displacement.data(), 3, displacement.size() / 3);
  Eigen::VectorXd numbers(displacement.size());
  Eigen::Map<Eigen::Matrix3Xd> field(numbers.data(), 3, displacement.size() / 3);
  field.topRows<2>() = (given.topRows<2>() * across_) * across_.transpose();
  field.row(2) = (given.row(2) * along_) * along_.transpose();
  return numbers;
}

}  // namespace lv::implicit
