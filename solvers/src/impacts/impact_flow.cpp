#include "impacts/impact_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "impacts/impact_parts.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

// The deflection of the poles by constant forces against the contacts that moves these by -`shift`.
Eigen::VectorXcd pressed(const ImpactModel& model, const Eigen::VectorXd& shift) {
  const Eigen::VectorXcd inverse = model.exponents().cwiseInverse();
  const Eigen::MatrixXcd deflections = inverse.asDiagonal() * model.inputs();
  const Eigen::MatrixXd compliance = -(model.outputs(0) * deflections).real();
  return deflections * least_squares(compliance, shift).cast<std::complex<double>>();
}

}  // namespace

ImpactFlow::ImpactFlow(const ImpactModel& model) : model_(model) {}

void ImpactFlow::start(const Eigen::VectorXcd& state) {
  constexpr int instants = 64;
  time_ = 0.0;
  state_ = state;
  if (state.size() > 0) return;
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd above;
  for (int k = 0; k < instants; ++k) {
    const Eigen::VectorXd now = model_.free_motion(double(k) / instants).displacement - model_.gaps();
    if (!(now.maxCoeff() < least)) continue;
    least = now.maxCoeff();
    above = now;
    time_ = double(k) / instants;
  }
  state_.setZero(model_.poles());
  if (least > 0.0) state_ = pressed(model_, above.cwiseMax(0.0) * (1.0 + 1e-6));
}

void ImpactFlow::forget_before(double time) {
  std::erase_if(events_, [time](const Event& event) { return event.time < time; });
}

// The impact of a contact at its gap now. False where the motion ends here.
bool ImpactFlow::rebound(int contact) {
  constexpr double vanishing = 1e-6;
  const double restitution = model_.restitution()[contact];
  const double before = model_.motion(state_, time_).velocity[contact];
  const double impulse = (1.0 + restitution) * before / model_.inverse_mass()(contact, contact);
  state_ -= impulse * model_.inputs().col(contact);
  events_.push_back({contact, time_, impulse});
  fastest_ = std::max(fastest_, before);
  const double pressing = model_.motion(state_, time_).acceleration[contact];
  const bool vanishes = before <= vanishing * fastest_;
  if (!(pressing > 0.0) || !(restitution == 0.0 || (vanishes && restitution < 1.0))) return true;
  end_ = restitution == 0.0 ? ExactStatus::lasting_contact : ExactStatus::chattering;
  end_contact_ = contact;
  end_time_ = time_ + 2.0 * restitution * before / ((1.0 - restitution) * pressing * model_.period());
  return false;
}

// Whether a contact has rebounded shortly before a time at which touching is undecided: it rests there, or
// is about to. Sets where and when.
bool ImpactFlow::comes_to_rest(double time) {
  constexpr double shortly = 1e-3, slow = 1e-2;  // periods, of the fastest impact
  if (events_.empty() || time - events_.back().time > shortly) return false;
  const Event& last = events_.back();
  const double speed = last.impulse * model_.inverse_mass()(last.contact, last.contact) /
                       (1.0 + model_.restitution()[last.contact]);
  if (speed > slow * fastest_) return false;
  end_contact_ = last.contact;
  end_time_ = time;
  return true;
}

bool ImpactFlow::advance_period() {
  const double begin = time_;
  const bool whole = advance_to(begin + 1.0);
  time_ = whole ? begin : time_ - 1.0;
  end_time_ -= 1.0;
  for (Event& event : events_) event.time -= 1.0;
  return whole;
}

bool ImpactFlow::advance_to(double time) {
  constexpr int most_impacts = 2000;
  for (int impacts = 0; impacts <= most_impacts; ++impacts) {
    const double length = std::max(0.0, time - time_) * model_.period();
    Flight flight(model_, state_, time_, length, allowed_penetration(model_));
    const Touch touch = flight.first_touch();
    if (touch.kind == Touch::Kind::unresolved) {
      end_ = comes_to_rest(time_ + touch.time / model_.period()) ? ExactStatus::chattering
                                                                 : ExactStatus::grazing;
      return false;
    }
    const bool free = touch.kind == Touch::Kind::none;
    state_ = flight.state_at(free ? length : touch.time);
    time_ = free ? time : time_ + touch.time / model_.period();
    if (free) return state_.allFinite();
    if (!rebound(touch.contact)) return false;
  }
  end_ = ExactStatus::too_many_impacts;
  return false;
}

}  // namespace wavebalance::solvers::detail
