#pragma once
#include <pybind11/pybind11.h>

#include "scene/enum_names.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/stability/curve_stability.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::python {

/// One law for all contacts, or a sequence of one each. Throws std::invalid_argument for anything else.
solvers::ContactLaws laws_of(const pybind11::object& laws);
/// The same for the contacts of a structure. Throws std::invalid_argument for rigid laws at contacts with
/// mass.
solvers::ContactLaws laws_of(const pybind11::object& laws, const solvers::LinearStructure& structure);

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

/// A periodic response with what it belongs to.
struct Response {
  std::shared_ptr<Problem> problem;
  solvers::ContactLaws laws;
  solvers::PeriodicResponse found;
  double wall_seconds = 0.0;  ///< of the condensation and the solution
};

/// A solution at a frequency (Hz) near the guess (contacts x points, m), the response before it, or the
/// motion without contact.
Response solve(const std::shared_ptr<Problem>& problem, solvers::ContactLaws laws, double frequency,
               const solvers::ForcedResponseOptions& options, const Eigen::VectorXd& guess,
               const Eigen::VectorXd& guess_force);

/// A curve with its stability; without points where that was not wanted or no modes were found.
struct Curve {
  std::shared_ptr<Problem> problem;
  solvers::ContactLaws laws;
  solvers::FrequencySweep curve;
  solvers::CurveStability stability;
  double wall_seconds = 0.0;

  std::size_t size() const { return curve.points.size(); }
};

}  // namespace wavebalance::python
