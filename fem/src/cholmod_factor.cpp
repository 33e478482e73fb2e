#include <algorithm>
#include <limits>

#include "cholmod_session.hpp"
#include "symmetric_factor.hpp"

namespace wavebalance::fem::detail {
namespace {

/// Columns that are solved at once, which bounds the copies of a solve.
constexpr Eigen::Index columns_at_once = 32;

cholmod_dense dense_view(double* values, Eigen::Index rows, Eigen::Index columns) {
  cholmod_dense view = {};
  view.nrow = view.d = static_cast<std::size_t>(rows);
  view.ncol = static_cast<std::size_t>(columns);
  view.nzmax = static_cast<std::size_t>(rows * columns);
  view.x = values;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

/// The least square of the diagonal of L.
double least_pivot(const cholmod_factor& factor) {
  const auto* values = static_cast<const double*>(factor.x);
  double least = std::numeric_limits<double>::infinity();
  if (!factor.is_super) {
    const auto* columns = static_cast<const int*>(factor.p);
    for (std::size_t column = 0; column < factor.n; ++column)
      least = std::min(least, values[columns[column]] * values[columns[column]]);
    return least;
  }
  const auto* first = static_cast<const int*>(factor.super);
  const auto* rows = static_cast<const int*>(factor.pi);
  const auto* places = static_cast<const int*>(factor.px);
  for (std::size_t block = 0; block < factor.nsuper; ++block) {
    const std::ptrdiff_t height = rows[block + 1] - rows[block], width = first[block + 1] - first[block];
    for (std::ptrdiff_t column = 0; column < width; ++column) {
      const double entry = values[places[block] + column * (height + 1)];
      least = std::min(least, entry * entry);
    }
  }
  return least;
}

}  // namespace

struct SymmetricFactor::Implementation {
  CholmodSession session{CHOLMOD_AUTO};
  cholmod_factor* factor = nullptr;
  Eigen::Index rows = 0;
  double smallest = 0.0;

  Implementation() = default;
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() { cholmod_free_factor(&factor, session.common()); }

  void make(const Eigen::SparseMatrix<double>& matrix) {
    rows = matrix.rows();
    if (matrix.nonZeros() == 0) return;  // not definite, and no matrix to CHOLMOD
    cholmod_sparse view = cholmod_view(matrix);
    factor = cholmod_analyze(&view, session.common());
    session.check();
    cholmod_factorize(&view, factor, session.common());
    session.check();
    if (session.common()->status == CHOLMOD_OK && factor->minor == factor->n) smallest = least_pivot(*factor);
  }
};

SymmetricFactor::SymmetricFactor(const Eigen::SparseMatrix<double>& matrix)
    : implementation_(std::make_unique<Implementation>()) {
  with_compressed(matrix, [&](const auto& compressed) { implementation_->make(compressed); });
}

SymmetricFactor::~SymmetricFactor() = default;
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;

bool SymmetricFactor::positive_definite() const { return implementation_->smallest > 0.0; }

Eigen::Index SymmetricFactor::rows() const { return implementation_->rows; }

double SymmetricFactor::smallest_pivot() const { return implementation_->smallest; }

// CHOLMOD does not change a factor that it solves with; its workspace belongs to the call.
Eigen::MatrixXd SymmetricFactor::solve(const Eigen::MatrixXd& right) const {
  CholmodSession own(CHOLMOD_AUTO);
  Eigen::MatrixXd solution(right.rows(), right.cols());
  for (Eigen::Index first = 0; first < right.cols(); first += columns_at_once) {
    const Eigen::Index count = std::min(columns_at_once, right.cols() - first);
    cholmod_dense given = dense_view(const_cast<double*>(right.col(first).data()), right.rows(), count);
    cholmod_dense* found = cholmod_solve(CHOLMOD_A, implementation_->factor, &given, own.common());
    own.check();
    if (found == nullptr) throw std::runtime_error("CHOLMOD could not solve with a factor");
    std::copy_n(static_cast<const double*>(found->x), right.rows() * count, solution.col(first).data());
    cholmod_free_dense(&found, own.common());
  }
  return solution;
}

}  // namespace wavebalance::fem::detail
