#include "balance/velocity_block.hpp"

#include "balance/active_block.hpp"

namespace wavebalance::solvers {

void VelocityBlock::collect(const Eigen::VectorXd& tangent, const Eigen::VectorXd& damping) {
  active_.clear();
  for (int l = 0; l < tangent.size(); ++l)
    if (tangent[l] != 0.0 || damping[l] != 0.0) active_.push_back(l);
  tangent_ = tangent(active_);
  damping_ = damping(active_);
}

// I + (D_u K + D_v f V K)_AA in the leading block. The columns of K are motions of the pair, so that V gives
// their velocities, and the shifts of V are those of K.
void VelocityBlock::fill(CondensedProblem& problem) {
  if (active_.empty()) return;
  lu_ = {};  // two matrices of the active samples at a time
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

// x = r - K w.
void VelocityBlock::complete(CondensedProblem& problem, const Eigen::VectorXd& r,
                             const Eigen::VectorXd& forces, Eigen::VectorXd& x) {
  x = r;
  if (active_.empty()) return;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(r.size()), product;
  all(active_) = forces;
  problem.apply(all, product);
  x -= product;
}

bool VelocityBlock::factorize(CondensedProblem& problem, const Eigen::VectorXd& tangent,
                              const Eigen::VectorXd& damping) {
  collect(tangent, damping);
  matrix_.resize(count(), count());
  fill(problem);
  return factorize_matrix();
}

void VelocityBlock::solve(CondensedProblem& problem, const Eigen::VectorXd& r, Eigen::VectorXd& x) {
  Eigen::VectorXd forces = weighted(problem, r);
  if (!active_.empty()) forces = lu_.solve(forces);
  complete(problem, r, forces, x);
}

// x = r - b y - K w. Eliminating x leaves (I + W K) w + W b y = W r and -(K^T c).w + (d - c.b) y = s - c.r,
// whose determinant is that of the whole.
bool VelocityBlock::factorize_bordered(CondensedProblem& problem, const Eigen::VectorXd& tangent,
                                       const Eigen::VectorXd& damping, const Eigen::VectorXd& b,
                                       const Eigen::VectorXd& c, double d) {
  collect(tangent, damping);
  border_column_ = b;
  border_row_ = c;
  matrix_.resize(count() + 1, count() + 1);
  fill(problem);
  if (count() > 0) {
    Eigen::VectorXd product;
    problem.apply_transposed(c, product);
    matrix_.col(count()).head(count()) = weighted(problem, b);
    matrix_.row(count()).head(count()) = -product(active_).transpose();
  }
  matrix_(count(), count()) = d - c.dot(b);
  return factorize_matrix();
}

void VelocityBlock::solve_bordered(CondensedProblem& problem, const Eigen::VectorXd& r, double s,
                                   Eigen::VectorXd& x, double& y) {
  Eigen::VectorXd values(count() + 1);
  values.head(count()) = weighted(problem, r);
  values[count()] = s - border_row_.dot(r);
  values = lu_.solve(values);
  y = values[count()];
  complete(problem, r - border_column_ * y, values.head(count()), x);
}

}  // namespace wavebalance::solvers
