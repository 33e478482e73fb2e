#pragma once
#include <memory>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"

namespace wavebalance::solvers {

/// Inputs of collocation_motion() from a problem, over its forcing frequency (Hz) or load scale. One object
/// per thread.
class ProblemFamily {
 public:
  /// Takes the structure, the load and the other parameter from `problem`, which may change afterwards.
  /// `dynamics` belong to its structure and must outlive the object; for a rotor they depend on the
  /// frequency. Throws std::invalid_argument for laws that are neither one nor one for each contact.
  ProblemFamily(const CondensedProblem& problem, ContactLaws laws, const ContactDynamics& dynamics,
                SweepParameter parameter);
  ProblemFamily(ProblemFamily&&) noexcept;
  ProblemFamily& operator=(ProblemFamily&&) noexcept;
  ~ProblemFamily();

  SweepParameter parameter() const;
  const ContactLaws& laws() const;
  /// Those at the frequency of the problem.
  const ContactDynamics& dynamics() const;
  /// O(n^3) for each harmonic of the load, and for the dynamics of a structure that turns.
  ExactProblem at(double value) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace wavebalance::solvers
