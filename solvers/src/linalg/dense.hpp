#pragma once
#include <Eigen/Core>
#include <complex>
#include <concepts>
#include <memory>
#include <optional>

/// Dense factorizations and eigenvalues, compiled once: Eigen's templates for them need most of the compile
/// time of a source.
namespace wavebalance::solvers::detail {

/// P A = L U with partial pivoting, for double and std::complex<double>. Copies share the factors, which do
/// not change any more. The default is the factorization of a matrix without rows.
template <class Scalar>
class Lu {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  Lu();
  explicit Lu(const Matrix& matrix);

  /// Factorizes the n x n `matrix`. O(n^3).
  void compute(const Matrix& matrix);
  Eigen::Index size() const;

  /// A^-1 right. O(n^2) per column.
  Matrix solve(const Matrix& right) const;
  Vector solve(const Vector& right) const;
  /// A^-T right, without conjugation. O(n^2) per column.
  Matrix solve_transposed(const Matrix& right) const;
  /// A^-1, of a real matrix. O(n^3).
  Matrix inverse() const requires std::same_as<Scalar, double>;

  /// Whether a pivot is not finite, or at most `tolerance` times the largest, or below the normal numbers.
  /// This costs O(n), less than the condition number.
  bool is_singular(double tolerance = 0.0) const;
  /// Estimate of the condition number of a real matrix in the 1-norm. O(n^2).
  double condition() const requires std::same_as<Scalar, double>;
  /// 1 or -1, of a real matrix; 1 of a matrix without rows.
  int determinant_sign() const requires std::same_as<Scalar, double>;
  /// A logarithm of the determinant, with any multiple of 2 pi i. O(n).
  std::complex<double> log_determinant() const requires std::same_as<Scalar, std::complex<double>>;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

extern template class Lu<double>;
extern template class Lu<std::complex<double>>;

/// A B, A^T B and A B^T of any sizes. O(n^3).
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd product_transposed(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// A B^T only on and below the diagonal, where A has the same number of rows for each row of B.
Eigen::MatrixXd lower_product_transposed(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// A^* B.
Eigen::MatrixXcd adjoint_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);

/// exp(A) by a Padé approximant of A / 2^s and s squarings [Higham, SIAM J. Matrix Anal. Appl. 26, 2005].
/// O(n^3).
Eigen::MatrixXd exponential(const Eigen::MatrixXd& matrix);

/// The shortest x that minimises ||A x - b||, by complete orthogonal decomposition; A may be singular.
/// Columns that others make up to this share of the largest are dependent, and at least up to rounding.
/// O(n^3).
Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right,
                              double dependent = 0.0);

/// The lower factor L of A = L L^T; nothing unless A is positive definite. O(n^3).
std::optional<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix);
/// L^-1 right and L^-T right for a lower triangular L. O(n^2) per column.
Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& lower, const Eigen::MatrixXd& right);
Eigen::MatrixXd solve_lower_transposed(const Eigen::MatrixXd& lower, const Eigen::MatrixXd& right);

/// Eigenvalues in ascending order, and eigenvectors as columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// A x = value x of a symmetric A, orthonormal vectors; nothing if the iteration does not converge. O(n^3).
std::optional<SymmetricEigen> symmetric_eigen(const Eigen::MatrixXd& matrix);
/// A x = value B x with B positive definite, x^T B x = 1; nothing if B is not, or if the iteration does not
/// converge to finite vectors. O(n^3).
std::optional<SymmetricEigen> symmetric_eigen(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& metric);

/// The eigenvalues of a square matrix, in no order; NaN if the iteration does not converge. O(n^3).
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

/// Whether a power of a square matrix, by squaring it up to 12 times, has a norm below 1/2: all its
/// eigenvalues then lie within the unit circle. Products need a tenth of the time of eigenvalues. False
/// where that is not shown. O(n^3).
bool powers_vanish(Eigen::MatrixXd matrix);

/// How many eigenvalues of a square matrix lie outside the unit circle, with the rule of
/// linalg/multipliers.hpp for those near it. O(n^3).
int count_outside_circle(const Eigen::MatrixXd& matrix);

/// Eigenvalues in no order, and eigenvectors as columns.
struct GeneralEigen {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};

/// A x = value x of a square A; nothing if the iteration does not converge. O(n^3).
std::optional<GeneralEigen> general_eigen(const Eigen::MatrixXd& matrix);

}  // namespace wavebalance::solvers::detail
