#include "wavebalance/fem/eigenmodes.hpp"

#include <algorithm>
#include <numbers>

#include "block_lanczos.hpp"
#include "dense.hpp"
#include "require.hpp"
#include "shift_invert.hpp"
#include "sparse_product.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Factor = detail::SymmetricFactor;

// Squares of the angular frequencies, ascending, and the mass-normalised shapes.
struct Modes {
  Eigen::VectorXd squares;
  Eigen::MatrixXd shapes;
  bool complete = true;
  bool cancelled = false;
};

void validate(const Sparse& stiffness, const Sparse& mass, int count, const EigenmodesOptions& options) {
  const Eigen::Index size = stiffness.rows();
  detail::require(size >= 1, "eigenmodes", "stiffness has 0 rows; it must have at least 1");
  detail::require_square(stiffness, "eigenmodes", "stiffness", size);
  detail::require_square(mass, "eigenmodes", "mass", size);
  detail::require_value(count >= 1 && count <= size, "eigenmodes", "count", count,
                        "in 1.." + std::to_string(size));
  detail::require_value(options.tolerance > 0.0 && options.tolerance < 1.0, "eigenmodes", "tolerance",
                        options.tolerance, "in (0, 1)");
  detail::require_value(options.max_restarts >= 1, "eigenmodes", "max_restarts", options.max_restarts,
                        "at least 1");
  detail::require_value(options.dense_up_to >= 0, "eigenmodes", "dense_up_to", options.dense_up_to,
                        "at least 0");
  detail::require_value(std::isfinite(options.shift) && options.shift <= 0.0, "eigenmodes", "shift",
                        options.shift, "finite and at most 0");
}

[[noreturn]] void reject_stiffness(double shift) {
  throw std::domain_error("eigenmodes: stiffness - shift mass is not positive definite with shift " +
                          std::to_string(shift) +
                          "; a structure that can move freely needs a negative shift");
}

// The modes above the geometric mean of the lowest and the highest requested omega^2, from (K - shift M)
// phi = omega^2 M phi, whose rounding is relative to the highest mode.
void replace_high_modes(Modes& modes, const Sparse& shifted, const Sparse& mass, double shift) {
  const Eigen::ArrayXd above = modes.squares.array() - shift;
  const double middle = std::sqrt(above[0] * above.tail(1)[0]);
  const Eigen::Index low = (above < middle).count(), high = above.size() - low;
  const auto eigen = detail::generalized_eigen(Eigen::MatrixXd(shifted), Eigen::MatrixXd(mass));
  if (!eigen) return;  // a mode without mass is infinitely high
  modes.squares.tail(high) = eigen->values.segment(low, high).array() + shift;
  modes.shapes.rightCols(high) = eigen->vectors.middleCols(low, high);
}

// M phi = mu (K - shift M) phi: with the inverse of omega^2 as the eigenvalue, rounding is relative to the
// lowest mode, and a singular mass is no exception.
Modes dense_modes(const Sparse& shifted, const Sparse& mass, int count, double shift) {
  const auto eigen = detail::generalized_eigen(Eigen::MatrixXd(mass), Eigen::MatrixXd(shifted));
  if (!eigen) reject_stiffness(shift);
  const Eigen::VectorXd inverse = eigen->values.reverse();  // descending
  const double rounding = 1e-14 * static_cast<double>(mass.rows()) * inverse[0];
  if (!(inverse[0] > 0.0) || inverse.tail(1)[0] < -rounding)
    throw std::domain_error("eigenmodes: mass is not positive semidefinite");
  if (inverse[count - 1] <= 0.0)
    throw std::domain_error("eigenmodes: the rank of mass is below the count of modes");
  Modes modes{inverse.head(count).cwiseInverse().array() + shift,
              eigen->vectors.rowwise().reverse().leftCols(count)};
  constexpr double wide = 1e6;  // rounding leaves more than nine digits below this ratio
  if (inverse[0] > wide * inverse[count - 1]) replace_high_modes(modes, shifted, mass, shift);
  return modes;
}

Modes lanczos_modes(const Factor& factor, const Sparse& mass, int count, const EigenmodesOptions& options,
                    unsigned seed) {
  detail::LanczosLimits limits{options.tolerance, options.max_restarts, seed};
  bool cancelled = false;
  limits.go_on = [&](Eigen::Index converged) {
    const double done = 0.8 * static_cast<double>(converged) / count;
    cancelled = options.observer && !options.observer("modes", done);
    return !cancelled;
  };
  detail::LanczosResult found = detail::block_lanczos(factor, mass, count, limits);
  return {found.values.cwiseInverse().array() + options.shift, std::move(found.vectors), found.complete,
          cancelled};
}

// Inverse iteration on all modes found, then the Rayleigh-Ritz approximations in the space of the results.
// The errors that Lanczos leaves, its tolerance over the distance between modes, fall to rounding.
void refine(Modes& modes, const Factor& factor, const Sparse& shifted, const Sparse& mass,
            const EigenmodesOptions& options) {
  if (modes.squares.size() == 0) return;
  Eigen::MatrixXd& space = modes.shapes;
  const int steps = options.tolerance > 1e-12 ? 2 : 1;
  for (int step = 0; step < steps; ++step) {
    space = factor.solve(detail::symmetric_product(mass, space));
    space.colwise().normalize();
  }
  const Eigen::MatrixXd left = detail::projection(mass, space);
  const Eigen::MatrixXd right = detail::projection(shifted, space);
  const auto ritz = detail::generalized_eigen(left, right);
  if (!ritz) return;  // the iterates are dependent to rounding; the frequencies stay as Lanczos left them
  modes.squares = ritz->values.reverse().cwiseInverse().array() + options.shift;
  modes.shapes = detail::product(space, ritz->vectors.rowwise().reverse());
}

// The number of modes below the count-th one found that are not among those found.
int missing_modes(const Sparse& stiffness, const Sparse& mass, const Modes& modes, int count) {
  if (modes.squares.size() == 0) return 0;
  const double highest = modes.squares[std::min<Eigen::Index>(count, modes.squares.size()) - 1];
  const double below = highest - 1e-7 * std::abs(highest);
  const detail::Inertia signs = detail::inertia(stiffness - below * mass);
  if (!signs.complete) return 0;  // a zero pivot: the modes cannot be counted
  return static_cast<int>(
      std::max<Eigen::Index>(0, signs.negative - (modes.squares.array() < below).count()));
}

Modes sparse_modes(const Sparse& stiffness, const Sparse& mass, const Sparse& shifted, int count,
                   const EigenmodesOptions& options, const Factor& factor) {
  const int most = static_cast<int>(mass.rows()) - 1;
  int wanted = count;
  Modes modes;
  for (unsigned attempt = 0; attempt < 4; ++attempt) {
    modes = lanczos_modes(factor, mass, wanted, options, attempt);
    if (modes.cancelled || (options.observer && !options.observer("refining and counting the modes", 0.85)))
      return {{}, Eigen::MatrixXd(mass.rows(), 0), false, true};
    refine(modes, factor, shifted, mass, options);
    const int missing = missing_modes(stiffness, mass, modes, count);
    modes.complete = modes.complete && missing == 0;
    if (missing == 0) break;
    wanted = std::min(wanted + missing, most);
  }
  const Eigen::Index kept = std::min<Eigen::Index>(count, modes.squares.size());
  return {modes.squares.head(kept), modes.shapes.leftCols(kept), modes.complete};
}

// Scales to phi^T M phi = 1, with a sign that does not depend on the solver.
void normalise(Eigen::MatrixXd& shapes, const Sparse& mass) {
  const Eigen::VectorXd squares =
      shapes.cwiseProduct(detail::symmetric_product(mass, shapes)).colwise().sum().transpose();
  for (Eigen::Index mode = 0; mode < shapes.cols(); ++mode) {
    auto shape = shapes.col(mode);
    Eigen::Index largest = 0;
    shape.cwiseAbs().maxCoeff(&largest);
    const double length = std::sqrt(squares[mode]);
    shape /= shape[largest] < 0.0 ? -length : length;
  }
}

double column_sum_norm(const Sparse& matrix) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(matrix.rows());
  return (matrix.cwiseAbs().transpose() * ones).maxCoeff();
}

EigenmodesResult make_result(Modes modes, const Sparse& stiffness, const Sparse& mass) {
  normalise(modes.shapes, mass);
  EigenmodesResult result;
  result.status = modes.cancelled  ? EigenmodesStatus::cancelled
                  : modes.complete ? EigenmodesStatus::converged
                                   : EigenmodesStatus::not_converged;
  result.omega = modes.squares.cwiseMax(0.0).cwiseSqrt();
  result.frequencies_hz = result.omega / (2.0 * std::numbers::pi);
  const Eigen::MatrixXd residual = detail::symmetric_product(stiffness, modes.shapes) -
                                   detail::symmetric_product(mass, modes.shapes) * modes.squares.asDiagonal();
  result.residuals = residual.colwise()
                         .norm()
                         .cwiseQuotient(column_sum_norm(stiffness) * modes.shapes.colwise().norm())
                         .transpose();
  result.shapes = std::move(modes.shapes);
  return result;
}

}  // namespace

namespace detail {

EigenmodesResult sparse_eigenmodes(const SymmetricFactor& factor, const Sparse& stiffness, const Sparse& mass,
                                   int count, const EigenmodesOptions& options) {
  if (options.shift == 0.0)
    return make_result(sparse_modes(stiffness, mass, stiffness, count, options, factor), stiffness, mass);
  const Sparse shifted = stiffness - options.shift * mass;
  return make_result(sparse_modes(stiffness, mass, shifted, count, options, factor), stiffness, mass);
}

}  // namespace detail

EigenmodesResult eigenmodes(const Sparse& given_stiffness, const Sparse& given_mass, int count,
                            const EigenmodesOptions& options) {
  validate(given_stiffness, given_mass, count, options);
  Sparse stiffness = given_stiffness;
  Sparse mass = given_mass;
  stiffness.makeCompressed();
  mass.makeCompressed();
  detail::require_symmetric(stiffness, "eigenmodes", "stiffness");
  detail::require_symmetric(mass, "eigenmodes", "mass");
  const Sparse shifted = stiffness - options.shift * mass;
  const Eigen::Index size = stiffness.rows();
  if (size <= options.dense_up_to || 2 * static_cast<Eigen::Index>(count) >= size)
    return make_result(dense_modes(shifted, mass, count, options.shift), stiffness, mass);
  const Factor factor(shifted);
  if (!factor.positive_definite()) reject_stiffness(options.shift);
  return detail::sparse_eigenmodes(factor, stiffness, mass, count, options);
}

}  // namespace wavebalance::fem
