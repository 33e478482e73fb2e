#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/stability/floquet_exponents.hpp"
#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::solvers {

/// The real motion of a perturbation exp(sigma t) p(t) and its contact force without their growth.
struct Perturbation {
  Eigen::VectorXd displacement;  ///< contact-major, with the largest rms of all phases; its rms is 1 m
  Eigen::VectorXd force;         ///< N

  /// The perturbation in the unknown of a form, see ContactOperator.
  Eigen::VectorXd unknown(const Eigen::VectorXd& series_flexibility) const;
};

/// The perturbation of an exponent that was found for a motion of one period, at the points of a pair whose
/// period is `periods` times as long. It repeats after them if the multiplier to that power is real and
/// positive. `phase` (rad) is counted from the phase of the largest rms. O(C points H). Without an entry
/// where the exponent has no motion.
Perturbation perturbation(const FloquetExponent& exponent, int periods, const TimePair& pair,
                          double phase = 0.0);

}  // namespace wavebalance::solvers
