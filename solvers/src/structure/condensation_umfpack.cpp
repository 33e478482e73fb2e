#include <umfpack.h>

#include <array>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "structure/condensation_direct.hpp"

namespace wavebalance::solvers {
namespace {

// UMFPACK's arrays of complex numbers hold real and imaginary parts by turns, as std::complex does.
const double* parts_of(const std::complex<double>* values) { return reinterpret_cast<const double*>(values); }
double* parts_of(std::complex<double>* values) { return reinterpret_cast<double*>(values); }

void check(int status) {
  if (status == UMFPACK_OK) return;
  if (status == UMFPACK_WARNING_singular_matrix)
    throw SingularSystem("the dynamic stiffness is singular: a pivot of its LU is zero");
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  throw std::runtime_error("UMFPACK could not factorise a dynamic stiffness (its status is " +
                           std::to_string(status) + ")");
}

/// Analysis or factor, freed with its owner.
template <void (*free_object)(void**)>
struct UmfpackObject {
  void* pointer = nullptr;

  UmfpackObject() = default;
  UmfpackObject(const UmfpackObject&) = delete;
  UmfpackObject& operator=(const UmfpackObject&) = delete;
  ~UmfpackObject() { reset(); }
  void reset() {
    if (pointer != nullptr) free_object(&pointer);
  }
};

/// Sparse LU in dense fronts [T. A. Davis, Algorithm 832: UMFPACK, ACM TOMS 30 (2004),
/// doi:10.1145/992200.992206]; the pattern is analysed once for all harmonics.
class UmfpackMethod final : public DirectMethod {
 public:
  explicit UmfpackMethod(const LinearStructure& structure) : DirectMethod(structure) {
    umfpack_zi_defaults(control_.data());
    control_[UMFPACK_IRSTEP] = 0;  // solves are as exact as with the other methods
    const SparseComplex pattern = combine({1.0, 1.0, 1.0});
    check(umfpack_zi_symbolic(size(), size(), pattern.outerIndexPtr(), pattern.innerIndexPtr(), nullptr,
                              nullptr, &symbolic_.pointer, control_.data(), nullptr));
  }

  std::unique_ptr<Method> twin() const override {
    return size() < least_size_for_threads ? nullptr : std::make_unique<UmfpackMethod>(structure());
  }

 private:
  void factorize(const ImpedanceCoefficients& factors) override {
    numeric_.reset();
    matrix_ = combine(factors);
    check(umfpack_zi_numeric(matrix_.outerIndexPtr(), matrix_.innerIndexPtr(), parts_of(matrix_.valuePtr()),
                             nullptr, symbolic_.pointer, &numeric_.pointer, control_.data(), nullptr));
  }

  Eigen::MatrixXcd solve(const Eigen::MatrixXcd& right) const override {
    return solve_system(UMFPACK_A, right);
  }
  Eigen::MatrixXcd solve_transposed(const Eigen::MatrixXcd& right) override {
    return solve_system(UMFPACK_Aat, right);
  }

  // `system`: UMFPACK_A, or UMFPACK_Aat for the transposed matrix.
  Eigen::MatrixXcd solve_system(int system, const Eigen::MatrixXcd& right) const {
    Eigen::MatrixXcd solution(right.rows(), right.cols());
    const auto rows = static_cast<std::size_t>(right.rows());
    std::vector<int> places(rows);
    std::vector<double> work(4 * rows);
    for (Eigen::Index column = 0; column < right.cols(); ++column)
      check(umfpack_zi_wsolve(system, matrix_.outerIndexPtr(), matrix_.innerIndexPtr(),
                              parts_of(matrix_.valuePtr()), nullptr, parts_of(solution.col(column).data()),
                              nullptr, parts_of(right.col(column).data()), nullptr, numeric_.pointer,
                              control_.data(), nullptr, places.data(), work.data()));
    return solution;
  }

  std::array<double, UMFPACK_CONTROL> control_{};
  SparseComplex matrix_;
  UmfpackObject<umfpack_zi_free_symbolic> symbolic_;
  UmfpackObject<umfpack_zi_free_numeric> numeric_;
};

}  // namespace

std::unique_ptr<Condensation::Method> make_sparse_method(const LinearStructure& structure) {
  return std::make_unique<UmfpackMethod>(structure);
}

}  // namespace wavebalance::solvers
