#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "wavebalance/solvers/balance/condensed_problem.hpp"

namespace wavebalance::solvers {

/// The operator between contact forces and the unknown of a balance, in the form in which contact is solved
/// for, at whatever frequency its problem has.
///
/// In the displacement form it is K of u = u0 - K f. In the force form the unknown is v = u + E lambda /
/// epsilon, with lambda = P f the coefficients of the contact force in the trial functions and E their
/// samples:
///
///   v = u0 - (K - E P / epsilon) rho(v),
///
/// rho the resolvent of the contact law (ContactLaws::resolvents). This is the same equation for another
/// operator: one residual, one Newton matrix and one curve serve both forms. A rigid obstacle has a resolvent
/// of slope epsilon, and epsilon -> infinity is the displacement form. A Nyquist coefficient that the pair
/// drops has no part of P.
class ContactOperator {
 public:
  /// `series_flexibility[c]` is 1 / epsilon of contact c, m/N, at least 0; an empty vector is the
  /// displacement form. Keeps a reference to the problem. Throws std::invalid_argument for another number of
  /// entries or a negative one.
  explicit ContactOperator(CondensedProblem& problem, Eigen::VectorXd series_flexibility = {});

  CondensedProblem& problem() const { return *problem_; }
  /// 1 / epsilon of each contact, m/N; empty in the displacement form.
  const Eigen::VectorXd& series_flexibility() const { return series_flexibility_; }
  bool is_force_form() const { return series_flexibility_.size() > 0; }

  /// Its product with forces, N, samples() values; the result in m. O(C N log N + C^2 M).
  void apply(const Eigen::VectorXd& force, Eigen::VectorXd& unknown);
  /// Its transposed product.
  void apply_transposed(const Eigen::VectorXd& values, Eigen::VectorXd& result);

  /// C x C: the parts exp(2 pi i n t) of the unknown that contact forces exp(2 pi i n t) cause, m/N, 0 <= n
  /// <= N/2. The diagonal over harmonics of the samples, which is all of it for two Fourier bases.
  Eigen::MatrixXcd harmonic_response(int n);

  /// The first p = shift_period() columns of each contact, samples() x C p: column d p + m belongs to a
  /// unit force at point m of contact d. The column of point m + j p is the column of m with the samples of
  /// every contact shifted cyclically by j p. Made on first use at a frequency. O(C p (C N log N + C M)).
  const Eigen::MatrixXd& columns();
  /// columns(), of which only the contacts in `wanted` need be valid.
  const Eigen::MatrixXd& columns(std::span<const int> wanted);

  /// CondensedProblem::rigid_position() and force_on_held_structure() of an unknown of the form and its
  /// contact force.
  Eigen::VectorXd rigid_position(const Eigen::VectorXd& unknown, const Eigen::VectorXd& force) const;
  Eigen::VectorXd force_on_held_structure(const Eigen::VectorXd& force, const Eigen::VectorXd& unknown) const;

  /// Spectra over translates, (M/2 + 1) x C, of the unknown of the form that belongs to force samples:
  /// CondensedProblem::coefficients() in the displacement form. `held` is the force_on_held_structure() of a
  /// free structure, and not used for others.
  Eigen::MatrixXcd unknown_coefficients(const Eigen::VectorXd& force, const Eigen::VectorXd& held = {});

 private:
  const Eigen::MatrixXcd& kernel();
  void follow_problem();

  CondensedProblem* problem_;
  Eigen::VectorXd series_flexibility_;
  std::uint64_t condensation_ = 0;  // of the problem, for which kernel_ and columns_ are current
  Eigen::MatrixXcd kernel_;         // K - E P / epsilon over translates; empty in the displacement form
  Eigen::MatrixXd columns_;
  std::vector<bool> columns_are_current_;  // one entry per contact
};

}  // namespace wavebalance::solvers
