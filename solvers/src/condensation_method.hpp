#pragma once
#include <memory>

#include "wavebalance/solvers/condensation.hpp"

namespace wavebalance::solvers {

/// Solves with one dynamic stiffness after the other.
class Condensation::Method {
 public:
  virtual ~Method() = default;
  virtual int size() const = 0;
  virtual CondensedPoint at(const StiffnessFactors& factors, const StiffnessFactors& rates) = 0;
  /// Point by point unless a method knows better.
  virtual void condense(const StiffnessSpectrum& factors, const StiffnessSpectrum& rates,
                        CondensedSpectrum& result);
  virtual Eigen::VectorXcd recover(const StiffnessFactors& factors, std::complex<double> load_amplitude,
                                   std::complex<double> contact_force) = 0;
};

/// For symmetric tridiagonal M, C, K.
std::unique_ptr<Condensation::Method> make_tridiagonal_method(const LinearStructure& structure);
/// For any symmetric sparse M, C, K.
std::unique_ptr<Condensation::Method> make_sparse_method(const LinearStructure& structure);

}  // namespace wavebalance::solvers
