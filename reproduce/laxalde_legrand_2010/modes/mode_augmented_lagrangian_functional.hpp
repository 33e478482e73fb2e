#pragma once
#include <Eigen/Core>
#include <optional>

#include "mode_augmented_lagrangian_multipliers.hpp"
#include "rayleigh_quotient.hpp"
#include "wavebalance/solvers/modes/nonlinear_mode.hpp"

namespace wavebalance::ll10 {

using solvers::ModalModel;

/// Which equations of [LL10] hold.
enum class ModeFormulation {
  published,  ///< as printed: the normalisation h without n^2 (24c), (24d), and omega^2 = r
  consistent  ///< h = m/2 - gamma with n^2 (11), (12), and omega^2 = r + mean(lambda_phys) g0 / m
};

/// The augmented Lagrangian of a nonlinear mode [LL10, eq. (18)] with the integral as a mean of m samples,
///   L(x) = r(x) + 1/2 (1/m) sum_k kappa_k (g_k + theta_k)_+^2 + 1/2 kappa_e (h(x) + theta_e)^2,
///   g(x) = B x - gap at t_k = k T/m,   h(x) = 1/2 sum_b w_b n_b^2 |x_b|^2 - gamma (published: no n^2),
/// x the real Fourier coefficients (FourierLayout) of the modal amplitudes. With r frozen at rho, as the
/// sequential Algorithm 2 does, the gradient is (2/m)(A - rho D) x instead of grad r [LL10, eq. (24d)], and
/// is no longer the gradient of a functional. In the consistent formulation the solution x is the same for
/// any rho: the multiplier of h, which has the form of D x, compensates for the difference.
///
/// Works in whatever consistent units the model has; LagrangianMode gives it a model with omega_1 = gap = 1.
/// Constraints are numbered contact * m + time. Immutable.
class ModeLagrangian {
 public:
  /// Throws std::invalid_argument if the model does not fit or m < 2N.
  ModeLagrangian(const ModalModel& model, FourierLayout layout, int samples, ModeFormulation formulation);

  const RayleighQuotient& quotient() const { return quotient_; }
  const FourierLayout& layout() const { return quotient_.layout(); }
  int unknowns() const { return static_cast<int>(quotient_.unknowns()); }
  int samples() const { return static_cast<int>(waves_.rows()); }
  int constraints() const { return static_cast<int>(gaps_.size()) * samples(); }

  /// g, c m entries. O(c r N + c m N).
  Eigen::VectorXd gap_function(const Eigen::VectorXd& x) const;
  /// h + gamma.
  double normalisation(const Eigen::VectorXd& x) const { return 0.5 * norm_.value(x); }
  /// (1/m) B^T force, the generalised force of force samples.
  Eigen::VectorXd generalised_force(const Eigen::VectorXd& force) const;

  /// frozen: rho, in the place of r.
  Eigen::VectorXd gradient(const Eigen::VectorXd& x, double gamma, const Multipliers& multipliers,
                           std::optional<double> frozen = {}) const;
  /// Its derivative, dense; at the kink the derivative in contact. O((r N)^2 active).
  Eigen::MatrixXd hessian(const Eigen::VectorXd& x, double gamma, const Multipliers& multipliers,
                          std::optional<double> frozen = {}) const;

 private:
  void add_contact(Eigen::MatrixXd& hessian, const Eigen::VectorXd& tangent) const;

  RayleighQuotient quotient_;
  HarmonicForm norm_;
  Eigen::MatrixXd shapes_;  // c x r
  Eigen::VectorXd gaps_;
  Eigen::MatrixXd waves_;  // m x blocks: cos and sin at the samples
};

}  // namespace wavebalance::ll10
