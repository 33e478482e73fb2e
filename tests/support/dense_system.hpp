#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"
#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::dense {

/// A_d[i, j] = <p_i, d^d q_j / dt^d>, M x M each, d = 0, 1, 2; time scaled to the period.
using InnerProductMatrices = std::array<Eigen::MatrixXd, 3>;

/// d^derivative g / dt^derivative ((l + offset)/points - j/M): points x M, offset 0 or 0.5. A basis that is
/// not band-limited needs points that are a multiple of M; std::invalid_argument otherwise. O(points M), or
/// O(points M^2) for a band-limited basis whose translates lie between the points.
Eigen::MatrixXd translate_samples(const solvers::AnyTimeBasis& basis, int points, int derivative,
                                  double offset = 0.0);

/// The sums over uniform points of the paper [JL14, eqs. (14)-(16), section 4.1]. O(M^2 points).
InnerProductMatrices sampled_inner_products(const solvers::AnyTimeBasis& trial,
                                            const solvers::AnyTimeBasis& weight,
                                            solvers::Formulation formulation, int points,
                                            double offset = 0.0);
/// Exact ones of which one basis is band-limited, entry by entry from the Fourier series. O(M^3).
InnerProductMatrices series_inner_products(const solvers::AnyTimeBasis& trial,
                                           const solvers::AnyTimeBasis& weight);
/// Circulant matrices from their first columns.
InnerProductMatrices circulant_inner_products(const std::function<Eigen::VectorXd(int)>& first_column);

/// Data of the nonlinear algebraic system in addition to the structure.
struct TimeDiscretisation {
  InnerProductMatrices products;
  Eigen::MatrixXd trial;   ///< N x M, samples of the trial functions
  Eigen::MatrixXd weight;  ///< N x M, samples of the weighting functions
  Eigen::VectorXd load;    ///< M, <p_i, time function of the load>
};

/// The discretisation of TimePair with the same arguments, every matrix formed.
TimeDiscretisation discretise(const solvers::AnyTimeBasis& trial, const solvers::AnyTimeBasis& weight,
                              const solvers::TimePairOptions& options, const Eigen::VectorXcd& harmonics);

struct NewtonOptions {
  double tolerance = 1e-12;  ///< on ||residual|| / (||G a|| + ||load|| + ||contact||)
  int max_iterations = 60;
  double smallest_step = 1.0 / 4096;  ///< of the step halving; 1: full steps only
};

struct Solution {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;         ///< relative, see NewtonOptions
  Eigen::VectorXd coefficients;  ///< n M
};

/// The system G a - f(a) = 0 of all n M unknowns as the published codes assemble it [JL14, eq. (17)],
///
///   G = f^2 mass (x) A_2 + f damping (x) A_1 + stiffness (x) A_0,
///
/// unknown i M + j the coefficient of trial function j in degree of freedom i, with the contact force sampled
/// at N points and summed against the weighting functions. Memory O((n M)^2), a Newton step O((n M)^3): an
/// oracle and a baseline.
class DenseSystem {
 public:
  DenseSystem(solvers::LinearStructure structure, solvers::ContactLaws laws, TimeDiscretisation time);

  int unknowns() const { return static_cast<int>(structure_.load.size() * time_.load.size()); }
  int functions() const { return static_cast<int>(time_.load.size()); }
  /// Adds a force `shape` (n) whose time function has these inner products with the weighting functions (M).
  void add_load(const Eigen::VectorXd& shape, const Eigen::VectorXd& projections);
  /// Assembles G at a frequency in Hz.
  void set_frequency(double frequency_hz);
  const Eigen::MatrixXd& matrix() const { return matrix_; }  ///< G

  /// Coefficients (n M) without contact, by dense LU.
  Eigen::VectorXd linear_response() const;
  /// Coefficients (n M) under given contact force samples (contacts x N, N), by dense LU.
  Eigen::VectorXd forced_response(const Eigen::VectorXd& force) const;
  /// x with G x = r, by dense LU.
  Eigen::VectorXd solve(const Eigen::VectorXd& r) const;
  int contacts() const { return structure_.contacts(); }
  int points() const { return static_cast<int>(time_.trial.rows()); }  ///< N
  /// Displacement samples (contacts x N, contact-major, m) of the contact degrees of freedom.
  Eigen::VectorXd contact_displacement(const Eigen::VectorXd& coefficients) const;
  /// G a - load + contact, n M.
  Eigen::VectorXd residual(const Eigen::VectorXd& coefficients) const;
  /// ||residual|| / (||G a|| + ||load|| + ||contact||).
  double relative_residual(const Eigen::VectorXd& coefficients) const;
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& coefficients) const;
  /// Newton with step halving and a dense LU of all n M unknowns in each iteration.
  Solution newton(const Eigen::VectorXd& start, const NewtonOptions& options = {}) const;

 private:
  /// Entries of a row of S, each with the first unknown of its degree of freedom.
  struct Entry {
    double coefficient;
    Eigen::Index first_unknown;
  };
  std::vector<Entry> direction(int contact) const;
  Eigen::VectorXd project(const Eigen::VectorXd& force) const;               // n M
  Eigen::VectorXd contact_force(const Eigen::VectorXd& coefficients) const;  // n M projections

  solvers::LinearStructure structure_;
  solvers::ContactLaws laws_;
  TimeDiscretisation time_;
  Eigen::VectorXd load_;  // n M
  Eigen::MatrixXd matrix_;
};

}  // namespace wavebalance::dense
