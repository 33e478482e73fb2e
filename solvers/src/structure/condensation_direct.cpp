#include "structure/condensation_direct.hpp"

#include "linalg/index.hpp"
#include "linalg/safe_norm.hpp"

namespace wavebalance::solvers {

CondensedPoint DirectMethod::dynamic_compliance(const ImpedanceCoefficients& factors,
                                                const ImpedanceCoefficients& derivatives) {
  factorize(factors);
  const int count = contacts();
  const Index loads = loads_.cols();
  Eigen::MatrixXcd right(size(), count + loads);
  right.leftCols(count) =
      Eigen::MatrixXd(structure_.contact_directions.transpose()).cast<std::complex<double>>();
  right.rightCols(loads) = loads_.cast<std::complex<double>>();
  const Eigen::MatrixXcd response = solve(right);
  for (int c = 0; c < count; ++c) record(scale_.require_regular(factors, response.col(c), lengths_[c]));
  const Eigen::MatrixXcd left =
      symmetric_ ? response.leftCols(count) : solve_transposed(right.leftCols(count));
  const Eigen::MatrixXcd slope = -left.transpose() * (combine(derivatives) * response);
  const Eigen::MatrixXcd at_contacts = structure_.contact_directions * response;
  CondensedPoint point{at_contacts.leftCols(count), at_contacts.rightCols(loads).reshaped(),
                       slope.leftCols(count), slope.rightCols(loads).reshaped()};
  set_errors(factors, response, left, point);
  return point;
}

// A factorisation solves (Z + E) x = b with |E| <= eps A, A = |s2| |M| + |s1| |C| + |s0| |K|, so that the
// part s^T x along a direction s has the error |y|^T |E| |x| with y = Z^-T s, for a symmetric Z the response
// to a unit force [Skeel]. It exceeds the rounding of the sum s^T x too, because |s| is at most A^T |y|. With
// the row sums r and the column sums c of A, |y|^T A |x| is at most the geometric mean of y^2 r and x^2 c by
// Cauchy and Schwarz.
void DirectMethod::set_errors(const ImpedanceCoefficients& factors, const Eigen::MatrixXcd& response,
                              const Eigen::MatrixXcd& left, CondensedPoint& point) const {
  const int count = contacts();
  Eigen::VectorXd size(Index(magnitudes_.size()));
  for (Index d = 0; d < size.size(); ++d) size[d] = std::abs(factors[std::size_t(d)]);
  const Eigen::MatrixXd squares = response.cwiseAbs2(), moduli = squares.cwiseSqrt();
  const Eigen::MatrixXd left_squares = left.cwiseAbs2(), left_moduli = left_squares.cwiseSqrt();
  point.load_response_error.resize(count * loads_.cols());
  for (Index l = 0; l < loads_.cols(); ++l) {
    const auto loaded = moduli.col(count + l);
    Eigen::VectorXd perturbed = magnitudes_[2] * (size[2] * loaded);
    for (std::size_t d = 0; d < magnitudes_.size(); ++d)
      if (d != 2) perturbed += magnitudes_[d] * (size[Index(d)] * loaded);
    point.load_response_error.segment(count * l, count) =
        rounding_unit * (left_moduli.transpose() * perturbed);
  }
  const Eigen::VectorXd by_rows = left_squares.transpose() * (row_sums_ * size);
  point.compliance_error = rounding_unit * by_rows;
  if (symmetric_) return;
  const Eigen::VectorXd by_columns = squares.leftCols(count).transpose() * (column_sums_ * size);
  point.compliance_error = rounding_unit * by_rows.cwiseMax(by_columns);
}

Eigen::VectorXcd DirectMethod::recover(const ImpedanceCoefficients& factors,
                                       const Eigen::VectorXcd& load_amplitudes,
                                       const Eigen::VectorXcd& contact_forces) {
  factorize(factors);
  Eigen::VectorXcd force = loads_ * load_amplitudes;
  force -= structure_.contact_directions.transpose() * contact_forces;
  const Eigen::VectorXcd response = solve(force);
  scale_.require_regular(factors, response, safe_norm(force));
  return response;
}

DirectMethod::SparseComplex DirectMethod::combine(const ImpedanceCoefficients& s) const {
  using Complex = std::complex<double>;
  SparseComplex sum = structure_.mass.cast<Complex>() * s[0] + structure_.damping.cast<Complex>() * s[1] +
                      structure_.stiffness.cast<Complex>() * s[2];
  if (structure_.turns())  // with zero factors too, for the same pattern
    sum = (sum + structure_.turning.gyroscopic.cast<Complex>() * s[3] +
           structure_.turning.stiffness.cast<Complex>() * s[4])
              .eval();
  sum.makeCompressed();
  return sum;
}

}  // namespace wavebalance::solvers
