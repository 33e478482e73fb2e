#include "wavebalance/solvers/balance/contact_system.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "balance/jacobian_solver.hpp"
#include "balance/rigid_position.hpp"
#include "linalg/safe_norm.hpp"
#include "time/rate_map.hpp"

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

ContactSystem::ContactSystem(CondensedProblem& problem, ContactLaws laws, Eigen::VectorXd series_flexibility)
    : operator_(problem, std::move(series_flexibility)),
      given_(std::move(laws)),
      laws_(given_),
      position_(problem.is_free() ? std::make_unique<RigidPosition>() : nullptr),
      rates_(laws_.depend_on_velocity() ? std::make_unique<RateMap>(problem.pair()) : nullptr),
      jacobian_(std::make_unique<JacobianSolver>(rates_.get())) {
  laws_.require(problem.contacts());
  if (operator_.is_force_form())
    if (laws_.depend_on_velocity() || (laws_.act_over_period() && !laws_.have_force_form()))
      throw std::invalid_argument(
          "ContactSystem: the force of a law depends on the velocity, or on the whole period without a resolvent; it is "
          "solved in the displacement form");
  take_laws();
}
ContactSystem::ContactSystem(ContactSystem&&) noexcept = default;
ContactSystem& ContactSystem::operator=(ContactSystem&&) noexcept = default;
ContactSystem::~ContactSystem() = default;

int ContactSystem::piece_at(int sample, double displacement) const {
  int piece = 0;
  for (const LawKink& kink : kinks_at(sample)) piece += displacement > kink.at ? 1 : 0;
  return piece;
}

void ContactSystem::take_laws() {
  const CondensedProblem& problem = operator_.problem();
  laws_at_ = problem.load_frequency();
  laws_ = given_.at(laws_at_);
  if (operator_.is_force_form()) laws_ = laws_.resolvents(operator_.series_flexibility());
  kinks_.clear();
  rest_pieces_.clear();
  for (int c = 0; c < problem.contacts(); ++c) {
    kinks_.push_back(kinks_of(laws_[c]));
    rest_pieces_.push_back(rest_piece_of(laws_[c], kinks_.back()));
  }
}

void ContactSystem::follow_frequency() {
  if (given_.follow_frequency() && laws_at_ != operator_.problem().load_frequency()) take_laws();
}

void ContactSystem::evaluate_laws(const Eigen::VectorXd& displacement) {
  follow_frequency();
  if (given_.follow_frequency()) evaluated_ = displacement;
  if (rates_) rates_->apply(displacement, operator_.problem().frequency(), velocity_);
  laws_.evaluate(operator_.problem().contacts(), displacement, velocity_, forces_);
  if (force_share_ != 1.0) scale_forces();
}

void ContactSystem::scale_forces() {
  forces_.force *= force_share_;
  forces_.slopes.displacement *= force_share_;
  forces_.slopes.velocity *= force_share_;
  for (SlopeEntry& entry : forces_.slopes.others) {
    entry.slope *= force_share_;
    entry.damping *= force_share_;
  }
}

double ContactSystem::evaluate(const Eigen::VectorXd& displacement) {
  evaluate_laws(displacement);
  return evaluate_residual(displacement);
}

double ContactSystem::evaluate(const Eigen::VectorXd& displacement, const LawSegments& pieces) {
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
  const ForceSlopes side = side_of(sample, kink, beyond);
  take_side(sample, side);
  forces_.force[sample] = side.force + side.tangent * (displacement - kink.at);
}

void ContactSystem::take_side(int sample, int kink, bool beyond) {
  take_side(sample, side_of(sample, kinks_at(sample)[static_cast<std::size_t>(kink)], beyond));
}

void ContactSystem::take_side(int sample, const ForceSlopes& side) {
  forces_.slopes.displacement[sample] = side.tangent;
  if (rates_) forces_.slopes.velocity[sample] = side.damping;
}

// Force and slopes at a kink from one side of it, at the velocity that the sample has.
ForceSlopes ContactSystem::side_of(int sample, const LawKink& kink, bool beyond) const {
  const AnyContactLaw& law = laws_[sample / operator_.problem().points()];
  if (!law.depends_on_velocity()) return {kink.force, beyond ? kink.beyond : kink.below, 0.0};
  const double inside = std::nextafter(kink.at, beyond ? -far_below : far_below);
  return law.at(inside, velocity_[sample]);
}

void ContactSystem::add_velocity_slope(Eigen::VectorXd& slope) {
  if (!rates_) return;
  // At fixed samples the velocities f V u grow like the frequency.
  Eigen::VectorXd growth = forces_.slopes.velocity.cwiseProduct(velocity_);
  for (const SlopeEntry& entry : forces_.slopes.others)
    growth[entry.force] += entry.damping * velocity_[entry.displacement];
  operator_.apply(growth / operator_.problem().frequency(), product_);
  slope += product_;
}

void ContactSystem::add_law_slope(Eigen::VectorXd& slope) {
  if (!given_.follow_frequency()) return;
  constexpr double change = 1e-6;  // forces are linear in what varies, on one piece
  const CondensedProblem& problem = operator_.problem();
  ContactLaws beside = given_.at((1.0 + change) * problem.load_frequency());
  if (operator_.is_force_form()) beside = beside.resolvents(operator_.series_flexibility());
  ContactForces forces;
  beside.evaluate(problem.contacts(), evaluated_, velocity_, forces);
  operator_.apply((forces.force - forces_.force) / (change * problem.frequency()), product_);
  slope += product_;
}

double ContactSystem::evaluate_residual(const Eigen::VectorXd& displacement) {
  const Eigen::VectorXd& free = operator_.problem().linear_response();
  if (forces_.force.isZero(0.0)) {
    product_.setZero(displacement.size());
  } else {
    operator_.apply(forces_.force, product_);
    const double contacts = operator_.problem().contacts(), points = operator_.problem().points();
    products_ += contacts * points * (20.0 * std::log2(points + 1.0) + 8.0 * contacts);
  }
  if (position_) {
    state_ = displacement;
    product_ -= operator_.problem().hold_response() * operator_.rigid_position(displacement, forces_.force);
  }
  residual_ = displacement - free + product_;
  if (added_motion_.size() > 0) residual_ -= added_motion_;
  relative_residual_ = relative_to(safe_norm(free) + safe_norm(product_), safe_norm(residual_));
  if (!std::isfinite(relative_residual_)) relative_residual_ = std::numeric_limits<double>::infinity();
  return relative_residual_;
}

void ContactSystem::set_linear_solver(LinearSolver method) { jacobian_->set_method(method); }

Eigen::VectorXd ContactSystem::force_on_held_structure() const {
  return position_ ? operator_.force_on_held_structure(forces_.force, state_) : forces_.force;
}

bool ContactSystem::factorize(const Border& border) {
  constexpr double reduction = 1e-12;
  if (!jacobian_->factorize(operator_, slopes(), border)) return false;
  const auto solve = [&](const Eigen::VectorXd& r, Eigen::VectorXd& x, double& y) {
    return jacobian_->solve(operator_, r, 0.0, reduction, x, y);
  };
  return !position_ || position_->factorize(operator_, tangent(), solve);
}

bool ContactSystem::factorize() { return factorize(Border{}); }

bool ContactSystem::solve(const Eigen::VectorXd& r, Eigen::VectorXd& x, double reduction) {
  double none = 0.0;
  return solve_bordered(r, 0.0, x, none, reduction);
}

double ContactSystem::operations() const { return products_ + jacobian_->operations(); }

double ContactSystem::condition() { return jacobian_->condition(operator_); }

bool ContactSystem::factorize_bordered(const Eigen::VectorXd& b, const Eigen::VectorXd& c, double d) {
  column_scale_ = border_scale(b);
  row_scale_ = border_scale(c);
  return factorize({column_scale_ * b, row_scale_ * c, column_scale_ * d * row_scale_});
}

bool ContactSystem::solve_bordered(const Eigen::VectorXd& r, double s, Eigen::VectorXd& x, double& y,
                                   double reduction) {
  const bool solved = jacobian_->solve(operator_, r, row_scale_ * s, reduction, x, y);
  if (position_) position_->correct(operator_, tangent(), x, y);
  y *= column_scale_;
  return solved;
}

int ContactSystem::determinant_sign() const {
  const int sign = jacobian_->determinant_sign();
  return position_ ? sign * position_->sign() : sign;
}

}  // namespace wavebalance::solvers
