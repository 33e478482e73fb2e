#include "linalg/dense.hpp"
#include "structure/condensation_direct.hpp"

namespace wavebalance::solvers {
namespace {

class DenseMethod final : public DirectMethod {
 public:
  using DirectMethod::DirectMethod;

  std::unique_ptr<Method> twin() const override {
    return size() < least_size_for_threads ? nullptr : std::make_unique<DenseMethod>(structure());
  }

 private:
  void factorize(const ImpedanceCoefficients& factors) override {
    solver_.compute(Eigen::MatrixXcd(combine(factors)));
  }
  Eigen::MatrixXcd solve(const Eigen::MatrixXcd& right) const override { return solver_.solve(right); }
  Eigen::MatrixXcd solve_transposed(const Eigen::MatrixXcd& right) override {
    return solver_.solve_transposed(right);
  }

  detail::Lu<std::complex<double>> solver_;
};

}  // namespace

std::unique_ptr<Condensation::Method> make_dense_method(const LinearStructure& structure) {
  return std::make_unique<DenseMethod>(structure);
}

}  // namespace wavebalance::solvers
