#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "cholmod_session.hpp"
#include "dense.hpp"
#include "symmetric_factor.hpp"

// L D L^T of an indefinite matrix by the multifrontal method [DR83], whose order and blocks of columns
// CHOLMOD finds. CHOLMOD has dense blocks only for L L^T.
namespace wavebalance::fem::detail {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// The order of elimination, and columns of equal pattern in blocks with the rows that each block has.
class Blocks {
 public:
  explicit Blocks(const Sparse& matrix) : session_(CHOLMOD_SUPERNODAL) {
    cholmod_sparse view = cholmod_view(matrix);
    factor_ = cholmod_analyze(&view, session_.common());
    session_.check();
  }
  ~Blocks() { cholmod_free_factor(&factor_, session_.common()); }
  Blocks(const Blocks&) = delete;
  Blocks& operator=(const Blocks&) = delete;

  std::size_t count() const { return factor_->nsuper; }
  std::size_t size() const { return factor_->n; }
  /// The row of the matrix that is eliminated at a place.
  const int* order() const { return static_cast<const int*>(factor_->Perm); }
  int first_column(std::size_t block) const { return static_cast<const int*>(factor_->super)[block]; }
  int columns(std::size_t block) const { return first_column(block + 1) - first_column(block); }
  /// Places, ascending; the first belong to the columns.
  const int* rows(std::size_t block) const { return static_cast<const int*>(factor_->s) + start(block); }
  int height(std::size_t block) const { return start(block + 1) - start(block); }

 private:
  int start(std::size_t block) const { return static_cast<const int*>(factor_->pi)[block]; }

  CholmodSession session_;
  cholmod_factor* factor_ = nullptr;
};

/// Contribution of a block to the blocks after it: a symmetric matrix over `rows`, its lower triangle.
struct Contribution {
  std::vector<int> rows;
  Eigen::MatrixXd matrix;
};

class Elimination {
 public:
  explicit Elimination(const Sparse& matrix)
      : matrix_(matrix), blocks_(matrix), place_(blocks_.size()), local_(blocks_.size()) {
    for (std::size_t place = 0; place < blocks_.size(); ++place)
      place_[static_cast<std::size_t>(blocks_.order()[place])] = static_cast<int>(place);
  }

  Inertia run() {
    result_ = {true, 0, std::numeric_limits<double>::infinity()};
    for (std::size_t block = 0; block < blocks_.count() && result_.complete; ++block) eliminate(block);
    return result_;
  }

 private:
  /// Blocks are in the postorder of their tree: the contributions to a block are the last ones.
  void eliminate(std::size_t block) {
    const int* rows = blocks_.rows(block);
    const int height = blocks_.height(block), columns = blocks_.columns(block);
    for (int i = 0; i < height; ++i) local_[static_cast<std::size_t>(rows[i])] = i;
    Eigen::MatrixXd front = Eigen::MatrixXd::Zero(height, height);
    add_matrix(front, block);
    const int end = blocks_.first_column(block) + columns;
    while (!contributions_.empty() && contributions_.back().rows.front() < end) {
      add_contribution(front, contributions_.back());
      contributions_.pop_back();
    }
    for (int first = 0; first < columns && result_.complete; first += panel_width)
      eliminate_panel(front, first, std::min(first + panel_width, columns));
    const int rest = height - columns;
    if (rest > 0)
      contributions_.push_back(
          {std::vector<int>(rows + columns, rows + height), front.bottomRightCorner(rest, rest)});
  }

  void add_matrix(Eigen::MatrixXd& front, std::size_t block) const {
    for (int column = 0; column < blocks_.columns(block); ++column) {
      const int place = blocks_.first_column(block) + column;
      for (Sparse::InnerIterator entry(matrix_, blocks_.order()[place]); entry; ++entry) {
        const int row = place_[static_cast<std::size_t>(entry.row())];
        if (row >= place) front(local_[static_cast<std::size_t>(row)], column) += entry.value();
      }
    }
  }

  void add_contribution(Eigen::MatrixXd& front, const Contribution& given) const {
    const auto size = static_cast<Eigen::Index>(given.rows.size());
    std::vector<int> to;
    for (const int row : given.rows) to.push_back(local_[static_cast<std::size_t>(row)]);
    for (Eigen::Index column = 0; column < size; ++column) {
      auto target = front.col(to[static_cast<std::size_t>(column)]);
      for (Eigen::Index row = column; row < size; ++row)
        target[to[static_cast<std::size_t>(row)]] += given.matrix(row, column);
    }
  }

  /// Eliminates the columns from `first` to `last` and subtracts L D L^T from the lower triangle after them.
  void eliminate_panel(Eigen::MatrixXd& front, Eigen::Index first, Eigen::Index last) {
    const Eigen::Index height = front.rows(), width = last - first;
    Eigen::VectorXd pivots(width);
    for (Eigen::Index column = first; column < last; ++column) {
      const double pivot = front(column, column);
      if (!count(pivot)) return;
      pivots[column - first] = pivot;
      const Eigen::Index below = height - column - 1;
      const Eigen::VectorXd scaled = front.col(column).segment(column + 1, last - column - 1) / pivot;
      for (Eigen::Index next = column + 1; next < last; ++next)
        front.col(next).tail(height - next) -=
            scaled[next - column - 1] * front.col(column).tail(height - next);
      front.col(column).tail(below) /= pivot;
    }
    const Eigen::MatrixXd factor = front.block(last, first, height - last, width);
    const Eigen::MatrixXd times_pivots = factor * pivots.asDiagonal();
    for (Eigen::Index start = 0; start < factor.rows(); start += strip_width) {
      const Eigen::Index strip = std::min<Eigen::Index>(strip_width, factor.rows() - start);
      front.block(last + start, last + start, factor.rows() - start, strip) -=
          product_transposed(times_pivots.bottomRows(factor.rows() - start), factor.middleRows(start, strip));
    }
  }

  bool count(double pivot) {
    if (pivot == 0.0 || !std::isfinite(pivot)) {
      result_.complete = false;
      return false;
    }
    if (pivot < 0.0) ++result_.negative;
    result_.smallest = std::min(result_.smallest, pivot);
    return true;
  }

  static constexpr int panel_width = 96, strip_width = 256;
  const Sparse& matrix_;
  Blocks blocks_;
  std::vector<int> place_;  // of each row in the order of elimination
  std::vector<int> local_;  // row of the current front, of each place
  std::vector<Contribution> contributions_;
  Inertia result_;
};

}  // namespace

Inertia inertia(const Sparse& matrix) {
  if (matrix.nonZeros() == 0) return {matrix.rows() == 0, 0, 0.0};  // no matrix to CHOLMOD
  return with_compressed(matrix, [](const Sparse& compressed) { return Elimination(compressed).run(); });
}

}  // namespace wavebalance::fem::detail
