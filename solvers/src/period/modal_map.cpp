#include "period/modal_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "period/step_forces.hpp"

namespace wavebalance::solvers {
namespace {

// How often a step is halved at most. A contact that opens or closes is then known to 1e-9 periods.
constexpr int deepest_level = 20;

// Whether a contact has a force at only one of two times.
bool opens_or_closes(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  return ((one.array() == 0.0) != (other.array() == 0.0)).any();
}

}  // namespace

ModalMap::ModalMap(const CondensedProblem& problem, const ContactLaws& laws, int steps, ModalFlow flow)
    : laws_(laws),
      steps_(steps),
      free_(problem, 2 * steps),
      clear_below_(laws.gaps(problem.contacts())),
      depends_on_velocity_(laws.depend_on_velocity()),
      has_memory_(laws.act_over_period()) {
  flow.set_constant_load(free_.left_out());
  free_state_ = flow.state(free_.initial_displacement(), free_.initial_velocity());
  for (int c = 0; c < problem.contacts(); ++c)
    if (!laws[c].unilateral() || !std::isfinite(clear_below_[c]))  // a spring may have no gap
      clear_below_[c] = -std::numeric_limits<double>::infinity();
  flows_.push_back(std::move(flow));
}

PeriodState ModalMap::state(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity) const {
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(free_.initial_displacement().size());
  const Eigen::VectorXd begin = flows_.front().state(displacement.size() > 0 ? displacement : rest,
                                                     velocity.size() > 0 ? velocity : rest);
  return {begin - free_state_, Eigen::VectorXd::Zero(clear_below_.size())};
}

// The forces of a motion at an instant, with displacements `before` where laws have memory.
Eigen::VectorXd ModalMap::forces_at(const PeriodState& state, Ticks time, Eigen::VectorXd velocity,
                                    Eigen::VectorXd before, const Eigen::VectorXd& begin) const {
  const ModalFlow& flow = flows_.front();
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(clear_below_.size(), clear_below_.size());
  return step_forces(
             laws_,
             {flow.static_compliance(), none, free_motion(0, time) + flow.contact_displacement(state.motion),
              std::move(velocity), std::move(before)},
             begin)
      .force;
}

PeriodState ModalMap::balanced(PeriodState state) const {
  state.force =
      forces_at(state, 0, depends_on_velocity_ ? velocity(state, 0) : Eigen::VectorXd(), {}, state.force);
  return state;
}

const ModalFlow& ModalMap::flow(int level) {
  while (static_cast<int>(flows_.size()) <= level) {
    const int halvings = static_cast<int>(flows_.size());
    flows_.push_back(flows_.front().over(std::ldexp(1.0 / (free_.frequency() * steps_), -halvings)));
  }
  return flows_[static_cast<std::size_t>(level)];
}

// Times are in ticks, the shortest step.
Eigen::VectorXd ModalMap::free_motion(int derivative, Ticks time) const {
  constexpr Ticks sample = Ticks{1} << (deepest_level - 1);
  if (time % sample == 0) return free_.sample(derivative, time / sample % (2 * steps_));
  return free_.at(derivative, std::ldexp(double(time), -deepest_level) / steps_);
}

Eigen::VectorXd ModalMap::velocity(const PeriodState& state, Ticks time) const {
  Eigen::VectorXd velocity = free_motion(1, time);
  flows_.front().add_contact_velocity(state.motion, velocity);
  return velocity;
}

Eigen::VectorXd ModalMap::displacement(const PeriodState& state, Ticks time) const {
  const ModalFlow& flow = flows_.front();
  Eigen::VectorXd displacement = free_motion(0, time);
  flow.add_contact_displacement(state.motion, displacement);
  displacement.noalias() -= flow.static_compliance() * state.force;
  return displacement;
}

bool ModalMap::is_clear(const Eigen::VectorXd& displacement) const {
  return (displacement.array() <= clear_below_.array()).all();
}

// A step of the length of its level, whatever acts within.
ModalMap::Step ModalMap::single(const PeriodState& begin, Ticks end, int level) {
  const ModalFlow& flow = this->flow(level);
  const auto states = double(flow.states()), contacts = double(clear_below_.size());
  constexpr double around = 1250.0;  // operations with the time of the rest of a step
  constexpr double of_law = 500.0;   // and the resolvent of a law
  operations_ += 2.0 * states * (states + 2.0 * contacts) + around;
  Step step;
  step.end.motion = flow.advance(begin.motion, begin.force);
  step.displacement = free_motion(0, end);
  flow.add_contact_displacement(step.end.motion, step.displacement);
  step.end.force.setZero(step.displacement.size());
  if (is_clear(step.displacement)) return step;
  const Eigen::VectorXd velocity = depends_on_velocity_ ? this->velocity(step.end, end) : Eigen::VectorXd();
  const Ticks start = end - (Ticks{1} << (deepest_level - level));
  StepForces forces = step_forces(laws_,
                                  {flow.step_compliance(), flow.step_mobility(), step.displacement, velocity,
                                   has_memory_ ? displacement(begin, start) : Eigen::VectorXd()},
                                  begin.force);
  operations_ += of_law * forces.evaluations;
  step.end.force = std::move(forces.force);
  flow.add_force(step.end.motion, step.end.force);
  step.displacement.noalias() -= flow.step_compliance() * step.end.force;
  return step;
}

// The forces that laws with memory have at the end of a step once its motion is extrapolated. Otherwise what
// a contact that sticks remembers would drift from its displacement.
void ModalMap::remember(const Step& before, Step& step, Ticks end) {
  step.end.force = forces_at(step.end, end, {}, before.displacement, before.end.force);
  step.displacement = displacement(step.end, end);
}

// The same, halved as far as needed for an error in the state of at most `allowed`. `whole_step` is the
// result of single(), if there is one.
ModalMap::Step ModalMap::refined(const PeriodState& begin, Ticks start, int level, double allowed,
                                 const Step* whole_step) {
  constexpr double rounding = 1e-12;
  constexpr double event = 1e-3;  // the share of the error that is allowed where a contact opens or closes
  const Ticks length = Ticks{1} << (deepest_level - level), half = length / 2;
  Step whole = whole_step ? *whole_step : single(begin, start + length, level);
  if (level == deepest_level || operations_ > max_operations_ || !(begin.motion.norm() <= far_)) return whole;
  if (begin.force.isZero(0.0) && whole.end.force.isZero(0.0)) {
    Eigen::VectorXd middle = free_motion(0, start + half);
    flow(level + 1).add_contact_displacement_after(begin.motion, middle);
    if (is_clear(middle)) return whole;
  }
  const Step first = single(begin, start + half, level + 1);
  Step second = single(first.end, start + length, level + 1);
  const Eigen::VectorXd correction = (second.end.motion - whole.end.motion) / 3.0;
  const bool changes =
      opens_or_closes(begin.force, first.end.force) || opens_or_closes(first.end.force, second.end.force);
  const double rounded = rounding * second.end.motion.norm();  // of a motion that grows far beyond its start
  if (!(correction.norm() > std::max(rounded, allowed * (changes ? event : 1.0)))) {
    second.end.motion += correction;
    if (has_memory_) remember(first, second, start + length);
    return second;
  }
  const Step middle = refined(begin, start, level + 1, allowed, &first);
  return refined(middle.end, start + half, level + 1, allowed, nullptr);
}

Period ModalMap::advance(const PeriodState& begin, const StepControl& control) {
  const Ticks length = Ticks{1} << deepest_level;
  const double allowed =
      control.tolerance * std::max({size(begin), control.least_size, free_state_.norm() * 1e-6});
  const Eigen::Index contacts = clear_below_.size();
  max_operations_ = operations_ + control.max_operations;
  if (far_ == 0.0) far_ = 1e10 * std::max(size(begin), free_state_.norm());
  Period period;
  for (Eigen::MatrixXd* values :
       {&period.contacts.displacement, &period.contacts.velocity, &period.contacts.force})
    values->resize(contacts, steps_);
  Step at{begin, displacement(begin, 0)};
  for (int k = 0; k < steps_; ++k) {
    period.contacts.displacement.col(k) = at.displacement;
    period.contacts.velocity.col(k) = velocity(at.end, k * length);
    period.contacts.force.col(k) = at.end.force;
    at = refined(at.end, k * length, 0, allowed, nullptr);
    period.grows = !(at.end.motion.norm() <= far_);
    if (period.grows || operations_ > max_operations_) return period;
  }
  period.complete = at.end.motion.allFinite();
  period.state = std::move(at.end);
  return period;
}

}  // namespace wavebalance::solvers
