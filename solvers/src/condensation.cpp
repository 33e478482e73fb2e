#include "wavebalance/solvers/condensation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "condensation_method.hpp"

namespace wavebalance::solvers {
namespace {

bool is_tridiagonal(const Eigen::SparseMatrix<double>& matrix) {
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry)
      if (std::abs(entry.row() - entry.col()) > 1 && entry.value() != 0.0) return false;
  return true;
}

void require_symmetric(const Eigen::SparseMatrix<double>& matrix, const char* name) {
  const Eigen::SparseMatrix<double> transposed = matrix.transpose();
  constexpr double tolerance = 1e-12;
  if ((matrix - transposed).norm() <= tolerance * matrix.norm()) return;
  throw std::invalid_argument("Condensation: " + std::string(name) +
                              " is not symmetric (relative asymmetry " +
                              std::to_string((matrix - transposed).norm() / matrix.norm()) + ")");
}

double largest_entry(const Eigen::SparseMatrix<double>& matrix) {
  double largest = 0.0;
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry)
      largest = std::max(largest, std::abs(entry.value()));
  return largest;
}

std::unique_ptr<Condensation::Method> choose_method(const LinearStructure& structure) {
  structure.validate();
  require_symmetric(structure.mass, "mass");
  require_symmetric(structure.damping, "damping");
  require_symmetric(structure.stiffness, "stiffness");
  const bool banded = is_tridiagonal(structure.mass) && is_tridiagonal(structure.damping) &&
                      is_tridiagonal(structure.stiffness);
  return banded ? make_tridiagonal_method(structure) : make_sparse_method(structure);
}

}  // namespace

StiffnessScale::StiffnessScale(const LinearStructure& structure)
    : largest_{largest_entry(structure.mass), largest_entry(structure.damping),
               largest_entry(structure.stiffness)} {}

void StiffnessScale::require_regular(const StiffnessFactors& factors, const Eigen::VectorXcd& solution,
                                     double right_norm) const {
  const double scale = std::abs(factors[0]) * largest_[0] + std::abs(factors[1]) * largest_[1] +
                       std::abs(factors[2]) * largest_[2];
  constexpr double largest_condition = 0.1 / std::numeric_limits<double>::epsilon();
  if (solution.norm() * scale <= largest_condition * right_norm) return;
  throw SingularSystem(
      "the dynamic stiffness is singular to working precision: no damping at a natural frequency, or a pair "
      "whose symbol vanishes");
}

Condensation::Condensation(const LinearStructure& structure) : method_(choose_method(structure)) {}
Condensation::Condensation(Condensation&&) noexcept = default;
Condensation& Condensation::operator=(Condensation&&) noexcept = default;
Condensation::~Condensation() = default;

int Condensation::size() const { return method_->size(); }

CondensedPoint Condensation::at(const StiffnessFactors& factors, const StiffnessFactors& rates) {
  return method_->at(factors, rates);
}

void Condensation::condense(const StiffnessSpectrum& factors, const StiffnessSpectrum& rates,
                            CondensedSpectrum& result) {
  const Eigen::Index size = factors[0].size();
  for (auto* vector :
       {&result.compliance, &result.load_response, &result.compliance_slope, &result.load_response_slope})
    vector->resize(size);
  method_->condense(factors, rates, result);
}

void Condensation::Method::condense(const StiffnessSpectrum& factors, const StiffnessSpectrum& rates,
                                    CondensedSpectrum& result) {
  for (Eigen::Index k = 0; k < factors[0].size(); ++k) {
    const CondensedPoint point =
        at({factors[0][k], factors[1][k], factors[2][k]}, {rates[0][k], rates[1][k], rates[2][k]});
    result.compliance[k] = point.compliance;
    result.load_response[k] = point.load_response;
    result.compliance_slope[k] = point.compliance_slope;
    result.load_response_slope[k] = point.load_response_slope;
  }
}

Eigen::VectorXcd Condensation::recover(const StiffnessFactors& factors, std::complex<double> load_amplitude,
                                       std::complex<double> contact_force) {
  return method_->recover(factors, load_amplitude, contact_force);
}

}  // namespace wavebalance::solvers
