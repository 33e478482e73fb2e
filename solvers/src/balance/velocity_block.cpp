#include "balance/velocity_block.hpp"

#include <cmath>

#include "balance/active_block.hpp"

namespace wavebalance::solvers {

void VelocityBlock::collect(const CondensedProblem& problem, const Eigen::VectorXd& tangent,
                            const Eigen::VectorXd& damping) {
  active_.clear();
  for (int l = 0; l < tangent.size(); ++l)
    if (tangent[l] != 0.0 || damping[l] != 0.0) active_.push_back(l);
  tangent_ = tangent(active_);
  damping_ = damping(active_);
  const Eigen::Index all = Eigen::Index{problem.contacts()} * map_.functions();
  coefficients_ = active() > all ? all : 0;
}

void VelocityBlock::fill(CondensedProblem& problem) {
  if (active_.empty()) return;
  lu_ = {};  // two matrices of the active samples at a time
  if (coefficients_ > 0)
    fill_coefficients(problem);
  else
    fill_active(problem);
}

// I + (D_u K + D_v f V K)_AA in the leading block. The columns of K are motions of the pair, so that V gives
// their velocities, and the shifts of V are those of K.
void VelocityBlock::fill_active(CondensedProblem& problem) {
  const std::vector<int> contacts = contacts_of(active_, problem.points());
  const Eigen::MatrixXd& columns = problem.columns(contacts);
  Eigen::MatrixXd rates(columns.rows(), columns.cols()), block(count(), count());
  const int period = problem.pair().shift_period();
  Eigen::VectorXd rate;
  for (const int contact : contacts)
    for (int m = 0; m < period; ++m) {
      map_.apply(columns.col(contact * period + m), problem.frequency(), rate);
      rates.col(contact * period + m) = rate;
    }
  fill_active_block(problem, columns, active_, matrix_);
  fill_active_block(problem, rates, active_, block);
  auto leading = matrix_.topLeftCorner(count(), count());
  leading.array().colwise() *= tangent_.array();  // in place, since these matrices may fill the memory
  leading += damping_.asDiagonal() * block;
  leading.diagonal().array() += 1.0;
}

// I + E^+ K W E in the leading block, column by column.
void VelocityBlock::fill_coefficients(CondensedProblem& problem) {
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(count());
  for (Eigen::Index j = 0; j < count(); ++j) {
    unit[j] = 1.0;
    matrix_.col(j).head(count()) = right_hand_side(problem, map_.motion(unit));
    matrix_(j, j) += 1.0;
    unit[j] = 0.0;
  }
  const double contacts = problem.contacts(), points = problem.points();
  operations_ += double(count()) * contacts * points * (30.0 * std::log2(points + 1.0) + 8.0 * contacts);
}

bool VelocityBlock::factorize_matrix() {
  const auto size = static_cast<double>(matrix_.rows());
  operations_ += 2.0 / 3.0 * size * size * size;
  lu_.compute(matrix_);
  return !lu_.is_singular();
}

// W times a motion, at the active samples.
Eigen::VectorXd VelocityBlock::weighted(CondensedProblem& problem, const Eigen::VectorXd& motion) {
  Eigen::VectorXd rate;
  map_.apply(motion, problem.frequency(), rate);
  return tangent_.cwiseProduct(motion(active_)) + damping_.cwiseProduct(rate(active_));
}

// K times forces at the active samples.
Eigen::VectorXd VelocityBlock::response(CondensedProblem& problem, const Eigen::VectorXd& forces) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(problem.samples()), product;
  all(active_) = forces;
  problem.apply(all, product);
  return product;
}

// W r, or E^+ K W r.
Eigen::VectorXd VelocityBlock::right_hand_side(CondensedProblem& problem, const Eigen::VectorXd& motion) {
  const Eigen::VectorXd forces = weighted(problem, motion);
  return coefficients_ > 0 ? map_.coefficients(response(problem, forces)) : forces;
}

// K w, or E a.
Eigen::VectorXd VelocityBlock::motion_of(CondensedProblem& problem, const Eigen::VectorXd& unknowns) {
  if (active_.empty()) return Eigen::VectorXd::Zero(problem.samples());
  return coefficients_ > 0 ? map_.motion(unknowns) : response(problem, unknowns);
}

// row^T K, or row^T E.
Eigen::RowVectorXd VelocityBlock::transposed_motion(CondensedProblem& problem, const Eigen::VectorXd& row) {
  if (coefficients_ == 0) {
    Eigen::VectorXd product;
    problem.apply_transposed(row, product);
    return product(active_).transpose();
  }
  Eigen::RowVectorXd result(count());
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(count());
  for (Eigen::Index j = 0; j < count(); ++j) {
    unit[j] = 1.0;
    result[j] = row.dot(map_.motion(unit));
    unit[j] = 0.0;
  }
  return result;
}

bool VelocityBlock::factorize(CondensedProblem& problem, const Eigen::VectorXd& tangent,
                              const Eigen::VectorXd& damping) {
  collect(problem, tangent, damping);
  matrix_.resize(count(), count());
  fill(problem);
  return factorize_matrix();
}

void VelocityBlock::solve(CondensedProblem& problem, const Eigen::VectorXd& r, Eigen::VectorXd& x) {
  Eigen::VectorXd unknowns = right_hand_side(problem, r);
  if (!active_.empty()) unknowns = lu_.solve(unknowns);
  x = r - motion_of(problem, unknowns);
}

// x = r - b y - K w. Eliminating x leaves (I + W K) w + W b y = W r and -(K^T c).w + (d - c.b) y = s - c.r,
// whose determinant is that of the whole; likewise with coefficients, E in place of K.
bool VelocityBlock::factorize_bordered(CondensedProblem& problem, const Eigen::VectorXd& tangent,
                                       const Eigen::VectorXd& damping, const Eigen::VectorXd& b,
                                       const Eigen::VectorXd& c, double d) {
  collect(problem, tangent, damping);
  border_column_ = b;
  border_row_ = c;
  matrix_.resize(count() + 1, count() + 1);
  fill(problem);
  if (count() > 0) {
    matrix_.col(count()).head(count()) = right_hand_side(problem, b);
    matrix_.row(count()).head(count()) = -transposed_motion(problem, c);
  }
  matrix_(count(), count()) = d - c.dot(b);
  return factorize_matrix();
}

void VelocityBlock::solve_bordered(CondensedProblem& problem, const Eigen::VectorXd& r, double s,
                                   Eigen::VectorXd& x, double& y) {
  Eigen::VectorXd values(count() + 1);
  values.head(count()) = right_hand_side(problem, r);
  values[count()] = s - border_row_.dot(r);
  values = lu_.solve(values);
  y = values[count()];
  x = r - border_column_ * y - motion_of(problem, values.head(count()));
}

}  // namespace wavebalance::solvers
