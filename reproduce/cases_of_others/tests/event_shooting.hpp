#pragma once
#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "dense_algebra.hpp"

/// Shooting for M u'' + C u' + K u = F cos(w t) with a spring at the first degree of freedom. Motions with
/// and without contact are exponentials of matrices, and the instants between them roots of the first
/// displacement.
namespace wavebalance::cases::testing {

struct SpringSystem {
  Eigen::MatrixXd mass, damping, stiffness;
  Eigen::VectorXd load;
  double spring = 0.0, gap = 0.0;
};

/// The state (u, u') after a period, and its derivative with respect to that before.
struct Period {
  Eigen::VectorXd end;
  Eigen::MatrixXd monodromy;
};

class EventShooting {
 public:
  EventShooting(const SpringSystem& system, double omega)
      : gap_(system.gap), size_(system.load.size()), period_(2.0 * std::numbers::pi / omega) {
    for (const bool contact : {false, true}) matrix_[contact] = matrix(system, omega, contact);
  }

  Period period(const Eigen::VectorXd& start) const {
    constexpr int steps = 4000;  // contact that opens and closes within one of them is missed
    const double step = period_ / steps;
    const Eigen::MatrixXd whole[2] = {oracle::exponential(matrix_[0] * step),
                                      oracle::exponential(matrix_[1] * step)};
    const Eigen::Index states = 2 * size_;
    Eigen::VectorXd y(states + 3);
    y << start, 1.0, 0.0, 1.0;  // then cos, sin and 1
    Eigen::MatrixXd map = Eigen::MatrixXd::Identity(states + 3, states + 3);
    bool contact = y[0] > gap_;
    for (int k = 0; k < steps; ++k) {
      double left = step;
      Eigen::MatrixXd move = whole[contact];
      while (((move * y)[0] > gap_) != contact) {
        const double until = crossing(y, left, contact);
        const Eigen::MatrixXd part = oracle::exponential(matrix_[contact] * until);
        y = part * y;
        map = part * map;
        left -= until;
        contact = !contact;
        move = oracle::exponential(matrix_[contact] * left);
      }
      y = move * y;
      map = move * map;
    }
    return {y.head(states), map.topLeftCorner(states, states)};
  }

  /// Newton's method for a motion of one period.
  Period periodic(Eigen::VectorXd& state) const {
    Period one = period(state);
    for (int i = 0; i < 12 && (one.end - state).norm() > 1e-13 * (1.0 + state.norm()); ++i) {
      const Eigen::MatrixXd jacobian = one.monodromy - Eigen::MatrixXd::Identity(state.size(), state.size());
      state -= oracle::solve(jacobian, Eigen::VectorXd(one.end - state));
      one = period(state);
    }
    return one;
  }

 private:
  static Eigen::MatrixXd matrix(const SpringSystem& system, double omega, bool contact) {
    const Eigen::Index n = system.load.size();
    const Eigen::MatrixXd inverse = oracle::inverse(system.mass);
    Eigen::MatrixXd stiffness = system.stiffness;
    if (contact) stiffness(0, 0) += system.spring;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n + 3, 2 * n + 3);
    a.block(0, n, n, n).setIdentity();
    a.block(n, 0, n, n) = -inverse * stiffness;
    a.block(n, n, n, n) = -inverse * system.damping;
    a.block(n, 2 * n, n, 1) = inverse * system.load;
    if (contact) a.block(n, 2 * n + 2, n, 1) = system.spring * system.gap * inverse.col(0);
    a(2 * n, 2 * n + 1) = -omega;
    a(2 * n + 1, 2 * n) = omega;
    return a;
  }

  double crossing(const Eigen::VectorXd& y, double left, bool contact) const {
    double low = 0.0, high = left, at = 0.5 * left;
    for (int i = 0; i < 60; ++i) {
      const Eigen::VectorXd there = oracle::exponential(matrix_[contact] * at) * y;
      const double beyond = there[0] - gap_;
      ((beyond > 0.0) == contact ? low : high) = at;
      const double newton = at - beyond / there[size_];
      const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
      if (std::abs(next - at) < 1e-15 * period_) return next;
      at = next;
    }
    return at;
  }

  Eigen::MatrixXd matrix_[2];
  double gap_;
  Eigen::Index size_;
  double period_;
};

}  // namespace wavebalance::cases::testing
