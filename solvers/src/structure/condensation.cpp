#include "wavebalance/solvers/structure/condensation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "linalg/index.hpp"
#include "linalg/safe_norm.hpp"
#include "structure/condensation_method.hpp"
#include "structure/largest_entry.hpp"
#include "wavebalance/solvers/linalg/parallel_for.hpp"

namespace wavebalance::solvers {
namespace {

bool is_tridiagonal(const Eigen::SparseMatrix<double>& matrix) {
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry)
      if (std::abs(entry.row() - entry.col()) > 1 && entry.value() != 0.0) return false;
  return true;
}

void require_symmetric(const Eigen::SparseMatrix<double>& matrix, const char* name, const char* reason) {
  if (is_symmetric(matrix)) return;
  throw std::invalid_argument("Condensation: " + std::string(name) +
                              " is not symmetric (relative asymmetry " + std::to_string(asymmetry(matrix)) +
                              ")" + reason);
}

// Whether the structure is symmetric. Its mass must be, and for two of the methods all matrices.
bool require_symmetry(const LinearStructure& structure, CondensationMethod method) {
  require_symmetric(structure.mass, "mass", "");
  if (method != CondensationMethod::tridiagonal && method != CondensationMethod::modal)
    return structure.symmetric();
  if (structure.turns())
    throw std::invalid_argument(
        "Condensation: the tridiagonal and the modal method take no matrices that turn, an LU does");
  const char* reason = "; the tridiagonal and the modal method need symmetric matrices, an LU does not";
  require_symmetric(structure.damping, "damping", reason);
  require_symmetric(structure.stiffness, "stiffness", reason);
  return true;
}

bool is_tridiagonal(const LinearStructure& structure) {
  return is_tridiagonal(structure.mass) && is_tridiagonal(structure.damping) &&
         is_tridiagonal(structure.stiffness);
}

// A dense elimination is faster than a sparse one unless few entries are nonzero.
bool is_dense(const LinearStructure& structure) {
  const double entries = double(structure.stiffness.nonZeros() + structure.mass.nonZeros());
  const double size = structure.size();
  return size <= 2000.0 && entries > 0.1 * size * size;
}

CondensationMethod elimination(const LinearStructure& structure) {
  return is_dense(structure) ? CondensationMethod::dense : CondensationMethod::sparse;
}

using MethodPointer = std::unique_ptr<Condensation::Method>;

// Sets `chosen` to the method taken.
MethodPointer choose_method(const LinearStructure& structure, bool symmetric, CondensationMethod& chosen) {
  constexpr int modal_limit = 1000;  // beyond it the modes cost more than a sweep by elimination
  const bool fixed = symmetric && !structure.turns();
  if (fixed && is_tridiagonal(structure)) {
    chosen = CondensationMethod::tridiagonal;
    return make_tridiagonal_method(structure);
  }
  chosen = CondensationMethod::modal;
  if (fixed && structure.size() <= modal_limit)
    if (MethodPointer method = make_modal_method(structure)) return method;
  chosen = elimination(structure);
  return chosen == CondensationMethod::dense ? make_dense_method(structure) : make_sparse_method(structure);
}

MethodPointer make_unscaled_method(const LinearStructure& structure, bool symmetric,
                                   CondensationMethod& method) {
  switch (method) {
    case CondensationMethod::automatic:
      return choose_method(structure, symmetric, method);
    case CondensationMethod::tridiagonal:
      if (is_tridiagonal(structure)) return make_tridiagonal_method(structure);
      throw std::invalid_argument("Condensation: the matrices are not tridiagonal");
    case CondensationMethod::modal:
      if (MethodPointer modal = make_modal_method(structure)) return modal;
      throw std::invalid_argument(
          "Condensation: the modal method needs a positive definite stiffness or mass and a damping that is "
          "diagonal in the undamped modes");
    case CondensationMethod::dense:
      return make_dense_method(structure);
    case CondensationMethod::sparse:
      return make_sparse_method(structure);
  }
  throw std::invalid_argument("Condensation: unknown method");
}

// Sets `method` to the method taken, and `symmetric`.
MethodPointer make_method(const LinearStructure& structure, CondensationMethod& method, bool& symmetric) {
  structure.validate();
  symmetric = require_symmetry(structure, method);
  return make_scaled_method(structure, [&](const LinearStructure& scaled) {
    return make_unscaled_method(scaled, symmetric, method);
  });
}

// The column of contact c in the sum of all loads with their amplitudes (K x L), or with 1 if there are none.
template <class Matrix, class Amplitudes>
auto sum_of_loads(const Matrix& responses, Index c, Index contacts, const Amplitudes& amplitudes) {
  using Column = Eigen::Matrix<typename Matrix::Scalar, Eigen::Dynamic, 1>;
  Column sum = Column::Zero(responses.rows());
  for (Index l = 0; l * contacts < responses.cols(); ++l)
    if (amplitudes.size() == 0)
      sum += responses.col(c + contacts * l);
    else
      sum += responses.col(c + contacts * l).cwiseProduct(amplitudes.col(l));
  return sum;
}

// NaN where squares leave the range of numbers.
RoundingErrors relative_errors(const CondensedSpectrum& spectrum, const Eigen::MatrixXcd& load) {
  const Index contacts = spectrum.compliance_error.cols();
  const bool one_load = spectrum.load_response.cols() == contacts;
  const Eigen::MatrixXd load_sizes = load.cwiseAbs();
  double largest = 0.0, response = 0.0, error = 0.0;  // squares
  for (Index c = 0; c < contacts; ++c) {
    largest = std::max(largest, spectrum.compliance.col(c * (contacts + 1)).cwiseAbs2().maxCoeff());
    if (!one_load) {
      response += sum_of_loads(spectrum.load_response, c, contacts, load).squaredNorm();
      error += sum_of_loads(spectrum.load_response_error, c, contacts, load_sizes).squaredNorm();
      continue;
    }
    const auto responses = spectrum.load_response.col(c).cwiseAbs2();
    const auto errors = spectrum.load_response_error.col(c).cwiseAbs2();
    response += load.size() == 0 ? responses.sum() : responses.dot(load.col(0).cwiseAbs2());
    error += load.size() == 0 ? errors.sum() : errors.dot(load.col(0).cwiseAbs2());
  }
  return {relative_to(std::sqrt(largest), spectrum.compliance_error.maxCoeff()),
          relative_to(std::sqrt(response), std::sqrt(error))};
}

}  // namespace

Eigen::VectorXd direction_lengths(const LinearStructure& structure) {
  Eigen::VectorXd lengths(structure.contacts());
  for (int c = 0; c < structure.contacts(); ++c) lengths[c] = structure.contact_directions.row(c).norm();
  return lengths;
}

StiffnessScale::StiffnessScale(const LinearStructure& structure)
    : largest_{largest_entry(structure.mass), largest_entry(structure.damping),
               largest_entry(structure.stiffness), largest_entry(structure.turning.gyroscopic),
               largest_entry(structure.turning.stiffness)} {}

double StiffnessScale::size(const ImpedanceCoefficients& factors) const {
  double sum = 0.0;
  for (std::size_t d = 0; d < factors.size(); ++d) sum += std::abs(factors[d]) * largest_[d];
  return sum;
}

ImpedanceCoefficients coefficients_at(const StiffnessSpectrum& spectrum, Eigen::Index k) {
  ImpedanceCoefficients at{};
  for (std::size_t d = 0; d < at.size(); ++d)
    if (spectrum[d].size() > 0) at[d] = spectrum[d][k];
  return at;
}

double StiffnessScale::condition(const ImpedanceCoefficients& factors, double solution_norm,
                                 double right_norm) const {
  return right_norm > 0.0 ? size(factors) * (solution_norm / right_norm) : 0.0;
}

double StiffnessScale::require_regular(const ImpedanceCoefficients& factors,
                                       const Eigen::Ref<const Eigen::VectorXcd>& solution,
                                       double right_norm) const {
  return require_regular(factors, safe_norm(solution), right_norm);
}

double StiffnessScale::require_regular(const ImpedanceCoefficients& factors, double solution_norm,
                                       double right_norm) const {
  const double found = condition(factors, solution_norm, right_norm);
  constexpr double largest_condition = 0.1 / std::numeric_limits<double>::epsilon();
  if (found <= largest_condition) return found;
  throw SingularSystem(
      "the dynamic stiffness is singular to working precision: no damping at a natural frequency, or a pair "
      "whose symbol vanishes");
}

Condensation::Condensation(const LinearStructure& structure, CondensationMethod method)
    : chosen_(method), loads_(structure.load_count()), method_(make_method(structure, chosen_, symmetric_)) {
  if (method == CondensationMethod::automatic && chosen_ == CondensationMethod::modal)
    structure_ = std::make_unique<LinearStructure>(structure);
}
Condensation::Condensation(Condensation&&) noexcept = default;
Condensation& Condensation::operator=(Condensation&&) noexcept = default;
Condensation::~Condensation() = default;

void Condensation::set_threads(int threads) {
  threads_ = thread_count(threads);
  method_->set_threads(threads_);
}

int Condensation::size() const { return method_->size(); }
int Condensation::contacts() const { return method_->contacts(); }

CondensedPoint Condensation::dynamic_compliance(const ImpedanceCoefficients& factors,
                                                const ImpedanceCoefficients& derivatives) {
  return method_->dynamic_compliance(factors, derivatives);
}

void Condensation::condense(const StiffnessSpectrum& factors, const StiffnessSpectrum& derivatives,
                            CondensedSpectrum& result, const Eigen::MatrixXcd& load) {
  condense_by_method(factors, derivatives, result, load);
  constexpr double largest_modal_error = 1e-8;
  if (!structure_ || !(rounding_.load_response > largest_modal_error)) return;
  const double modal_error = rounding_.load_response;
  chosen_ = elimination(*structure_);
  MethodPointer modal = std::exchange(method_, make_method(*structure_, chosen_, symmetric_));
  structure_.reset();
  method_->set_threads(threads_);
  condense_by_method(factors, derivatives, result, load);
  if (rounding_.load_response < modal_error) return;
  method_ = std::move(modal);
  chosen_ = CondensationMethod::modal;
  condense_by_method(factors, derivatives, result, load);
}

void Condensation::condense_by_method(const StiffnessSpectrum& factors, const StiffnessSpectrum& derivatives,
                                      CondensedSpectrum& result, const Eigen::MatrixXcd& load) {
  const Index size = factors[0].size(), count = contacts();
  for (auto* matrix : {&result.compliance, &result.compliance_slope}) matrix->resize(size, count * count);
  for (auto* matrix : {&result.load_response, &result.load_response_slope})
    matrix->resize(size, count * loads_);
  result.compliance_error.resize(size, count);
  result.load_response_error.resize(size, count * loads_);
  method_->reset_condition();
  method_->condense(factors, derivatives, result);
  condition_ = method_->condition();
  rounding_ = relative_errors(result, load);
}

namespace {

// Rows of results from `first` on. For many contacts several are written together, since each number of a
// row lies in another line of the cache.
void write_rows(const std::vector<CondensedPoint>& points, Index first, CondensedSpectrum& result) {
  const auto write = [&](auto member, auto& rows) {
    for (Index i = 0; i < rows.cols(); ++i)
      for (std::size_t j = 0; j < points.size(); ++j)
        rows(first + Index(j), i) = (points[j].*member).data()[i];
  };
  write(&CondensedPoint::compliance, result.compliance);
  write(&CondensedPoint::load_response, result.load_response);
  write(&CondensedPoint::compliance_slope, result.compliance_slope);
  write(&CondensedPoint::load_response_slope, result.load_response_slope);
  write(&CondensedPoint::compliance_error, result.compliance_error);
  write(&CondensedPoint::load_response_error, result.load_response_error);
}

}  // namespace

void Condensation::Method::condense(const StiffnessSpectrum& factors, const StiffnessSpectrum& derivatives,
                                    CondensedSpectrum& result) {
  constexpr Index many_entries = 1024, in_a_line = 4;
  const Index points = factors[0].size();
  const Index together = result.compliance.cols() >= many_entries ? in_a_line : 1;
  make_twins(points);
  const int workers = static_cast<int>(std::min<Index>(threads_, Index(twins_.size()) + 1));
  parallel_for(workers, (points + together - 1) / together, [&](int worker, Index part) {
    Method& method = worker == 0 ? *this : *twins_[static_cast<std::size_t>(worker) - 1];
    std::vector<CondensedPoint> found;
    for (Index k = part * together; k < std::min(points, (part + 1) * together); ++k)
      found.push_back(
          method.dynamic_compliance(coefficients_at(factors, k), coefficients_at(derivatives, k)));
    write_rows(found, part * together, result);
  });
  for (const auto& other : twins_) {
    record(other->condition());
    other->reset_condition();
  }
}

void Condensation::Method::make_twins(Index points) {
  while (Index(twins_.size()) + 1 < std::min<Index>(threads_, points)) {
    std::unique_ptr<Method> other = twin();
    if (!other) return;
    twins_.push_back(std::move(other));
  }
}

Eigen::VectorXcd Condensation::recover(const ImpedanceCoefficients& factors,
                                       std::complex<double> load_amplitude,
                                       const Eigen::VectorXcd& contact_forces) {
  Eigen::VectorXcd amplitudes = Eigen::VectorXcd::Zero(loads_);
  amplitudes[0] = load_amplitude;
  return recover(factors, amplitudes, contact_forces);
}

Eigen::VectorXcd Condensation::recover(const ImpedanceCoefficients& factors,
                                       const Eigen::VectorXcd& load_amplitudes,
                                       const Eigen::VectorXcd& contact_forces) {
  if (load_amplitudes.size() != loads_)
    throw std::invalid_argument("Condensation::recover: load_amplitudes has " +
                                std::to_string(load_amplitudes.size()) + " entries; the structure has " +
                                std::to_string(loads_) + " loads");
  return method_->recover(factors, load_amplitudes, contact_forces);
}

}  // namespace wavebalance::solvers
