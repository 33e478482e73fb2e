#pragma once

#include "scene/enum_names.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::python {

/// The value of an enumeration that has this name in scenes. Throws std::invalid_argument for another.
template <class Enum>
Enum named(const std::string& key, const std::string& name) {
  std::string allowed;
  for (const auto& [value, known] : app::enum_names<Enum>) {
    if (name == known) return value;
    allowed += (allowed.empty() ? "\"" : ", \"") + std::string(known) + "\"";
  }
  throw std::invalid_argument(key + " is \"" + name + "\"; expected one of " + allowed);
}

/// A structure as it is solved, and the way back to the degrees of freedom that Python gave.
struct Structure : solvers::LinearStructure {
  /// Displacements of the given degrees of freedom from those that are solved for; 0 x 0: they are equal.
  Eigen::MatrixXd recovery = {};
};

/// A structure with its pair of bases, for any laws. Threads of Python may share it. Its user locks the
/// member `alone`, without the lock of the interpreter.
class Problem {
 public:
  Problem(solvers::CondensedProblem problem, Eigen::MatrixXd recovery)
      : problem_(std::move(problem), {}), recovery_(std::move(recovery)) {}

  std::mutex alone;

  const solvers::CondensedProblem& condensed() const { return problem_.condensed(); }
  /// The problem with these laws, which are checked as in ContactProblem.
  solvers::ContactProblem& with(const solvers::ContactLaws& laws) {
    problem_.set_laws(laws);
    return problem_;
  }
  /// Rows of the given degrees of freedom from the solved structure.
  Eigen::MatrixXd recovered(const Eigen::MatrixXd& rows) const {
    return recovery_.size() > 0 ? Eigen::MatrixXd(recovery_ * rows) : rows;
  }

 private:
  solvers::ContactProblem problem_;
  Eigen::MatrixXd recovery_;  // as of Structure
};

}  // namespace wavebalance::python
