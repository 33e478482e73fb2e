#include "modes/damped_equations.hpp"

#include <cmath>
#include <limits>

#include "continuation/bordered.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
/// Z^-1 right and its derivatives.
struct Solutions {
  Eigen::MatrixXcd value, by_frequency, by_damping;
};

Solutions solutions(const Eigen::MatrixXcd& matrix, const Eigen::MatrixXcd& by_frequency,
                    const Eigen::VectorXcd& by_damping, const Eigen::MatrixXcd& right) {
  const detail::Lu<Complex> lu(matrix);
  Solutions found{lu.solve(right), {}, {}};
  found.by_frequency = -lu.solve(Eigen::MatrixXcd(by_frequency * found.value));
  found.by_damping = -lu.solve(Eigen::MatrixXcd(by_damping.asDiagonal() * found.value));
  return found;
}

}  // namespace

DampedMotions::DampedMotions(const DampedProblem& problem, const DampedBackboneOptions& options)
    : problem_(problem), options_(options) {
  const int contacts = problem.contacts(), rows = problem.rows();
  const double square = options.frequency_scale * options.frequency_scale;
  metric_.setConstant(problem.unknowns(), 1.0 / square);
  for (int c = 0; c < contacts; ++c)
    metric_.segment(c * rows, rows) =
        problem.transform.pair.mean_square / (problem.wave * problem.wave * contacts);
}

DampedMotions::Stiffness DampedMotions::stiffness_at(int k, double frequency, double damping) const {
  const Complex first = problem_.transform.first[k], second = problem_.transform.second[k];
  const Eigen::VectorXcd inertia = problem_.shape_inertia.cast<Complex>();
  Stiffness at{first * frequency * problem_.shape_damping.cast<Complex>(),
               first * problem_.shape_damping.cast<Complex>(), -first * frequency * inertia};
  if (k > 0 && problem_.shape_loss.size() > 0)
    at.value += Complex(0.0, 1.0) * problem_.shape_loss.cast<Complex>();
  at.value.diagonal().array() += 1.0;
  at.value.diagonal() += frequency * (second * frequency - first * damping) * inertia;
  at.by_frequency.diagonal() += (2.0 * second * frequency - first * damping) * inertia;
  return at;
}

void DampedMotions::set_gains(double frequency, double damping) {
  harmonics_.resize(static_cast<std::size_t>(problem_.highest()) + 1);
  const Eigen::MatrixXcd from_modes = problem_.contact_shapes.cast<Complex>();
  for (int k = 0; k <= problem_.highest(); ++k) {
    Stiffness at = stiffness_at(k, frequency, damping);
    if (k == 1) {
      set_first(std::move(at));
      continue;
    }
    const Solutions found = solutions(at.value, at.by_frequency, at.by_damping, from_modes.transpose());
    harmonics_[static_cast<std::size_t>(k)] = {from_modes * found.value, from_modes * found.by_frequency,
                                               from_modes * found.by_damping};
  }
}

// The row of mode m is that its coefficient is given, and its own equation is the last one.
void DampedMotions::set_first(Stiffness first) {
  const Index contacts = problem_.contacts(), m = problem_.mode;
  const Eigen::MatrixXcd from_modes = problem_.contact_shapes.cast<Complex>();
  const Eigen::RowVectorXcd row = first.value.row(m), row_by_frequency = first.by_frequency.row(m);
  const Complex row_by_damping = first.by_damping[m];
  Eigen::MatrixXcd right = Eigen::MatrixXcd::Zero(problem_.shape_inertia.size(), contacts + 1);
  right.leftCols(contacts) = from_modes.transpose();
  right.row(m).setZero();
  first.value.row(m).setZero();
  first.by_frequency.row(m).setZero();
  first.by_damping[m] = 0.0;
  first.value(m, m) = right(m, contacts) = 1.0;
  const Solutions found = solutions(first.value, first.by_frequency, first.by_damping, right);
  harmonics_[1] = {from_modes * found.value.leftCols(contacts),
                   from_modes * found.by_frequency.leftCols(contacts),
                   from_modes * found.by_damping.leftCols(contacts)};
  shape_.resize(contacts, 3);
  shape_ << from_modes * found.value.col(contacts), from_modes * found.by_frequency.col(contacts),
      from_modes * found.by_damping.col(contacts);
  shape_ /= problem_.reach;
  Eigen::MatrixXcd own(3, contacts + 1);
  own << row * found.value, row_by_frequency * found.value + row * found.by_frequency,
      row_by_damping * found.value.row(m) + row * found.by_damping;
  last_ = own.col(contacts);
  last_row_ = -own.leftCols(contacts).transpose();
  last_row_.col(0) += from_modes.col(m);
  last_row_ *= problem_.reach;
}

void DampedMotions::set_forces(const Eigen::VectorXd& unknowns) {
  const int contacts = problem_.contacts(), rows = problem_.rows(), points = problem_.points();
  const Index last = Index(contacts) * rows;
  const PairTransform& pair = problem_.transform.pair;
  const Eigen::Map<const Eigen::MatrixXd> scaled(unknowns.data(), rows, contacts);
  const Eigen::MatrixXd coefficients = amplitude_ / problem_.wave * scaled;
  const Eigen::MatrixXd motion = detail::product(pair.synthesis, coefficients);
  samples_ = motion.rowwise() + problem_.rest.transpose();
  velocity_.resize(0, 0);
  if (problem_.laws.depend_on_velocity())
    velocity_ = unknowns[last] * problem_.omega * detail::product(problem_.transform.rate, coefficients);
  problem_.laws.evaluate(contacts, samples_.reshaped(), velocity_.reshaped(), forces_);
  const Eigen::MatrixXd rest = forces_.force.reshaped(points, contacts).rowwise() -
                               problem_.rest_force.transpose() - motion * problem_.rest_slope.transpose();
  const double unit = problem_.wave / amplitude_;
  psi_ = unit * detail::product(pair.projection, rest);
  psi_by_frequency_.setZero(rows, contacts);
  if (velocity_.size() == 0) return;
  const Eigen::MatrixXd slope = forces_.slopes.velocity.reshaped(points, contacts);
  psi_by_frequency_ = unit / unknowns[last] * detail::product(pair.projection, slope.cwiseProduct(velocity_));
}

Complex DampedMotions::force_coefficient(const Eigen::MatrixXd& coefficients, int contact, int k) const {
  const int row = problem_.transform.pair.real_rows[static_cast<std::size_t>(k)];
  return {coefficients(row, contact), k > 0 ? coefficients(row + 1, contact) : 0.0};
}

double DampedMotions::evaluate(const CurvePoint& point, const Pieces*) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const int contacts = problem_.contacts(), rows = problem_.rows(), last = contacts * rows;
  const PairTransform& pair = problem_.transform.pair;
  if (!point.displacement.allFinite() || !std::isfinite(point.parameter)) return none;
  if (!(point.displacement[last] > 0.0)) return none;
  unknowns_ = point.displacement;
  amplitude_ = std::exp(point.parameter);
  set_gains(unknowns_[last], unknowns_[last + 1]);
  set_forces(unknowns_);
  residual_.resize(last + 2);
  for (int c = 0; c < contacts; ++c)
    for (int k = 0; k <= problem_.highest(); ++k) {
      const int row = c * rows + pair.real_rows[static_cast<std::size_t>(k)];
      Complex value = k == 1 ? -shape_(c, 0) : 0.0;
      for (int d = 0; d < contacts; ++d)
        value += harmonics_[static_cast<std::size_t>(k)].gain(c, d) * force_coefficient(psi_, d, k);
      residual_[row] = unknowns_[row] + value.real();
      if (k > 0) residual_[row + 1] = unknowns_[row + 1] + value.imag();
    }
  Complex value = last_[0];
  for (int d = 0; d < contacts; ++d) value += last_row_(d, 0) * force_coefficient(psi_, d, 1);
  residual_[last] = value.real();
  residual_[last + 1] = value.imag();
  if (!residual_.allFinite()) return none;
  double scale = 0.0;
  for (int c = 0; c < contacts; ++c)
    scale += metric_.segment(c * rows, rows).dot(unknowns_.segment(c * rows, rows).cwiseAbs2());
  double square = residual_.tail(2).squaredNorm();
  square += metric_.head(last).dot(residual_.head(last).cwiseAbs2());
  return std::sqrt(square / scale);
}

std::vector<DampedMotions::Block> DampedMotions::force_slopes() const {
  const int contacts = problem_.contacts(), points = problem_.points();
  const PairTransform& pair = problem_.transform.pair;
  std::vector<std::vector<SlopeEntry>> entries(static_cast<std::size_t>(contacts * contacts));
  const auto add = [&](int force, int displacement, double slope) {
    const int block = force / points * contacts + displacement / points;
    entries[static_cast<std::size_t>(block)].push_back({force % points, displacement % points, slope});
  };
  for (int i = 0; i < contacts * points; ++i)
    if (forces_.slopes.displacement[i] != 0.0) add(i, i, forces_.slopes.displacement[i]);
  for (const SlopeEntry& one : forces_.slopes.others) add(one.force, one.displacement, one.slope);
  std::vector<Block> blocks;
  for (int c = 0; c < contacts; ++c)
    for (int d = 0; d < contacts; ++d) {
      const auto& own = entries[static_cast<std::size_t>(c * contacts + d)];
      const bool moves = c == d && velocity_.size() > 0;
      if (own.empty() && !moves && problem_.rest_slope(c, d) == 0.0) continue;
      Eigen::MatrixXd change = -problem_.rest_slope(c, d) * pair.synthesis;
      for (const SlopeEntry& one : own)
        change.row(one.force) += one.slope * pair.synthesis.row(one.displacement);
      if (moves)
        change += unknowns_[contacts * problem_.rows()] * problem_.omega *
                  forces_.slopes.velocity.segment(Index(c) * points, points).asDiagonal() *
                  problem_.transform.rate;
      blocks.push_back({c, d, detail::product(pair.projection, change)});
    }
  return blocks;
}

// Adds factor psi(k) of the block's contact to the residuals `row` and `row` + 1, real and imaginary; the
// mean has only the first.
void DampedMotions::add_row(Eigen::MatrixXd& matrix, int row, int k, Complex factor,
                            const Block& block) const {
  const int rows = problem_.rows(), first = problem_.transform.pair.real_rows[static_cast<std::size_t>(k)];
  const Index parameter = matrix.cols() - 1;
  const Eigen::VectorXd own = unknowns_.segment(Index(block.displacement) * rows, rows);
  const auto add = [&](int at_row, double share, int of) {
    const auto slope = block.slope.row(of);
    matrix.row(at_row).segment(Index(block.displacement) * rows, rows) += share * slope;
    matrix(at_row, parameter) += share * slope.dot(own);  // psi over A by ln A, with that below
  };
  add(row, factor.real(), first);
  if (k == 0) return;
  add(row, -factor.imag(), first + 1);
  add(row + 1, factor.imag(), first);
  add(row + 1, factor.real(), first + 1);
}

Eigen::MatrixXd DampedMotions::jacobian() const {
  const int contacts = problem_.contacts(), rows = problem_.rows(), last = contacts * rows;
  const PairTransform& pair = problem_.transform.pair;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(last + 2, last + 3);
  matrix.diagonal().head(last).setOnes();
  const auto put = [&](int row, int column, int k, Complex value) {
    matrix(row, column) += value.real();
    if (k > 0) matrix(row + 1, column) += value.imag();
  };
  for (const Block& block : force_slopes())
    for (int k = 0; k <= problem_.highest(); ++k) {
      const int of = pair.real_rows[static_cast<std::size_t>(k)];
      for (int c = 0; c < contacts; ++c)
        add_row(matrix, c * rows + of, k, harmonics_[static_cast<std::size_t>(k)].gain(c, block.force),
                block);
      if (k == 1) add_row(matrix, last, k, last_row_(block.force, 0), block);
    }
  for (int d = 0; d < contacts; ++d)
    for (int k = 0; k <= problem_.highest(); ++k) {
      const Harmonic& harmonic = harmonics_[static_cast<std::size_t>(k)];
      const Complex psi = force_coefficient(psi_, d, k), moved = force_coefficient(psi_by_frequency_, d, k);
      const int of = pair.real_rows[static_cast<std::size_t>(k)];
      for (int c = 0; c < contacts; ++c) {
        put(c * rows + of, last, k, harmonic.by_frequency(c, d) * psi + harmonic.gain(c, d) * moved);
        put(c * rows + of, last + 1, k, harmonic.by_damping(c, d) * psi);
        put(c * rows + of, last + 2, k, -harmonic.gain(c, d) * psi);
      }
      if (k != 1) continue;
      put(last, last, k, last_row_(d, 1) * psi + last_row_(d, 0) * moved);
      put(last, last + 1, k, last_row_(d, 2) * psi);
      put(last, last + 2, k, -last_row_(d, 0) * psi);
    }
  for (int c = 0; c < contacts; ++c)
    for (int which = 1; which <= 2; ++which)
      put(c * rows + pair.real_rows[1], last + which - 1, 1, -shape_(c, which));
  put(last, last, 1, last_[1]);
  put(last, last + 1, 1, last_[2]);
  return matrix;
}

bool DampedMotions::solve_bordered(const Eigen::VectorXd& row, double last, const Eigen::VectorXd& right,
                                   double last_right, Eigen::VectorXd& change,
                                   double& parameter_change) const {
  return solve_bordered_dense(jacobian(), row, last, right, last_right, change, parameter_change);
}

Eigen::MatrixXcd DampedMotions::modal_coefficients(const DampedPoint& point) const {
  const Eigen::MatrixXd motion = point.displacement.transpose().rowwise() - problem_.rest.transpose();
  const Eigen::MatrixXd beyond_rest = (point.force.transpose().rowwise() - problem_.rest_force.transpose()) -
                                      motion * problem_.rest_slope.transpose();
  const Eigen::MatrixXd psi = detail::product(problem_.transform.pair.projection, beyond_rest);
  const Index m = problem_.mode;
  Eigen::MatrixXcd modes(problem_.shape_inertia.size(), problem_.highest() + 1);
  for (int k = 0; k <= problem_.highest(); ++k) {
    Eigen::MatrixXcd stiffness =
        stiffness_at(k, point.omega / problem_.omega, point.xi / problem_.omega).value;
    Eigen::VectorXcd right = Eigen::VectorXcd::Zero(modes.rows());
    for (int c = 0; c < problem_.contacts(); ++c)
      right -= problem_.contact_shapes.row(c).transpose() * force_coefficient(psi, c, k);
    if (k == 1) {  // as in set_first()
      stiffness.row(m).setZero();
      stiffness(m, m) = 1.0;
      right[m] = point.amplitude / (problem_.wave * problem_.reach);
    }
    modes.col(k) = detail::Lu<Complex>(stiffness).solve(right);
  }
  return modes;
}

Eigen::MatrixXd DampedMotions::force() const {
  return forces_.force.reshaped(problem_.points(), problem_.contacts());
}

}  // namespace wavebalance::solvers
