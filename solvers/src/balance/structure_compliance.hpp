#pragma once
#include <memory>

#include "structure/held_structure.hpp"
#include "wavebalance/solvers/balance/harmonic_compliance.hpp"
#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::solvers {

/// The compliance of a structure of matrices in a pair of bases: Z(k) = lambda_2(k) f^2 M + lambda_1(k) f C
/// + lambda_0(k) K (1 + i eta) with the symbols lambda of the pair and the loss factor eta below the
/// Nyquist coefficient. For a rotor C has the part Omega G and K the part Omega^2 K_s at each f, with Omega
/// = 2 pi f times the periods of its load. The static compliance of a free structure is the compliance of
/// the held one, at any frequency. A Nyquist coefficient that the pair drops has no compliance.
class StructureCompliance final : public HarmonicCompliance {
 public:
  /// `held` is the structure at rest where it is free to move; null for others. `periods`: of the load within
  /// one of the problem.
  StructureCompliance(TimePair pair, const LinearStructure& structure, CondensationMethod method,
                      const HeldStructure* held, int periods);

  void condense(double frequency, const Eigen::MatrixXcd& loads, CondensedSpectrum& result) override;
  Eigen::VectorXcd recover(int k, const Eigen::VectorXcd& loads, const Eigen::VectorXcd& forces) override;
  bool symmetric() const override { return condensation_.symmetric(); }
  double condition() const override { return condensation_.condition(); }
  void set_threads(int threads) override { condensation_.set_threads(threads); }
  int threads() const override { return condensation_.threads(); }

 private:
  // The held structure at rest, with springs for the last frequency.
  struct Rest {
    HeldStructure held;
    double stiffness = 0.0;
    std::unique_ptr<Condensation> condensation;
    CondensedPoint point;
  };
  void condense_rest(double frequency);
  void set_factors(double frequency);
  void set_turning_factors(double frequency);
  void condense_moving(const Eigen::MatrixXcd& loads, CondensedSpectrum& result);

  TimePair pair_;
  double loss_factor_;
  bool turns_;
  double base_speed_;          // rad/s, of the matrices that are condensed
  double speed_by_frequency_;  // rad/s per Hz
  Condensation condensation_;
  std::unique_ptr<Rest> rest_;               // null for a structure that is held
  StiffnessSpectrum factors_, derivatives_;  // of the coefficients that are solved for
};

}  // namespace wavebalance::solvers
