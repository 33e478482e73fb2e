#include "wavebalance/solvers/balance/contact_system.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "balance/jacobian_solver.hpp"
#include "balance/rigid_position.hpp"
#include "balance/velocity_block.hpp"
#include "linalg/safe_norm.hpp"

namespace wavebalance::solvers {

namespace {

// A power of two that brings numbers whose products leave the range of double precision to the order of 1.
double border_scale(const Eigen::VectorXd& values) {
  const double largest = values.size() > 0 ? values.cwiseAbs().maxCoeff() : 1.0;
  const bool extreme = std::isfinite(largest) && largest > 0.0 && (largest < 1e-100 || largest > 1e100);
  return extreme ? std::ldexp(1.0, -std::ilogb(largest)) : 1.0;
}

constexpr double far_below = -std::numeric_limits<double>::infinity();

// Outside contact a unilateral law is zero, which is not left to rounding.
std::vector<LawKink> kinks_of(const AnyContactLaw& law) {
  std::vector<LawKink> kinks;
  for (const double at : law.kinks()) {
    const double lower = std::nextafter(at, far_below);
    if (law.unilateral())
      kinks.push_back({at, 0.0, 0.0, law.tangent(at)});
    else
      kinks.push_back({at, law.force(at), law.tangent(lower), law.tangent(at)});
  }
  return kinks;
}

int rest_piece_of(const AnyContactLaw& law, const std::vector<LawKink>& kinks) {
  int piece = 0;
  if (law.unilateral()) return piece;
  for (const LawKink& kink : kinks) piece += kink.at < 0.0 ? 1 : 0;
  return piece;
}

}  // namespace

struct ContactSystem::VelocityPart {
  VelocityPart(const TimePair& pair, int samples) : map(pair), block(map), damping(samples) {}
  VelocityMap map;
  VelocityBlock block;
  Eigen::VectorXd velocity, damping;  // at the samples, m/s and N s/m
};

ContactSystem::ContactSystem(CondensedProblem& problem, ContactLaws laws)
    : problem_(&problem),
      laws_(std::move(laws)),
      force_(problem.samples()),
      tangent_(problem.samples()),
      position_(problem.is_free() ? std::make_unique<RigidPosition>() : nullptr),
      jacobian_(std::make_unique<JacobianSolver>()) {
  laws_.require(problem.contacts());
  if (laws_.depend_on_velocity()) {
    if (problem.regularization().size() > 0)
      throw std::invalid_argument(
          "ContactSystem: the force of a law depends on the velocity; it is solved in the displacement form");
    velocity_ = std::make_unique<VelocityPart>(problem.pair(), problem.samples());
  }
  if (problem.regularization().size() > 0) laws_ = laws_.resolvents(problem.regularization());
  for (int c = 0; c < problem.contacts(); ++c) {
    kinks_.push_back(kinks_of(laws_[c]));
    rest_pieces_.push_back(rest_piece_of(laws_[c], kinks_.back()));
  }
}
ContactSystem::ContactSystem(ContactSystem&&) noexcept = default;
ContactSystem& ContactSystem::operator=(ContactSystem&&) noexcept = default;
ContactSystem::~ContactSystem() = default;

int ContactSystem::piece_at(int sample, double displacement) const {
  int piece = 0;
  for (const LawKink& kink : kinks_at(sample)) piece += displacement > kink.at ? 1 : 0;
  return piece;
}

void ContactSystem::evaluate_laws(const Eigen::VectorXd& displacement) {
  if (!velocity_) return laws_.evaluate(problem_->contacts(), displacement, force_, tangent_);
  velocity_->map.apply(displacement, problem_->frequency(), velocity_->velocity);
  laws_.evaluate(problem_->contacts(), displacement, velocity_->velocity, force_, tangent_,
                 velocity_->damping);
}

double ContactSystem::evaluate(const Eigen::VectorXd& displacement) {
  evaluate_laws(displacement);
  return evaluate_residual(displacement);
}

double ContactSystem::evaluate(const Eigen::VectorXd& displacement, const LawPieces& pieces) {
  evaluate_laws(displacement);
  for (int l = 0; l < displacement.size(); ++l) {
    const std::span<const LawKink> kinks = kinks_at(l);
    const auto piece = static_cast<std::size_t>(pieces[l]);
    if (piece < kinks.size() && displacement[l] >= kinks[piece].at)
      continue_piece(l, displacement[l], kinks[piece], false);
    else if (piece > 0 && displacement[l] <= kinks[piece - 1].at)
      continue_piece(l, displacement[l], kinks[piece - 1], true);
  }
  return evaluate_residual(displacement);
}

void ContactSystem::continue_piece(int sample, double displacement, const LawKink& kink, bool beyond) {
  const double past = displacement - kink.at;
  take_side(sample, kink, beyond);
  force_[sample] = kink.force + tangent_[sample] * past;
  if (!velocity_) return;
  const double inside = beyond ? std::nextafter(kink.at, -far_below) : std::nextafter(kink.at, far_below);
  const AnyContactLaw& law = laws_[sample / problem_->points()];
  force_[sample] = law.at(inside, velocity_->velocity[sample]).force + tangent_[sample] * past;
}

void ContactSystem::take_side(int sample, int kink, bool beyond) {
  take_side(sample, kinks_at(sample)[static_cast<std::size_t>(kink)], beyond);
}

void ContactSystem::take_side(int sample, const LawKink& kink, bool beyond) {
  tangent_[sample] = beyond ? kink.beyond : kink.below;
  if (!velocity_) return;
  const double inside = beyond ? std::nextafter(kink.at, -far_below) : std::nextafter(kink.at, far_below);
  const ForceSlopes at = laws_[sample / problem_->points()].at(inside, velocity_->velocity[sample]);
  tangent_[sample] = at.tangent;
  velocity_->damping[sample] = at.damping;
}

void ContactSystem::add_velocity_slope(Eigen::VectorXd& slope) {
  if (!velocity_) return;
  // At fixed samples the velocities f V u grow like the frequency.
  problem_->apply(velocity_->damping.cwiseProduct(velocity_->velocity) / problem_->frequency(), product_);
  slope += product_;
}

double ContactSystem::evaluate_residual(const Eigen::VectorXd& displacement) {
  const Eigen::VectorXd& free = problem_->contact_free_response();
  if (force_.isZero(0.0)) {
    product_.setZero(displacement.size());
  } else {
    problem_->apply(force_, product_);
    const double contacts = problem_->contacts(), points = problem_->points();
    products_ += contacts * points * (20.0 * std::log2(points + 1.0) + 8.0 * contacts);
  }
  if (position_) {
    state_ = displacement;
    product_ -= problem_->hold_response() * problem_->rigid_position(displacement, force_);
  }
  residual_ = displacement - free + product_;
  if (added_motion_.size() > 0) residual_ -= added_motion_;
  relative_residual_ = relative_to(safe_norm(free) + safe_norm(product_), safe_norm(residual_));
  if (!std::isfinite(relative_residual_)) relative_residual_ = std::numeric_limits<double>::infinity();
  return relative_residual_;
}

void ContactSystem::set_linear_solver(LinearSolver method) { jacobian_->set_method(method); }

Eigen::VectorXd ContactSystem::held_force() const {
  return position_ ? problem_->held_force(force_, state_) : force_;
}

bool ContactSystem::factorize_position(bool bordered) {
  constexpr double reduction = 1e-12;
  return position_->factorize(
      *problem_, tangent_, [&](const Eigen::VectorXd& r, Eigen::VectorXd& x, double& y) {
        y = 0.0;
        return bordered ? solve_at_position(r, 0.0, x, y, reduction) : solve_at_position(r, x, reduction);
      });
}

bool ContactSystem::factorize() {
  const bool factorized = velocity_ ? velocity_->block.factorize(*problem_, tangent_, velocity_->damping)
                                    : jacobian_->factorize(*problem_, tangent_);
  return factorized && (!position_ || factorize_position(false));
}

bool ContactSystem::solve_at_position(const Eigen::VectorXd& r, Eigen::VectorXd& x, double reduction) {
  if (velocity_) {
    velocity_->block.solve(*problem_, r, x);
    return true;
  }
  return jacobian_->solve(*problem_, r, reduction, x);
}

bool ContactSystem::solve(const Eigen::VectorXd& r, Eigen::VectorXd& x, double reduction) {
  const bool solved = solve_at_position(r, x, reduction);
  double none = 0.0;
  if (position_) position_->correct(*problem_, tangent_, x, none);
  return solved;
}

double ContactSystem::operations() const {
  return products_ + jacobian_->operations() + (velocity_ ? velocity_->block.operations() : 0.0);
}

double ContactSystem::condition() {
  return velocity_ ? velocity_->block.condition() : jacobian_->condition(*problem_);
}

bool ContactSystem::factorize_bordered(const Eigen::VectorXd& b, const Eigen::VectorXd& c, double d) {
  column_scale_ = border_scale(b);
  row_scale_ = border_scale(c);
  const Eigen::VectorXd column = column_scale_ * b, row = row_scale_ * c;
  const double corner = column_scale_ * d * row_scale_;
  const bool factorized = velocity_ ? velocity_->block.factorize_bordered(
                                          *problem_, tangent_, velocity_->damping, column, row, corner)
                                    : jacobian_->factorize_bordered(*problem_, tangent_, column, row, corner);
  return factorized && (!position_ || factorize_position(true));
}

bool ContactSystem::solve_at_position(const Eigen::VectorXd& r, double s, Eigen::VectorXd& x, double& y,
                                      double reduction) {
  if (!velocity_) return jacobian_->solve_bordered(*problem_, r, s, reduction, x, y);
  velocity_->block.solve_bordered(*problem_, r, s, x, y);
  return true;
}

bool ContactSystem::solve_bordered(const Eigen::VectorXd& r, double s, Eigen::VectorXd& x, double& y,
                                   double reduction) {
  const bool solved = solve_at_position(r, row_scale_ * s, x, y, reduction);
  if (position_) position_->correct(*problem_, tangent_, x, y);
  y *= column_scale_;
  return solved;
}

int ContactSystem::determinant_sign() const {
  const int sign = velocity_ ? velocity_->block.determinant_sign() : jacobian_->determinant_sign();
  return position_ ? sign * position_->sign() : sign;
}

}  // namespace wavebalance::solvers
