#pragma once
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"

namespace wavebalance::python {

/// A structure as it is solved, and the way back to the degrees of freedom that Python gave.
struct Structure : solvers::LinearStructure {
  /// Displacements of the given degrees of freedom from those that are solved for; 0 x 0: they are equal.
  Eigen::MatrixXd recovery = {};
};

/// A structure with its pair of bases, condensed on the contacts. Threads of Python may share it. Whoever
/// works with it holds `alone`, without the lock of the interpreter.
class Problem {
 public:
  Problem(solvers::CondensedProblem problem, Eigen::MatrixXd recovery)
      : condensed_(std::move(problem)), recovery_(std::move(recovery)) {}

  std::mutex alone;

  /// The problem at its last frequency and load scale. What may change them calls moved() before.
  solvers::CondensedProblem& condensed() { return condensed_; }
  const solvers::CondensedProblem& condensed() const { return condensed_; }
  void moved() { frequency_ = std::numeric_limits<double>::quiet_NaN(); }
  /// The problem at a frequency (Hz) and load scale. Throws as CondensedProblem::set_frequency does.
  solvers::CondensedProblem& at(double frequency, double load_scale = 1.0) {
    if (condensed_.load_scale() != load_scale) condensed_.set_load_scale(load_scale);
    if (frequency_ != frequency) {
      moved();
      condensed_.set_frequency(frequency);
      frequency_ = frequency;
    }
    return condensed_;
  }
  /// Rows of the given degrees of freedom from those of the structure that is solved.
  Eigen::MatrixXd recovered(const Eigen::MatrixXd& rows) const {
    return recovery_.size() > 0 ? Eigen::MatrixXd(recovery_ * rows) : rows;
  }
  /// Made on first use. Throws std::invalid_argument where no modes are found.
  const solvers::ContactDynamics& dynamics() {
    if (!dynamics_) dynamics_.emplace(condensed_.structure());
    return *dynamics_;
  }

 private:
  solvers::CondensedProblem condensed_;
  Eigen::MatrixXd recovery_;                                     // as of Structure
  double frequency_ = std::numeric_limits<double>::quiet_NaN();  // at which it is condensed
  std::optional<solvers::ContactDynamics> dynamics_ = {};
};

}  // namespace wavebalance::python
