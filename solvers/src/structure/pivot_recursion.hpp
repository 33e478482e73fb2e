#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "wavebalance/solvers/structure/condensation.hpp"

namespace wavebalance::solvers {

/// A pivot below this share of the terms that it is the sum of has lost half of its digits.
constexpr double weak_pivot = 1e-8;

/// The pivots d_i = z_ii - z_{i,i-1}^2 / d_{i-1} of symmetric tridiagonal dynamic stiffnesses Z(k), k =
/// 0..K-1, and their derivatives along the rates, row by row for all k at once: 1/d_n is the compliance of
/// the last degree of freedom, and no back substitution is needed. Real and imaginary parts lie apart, in
/// blocks of a fixed size, so that the loops vectorise and nothing is allocated on the way.
class PivotRecursion {
 public:
  PivotRecursion(const StiffnessSpectrum& factors, const StiffnessSpectrum& rates);

  /// Entries of mass, damping and stiffness in one row.
  struct Row {
    std::array<double, 3> diagonal;
    std::array<double, 3> off;  ///< to the left of the diagonal; zero in the first row
  };
  void eliminate(const Row& row);

  /// Whether a pivot nearly vanished: elimination without row exchanges is then not to be trusted.
  bool weak() const { return weak_; }
  /// 1/d and its derivative after the last row, K values each.
  void last(Eigen::Ref<Eigen::VectorXcd> inverse, Eigen::Ref<Eigen::VectorXcd> slope) const;

 private:
  static constexpr Eigen::Index block_size = 8;
  using Block = Eigen::Array<double, block_size, 1>;
  struct Parts {
    Block re, im;
  };
  struct Chunk {  // of k; the last one is filled up with its last value
    std::array<Parts, 3> factors, rates;
    std::array<Block, 3> magnitudes;  // of the factors
    Parts inverse, slope;             // of 1/d
  };
  static Parts combine(const std::array<Parts, 3>& spectrum, const std::array<double, 3>& entries);
  void eliminate(const Row& row, Chunk& chunk);

  std::vector<Chunk> chunks_;
  bool first_ = true;
  bool weak_ = false;
};

}  // namespace wavebalance::solvers
