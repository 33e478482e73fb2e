#pragma once
#include <Eigen/Core>
#include <array>
#include <complex>
#include <memory>
#include <stdexcept>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// The dynamic stiffness is singular to working precision: an undamped structure driven at a natural
/// frequency, or a pair whose symbol vanishes.
class SingularSystem : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The reduction of a structure to C contacts at one dynamic stiffness Z = s2 M + s1 C + s0 K, of one that
/// turns with parts of G and K_s too; S are their directions, C x n.
struct CondensedPoint {
  Eigen::MatrixXcd compliance;  ///< S Z^-1 S^T, C x C, m/N
  /// S Z^-1 L, m for a unit time function of each load: C L values, contact c by load l at c + C l. The
  /// loads are the columns of LinearStructure::load_shapes(); without forces there is one.
  Eigen::VectorXcd load_response;
  /// Derivatives of both along dZ = d2 M + d1 C + d0 K.
  Eigen::MatrixXcd compliance_slope;
  Eigen::VectorXcd load_response_slope;
  /// Estimated rounding errors, C each, by first-order bounds: of the diagonal of the compliance, m/N,
  /// whose entry (c, d) has at most the geometric mean of the errors of c and d, and of the load response,
  /// m.
  Eigen::VectorXd compliance_error = {}, load_response_error = {};
};

/// The complex factors of M, C and K and of what a structure that turns adds to them
/// (LinearStructure::turning), G and K_s.
using ImpedanceCoefficients = std::array<std::complex<double>, 5>;

/// The same factors for each k of a spectrum over translates; empty: zero.
using StiffnessSpectrum = std::array<Eigen::VectorXcd, 5>;

/// The factors at one k.
ImpedanceCoefficients coefficients_at(const StiffnessSpectrum& spectrum, Eigen::Index k);

/// CondensedPoint for each of the K values k of a spectrum, one row each: entry (c, d) of the compliance is
/// in column c + C d, the response of contact c to load l in column c + C l.
struct CondensedSpectrum {
  Eigen::MatrixXcd compliance, load_response;              ///< K x C^2, m/N; K x C L, m
  Eigen::MatrixXcd compliance_slope, load_response_slope;  ///< along the derivatives of the factors
  Eigen::MatrixXd compliance_error, load_response_error;   ///< K x C, m/N; K x C L, m
};

/// Estimated rounding errors of a condensation, relative.
struct RoundingErrors {
  double compliance = 0.0;     ///< largest error over k and contacts, over the largest diagonal entry
  double load_response = 0.0;  ///< of the linear response: 2-norms over k and contacts
};

/// How dynamic stiffnesses are solved. n degrees of freedom, C contacts.
enum class CondensationMethod {
  /// Tridiagonal, or else modal up to 1000 degrees of freedom, or else an LU, as for any damping or stiffness
  /// without symmetry; an LU also from the first
  /// condense() on in which the modal sum loses so many digits that the relative error of the linear
  /// response is estimated above 1e-8.
  automatic,
  tridiagonal,  ///< tridiagonal matrices (a bar): O(n C^2) per point, O(n) for one contact
  modal,  ///< modes computed once, O(n^3), then O(n C^2) per point; the damping must be diagonal in them
  dense,  ///< one dense LU per point, O(n^3); also for damping and stiffness without symmetry
  sparse  ///< one sparse LU per point; likewise
};

/// Condensation of a structure on its contacts, after which no cost depends on the
/// structure. Immutable after construction except for work space: one object per thread
/// that calls.
class Condensation {
 public:
  /// Throws std::invalid_argument as LinearStructure::validate does, for an unsymmetric mass, and for a
  /// method that the matrices do not admit: tridiagonal elimination or modes of an unsymmetric damping or
  /// stiffness or of matrices that turn; matrices that are not tridiagonal; modes when neither K nor M is
  /// positive definite or the damping couples them.
  explicit Condensation(const LinearStructure& structure,
                        CondensationMethod method = CondensationMethod::automatic);
  Condensation(Condensation&&) noexcept;
  Condensation& operator=(Condensation&&) noexcept;
  ~Condensation();

  int size() const;
  int contacts() const;
  /// Whether M, C and K are symmetric, and all compliances with them.
  bool symmetric() const { return symmetric_; }
  /// The method taken, never automatic.
  CondensationMethod method() const { return chosen_; }

  /// Threads that condense() may use, at least 1; 0: one per core of the machine. With more than one it
  /// factorises the dynamic stiffnesses of several k at the same time, each thread with a copy of the
  /// structure and separate factors: `dense` and `sparse` from 64 degrees of freedom on, `modal` of many
  /// contacts. The results are the same to the last digit. A BLAS with threads should be set to one
  /// (use_one_blas_thread()).
  void set_threads(int threads);
  int threads() const { return threads_; }

  /// Condenses for the factors {s2, s1, s0} of M, C, K and their derivatives {d2, d1, d0}, with two more of
  /// parts that turn. Throws
  /// SingularSystem.
  CondensedPoint dynamic_compliance(const ImpedanceCoefficients& factors,
                                    const ImpedanceCoefficients& derivatives);

  /// dynamic_compliance() for all k at once, with results resized to fit. A bar with load and contact only
  /// at its last degree of freedom needs one forward recursion, vectorised over k. K times the cost of a
  /// point. `load`: amplitudes of the loads at each k, K x L, which weight the error of the load response;
  /// empty: 1.
  void condense(const StiffnessSpectrum& factors, const StiffnessSpectrum& derivatives,
                CondensedSpectrum& result, const Eigen::MatrixXcd& load = {});

  /// Condition of the dynamic stiffnesses of the last condense(): the largest over k of (|s2| max|M| + |s1|
  /// max|C| + |s0| max|K|) ||x|| / ||b|| over the systems Z(k) x = b that were solved, a lower bound up to
  /// a factor of the row length. SingularSystem is thrown from 4.5e14 on; the vectorised recursion of a bar
  /// computes only the contact's entry of x.
  double condition() const { return condition_; }

  /// Rounding errors of the last condense(). The modal sums lose the digits by which their terms exceed
  /// them: far from the load in a weakly coupled structure all of them. An elimination keeps them there,
  /// and loses digits only near natural frequencies and antiresonances.
  const RoundingErrors& rounding() const { return rounding_; }

  /// The full displacement Z^-1 (load a - S^T b), n values, for a load of amplitude a and contact forces b
  /// (C). The structure's forces do not act.
  Eigen::VectorXcd recover(const ImpedanceCoefficients& factors, std::complex<double> load_amplitude,
                           const Eigen::VectorXcd& contact_forces);
  /// The same for the amplitudes of all L loads.
  Eigen::VectorXcd recover(const ImpedanceCoefficients& factors, const Eigen::VectorXcd& load_amplitudes,
                           const Eigen::VectorXcd& contact_forces);

  class Method;  ///< how one dynamic stiffness is solved; see condensation.cpp

 private:
  void condense_by_method(const StiffnessSpectrum& factors, const StiffnessSpectrum& derivatives,
                          CondensedSpectrum& result, const Eigen::MatrixXcd& load);

  std::unique_ptr<LinearStructure> structure_;  // kept while the modal method may be replaced
  CondensationMethod chosen_;
  bool symmetric_ = true;
  int loads_;
  int threads_ = 1;
  double condition_ = 0.0;
  RoundingErrors rounding_;
  std::unique_ptr<Method> method_;
};

}  // namespace wavebalance::solvers
