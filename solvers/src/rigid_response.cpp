#include "wavebalance/solvers/rigid_response.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "active_block.hpp"
#include "wavebalance/solvers/arc_length.hpp"

namespace wavebalance::solvers {
namespace {

struct UnilateralSpring {
  double stiffness;
  double start;

  double force(double u) const { return u > start ? stiffness * (u - start) : 0.0; }
  double tangent(double u) const { return u >= start ? stiffness : 0.0; }
  double potential(double u) const { return u > start ? 0.5 * stiffness * (u - start) * (u - start) : 0.0; }
  double gap() const { return start; }
};

// The gap of each sample.
Eigen::VectorXd sample_gaps(const Eigen::VectorXd& gaps, int points) {
  return gaps.transpose().replicate(points, 1).reshaped();
}

ContactLaws springs(const Eigen::VectorXd& gaps, double stiffness) {
  std::vector<AnyContactLaw> laws;
  for (const double gap : gaps) laws.emplace_back(UnilateralSpring{stiffness, gap});
  return laws;
}

// The path over ln(stiffness) with the compliance as unit: 0 is a spring as stiff as the structure.
class StiffeningPath {
 public:
  StiffeningPath(CondensedProblem& problem, const Eigen::VectorXd& gaps, const RigidResponseOptions& options)
      : options_(options),
        unit_(1.0 / problem.columns().cwiseAbs().maxCoeff()),
        system_(problem, springs(gaps, unit_)),
        gap_(sample_gaps(gaps, problem.points())),
        size_(problem.free_response().cwiseAbs().maxCoeff()) {}

  double unit() const { return unit_; }
  double size() const { return size_; }
  ContactSystem& system() { return system_; }
  int iterations() const { return iterations_; }

  // Leaves u at the stiffest spring reached and returns ln of its stiffness; nothing when not even a soft one
  // was solved.
  std::optional<double> follow(Eigen::VectorXd& u) {
    const double softest = std::log(1e-6);
    const double stiffest = std::log(options_.stiffest);
    parameter_.set(system_, softest);
    u = system_.problem().free_response();
    const NewtonResult first = newton(system_, u, options_.newton);
    iterations_ = first.iterations;
    if (first.status != SolveStatus::converged) return std::nullopt;
    ArcLength curve(system_, parameter_, arc_options());
    if (curve.start(u, softest, 1.0) != ArcLength::Status::advanced) return softest;
    double reached = softest;
    for (int step = 0; step < options_.max_steps && curve.advance() == ArcLength::Status::advanced; ++step) {
      ++iterations_;
      const CurvePoint& point = curve.point();
      if (point.parameter < softest) break;
      if (point.parameter > reached) {
        reached = point.parameter;
        u = point.displacement;
      }
      const bool rigid = (point.displacement - gap_).maxCoeff() <= options_.tolerance * size_;
      if (rigid || point.parameter >= stiffest) break;
      if (options_.observer && !options_.observer("stiffening", step, point.residual)) break;
    }
    return reached;
  }

 private:
  ArcLengthOptions arc_options() const {
    ArcLengthOptions arc;
    arc.displacement_scale = std::max(size_, gap_.cwiseAbs().maxCoeff());
    arc.parameter_scale = 4.0;
    arc.largest_step = 0.5;
    arc.smallest_step = 1e-5;
    arc.largest_angle = 0.6;
    arc.corners = Corners::where_needed;
    return arc;
  }

  RigidResponseOptions options_;
  double unit_;
  ContactSystem system_;
  Eigen::VectorXd gap_;  // of each sample
  double size_;
  StiffnessParameter parameter_;
  int iterations_ = 0;
};

// Force with u = gap at the samples where `start` presses, by least squares: K is singular on more samples
// than there are functions. Nothing when a sign fails.
std::optional<Eigen::VectorXd> solve_active(CondensedProblem& problem, const Eigen::VectorXd& gap,
                                            const Eigen::VectorXd& start, double tolerance) {
  std::vector<int> active;
  for (int l = 0; l < start.size(); ++l)
    if (start[l] > 0.0) active.push_back(l);
  if (active.empty()) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(active.size());
  Eigen::MatrixXd matrix(count, count);
  fill_active_compliance(problem, active, matrix);
  const Eigen::VectorXd right = (problem.free_response() - gap)(active);
  const Eigen::VectorXd values = matrix.completeOrthogonalDecomposition().solve(right);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(start.size());
  force(active) = values;
  Eigen::VectorXd product(start.size());
  problem.apply(force, product);
  const double excess = (problem.free_response() - product - gap).maxCoeff();
  if (!force.allFinite() || values.minCoeff() < 0.0 || excess > tolerance) return std::nullopt;
  return force;
}

void require_gaps(const CondensedProblem& problem, const Eigen::VectorXd& gaps) {
  if (gaps.size() != problem.contacts())
    throw std::invalid_argument("rigid_response: gaps has " + std::to_string(gaps.size()) +
                                " entries; the problem has " + std::to_string(problem.contacts()) +
                                " contacts");
  if (!gaps.allFinite()) throw std::invalid_argument("rigid_response: every gap must be finite");
}

// Stiffens springs and then solves their active samples; fills all of `result` but what follows from the
// force.
void solve_contact(CondensedProblem& problem, const Eigen::VectorXd& gaps, const Eigen::VectorXd& gap,
                   const RigidResponseOptions& options, RigidResponse& result) {
  PeriodicResponse& response = result.response;
  const double tolerance = options.tolerance * response.displacement.cwiseAbs().maxCoeff();
  StiffeningPath path(problem, gaps, options);
  Eigen::VectorXd u;
  const std::optional<double> reached = path.follow(u);
  response.iterations = path.iterations();
  response.used_homotopy = true;
  response.status = SolveStatus::stalled;
  if (!reached) return;
  StiffnessParameter{}.set(path.system(), *reached);
  response.residual = path.system().evaluate(u);
  response.contact_force = path.system().force();
  response.displacement = u;
  result.stiffness = path.unit() * std::exp(*reached);
  if (const auto exact = solve_active(problem, gap, response.contact_force, 1e-9 * path.size())) {
    Eigen::VectorXd product(problem.samples());
    problem.apply(*exact, product);
    response.contact_force = *exact;
    response.displacement = problem.free_response() - product;
    response.residual = 0.0;
    result.stiffness = std::numeric_limits<double>::infinity();
  }
  if ((response.displacement - gap).maxCoeff() <= tolerance) response.status = SolveStatus::converged;
}

}  // namespace

Complementarity complementarity(const Eigen::VectorXd& displacement, const Eigen::VectorXd& force,
                                double gap) {
  return complementarity(displacement, force, Eigen::VectorXd::Constant(1, gap));
}

Complementarity complementarity(const Eigen::VectorXd& displacement, const Eigen::VectorXd& force,
                                const Eigen::VectorXd& gaps) {
  const auto points = static_cast<int>(displacement.size() / gaps.size());
  const Eigen::VectorXd opening = sample_gaps(gaps, points) - displacement;
  Complementarity result{-opening.minCoeff(), force.minCoeff(), 0.0};
  const double scale = force.cwiseAbs().maxCoeff() * opening.cwiseAbs().maxCoeff();
  if (scale > 0.0) result.product = force.cwiseProduct(opening).cwiseAbs().maxCoeff() / scale;
  return result;
}

RigidResponse rigid_response(CondensedProblem& problem, const Eigen::VectorXd& gaps,
                             const RigidResponseOptions& options) {
  require_gaps(problem, gaps);
  const int points = problem.points();
  const Eigen::VectorXd gap = sample_gaps(gaps, points);
  RigidResponse result;
  PeriodicResponse& response = result.response;
  response.frequency = problem.frequency();
  response.displacement = problem.free_response();
  response.contact_force = Eigen::VectorXd::Zero(problem.samples());
  if ((response.displacement - gap).maxCoeff() <= 0.0) {
    response.status = SolveStatus::converged;
    result.stiffness = std::numeric_limits<double>::infinity();
  } else {
    solve_contact(problem, gaps, gap, options, result);
  }
  response.coefficients = problem.coefficients(response.contact_force);
  result.complementarity = complementarity(response.displacement, response.contact_force, gaps);
  for (int c = 0; c < problem.contacts(); ++c)
    result.contact_complementarity.push_back(
        complementarity(response.displacement.segment(c * points, points),
                        response.contact_force.segment(c * points, points), gaps[c]));
  result.active_samples = static_cast<int>((response.contact_force.array() > 0.0).count());
  return result;
}

RigidResponse rigid_response(CondensedProblem& problem, double gap, const RigidResponseOptions& options) {
  return rigid_response(problem, Eigen::VectorXd::Constant(problem.contacts(), gap), options);
}

}  // namespace wavebalance::solvers
