#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "collocation/exact_solution_parts.hpp"
#include "flow/flow_intervals.hpp"
#include "impacts/impact_parts.hpp"
#include "impacts/impact_search.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "problem/motion_samples.hpp"
#include "wavebalance/solvers/flow/attractor_motion.hpp"
#include "wavebalance/solvers/problem/coexisting_motions.hpp"
#include "wavebalance/solvers/problem/motion_stability.hpp"

namespace wavebalance::solvers {
namespace {

using namespace detail;

bool has_impacts_alone(const ExactProblem& problem) {
  return problem.laws.have_impacts_alone(problem.dynamics.contacts()) && problem.dynamics.holding() == 0.0;
}

// Random states of the poles, uniform in discs.
class RandomStates {
 public:
  // The radii hold twice the free vibration after an impact with the speed of the motion without contact, and
  // twice the first motion found.
  RandomStates(const ExactProblem& problem, const ImpactResponse& first, unsigned seed)
      : problem_(problem), generator_(seed), radii_(Eigen::VectorXd::Zero(poles())) {
    constexpr double wider = 2.0;
    const Eigen::MatrixXd inverse_mass = inverse_contact_mass(problem.dynamics);
    const double speed = free_scales(problem).velocity;
    for (Index c = 0; c < inverse_mass.rows(); ++c)
      for (Index l = 0; l < poles() && inverse_mass(c, c) > 0.0; ++l)
        radii_[l] = std::max(radii_[l], std::abs(pole(l).left[c]) * (speed / inverse_mass(c, c)));
    if (first.motion.converged()) include(first);
    radii_ *= wider;
  }

  // One with all contacts below their gaps at t = 0, in smaller discs where none is found.
  Eigen::VectorXcd next() {
    constexpr int most = 64;
    Eigen::VectorXcd state(poles());
    for (int k = 0;; ++k) {
      const double smaller = std::ldexp(1.0, -(k / most));
      for (Index i = 0; i < poles(); ++i) {
        const double modulus = smaller * radii_[i] * std::sqrt(uniform_(generator_));
        const double angle = 2.0 * std::numbers::pi * uniform_(generator_);
        const bool real = pole(i).exponent.imag() == 0.0;
        state[i] = real ? std::complex<double>(modulus * std::cos(angle)) : std::polar(modulus, angle);
      }
      if (is_clear(state) || k >= 32 * most) return state;
    }
  }

 private:
  Index poles() const { return Index(problem_.dynamics.poles().size()); }
  const ContactPole& pole(Index l) const { return problem_.dynamics.poles()[std::size_t(l)]; }

  void include(const ImpactResponse& first) {
    if (has_impacts_alone(problem_) && !first.lasts() && !first.motion.impacts.empty()) {
      const ImpactModel model(over_periods(problem_, first.load_periods));
      radii_ = radii_.cwiseMax(states_after(model, first.motion.impacts).cwiseAbs().rowwise().maxCoeff());
    } else if (first.motion.parts->start) {
      radii_ =
          radii_.cwiseMax(states_by_pole(problem_.dynamics, first.motion.parts->start->state).cwiseAbs());
    }
  }

  bool is_clear(const Eigen::VectorXcd& state) const {
    Eigen::VectorXd displacement = problem_.linear_motion.rowwise().sum().real();
    for (Index l = 0; l < poles(); ++l)
      displacement +=
          (pole(l).exponent.imag() == 0.0 ? 1.0 : 2.0) * (pole(l).residue * state[l] * pole(l).shape).real();
    for (int c = 0; c < displacement.size(); c += problem_.laws[c].rows()) {
      const AnyContactLaw& law = problem_.laws[c];
      if (law.coupled() && displacement.segment(c, law.rows()).norm() >= law.gap()) return false;
      if ((law.restitution() || law.unilateral()) && displacement[c] >= law.gap()) return false;
    }
    return true;
  }

  const ExactProblem& problem_;
  std::mt19937 generator_;
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
  Eigen::VectorXd radii_;
};

class EventMotions {
 public:
  EventMotions(const ExactProblem& problem, const MotionsOptions& options)
      : problem_(problem), options_(options), impacts_alone_(has_impacts_alone(problem)) {}

  CoexistingMotions run() {
    const ImpactResponse first = settled({});
    result_.first = first.motion.status;
    arrive(first, MotionSource::rest);
    if (options_.random_starts > 0 && !cancelled()) {
      RandomStates states(problem_, first, options_.seed);
      while (result_.starts < options_.random_starts && !cancelled()) from(states.next());
    }
    describe();
    return std::move(result_);
  }

 private:
  bool cancelled() const { return result_.status == MotionsStatus::cancelled; }

  void from(const Eigen::VectorXcd& state) {
    const ImpactResponse found = settled(state);
    if (cancelled()) return;
    ++result_.starts;
    const CoexistingMotion* one = arrive(found, MotionSource::random);
    if (one == nullptr || !settled_)
      ++result_.none_by[one == nullptr ? found.motion.status : ExactStatus::not_settled];
  }

  // The attractor from a state, or from rest. Motions near the closest returns of impacts are kept for
  // later.
  ImpactResponse settled(const Eigen::VectorXcd& state) {
    ImpactResponse found;
    settled_ = false;
    near_.clear();
    if (impacts_alone_) {
      ImpactResponseOptions how;
      how.longest = options_.longest;
      how.observer = options_.observer;
      how.start = state;
      ImpactSearch search(problem_, how);
      found = search.run();
      settled_ = found.motion.converged() && found.unstable == 0;
      if (found.motion.status != ExactStatus::cancelled) near_ = search.near_returns();
    } else {
      found = attractor_by_events(state);
    }
    if (found.motion.status == ExactStatus::cancelled) result_.status = MotionsStatus::cancelled;
    return found;
  }

  ImpactResponse attractor_by_events(const Eigen::VectorXcd& state) {
    TimeSteppingOptions stepping;
    stepping.longest = options_.longest;
    stepping.observer = options_.observer;
    std::optional<PoleStart> start;
    if (state.size() > 0) start = PoleStart{0.0, state};
    ExactAttractor exact = attractor_motion(
        problem_, stepping, {.tolerance = options_.tolerance, .observer = options_.observer}, start);
    ImpactResponse found;
    found.load_periods = exact.load_periods;
    found.motion = std::move(exact.motion);
    if (found.motion.parts == nullptr) {
      if (found.motion.status != ExactStatus::cancelled)
        found.motion.status =
            exact.settled.ended == FlowStatus::grows ? ExactStatus::grows : ExactStatus::not_settled;
      return found;
    }
    found.multipliers = found.motion.multipliers();
    found.unstable = count_outside(found.multipliers);
    settled_ = exact.settled.stepping.attractor_periods >= 1 && found.unstable <= 0;
    return found;
  }

  // The motion of a start in the list, and those near it.
  CoexistingMotion* arrive(const ImpactResponse& found, MotionSource source) {
    const auto number = add(found, settled_ ? source : MotionSource::newton);
    for (const ImpactResponse& one : near_) add(one, MotionSource::newton);
    if (!number) return nullptr;
    CoexistingMotion& one = result_.motions[*number];
    if (!settled_) return &one;
    if (one.found_by == MotionSource::newton) one.found_by = source;
    one.arrivals += source == MotionSource::random ? 1 : 0;
    return &one;
  }

  std::optional<std::size_t> add(const ImpactResponse& found, MotionSource source) {
    if (!found.motion.converged()) return std::nullopt;
    MotionSamples samples = samples_of(found.motion, found.load_periods);
    if (problem_.dynamics.holding() > 0.0)  // the position of a free body is arbitrary
      samples.contacts.displacement.colwise() -= samples.contacts.displacement.rowwise().mean().eval();
    if (const auto known = find_among(samples_, samples)) return known;
    CoexistingMotion& one = result_.motions.emplace_back();
    one.motion = found.motion;
    one.periods = found.load_periods;
    one.stability = stability_of_multipliers(found.multipliers);
    one.found_by = source;
    samples_.push_back(std::move(samples));
    return samples_.size() - 1;
  }

  void describe() {
    for (CoexistingMotion& one : result_.motions)
      one.max_displacement = samples_of(one.motion, one.periods).contacts.displacement.maxCoeff();
    set_shares(result_);
    for (const auto& [status, count] : result_.none_by) result_.none += count;
    if (!cancelled() && !result_.motions.empty()) result_.status = MotionsStatus::converged;
  }

  const ExactProblem& problem_;
  const MotionsOptions& options_;
  bool impacts_alone_;
  bool settled_ = false;  // whether the structure converged to the last motion found
  std::vector<ImpactResponse> near_;
  std::vector<MotionSamples> samples_;  // of the motions of the result
  CoexistingMotions result_;
};

}  // namespace

CoexistingMotions event_motions(const ExactProblem& problem, const MotionsOptions& options) {
  options.validate();
  if (has_impacts_alone(problem)) require_impacts(problem);
  return EventMotions(problem, options).run();
}

}  // namespace wavebalance::solvers
