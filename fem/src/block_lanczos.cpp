#include "block_lanczos.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "dense.hpp"
#include "sparse_product.hpp"

namespace wavebalance::fem::detail {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Basis (n x capacity) and the projected operator. The last `fresh_` columns of the basis are those to which
/// the operator has not been applied.
class BlockLanczos {
 public:
  BlockLanczos(const SymmetricFactor& factor, const Eigen::SparseMatrix<double>& mass, Eigen::Index count,
               const LanczosLimits& limits)
      : factor_(factor),
        mass_(mass),
        count_(count),
        width_(std::clamp<Eigen::Index>(count / 4, 2, 8)),
        limits_(limits),
        basis_(mass.rows(), std::max<Eigen::Index>(2 * count + 4 * width_, 24) + width_),
        projected_(Eigen::MatrixXd::Zero(basis_.cols(), basis_.cols())),
        generator_(limits.seed) {}

  LanczosResult run() {
    append_random();
    if (fresh_ == 0) throw std::domain_error("eigenmodes: mass is zero");
    for (int cycle = 0; cycle < limits_.max_cycles; ++cycle) {
      while (fresh_ > 0 && size_ + width_ <= basis_.cols()) {
        expand();
        if (fresh_ == 0) append_random();  // an invariant subspace
        const Eigen::Index found = converged();
        if (found >= count_ || !limits_.go_on(found)) return result();
      }
      if (fresh_ == 0) break;  // as many pairs as the mass has
      restart();
    }
    return result();
  }

 private:
  struct Ritz {
    Eigen::VectorXd values;     // ascending
    Eigen::MatrixXd vectors;    // in the basis
    Eigen::VectorXd residuals;  // norms
  };

  Eigen::Index applied() const { return size_ - fresh_; }
  auto known() const { return basis_.leftCols(size_); }

  /// One pass through the factor and the mass for all columns of the fresh block.
  void expand() {
    const Eigen::Index first = applied(), block = fresh_;
    Eigen::MatrixXd image = factor_.solve(momenta_);
    Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero(size_, block);
    coupling_ = orthonormalise(image, coefficients, largest_);
    projected_.block(0, first, size_, block) = coefficients;
    projected_.block(first, 0, block, size_) = coefficients.transpose();
    append(image);
    update_ritz(block);
  }

  /// A random block in the range of the operator, or none if the basis spans it already.
  void append_random() {
    Eigen::MatrixXd block(basis_.rows(), std::min(width_, basis_.cols() - size_));
    const double range = 0.5 * static_cast<double>(std::mt19937::max());
    for (double& entry : block.reshaped()) entry = static_cast<double>(generator_()) / range - 1.0;
    Eigen::MatrixXd image = factor_.solve(symmetric_product(mass_, block));
    image.colwise().normalize();
    block = symmetric_product(mass_, image);
    const double scale = std::sqrt(std::max(0.0, (image.cwiseProduct(block)).colwise().sum().maxCoeff()));
    if (!(scale > 0.0)) return;
    Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero(size_, image.cols());
    orthonormalise(image, coefficients, 1e3 * scale);  // rounding of a solve is no new direction
    append(image);
  }

  void append(const Eigen::MatrixXd& block) {
    fresh_ = block.cols();
    basis_.middleCols(size_, fresh_) = block;
    size_ += fresh_;
  }

  /// Replaces W by Q with W = V C + Q R, Q orthonormal to itself and to the basis V in the inner product of
  /// M, adds C to `coefficients` and returns R. Directions of W below rounding relative to `scale` are left
  /// out of Q. Each pass projects and then computes a square root of the Gram matrix; a third corrects the
  /// rounding of the second. M Q is kept.
  Eigen::MatrixXd orthonormalise(Eigen::MatrixXd& block, Eigen::MatrixXd& coefficients, double scale) {
    Eigen::MatrixXd root = Eigen::MatrixXd::Identity(block.cols(), block.cols());
    double least = 8.0 * eps * scale;
    for (int pass = 0; pass < 4 && block.cols() > 0; ++pass) {
      momenta_ = symmetric_product(mass_, block);
      const Eigen::MatrixXd along = transposed_product(known(), momenta_);
      coefficients += along * root;
      Eigen::MatrixXd gram = transposed_product(block, momenta_) - along.transpose() * along;
      block -= product(known(), along);
      if (pass == 0) {  // too much has cancelled to use the Gram matrix
        momenta_ = symmetric_product(mass_, block);
        gram = transposed_product(block, momenta_);
      }
      const double change =
          along.norm() + (gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).norm();
      normalise(block, gram, root, least);
      if (pass > 0 && change < 1e-8) {
        // The projected parts are still in M Q, from which the next image follows.
        if (along.norm() > 1e-14) momenta_ = symmetric_product(mass_, block);
        break;
      }
      least = 1e-10;
    }
    return root;
  }

  /// W = Q R by the eigenvectors of W^T M W; `momenta_` turns with W.
  void normalise(Eigen::MatrixXd& block, const Eigen::MatrixXd& gram, Eigen::MatrixXd& root, double least) {
    const Eigen::Index columns = gram.rows();
    const auto eigen =
        generalized_eigen((gram + gram.transpose()) / 2.0, Eigen::MatrixXd::Identity(columns, columns));
    Eigen::Index kept = 0;
    while (eigen && kept < columns && eigen->values[columns - 1 - kept] > least * least) ++kept;
    if (kept == 0) {
      block.resize(block.rows(), 0);
      momenta_.resize(block.rows(), 0);
      root.resize(0, root.cols());
      return;
    }
    const Eigen::MatrixXd directions = eigen->vectors.rightCols(kept);
    const Eigen::VectorXd lengths = eigen->values.tail(kept).cwiseSqrt();
    const Eigen::MatrixXd turn = directions * lengths.cwiseInverse().asDiagonal();
    block = product(block, turn);
    momenta_ = product(momenta_, turn);
    root = (lengths.asDiagonal() * directions.transpose() * root).eval();
  }

  /// Ritz pairs of the columns to which the operator has been applied, the last `block` of them at once.
  void update_ritz(Eigen::Index block) {
    const Eigen::Index size = applied();
    auto eigen =
        generalized_eigen(projected_.topLeftCorner(size, size), Eigen::MatrixXd::Identity(size, size));
    if (!eigen)
      throw std::domain_error("eigenmodes: the stiffness or the mass has entries that are too large");
    ritz_ = {std::move(eigen->values), std::move(eigen->vectors), {}};
    ritz_.residuals = (coupling_ * ritz_.vectors.bottomRows(block)).colwise().norm().transpose();
    largest_ = ritz_.values[size - 1];
  }

  /// How many of the wanted pairs have converged, from the largest on.
  Eigen::Index converged() const {
    const double rounding = 4.0 * eps * coupling_.norm();
    const Eigen::Index size = ritz_.values.size();
    Eigen::Index found = 0;
    while (found < std::min(count_, size)) {
      const double value = ritz_.values[size - 1 - found];
      if (!(value > 8.0 * eps * largest_)) break;  // of the null space of the mass
      if (ritz_.residuals[size - 1 - found] > std::max(limits_.tolerance * value, rounding)) break;
      ++found;
    }
    return found;
  }

  /// Keeps the best Ritz vectors and the fresh block.
  void restart() {
    const Eigen::Index size = applied(), keep = std::min(size, count_ + (size - count_) / 3 + 1);
    combine(ritz_.vectors.rightCols(keep));
    basis_.middleCols(keep, fresh_) = basis_.middleCols(size, fresh_).eval();
    projected_.setZero();
    projected_.topLeftCorner(keep, keep) = ritz_.values.tail(keep).asDiagonal();
    size_ = keep + fresh_;
    ritz_ = {ritz_.values.tail(keep).eval(), Eigen::MatrixXd::Identity(keep, keep),
             ritz_.residuals.tail(keep).eval()};
  }

  /// The first columns of the basis become the combinations of them, strip by strip of its rows.
  void combine(const Eigen::MatrixXd& weights) {
    constexpr Eigen::Index strip = 8192;
    for (Eigen::Index row = 0; row < basis_.rows(); row += strip) {
      const Eigen::Index rows = std::min(strip, basis_.rows() - row);
      basis_.block(row, 0, rows, weights.cols()) =
          product(basis_.block(row, 0, rows, weights.rows()), weights);
    }
  }

  LanczosResult result() {
    const Eigen::Index found = converged();
    combine(ritz_.vectors.rightCols(found).rowwise().reverse());
    basis_.conservativeResize(Eigen::NoChange, found);
    return {ritz_.values.tail(found).reverse(), std::move(basis_), found == count_};
  }

  const SymmetricFactor& factor_;
  const Eigen::SparseMatrix<double>& mass_;
  Eigen::Index count_, width_;
  LanczosLimits limits_;
  Eigen::MatrixXd basis_, projected_;
  std::mt19937 generator_;
  Eigen::Index size_ = 0, fresh_ = 0;
  Eigen::MatrixXd momenta_;   // of the fresh block
  Eigen::MatrixXd coupling_;  // of the block applied last to the fresh one
  Ritz ritz_;
  double largest_ = 0.0;
};

}  // namespace

LanczosResult block_lanczos(const SymmetricFactor& factor, const Eigen::SparseMatrix<double>& mass,
                            Eigen::Index count, const LanczosLimits& limits) {
  return BlockLanczos(factor, mass, count, limits).run();
}

}  // namespace wavebalance::fem::detail
