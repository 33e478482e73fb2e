#pragma once
#include <Eigen/Core>
#include <concepts>
#include <functional>
#include <utility>
#include <vector>

#include "wavebalance/solvers/time/time_basis.hpp"

namespace wavebalance::solvers {

/// What is asked of a periodic wavelet transform: from coefficients in the order [s_levels | d_levels | ..
/// | d_1] to those of the finest translates, an orthogonal map that takes a cyclic shift of a block of n
/// coefficients by one to a cyclic shift of the M translates by M/n.
template <class Transform>
concept WaveletTransform = std::copy_constructible<Transform> &&
    requires(const Transform& transform, const Eigen::VectorXd& coefficients, int levels) {
  { transform.synthesis(coefficients, levels) } -> std::convertible_to<Eigen::VectorXd>;
};

/// Functions selected from the M of a MultiscaleBasis: ascending, without repetition.
using Selection = std::vector<int>;

/// The space of the M translates of a time basis, M / 2^levels coarse scaling functions and blocks of detail
/// wavelets, each twice as many as the block before (the first as many as the scaling functions). Function k
/// of block b is number first(b) + k; block 0 holds the scaling functions. Below, W stands for the analysis
/// and P for the restriction to a selection S.
///
/// A block consists of the translates of one function, so that whatever involves two functions is read from
/// one cyclic correlation of their blocks. Immutable after construction; may be shared between threads.
class MultiscaleBasis {
 public:
  using Synthesis = std::function<Eigen::VectorXd(const Eigen::VectorXd& coefficients, int levels)>;

  /// With values at `points` = N uniform points, a multiple of M. Throws std::invalid_argument for other
  /// points, unless levels >= 0 and 2^levels divides M, and when the synthesis is not orthogonal on the first
  /// function of every block. O(levels N log N).
  MultiscaleBasis(const AnyTimeBasis& basis, int points, Synthesis synthesis, int levels);

  template <WaveletTransform Transform>
  MultiscaleBasis(const AnyTimeBasis& basis, int points, Transform transform, int levels)
      : MultiscaleBasis(basis, points, Synthesis([transform](const Eigen::VectorXd& a, int l) {
                          return transform.synthesis(a, l);
                        }),
                        levels) {}

  int functions() const { return functions_; }  ///< M
  int points() const { return points_; }        ///< N
  int blocks() const { return static_cast<int>(blocks_.size()); }
  int size(int block) const { return block == 0 ? coarse_ : coarse_ << (block - 1); }
  int first(int block) const { return block == 0 ? 0 : size(block); }
  int block_of(int function) const;
  /// Where a function lies: the centre of its square, as a fraction of the period in [0, 1).
  double centre(int function) const;
  /// The functions of a block whose centres lie within `radius` of `time` on the circle (at least one).
  std::vector<int> around(int block, double time, double radius) const;
  /// The first `count` blocks, which span a whole coarser level. Throws std::invalid_argument outside
  /// 1..blocks().
  Selection uniform(int count) const;
  /// Throws std::invalid_argument for a selection that is empty, does not ascend or leaves 0..M-1.
  void require_selection(const Selection& selection) const;

  /// Values of the selected functions at the N points, N x |S|. O(N |S|).
  Eigen::MatrixXd samples(const Selection& selection) const;
  /// P W A W^T P^T of the circulant A whose symbol (M/2 + 1) is given. O(blocks^2 M log M + |S|^2).
  Eigen::MatrixXd section(const Eigen::VectorXcd& symbol, const Selection& selection) const;
  /// Products of every shift of every block's function with M coefficients, given by their spectrum over
  /// translates (M/2 + 1): entry (m, b) is that of function 0 of block b shifted by m/M. O(blocks M log M).
  Eigen::MatrixXd correlations(const Eigen::VectorXcd& coefficients) const;
  /// m of a function: by how many fine translates it is shifted against function 0 of its block.
  int offset(int function) const {
    const int b = block_of(function);
    return (function - first(b)) * (functions_ / size(b));
  }
  /// All M coefficients for a spectrum over translates: W. O(blocks M log M).
  Eigen::VectorXd analysis(const Eigen::VectorXcd& coefficients) const;

 private:
  struct Block {
    Eigen::VectorXcd spectrum;  // spectrum over translates of function 0
    Eigen::VectorXd samples;    // N values of function 0
    double centre = 0.0;        // centre of function 0
  };

  int functions_;
  int points_;
  int coarse_;
  std::vector<Block> blocks_;
};

}  // namespace wavebalance::solvers
