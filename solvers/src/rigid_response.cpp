#include "wavebalance/solvers/rigid_response.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

// The path over ln(stiffness) with the compliance as unit: 0 is a spring as stiff as the structure.
class StiffeningPath {
 public:
  StiffeningPath(CondensedProblem& problem, double gap, const RigidResponseOptions& options)
      : options_(options),
        unit_(1.0 / problem.columns().cwiseAbs().maxCoeff()),
        system_(problem, UnilateralSpring{unit_, gap}),
        gap_(gap),
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
      const bool rigid = point.displacement.maxCoeff() - gap_ <= options_.tolerance * size_;
      if (rigid || point.parameter >= stiffest) break;
      if (options_.observer && !options_.observer("stiffening", step, point.residual)) break;
    }
    return reached;
  }

 private:
  ArcLengthOptions arc_options() const {
    ArcLengthOptions arc;
    arc.displacement_scale = std::max(size_, std::abs(gap_));
    arc.parameter_scale = 4.0;
    arc.largest_step = 0.5;
    arc.smallest_step = 1e-5;
    arc.largest_angle = 0.6;
    return arc;
  }

  RigidResponseOptions options_;
  double unit_;
  ContactSystem system_;
  double gap_;
  double size_;
  StiffnessParameter parameter_;
  int iterations_ = 0;
};

// Force with u = gap at the samples where `start` presses, by least squares: K is singular on more samples
// than there are functions. Nothing when a sign fails.
std::optional<Eigen::VectorXd> solve_active(CondensedProblem& problem, double gap,
                                            const Eigen::VectorXd& start, double tolerance) {
  std::vector<int> active;
  for (int l = 0; l < start.size(); ++l)
    if (start[l] > 0.0) active.push_back(l);
  const auto count = static_cast<Eigen::Index>(active.size());
  const Eigen::MatrixXd& columns = problem.columns();
  const int period = static_cast<int>(columns.cols());
  Eigen::MatrixXd matrix(count, count);
  Eigen::VectorXd right(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int row = active[static_cast<std::size_t>(i)];
    right[i] = problem.free_response()[row] - gap;
    for (Eigen::Index j = 0; j < count; ++j) {
      const int column = active[static_cast<std::size_t>(j)];
      const int shifted = row - (column - column % period);
      matrix(i, j) = columns(shifted < 0 ? shifted + problem.points() : shifted, column % period);
    }
  }
  const Eigen::VectorXd values = matrix.completeOrthogonalDecomposition().solve(right);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(start.size());
  for (Eigen::Index i = 0; i < count; ++i) force[active[static_cast<std::size_t>(i)]] = values[i];
  Eigen::VectorXd product(start.size());
  problem.apply(force, product);
  const double excess = (problem.free_response() - product).maxCoeff() - gap;
  if (!force.allFinite() || (count > 0 && values.minCoeff() < 0.0) || excess > tolerance) return std::nullopt;
  return force;
}

}  // namespace

Complementarity complementarity(const Eigen::VectorXd& displacement, const Eigen::VectorXd& force,
                                double gap) {
  const Eigen::VectorXd opening = (gap - displacement.array()).matrix();
  Complementarity result{-opening.minCoeff(), force.minCoeff(), 0.0};
  const double scale = force.cwiseAbs().maxCoeff() * opening.cwiseAbs().maxCoeff();
  if (scale > 0.0) result.product = force.cwiseProduct(opening).cwiseAbs().maxCoeff() / scale;
  return result;
}

RigidResponse rigid_response(CondensedProblem& problem, double gap, const RigidResponseOptions& options) {
  if (!std::isfinite(gap)) throw std::invalid_argument("rigid_response: gap must be finite");
  RigidResponse result;
  PeriodicResponse& response = result.response;
  response.frequency = problem.frequency();
  response.displacement = problem.free_response();
  response.contact_force = Eigen::VectorXd::Zero(problem.points());
  const double tolerance = options.tolerance * response.displacement.cwiseAbs().maxCoeff();
  if (response.displacement.maxCoeff() <= gap) {
    response.status = SolveStatus::converged;
    result.stiffness = std::numeric_limits<double>::infinity();
  } else {
    StiffeningPath path(problem, gap, options);
    Eigen::VectorXd u;
    const std::optional<double> reached = path.follow(u);
    response.iterations = path.iterations();
    response.used_homotopy = true;
    response.status = SolveStatus::stalled;
    if (reached) {
      StiffnessParameter{}.set(path.system(), *reached);
      response.residual = path.system().evaluate(u);
      response.contact_force = path.system().force();
      response.displacement = u;
      result.stiffness = path.unit() * std::exp(*reached);
      if (const auto exact = solve_active(problem, gap, response.contact_force, 1e-9 * path.size())) {
        Eigen::VectorXd product(problem.points());
        problem.apply(*exact, product);
        response.contact_force = *exact;
        response.displacement = problem.free_response() - product;
        response.residual = 0.0;
        result.stiffness = std::numeric_limits<double>::infinity();
      }
      if (response.displacement.maxCoeff() - gap <= tolerance) response.status = SolveStatus::converged;
    }
  }
  response.coefficients = problem.coefficients(response.contact_force);
  result.complementarity = complementarity(response.displacement, response.contact_force, gap);
  result.active_samples = static_cast<int>((response.contact_force.array() > 0.0).count());
  return result;
}

}  // namespace wavebalance::solvers
