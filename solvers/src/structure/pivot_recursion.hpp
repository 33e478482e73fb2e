#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "wavebalance/solvers/structure/condensation.hpp"

namespace wavebalance::solvers {

/// A pivot below this share of the terms that it is the sum of has lost half of its digits.
constexpr double weak_pivot = 1e-8;

/// The pivots d_i = z_ii - z_{i,i-1}^2 / d_{i-1} of symmetric tridiagonal dynamic stiffnesses Z(k), k =
/// 0..K-1, and their derivatives, row by row for all k at once: 1/d_n is the compliance of
/// the last degree of freedom, and no back substitution is needed. Real and imaginary parts lie apart, in
/// blocks of a fixed size, so that the loops vectorise and do not allocate.
class PivotRecursion {
 public:
  PivotRecursion(const StiffnessSpectrum& factors, const StiffnessSpectrum& derivatives);

  /// Entries of mass, damping and stiffness in one row.
  struct Row {
    std::array<double, 3> diagonal;
    std::array<double, 3> off;  ///< to the left of the diagonal; zero in the first row
  };
  void eliminate(const Row& row);

  /// Whether a pivot nearly vanished, so that elimination without row exchanges is inaccurate.
  bool weak() const { return weak_; }
  /// 1/d, its derivative and its estimated rounding error after the last row, K values each.
  void last(Eigen::Ref<Eigen::VectorXcd> inverse, Eigen::Ref<Eigen::VectorXcd> slope,
            Eigen::Ref<Eigen::VectorXd> error) const;

 private:
  static constexpr Eigen::Index block_size = 8;
  using Block = Eigen::Array<double, block_size, 1>;
  struct Parts {
    Block re, im;
  };
  struct Chunk {  // a block of values of k; the last block is filled up with its last value
    std::array<Parts, 3> factors, derivatives;
    std::array<Block, 3> magnitudes;  // of the factors, times weak_pivot
    Parts inverse, slope;             // 1/d and its derivative
    Block error = Block::Zero();      // of d, over rounding_unit / weak_pivot
  };
  static Parts combine(const std::array<Parts, 3>& spectrum, const std::array<double, 3>& entries);
  void eliminate(const Row& row, Chunk& chunk);

  std::vector<Chunk> chunks_;
  bool first_ = true;
  bool weak_ = false;
};

}  // namespace wavebalance::solvers
