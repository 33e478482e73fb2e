#include "impacts/lasting_flow.hpp"

#include <algorithm>
#include <cmath>

#include "impacts/impact_parts.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {

LastingFlow::LastingFlow(const ImpactModel& model)
    : model_(model),
      poles_(model.problem().dynamics, model.period()),
      generator_(poles_.generator()),
      impulse_(poles_.after_impulse(0.0)),
      displacement_(poles_.free_motion(0.0)),
      velocity_(poles_.free_velocity(0.0)),
      acceleration_(velocity_ * generator_) {}

Eigen::VectorXcd LastingFlow::complex_of(const Eigen::VectorXd& states) const {
  Eigen::VectorXcd result(model_.poles());
  Index row = 0;
  for (Index l = 0; l < model_.poles(); ++l) {
    const bool real = model_.exponents()[l].imag() == 0.0;
    result[l] = {states[row], real ? 0.0 : states[row + 1]};
    row += real ? 1 : 2;
  }
  return result;
}

Eigen::VectorXd LastingFlow::real_of(const Eigen::VectorXcd& states) const {
  Eigen::VectorXd result(poles_.size());
  Index row = 0;
  for (Index l = 0; l < model_.poles(); ++l) {
    result[row++] = states[l].real();
    if (model_.exponents()[l].imag() != 0.0) result[row++] = states[l].imag();
  }
  return result;
}

const ClosedModes* LastingFlow::closed(int contact) {
  const auto [place, added] = closed_.try_emplace(contact);
  if (added) place->second = ClosedModes::make(model_, contact);
  return place->second ? &*place->second : nullptr;
}

bool LastingFlow::fail(ImpactStatus status) {
  end_ = status;
  return false;
}

bool LastingFlow::advance(LastingState& state, double periods, LastingRecord* record,
                          Eigen::MatrixXd* perturbations) {
  constexpr int most_events = 4000;
  const double until = state.time + periods;
  for (int event = 0; event < most_events; ++event) {
    const bool goes_on = state.closed < 0 ? fly(state, until, record, perturbations)
                                          : stay(state, until, record, perturbations);
    if (!goes_on) return false;
    if (state.time >= until) return state.states.allFinite();
  }
  return fail(ImpactStatus::too_many_impacts);
}

// Until the next impact, or the end.
bool LastingFlow::fly(LastingState& state, double until, LastingRecord* record,
                      Eigen::MatrixXd* perturbations) {
  const Eigen::VectorXcd begin = complex_of(state.states);
  const double length = (until - state.time) * model_.period();
  if (record != nullptr) record->segments.push_back({state.time, -1, begin});
  Flight flight(model_, begin, state.time, length, allowed_penetration(model_));
  const Touch touch = flight.first_touch();
  if (touch.kind == Touch::Kind::unresolved) return fail(ImpactStatus::grazing);
  const bool free = touch.kind == Touch::Kind::none;
  const double flown = free ? length : touch.time;
  state.states = real_of(flight.state_at(flown));
  if (perturbations != nullptr) poles_.advance(flown / model_.period(), *perturbations);
  state.time = free ? until : state.time + flown / model_.period();
  return free || impact(state, touch.contact, record, perturbations);
}

// Until the closed contact opens, another one touches, or the end.
bool LastingFlow::stay(LastingState& state, double until, LastingRecord* record,
                       Eigen::MatrixXd* perturbations) {
  const ClosedModes* modes = closed(state.closed);
  if (modes == nullptr) return fail(ImpactStatus::singular);
  const Eigen::VectorXcd begin = modes->modes_of(state.states, state.time);
  const double length = (until - state.time) * model_.period();
  if (record != nullptr) record->segments.push_back({state.time, state.closed, begin});
  const ClosedModes::End end = modes->first_end(begin, state.time, length);
  if (end.kind == ClosedModes::End::Kind::unresolved) return fail(ImpactStatus::grazing);
  const bool whole = end.kind == ClosedModes::End::Kind::none;
  const double stayed = whole ? length : end.time;
  const double time = whole ? until : state.time + stayed / model_.period();
  state.states = modes->states_of(modes->after(begin, stayed), time);
  if (perturbations != nullptr) *perturbations = modes->transition(stayed) * *perturbations;
  state.time = time;
  if (whole) return true;
  if (end.kind == ClosedModes::End::Kind::touches) return impact(state, end.contact, record, perturbations);
  if (record != nullptr && !record->contacts.empty()) record->contacts.back().end = time;
  state.closed = -1;
  return true;
}

// An impact of a contact, whose perturbations pass by the saltation matrix; where it has no rebound and is
// pressed on, the contact is closed then.
bool LastingFlow::impact(LastingState& state, int contact, LastingRecord* record,
                         Eigen::MatrixXd* perturbations) {
  constexpr double vanishing = 1e-6, coupling = 1e-9;
  const ImpactsProblem& problem = model_.problem();
  const double mobility = model_.inverse_mass()(contact, contact), restitution = problem.restitution[contact];
  if (state.closed >= 0 && std::abs(model_.inverse_mass()(contact, state.closed)) > coupling * mobility)
    return fail(ImpactStatus::lasting_contact);  // the closed contact would have an impulse, too
  const ContactState before = model_.motion(complex_of(state.states), state.time);
  const double speed = before.velocity[contact], gain = (1.0 + restitution) / mobility;
  const Eigen::VectorXd left = impulse_.col(contact) * (gain * speed);
  state.states -= left;
  fastest_ = std::max(fastest_, speed);
  const double pressing = model_.motion(complex_of(state.states), state.time).acceleration[contact];
  if (restitution > 0.0 && restitution < 1.0 && pressing > 0.0 && speed <= vanishing * fastest_)
    return fail(ImpactStatus::chattering);
  const bool lasts = restitution == 0.0 && pressing > 0.0;
  if (lasts && state.closed >= 0) return fail(ImpactStatus::lasting_contact);
  if (perturbations != nullptr) {
    const Eigen::RowVectorXd u = displacement_.row(contact) * *perturbations,
                             v = velocity_.row(contact) * *perturbations;
    // The rates before less those after, and what the velocity before changes by while the instant moves.
    const Eigen::VectorXd moved = state.closed < 0 ? generator_ * left : closed(state.closed)->rates(left);
    Eigen::VectorXd rates = moved - impulse_.col(contact) * (gain * before.acceleration[contact]);
    if (lasts) rates += impulse_.col(contact) * (pressing / mobility);
    *perturbations -= impulse_.col(contact) * (gain * v);
    *perturbations -= rates * u / speed;
  }
  if (record != nullptr) {
    const double impulse = gain * speed;
    record->impacts.push_back({contact, state.time, speed, -restitution * speed, impulse,
                               0.5 * impulse * (1.0 - restitution) * speed});
    if (lasts) record->contacts.push_back({contact, state.time, state.time});
  }
  if (lasts) state.closed = contact;
  return true;
}

}  // namespace wavebalance::solvers::detail
