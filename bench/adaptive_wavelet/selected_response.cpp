#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "adaptive_wavelet.hpp"
#include "dense_solve.hpp"
#include "linalg/safe_norm.hpp"
#include "linalg/spans.hpp"

namespace wavebalance::solvers {
namespace {

// R(a) = a - free + effect^T s f_c(values a) and its Newton steps.
class SelectedSystem {
 public:
  SelectedSystem(const SelectedBalance& balance, const AnyContactLaw& law)
      : law_(law),
        balance_(balance),
        displacement_(balance.values.rows()),
        force_(balance.values.rows()),
        tangent_(balance.values.rows()) {}

  const SelectedBalance& balance() const { return balance_; }
  const Eigen::VectorXd& displacement() const { return displacement_; }
  const Eigen::VectorXd& force() const { return force_; }
  const Eigen::VectorXd& residual() const { return residual_; }
  void set_stiffness_factor(double factor) { factor_ = factor; }

  // The relative residual.
  double evaluate(const Eigen::VectorXd& a) {
    displacement_.noalias() = balance_.values * a;
    contract();
    residual_ = a - balance_.free + response_;
    const double relative = relative_to(balance_.free.norm() + response_.norm(), residual_.norm());
    return std::isfinite(relative) ? relative : std::numeric_limits<double>::infinity();
  }

  // The coefficients that the force at given displacement samples leads to.
  Eigen::VectorXd picard(const Eigen::VectorXd& displacement) {
    displacement_ = displacement;
    contract();
    return balance_.free - response_;
  }

  // J^-1 R; empty when J is singular.
  Eigen::VectorXd step() {
    const std::vector<int> active = active_points();
    const Eigen::MatrixXd values = tangent_(active).asDiagonal() * balance_.values(active, Eigen::all);
    const Eigen::MatrixXd effect = balance_.effect(active, Eigen::all);
    Eigen::MatrixXd jacobian = effect.transpose() * values;
    jacobian.diagonal().array() += 1.0;
    return detail::dense_solve(jacobian, residual_);
  }

 private:
  std::vector<int> active_points() const {
    std::vector<int> active;
    for (int l = 0; l < tangent_.size(); ++l)
      if (tangent_[l] != 0.0) active.push_back(l);
    return active;
  }
  void contract() {
    law_.evaluate(span_of(displacement_), span_of(force_), span_of(tangent_));
    force_ *= factor_;
    tangent_ *= factor_;
    const std::vector<int> active = active_points();
    response_.noalias() = balance_.effect(active, Eigen::all).transpose() * force_(active);
  }

  AnyContactLaw law_;
  const SelectedBalance& balance_;
  double factor_ = 1.0;
  Eigen::VectorXd displacement_, force_, tangent_, response_, residual_;
};

struct NewtonEnd {
  SolveStatus status = SolveStatus::iteration_limit;
  int iterations = 0;
  double residual = 0.0;
};

// Newton with Armijo backtracking on ||R||^2.
NewtonEnd newton(SelectedSystem& system, Eigen::VectorXd& a, const NewtonOptions& options) {
  constexpr double sufficient = 1e-4;
  NewtonEnd end;
  end.residual = system.evaluate(a);
  for (;; ++end.iterations) {
    if (end.residual <= options.tolerance) {
      end.status = SolveStatus::converged;
      return end;
    }
    if (end.iterations >= options.max_iterations) return end;
    const double start = system.residual().squaredNorm();
    const Eigen::VectorXd direction = system.step();
    if (direction.size() == 0) {
      end.status = SolveStatus::singular;
      return end;
    }
    const Eigen::VectorXd base = a;
    double length = 1.0;
    for (; length >= options.min_step; length *= 0.5) {
      a = base - length * direction;
      end.residual = system.evaluate(a);
      if (system.residual().squaredNorm() <= (1.0 - 2.0 * sufficient * length) * start) break;
    }
    if (length >= options.min_step) continue;
    a = base;
    end.residual = system.evaluate(a);
    end.status = SolveStatus::stalled;
    return end;
  }
}

// From a law that hardly acts to the law itself, in steps of the stiffness's logarithm that shrink where
// Newton fails.
NewtonEnd stiffen(SelectedSystem& system, Eigen::VectorXd& a, const NewtonOptions& options) {
  constexpr double softest = -18.0, smallest = 1e-3;
  double reached = softest, step = 4.0;
  NewtonEnd total;
  a = system.balance().free;
  for (double next = softest;;) {
    Eigen::VectorXd trial = a;
    system.set_stiffness_factor(std::exp(next));
    const NewtonEnd end = newton(system, trial, options);
    total.iterations += end.iterations;
    total.status = end.status;
    total.residual = end.residual;
    if (end.status == SolveStatus::converged) {
      a = trial;
      reached = next;
      if (reached == 0.0) return total;
      step *= 1.5;
    } else {
      step *= 0.4;
      if (step < smallest || next == softest) break;
    }
    next = std::min(0.0, reached + step);
  }
  system.set_stiffness_factor(1.0);
  total.residual = system.evaluate(a);
  return total;
}

}  // namespace

SelectedResponse selected_response(const SelectedBalance& balance, const AnyContactLaw& law,
                                   const NewtonOptions& options, const Eigen::VectorXd& start) {
  if (start.size() != 0 && start.size() != balance.values.rows())
    throw std::invalid_argument("selected_response: start has " + std::to_string(start.size()) +
                                " samples; it must be empty or have the problem's " +
                                std::to_string(balance.values.rows()));
  SelectedSystem system(balance, law);
  Eigen::VectorXd a = start.size() == 0 ? balance.free : system.picard(start);
  NewtonEnd end = newton(system, a, options);
  if (end.status != SolveStatus::converged) {
    const int before = end.iterations;
    end = stiffen(system, a, options);
    end.iterations += before;
  }
  return {end.status, end.iterations,        end.residual,  balance.selection,
          a,          system.displacement(), system.force()};
}

}  // namespace wavebalance::solvers
