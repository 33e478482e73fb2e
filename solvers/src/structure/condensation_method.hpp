#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "wavebalance/solvers/structure/condensation.hpp"

namespace wavebalance::solvers {

/// Solves with one dynamic stiffness after the other.
class Condensation::Method {
 public:
  virtual ~Method() = default;
  virtual int size() const = 0;
  virtual int contacts() const = 0;
  virtual CondensedPoint dynamic_compliance(const ImpedanceCoefficients& factors,
                                            const ImpedanceCoefficients& derivatives) = 0;
  /// The default condenses point by point, by twins on several threads. The results have their size already.
  virtual void condense(const StiffnessSpectrum& factors, const StiffnessSpectrum& derivatives,
                        CondensedSpectrum& result);
  virtual Eigen::VectorXcd recover(const ImpedanceCoefficients& factors,
                                   const Eigen::VectorXcd& load_amplitudes,
                                   const Eigen::VectorXcd& contact_forces) = 0;

  /// Another method for the same structure with the same results to the last digit, which another thread may
  /// use at the same time; null where points cost too little for threads.
  virtual std::unique_ptr<Method> twin() const { return nullptr; }
  /// Threads of condense(), at least 1.
  virtual void set_threads(int threads) { threads_ = threads; }

  /// The largest lower bound of a condition number since the last reset.
  double condition() const { return condition_; }
  void reset_condition() { condition_ = 0.0; }

 protected:
  Method() = default;
  /// For a twin, which has none itself.
  Method(const Method&) {}
  void record(double condition) { condition_ = std::max(condition_, condition); }

 private:
  void make_twins(Eigen::Index points);

  double condition_ = 0.0;
  int threads_ = 1;
  std::vector<std::unique_ptr<Method>> twins_;  // one per thread in addition to the caller's, made when
                                                // needed
};

/// Bound of the relative rounding error of an entry of a factorised matrix, a few roundings of its terms.
/// The errors of eliminations in double precision, compared with long double, are at most 2.5 times the
/// errors of one rounding.
constexpr double rounding_unit = 4.0 * std::numeric_limits<double>::epsilon();

/// The 2-norms of the contact directions, C: of their unit forces.
Eigen::VectorXd direction_lengths(const LinearStructure& structure);

/// Upper bound of the entries of Z, of the size of its terms: at a natural frequency of an undamped structure
/// they cancel in Z itself.
class StiffnessScale {
 public:
  explicit StiffnessScale(const LinearStructure& structure);
  /// Largest entries of M, C and K, and of G and K_s.
  const std::array<double, 5>& largest() const { return largest_; }
  /// |s2| max|M| + |s1| max|C| + |s0| max|K|, and so on.
  double size(const ImpedanceCoefficients& factors) const;
  /// scale ||x|| / ||b|| for Z x = b, a lower bound of the condition number of Z up to a factor.
  double condition(const ImpedanceCoefficients& factors, double solution_norm, double right_norm) const;
  /// Throws SingularSystem when the solution of Z x = b is as large as only a matrix that is singular to
  /// working precision makes it, or not finite. Returns condition(). O(n).
  double require_regular(const ImpedanceCoefficients& factors,
                         const Eigen::Ref<const Eigen::VectorXcd>& solution, double right_norm) const;
  double require_regular(const ImpedanceCoefficients& factors, double solution_norm, double right_norm) const;

 private:
  std::array<double, 5> largest_;
};

using MethodMaker = std::function<std::unique_ptr<Condensation::Method>(const LinearStructure&)>;
/// Another method in units in which matrices and dynamic stiffnesses beyond 1e100 or below 1e-100 have
/// entries near 1, so that no square of a pivot overflows. Ordinary ones are not scaled. `make` is called
/// once.
std::unique_ptr<Condensation::Method> make_scaled_method(const LinearStructure& structure,
                                                         const MethodMaker& make);
/// For symmetric tridiagonal M, C, K.
std::unique_ptr<Condensation::Method> make_tridiagonal_method(const LinearStructure& structure);
/// For symmetric M, C, K whose undamped modes decouple them, K or M positive definite; null for any other.
/// O(n^3).
std::unique_ptr<Condensation::Method> make_modal_method(const LinearStructure& structure);
/// For any M, C, K, by dense LU.
std::unique_ptr<Condensation::Method> make_dense_method(const LinearStructure& structure);
/// For any M, C, K, by sparse LU: UMFPACK's, or the plain one in a build without it.
std::unique_ptr<Condensation::Method> make_sparse_method(const LinearStructure& structure);
/// The same by Eigen's sparse LU.
std::unique_ptr<Condensation::Method> make_plain_sparse_method(const LinearStructure& structure);

}  // namespace wavebalance::solvers
