#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "linalg/dense.hpp"
#include "support/impact_scenes.hpp"

namespace wavebalance::solvers::testing {

/// Motions in time of all degrees of freedom of a scene, by matrix exponentials over fixed steps, in which an
/// impact is where a contact that was below its gap is above it. Nothing is shared with the product but
/// exponentials and LU.
class ImpactOracle {
 public:
  struct Event {
    int contact;
    double time, velocity, impulse;  // s, m/s, N s
  };

  explicit ImpactOracle(const ImpactScene& scene, int steps = 2000) : scene_(scene) {
    const Eigen::Index n = scene.mass.rows();
    const Eigen::MatrixXd inverse = detail::Lu<double>(scene.mass).inverse();
    rates_.setZero(2 * n, 2 * n);
    rates_.topRightCorner(n, n).setIdentity();
    rates_.bottomLeftCorner(n, n) = -inverse * scene.stiffness;
    rates_.bottomRightCorner(n, n) = -inverse * scene.damping;
    impulses_.setZero(2 * n, scene.contacts.rows());
    impulses_.bottomRows(n) = inverse * scene.contacts.transpose();
    mobility_ = scene.contacts * inverse * scene.contacts.transpose();
    free_ = scene.free_amplitudes();
    step_ = load_period() / steps;
    growth_ = detail::exponential(step_ * rates_);
  }

  double load_period() const { return 1.0 / scene_.frequency(); }

  /// The state (2 n) at t = 0 of the periodic motion of `periods` load periods with these impacts.
  Eigen::VectorXd periodic_state(const std::vector<Event>& events, int periods) const {
    const double period = periods * load_period();
    const Eigen::Index size = rates_.rows();
    const detail::Lu<double> repeated(Eigen::MatrixXd::Identity(size, size) -
                                      detail::exponential(period * rates_));
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size);
    for (const Event& event : events)
      sum -= event.impulse *
             (detail::exponential((period - event.time) * rates_) * impulses_.col(event.contact));
    return repeated.solve(sum) + free_state(0.0);
  }

  /// Goes on from a state at a time, s, to another.
  Eigen::VectorXd advance(Eigen::VectorXd state, double time, double until,
                          std::vector<Event>& events) const {
    const double begin = time;
    const auto steps = static_cast<long>(std::lround((until - time) / step_));
    for (long k = 1; k <= steps; ++k) {
      const double end = k == steps ? until : begin + double(k) * step_;
      while (advance_within(state, time, end, events)) {
      }
    }
    return state;
  }
  /// The state (2 n) without contact.
  Eigen::VectorXd free_state(double time) const {
    const std::complex<double> rate(0.0, scene_.omega), phase = std::exp(rate * time);
    Eigen::VectorXd state(2 * free_.size());
    state << (free_ * phase).real(), (free_ * (rate * phase)).real();
    return state;
  }

 private:
  Eigen::VectorXd at(const Eigen::VectorXd& state, double from, double to) const {
    const Eigen::VectorXd own = state - free_state(from);
    const bool whole = std::abs(to - from - step_) < 1e-9 * step_;
    const Eigen::MatrixXd growth = whole ? growth_ : detail::exponential((to - from) * rates_);
    return growth * own + free_state(to);
  }
  double above(const Eigen::VectorXd& state, int c) const {
    return scene_.contacts.row(c).dot(state.head(free_.size())) - scene_.gaps[c];
  }

  // To the next impact before `end`, true, or to `end`.
  bool advance_within(Eigen::VectorXd& state, double& time, double end, std::vector<Event>& events) const {
    constexpr int parts = 4;
    double from = time;
    Eigen::VectorXd low_state = state;
    for (int part = 1; part <= parts; ++part) {
      const double to = part == parts ? end : time + (end - time) * part / parts;
      const Eigen::VectorXd next = at(state, time, to);
      int hit = -1;
      double first = to;
      for (int c = 0; c < scene_.gaps.size(); ++c) {
        if (above(next, c) <= 0.0) continue;
        const double when = crossing(state, time, from, to, c);
        if (hit < 0 || when < first) {
          hit = c;
          first = when;
        }
      }
      if (hit >= 0) {
        state = at(state, time, first);
        time = first;
        const double v = scene_.contacts.row(hit).dot(state.tail(free_.size()));
        const double impulse = (1.0 + scene_.restitution) * v / mobility_(hit, hit);
        if (v > 0.0) {
          state -= impulse * impulses_.col(hit);
          events.push_back({hit, time, v, impulse});
          return time < end;
        }
      }
      from = to;
    }
    state = at(state, time, end);
    time = end;
    return false;
  }
  double crossing(const Eigen::VectorXd& state, double time, double low, double high, int c) const {
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (above(at(state, time, middle), c) > 0.0 ? high : low) = middle;
    }
    return low;
  }

  ImpactScene scene_;
  Eigen::MatrixXd rates_, impulses_, mobility_, growth_;
  Eigen::VectorXcd free_;
  double step_;
};

}  // namespace wavebalance::solvers::testing
