#pragma once
#include <memory>

#include "wavebalance/solvers/impacts/impacts_problem.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"

namespace wavebalance::solvers {

/// What impacts take of a problem, over the frequency of its load (Hz) or its load scale.
///
/// One object per thread.
class ImpactFamily {
 public:
  /// Takes the structure, the load and the other parameter from `problem`, which may change afterwards.
  /// `dynamics` are those of its structure and must outlive the object. `gaps` (m) and `restitution`: one for
  /// each contact. Throws as ImpactsProblem::validate().
  ImpactFamily(const CondensedProblem& problem, const ContactDynamics& dynamics, Eigen::VectorXd gaps,
               Eigen::VectorXd restitution, SweepParameter parameter);
  ImpactFamily(ImpactFamily&&) noexcept;
  ImpactFamily& operator=(ImpactFamily&&) noexcept;
  ~ImpactFamily();

  SweepParameter parameter() const;
  /// Over so many periods of the load. O(modes) for each harmonic of the load where modes decouple the
  /// damping, otherwise O(n^3).
  ImpactsProblem at(double value, int periods = 1) const;
  /// The slopes of contact_free (C x (H + 1)) by the parameter, by a central difference to about 1e-10, and
  /// that of ImpactsProblem::frequency.
  Eigen::MatrixXcd contact_free_slope(double value, int periods = 1) const;
  double frequency_slope(int periods = 1) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace wavebalance::solvers
