#pragma once
#include <cholmod.h>

#include <Eigen/SparseCore>
#include <new>
#include <stdexcept>

namespace wavebalance::fem::detail {

/// CHOLMOD's settings and workspace, for one thread.
class CholmodSession {
 public:
  explicit CholmodSession(int supernodal) {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = supernodal;
    common_.final_ll = true;
    common_.quick_return_if_not_posdef = true;
  }
  ~CholmodSession() { cholmod_finish(&common_); }
  CholmodSession(const CholmodSession&) = delete;
  CholmodSession& operator=(const CholmodSession&) = delete;

  cholmod_common* common() { return &common_; }
  /// Throws as SymmetricFactor. A matrix that is not positive definite is no error.
  void check() const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common_.status == CHOLMOD_TOO_LARGE)
      throw std::runtime_error(
          "the factor of a matrix would have more than 2^31 entries; the structure must have fewer degrees of "
          "freedom");
    if (common_.status < CHOLMOD_OK) throw std::runtime_error("CHOLMOD could not factorise a matrix");
  }

 private:
  cholmod_common common_ = {};
};

/// Result of `use` for a matrix, or for its compressed copy.
template <class Use>
auto with_compressed(const Eigen::SparseMatrix<double>& matrix, Use use) {
  if (matrix.isCompressed()) return use(matrix);
  Eigen::SparseMatrix<double> compressed = matrix;
  compressed.makeCompressed();
  return use(compressed);
}

/// CHOLMOD's description of a compressed symmetric matrix, of which it reads the lower triangle. Nothing is
/// copied.
inline cholmod_sparse cholmod_view(const Eigen::SparseMatrix<double>& matrix) {
  cholmod_sparse view = {};
  view.nrow = static_cast<std::size_t>(matrix.rows());
  view.ncol = static_cast<std::size_t>(matrix.cols());
  view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  view.p = const_cast<int*>(matrix.outerIndexPtr());
  view.i = const_cast<int*>(matrix.innerIndexPtr());
  view.x = const_cast<double*>(matrix.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = true;
  view.packed = true;
  return view;
}

}  // namespace wavebalance::fem::detail
