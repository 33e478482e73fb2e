#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/structure/condensation.hpp"

namespace wavebalance::solvers {

/// A structure in a harmonic or wavelet balance: at each coefficient k over translates the compliance of
/// its contacts and their response to its loads. Structures of matrices have one (StructureCompliance);
/// another, of a cyclic sector or of measured frequency responses, is a class with these members. Owned by
/// a CondensedProblem; one object per thread.
class HarmonicCompliance {
 public:
  virtual ~HarmonicCompliance() = default;

  /// Fills all M/2 + 1 rows of `result` at a frequency (Hz, > 0), with derivatives by the frequency (per Hz)
  /// and rounding errors. `loads` are the amplitudes of the loads, (M/2 + 1) x L, which weight these errors.
  /// Throws SingularSystem.
  virtual void condense(double frequency, const Eigen::MatrixXcd& loads, CondensedSpectrum& result) = 0;
  /// Coefficient k of all n degrees of freedom under loads (L) and contact forces (C), at the frequency last
  /// condensed.
  virtual Eigen::VectorXcd recover(int k, const Eigen::VectorXcd& loads, const Eigen::VectorXcd& forces) = 0;

  /// Whether all compliances are symmetric.
  virtual bool symmetric() const = 0;
  /// Condition of the last solved systems, as Condensation::condition().
  virtual double condition() const = 0;
  /// Threads of condense(), as in Condensation::set_threads(); no effect without threads.
  virtual void set_threads(int) {}
  virtual int threads() const { return 1; }
};

}  // namespace wavebalance::solvers
