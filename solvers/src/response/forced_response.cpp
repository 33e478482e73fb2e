#include "wavebalance/solvers/response/forced_response.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "complementarity/law_force.hpp"
#include "wavebalance/solvers/continuation/arc_length.hpp"

namespace wavebalance::solvers {
namespace {

double rms(const Eigen::VectorXd& values) { return values.norm() / std::sqrt(double(values.size())); }

ArcLengthOptions homotopy_options(ContactSystem& system) {
  ArcLengthOptions options;
  options.displacement_scale = std::max(rms(system.problem().free_response()), system.laws().largest_gap());
  options.parameter_scale = 4.0;
  options.largest_step = 0.25;
  options.smallest_step = 1e-5;
  options.largest_angle = 0.6;
  options.corners = Corners::where_needed;
  options.most_operations = 5e10;  // some twenty seconds: thousands of samples in stiff contact are lost here
  return options;
}

// Follows the solution from a nearly vanishing law to the law itself; true when `u` is a start for it.
bool follow_stiffness(ContactSystem& system, Eigen::VectorXd& u, const ForcedResponseOptions& options,
                      int& iterations) {
  const double softest = std::log(1e-8);
  const StiffnessParameter parameter;
  u = system.problem().free_response();
  parameter.set(system, softest);
  const NewtonResult first = newton(system, u, options.newton);
  iterations += first.iterations;
  if (first.status != SolveStatus::converged) return false;
  ArcLength curve(system, parameter, homotopy_options(system));
  if (curve.start(u, softest, 1.0) != ArcLength::Status::advanced) return false;
  for (int step = 0; step < options.homotopy_steps; ++step) {
    if (curve.advance() != ArcLength::Status::advanced) return false;
    ++iterations;
    const CurvePoint& point = curve.point();
    if (options.observer && !options.observer("homotopy", step, point.residual)) return false;
    if (point.parameter < softest) return false;
    if (point.parameter < 0.0) continue;
    CurvePoint landed;
    const bool located = curve.locate([](const CurvePoint& p) { return p.parameter; }, landed);
    u = located ? landed.displacement : point.displacement;
    return true;
  }
  return false;
}

void require_start(const CondensedProblem& problem, const Eigen::VectorXd& guess) {
  if (problem.frequency() == 0.0)
    throw std::invalid_argument(
        "forced_response: the problem has no frequency yet; call set_frequency first");
  if (guess.size() != 0 && guess.size() != problem.samples())
    throw std::invalid_argument("forced_response: guess has " + std::to_string(guess.size()) +
                                " samples; it must be empty or have the problem's " +
                                std::to_string(problem.samples()));
}

// One response from several starts: what the best of them gave so far.
class Attempts {
 public:
  Attempts(ContactSystem& system, const ForcedResponseOptions& options)
      : system_(system), options_(options) {}

  bool converged() const { return result_.status == SolveStatus::converged; }
  int iterations() const { return iterations_; }

  // Newton from u; of two that do not converge the one with the smaller residual is kept.
  void start_at(Eigen::VectorXd u) {
    NewtonResult result = newton(system_, u, options_.newton);
    iterations_ += result.iterations;
    if (u_.size() != 0 && !(result.residual < result_.residual)) return;
    result_ = std::move(result);
    u_ = std::move(u);
  }

  // By complementarity; false when the observer has stopped it.
  bool from_obstacles() {
    bool go_on = true;
    int corner = 0;
    const LawForce found = law_force(system_, [&](double height) {
      go_on = !options_.observer || options_.observer("homotopy", corner++, height);
      return go_on;
    });
    iterations_ += found.corners;
    if (!found.found) return go_on;
    if (found.rounding <= largest_rounding) start_at(found.displacement);
    if (converged() || found.defect > largest_defect) return go_on;
    result_.status = SolveStatus::converged;
    result_.residual = found.defect;
    result_.residual_history.push_back(found.defect);
    result_.condition = found.condition;
    u_ = found.displacement;
    force_ = found.force;
    return go_on;
  }

  void along_stiffness() {
    Eigen::VectorXd u;
    const bool found = follow_stiffness(system_, u, options_, iterations_);
    system_.set_stiffness_factor(1.0);
    if (found) start_at(std::move(u));
  }

  void write(PeriodicResponse& response) {
    if (force_.size() == 0) system_.evaluate(u_);
    response.force_by_balance = force_.size() != 0;
    response.contact_force = response.force_by_balance ? force_ : system_.force();
    response.status = result_.status;
    response.residual = result_.residual;
    response.residual_history = std::move(result_.residual_history);
    response.condition = result_.condition;
    response.iterations = iterations_;
    response.coefficients = system_.problem().coefficients(response.contact_force);
    response.displacement = std::move(u_);
  }

 private:
  // Of the size of a motion: as far as a stiff law may be from its displacements.
  static constexpr double largest_defect = 1e-9;
  // Of a law's force: what Newton seeks, and beyond which it takes rounding for descent.
  static constexpr double largest_rounding = 1e-9;

  ContactSystem& system_;
  const ForcedResponseOptions& options_;
  NewtonResult result_;
  Eigen::VectorXd u_, force_;
  int iterations_ = 0;
};

}  // namespace

PeriodicResponse forced_response(CondensedProblem& problem, const ContactLaws& laws,
                                 const ForcedResponseOptions& options, const Eigen::VectorXd& guess) {
  require_start(problem, guess);
  ContactSystem system(problem, laws);
  PeriodicResponse response;
  response.frequency = problem.frequency();
  Attempts attempts(system, options);
  attempts.start_at(guess.size() != 0 ? guess : problem.free_response());
  if (!attempts.converged() && options.homotopy) {
    response.used_homotopy = true;
    if (attempts.from_obstacles() && !attempts.converged()) attempts.along_stiffness();
  }
  attempts.write(response);
  return response;
}

}  // namespace wavebalance::solvers
