#include "structure/condensation_direct.hpp"

#include "linalg/safe_norm.hpp"

namespace wavebalance::solvers {

CondensedPoint DirectMethod::dynamic_compliance(const ImpedanceCoefficients& factors,
                                                const ImpedanceCoefficients& derivatives) {
  factorize(factors);
  const int count = contacts();
  Eigen::MatrixXcd right = Eigen::MatrixXcd::Zero(size(), count + 1);
  for (int c = 0; c < count; ++c) right(structure_.contact_dofs[static_cast<std::size_t>(c)], c) = 1.0;
  right.col(count) = structure_.load;
  const Eigen::MatrixXcd response = solve(right);
  for (int c = 0; c < count; ++c) record(scale_.require_regular(factors, response.col(c), 1.0));
  const Eigen::MatrixXcd slope = -response.leftCols(count).transpose() * (combine(derivatives) * response);
  const Eigen::MatrixXcd at_contacts = response(structure_.contact_dofs, Eigen::all);
  return {at_contacts.leftCols(count), at_contacts.col(count), slope.leftCols(count), slope.col(count)};
}

Eigen::VectorXcd DirectMethod::recover(const ImpedanceCoefficients& factors,
                                       std::complex<double> load_amplitude,
                                       const Eigen::VectorXcd& contact_forces) {
  factorize(factors);
  Eigen::VectorXcd force = structure_.load * load_amplitude;
  force(structure_.contact_dofs) -= contact_forces;
  const Eigen::VectorXcd response = solve(force);
  scale_.require_regular(factors, response, safe_norm(force));
  return response;
}

DirectMethod::SparseComplex DirectMethod::combine(const ImpedanceCoefficients& s) const {
  using Complex = std::complex<double>;
  SparseComplex sum = structure_.mass.cast<Complex>() * s[0] + structure_.damping.cast<Complex>() * s[1] +
                      structure_.stiffness.cast<Complex>() * s[2];
  sum.makeCompressed();
  return sum;
}

}  // namespace wavebalance::solvers
