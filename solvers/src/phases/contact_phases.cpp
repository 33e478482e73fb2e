#include "wavebalance/solvers/phases/contact_phases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "linalg/enum_table.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"
#include "phases/phase_equations.hpp"

namespace wavebalance::solvers {

struct PhaseMotion::Parts {
  detail::PhaseModel model;
  detail::PhaseIterate iterate;
  detail::PanelForces tangent, damping;  // slopes of the laws, N/m and N s/m
};

namespace {

using detail::Influence, detail::Layout, detail::LegendreNodes, detail::PanelForces, detail::PhaseIterate,
    detail::PhaseModel, detail::PhaseNewtonResult;

// At least so many instants at which the motion found is held against its phases.
constexpr Index least_samples = 256;

// Slopes at times l / N of the cubic spline through periodic samples that central differences of fourth order
// give, per period.
Eigen::MatrixXd slopes_of(const Eigen::MatrixXd& samples) {
  const Index count = samples.cols();
  Eigen::MatrixXd slopes(samples.rows(), count);
  const auto at = [&](Index l) { return samples.col((l % count + count) % count); };
  for (Index l = 0; l < count; ++l)
    slopes.col(l) = double(count) / 12.0 * (8.0 * (at(l + 1) - at(l - 1)) - (at(l + 2) - at(l - 2)));
  return slopes;
}

PhasesStatus refusal(const PhasesProblem& problem) {
  const ContactDynamics& dynamics = problem.dynamics;
  if (dynamics.structurally_damped()) return PhasesStatus::structural_damping;
  if (dynamics.holding() > 0.0) return PhasesStatus::free_structure;
  if (!problem.laws.have_finite_force()) return PhasesStatus::rigid_contact;
  if (problem.laws.depend_on_velocity() && !dynamics.constant().isZero(0.0))
    return PhasesStatus::velocity_and_no_mass;
  constexpr double least_decay = 1e-9;  // in a period
  for (const ContactPole& pole : dynamics.poles())
    if (!(-pole.exponent.real() / problem.frequency > least_decay)) return PhasesStatus::undamped;
  return PhasesStatus::converged;
}

void require_sizes(const PhasesProblem& problem, const Eigen::MatrixXd& start) {
  const int contacts = problem.dynamics.contacts();
  problem.laws.require(contacts);
  if (problem.contact_free.rows() != contacts || problem.contact_free.cols() < 1)
    throw std::invalid_argument("contact_phases: contact_free has " +
                                std::to_string(problem.contact_free.rows()) + " rows; the structure has " +
                                std::to_string(contacts) + " contacts");
  if (start.rows() != contacts || start.cols() < 8)
    throw std::invalid_argument("contact_phases: start is " + std::to_string(start.rows()) + " x " +
                                std::to_string(start.cols()) + "; it must have a row for each of " +
                                std::to_string(contacts) + " contacts and at least 8 columns");
  if (!(problem.frequency > 0.0) || !std::isfinite(problem.frequency))
    throw std::invalid_argument("contact_phases: frequency is " + std::to_string(problem.frequency) +
                                " Hz; it must be positive and finite");
}

// The last two Legendre coefficients of each panel at its nodes, n, N: what the next ones are not larger
// than.
Eigen::VectorXd last_parts(const PanelForces& forces, const LegendreNodes& nodes) {
  const Eigen::MatrixXd& coefficients = forces.coefficients();
  const Index q = coefficients.rows();
  const Eigen::MatrixXd values = detail::legendre_values(nodes.points, q).rightCols(2);
  return (values * coefficients.bottomRows(2)).reshaped();
}

// The rms displacement at the nodes that those parts make, over that of the motion.
double error_of(const PhaseNewtonResult& solved, const LegendreNodes& nodes, double motion_rms) {
  const Eigen::VectorXd parts = last_parts(solved.iterate.forces, nodes);
  if (parts.size() == 0) return 0.0;
  const double rms = (solved.displacement * parts).norm() / std::sqrt(double(parts.size()));
  return rms / motion_rms;
}

double rms_of(const Eigen::MatrixXd& values) { return values.norm() / std::sqrt(double(values.size())); }

// Cuts the phases where the last coefficients of a panel are above `share` of the largest force: near an end
// of the phase, where layers of fast modes lie, or in the middle. Whether it cut any.
bool divide(PhaseIterate& iterate, double share) {
  constexpr double layer = 0.15;
  const Eigen::MatrixXd& coefficients = iterate.forces.coefficients();
  const double limit = share * coefficients.cwiseAbs().maxCoeff();
  bool cut = false;
  for (std::size_t p = 0; p < iterate.forces.panels().size(); ++p) {
    const detail::Panel& panel = iterate.forces.panels()[p];
    if (coefficients.col(Index(p)).tail(2).cwiseAbs().maxCoeff() <= limit) continue;
    detail::Phase& phase = iterate.layout.phases[static_cast<std::size_t>(panel.phase)];
    const double begin = iterate.layout.begin(phase), length = iterate.layout.end(phase) - begin;
    const double from = (panel.begin - begin) / length, to = (panel.end - begin) / length, size = to - from;
    constexpr double edge = 1e-6;
    const bool first = phase.begin >= 0 && from < edge, last = phase.begin >= 0 && to > 1.0 - edge;
    if (first) phase.cuts.push_back(from + layer * size);
    if (last) phase.cuts.push_back(to - layer * size);
    if (!first && !last) phase.cuts.push_back(from + 0.5 * size);
    std::sort(phase.cuts.begin(), phase.cuts.end());
    cut = true;
  }
  return cut;
}

// One solution of the equations for a list of phases, and the motion that belongs to it.
struct Found {
  PhaseNewtonResult newton;
  Influence motion;
  Layout phases_of_motion;

  bool agrees() const {
    return newton.converged && detail::same_phases(newton.iterate.layout, phases_of_motion);
  }
};

class Search {
 public:
  Search(const PhaseModel& model, const ContactPhasesOptions& options, Index samples)
      : model_(model),
        options_(options),
        times_(Eigen::VectorXd::LinSpaced(samples, 0.0, 1.0 - 1.0 / double(samples))) {}

  PhaseMotion run(const Influence& start) {
    PhaseMotion result;
    Found found = at(start, result);
    for (; !found.agrees() && result.changes < options_.max_changes; ++result.changes)
      found = at(found.motion, result);
    if (found.agrees()) refine(found, result);
    return describe(found, std::move(result));
  }

 private:
  Found solved(PhaseIterate iterate, const LegendreNodes& nodes, PhaseMotion& result) const {
    Found found{detail::solve_phases(model_, std::move(iterate), nodes, options_.max_iterations), {}, {}};
    result.iterations += found.newton.iterations;
    found.motion = model_.motion(found.newton.iterate.forces, times_);
    found.phases_of_motion = detail::layout_of(model_.laws, found.motion.displacement, found.motion.velocity);
    return found;
  }

  // Stiff contact does not fit the panels at first: with the passages held they are refined until they
  // roughly resolve its force.
  Found at(const Influence& motion, PhaseMotion& result) {
    constexpr double rough = 0.03;
    constexpr Index many_nodes = 12;
    Layout layout = detail::layout_of(model_.laws, motion.displacement, motion.velocity);
    PanelForces forces = detail::forces_along(model_, layout, nodes_, motion);
    PhaseIterate iterate{std::move(layout), std::move(forces)};
    for (int level = 0; level < 6; ++level) {
      PhaseNewtonResult held =
          detail::solve_forces(model_, iterate, nodes_, options_.max_iterations, rough * rough);
      result.iterations += held.iterations;
      if (!held.converged) break;
      iterate = std::move(held.iterate);
      const Eigen::MatrixXd& coefficients = iterate.forces.coefficients();
      if (coefficients.size() == 0 ||
          coefficients.bottomRows(2).cwiseAbs().maxCoeff() < rough * coefficients.cwiseAbs().maxCoeff())
        break;
      if (nodes_.count() < many_nodes)
        nodes_ = LegendreNodes(many_nodes);
      else
        divide(iterate, rough);
    }
    return solved(std::move(iterate), nodes_, result);
  }

  void refine(Found& found, PhaseMotion& result) {
    for (;;) {
      result.estimated_error = error_of(found.newton, nodes_, rms_of(found.motion.displacement));
      if (result.estimated_error <= options_.tolerance) return;
      PhaseIterate finer = found.newton.iterate;
      if (nodes_.count() < options_.max_nodes)
        nodes_ = LegendreNodes(std::min<Index>(options_.max_nodes, nodes_.count() + nodes_.count() / 2));
      else if (static_cast<int>(finer.forces.panels().size()) > options_.max_panels ||
               !divide(finer, 0.1 * options_.tolerance))
        return;
      Found better = solved(std::move(finer), nodes_, result);
      if (!better.agrees()) return;
      found = std::move(better);
    }
  }

  PhaseMotion describe(const Found& found, PhaseMotion result) const {
    const PhaseIterate& iterate = found.newton.iterate;
    result.residual = found.newton.residual;
    result.unknowns = static_cast<int>(iterate.forces.coefficients().size()) +
                      static_cast<int>(iterate.layout.passages.size());
    if (!found.agrees()) return result;
    result.status = result.estimated_error <= options_.tolerance ? PhasesStatus::converged
                                                                 : PhasesStatus::tolerance_missed;
    for (const detail::Phase& phase : iterate.layout.phases) {
      const double begin = iterate.layout.begin(phase), whole = std::floor(begin);
      result.phases.push_back({phase.contact, phase.piece, begin - whole, iterate.layout.end(phase) - whole});
    }
    std::sort(result.phases.begin(), result.phases.end(), [](const ContactPhase& a, const ContactPhase& b) {
      return std::pair(a.contact, a.begin) < std::pair(b.contact, b.begin);
    });
    const detail::LawSlopes slopes = detail::slopes_along(model_, iterate, nodes_);
    result.parts = std::make_shared<PhaseMotion::Parts>(
        PhaseMotion::Parts{model_, iterate, slopes.tangent, slopes.damping});
    return result;
  }

  const PhaseModel& model_;
  const ContactPhasesOptions& options_;
  Eigen::VectorXd times_;  // l / N
  LegendreNodes nodes_{options_.nodes};
};

}  // namespace

void ContactPhasesOptions::validate() const {
  detail::require_positive("contact_phases", "tolerance", tolerance);
  detail::require_at_least("contact_phases", "nodes", nodes, 4);
  detail::require_at_least("contact_phases", "max_nodes", max_nodes, nodes);
  detail::require_at_least("contact_phases", "max_panels", max_panels, 1);
  detail::require_at_least("contact_phases", "max_iterations", max_iterations, 1);
  detail::require_at_least("contact_phases", "max_changes", max_changes, 0);
}

std::string_view to_string(PhasesStatus status) {
  using enum PhasesStatus;
  return detail::name_in<PhasesStatus>({{converged, "converged"},
                                        {no_motion_near, "no_motion_near"},
                                        {tolerance_missed, "tolerance_missed"},
                                        {rigid_contact, "rigid_contact"},
                                        {velocity_and_no_mass, "velocity_and_no_mass"},
                                        {free_structure, "free_structure"},
                                        {undamped, "undamped"},
                                        {structural_damping, "structural_damping"}},
                                       status);
}

Eigen::MatrixXd PhaseMotion::displacement(const Eigen::VectorXd& times) const {
  return parts->model.motion(parts->iterate.forces, times).displacement;
}

Eigen::MatrixXd PhaseMotion::velocity(const Eigen::VectorXd& times) const {
  return parts->model.frequency * parts->model.motion(parts->iterate.forces, times).velocity;
}

Eigen::MatrixXd PhaseMotion::force(const Eigen::VectorXd& times) const {
  Eigen::MatrixXd forces(parts->model.response.contacts(), times.size());
  for (Index k = 0; k < times.size(); ++k)
    for (Index c = 0; c < forces.rows(); ++c)
      forces(c, k) = parts->iterate.forces.at(static_cast<int>(c), times[k]);
  return forces;
}

bool PhaseMotion::depends_on_velocity() const { return parts != nullptr && parts->model.velocity; }

double PhaseMotion::tangent(int contact, double time) const { return parts->tangent.at(contact, time); }

double PhaseMotion::damping(int contact, double time) const { return parts->damping.at(contact, time); }

PhaseMotion contact_phases(const PhasesProblem& problem, const Eigen::MatrixXd& start,
                           const ContactPhasesOptions& options) {
  options.validate();
  require_sizes(problem, start);
  PhaseMotion result;
  result.status = refusal(problem);
  if (!result.converged()) return result;
  const PhaseModel model(problem, start.cwiseAbs().maxCoeff());
  return Search(model, options, std::max(least_samples, start.cols())).run({start, slopes_of(start)});
}

}  // namespace wavebalance::solvers
