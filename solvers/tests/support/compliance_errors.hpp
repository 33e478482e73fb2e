#pragma once
#include <algorithm>
#include <complex>

#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "wavebalance/solvers/structure/condensation.hpp"

namespace wavebalance::solvers::testing {

/// Over the largest compliance.
struct ComplianceErrors {
  double sections = 0.0;  ///< of the compliance and its slope
  double poles = 0.0;     ///< of the sum over poles and residues
};

/// The largest differences to a condensation at complex exponents of the order of `size`, of which the lowest
/// frequency is given: a free structure has no compliance at zero.
inline ComplianceErrors compliance_errors(const ContactDynamics& dynamics, const LinearStructure& structure,
                                          double size, double lowest = 0.0) {
  using Complex = std::complex<double>;
  Condensation condensation(structure, CondensationMethod::dense);
  const int count = structure.contacts();
  ComplianceErrors errors;
  double largest = 0.0;
  for (const double real : {0.0, 0.3 * size, -0.02 * size})
    for (const double imaginary : {lowest, 0.7 * size, 3.1 * size, -5.0 * size}) {
      const Complex s(real, imaginary);
      const CondensedPoint exact = condensation.dynamic_compliance({s * s, s, 1.0}, {2.0 * s, 1.0, 0.0});
      const auto values = dynamics.compliance(real, Eigen::VectorXd::Constant(1, imaginary));
      const Eigen::MatrixXcd compliance =
          dynamics.constant() + values.compliance.row(0).reshaped(count, count);
      const Eigen::MatrixXcd slope = values.slope.row(0).reshaped(count, count);
      Eigen::MatrixXcd sum = dynamics.constant().cast<Complex>();
      for (const ContactPole& pole : dynamics.poles()) {
        const Eigen::MatrixXcd matrix = pole.residue * pole.shape * pole.left.transpose();
        sum += matrix / (s - pole.exponent);
        if (pole.exponent.imag() != 0.0) sum += matrix.conjugate() / (s - std::conj(pole.exponent));
      }
      largest = std::max(largest, exact.compliance.cwiseAbs().maxCoeff());
      errors.sections = std::max({errors.sections, (compliance - exact.compliance).cwiseAbs().maxCoeff(),
                                  size * (slope - exact.compliance_slope).cwiseAbs().maxCoeff()});
      errors.poles = std::max(errors.poles, (sum - exact.compliance).cwiseAbs().maxCoeff());
    }
  return {errors.sections / largest, errors.poles / largest};
}

}  // namespace wavebalance::solvers::testing
