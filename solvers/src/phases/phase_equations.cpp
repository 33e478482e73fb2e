#include "phases/phase_equations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;
constexpr double turn = 2.0 * std::numbers::pi;

// Sums of harmonics at instants, each times (2 pi i n)^derivative, by Horner's rule.
Eigen::VectorXd sum_of_harmonics(const Eigen::MatrixXcd& amplitudes, const std::vector<Instant>& instants,
                                 int derivative) {
  Eigen::VectorXd values(Index(instants.size()));
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const double re = std::cos(turn * instants[i].time), im = std::sin(turn * instants[i].time);
    Complex sum = 0.0;
    for (Index n = amplitudes.cols() - 1; n >= 0; --n) {
      Complex own = amplitudes(instants[i].contact, n);
      if (derivative > 0) own = turn * double(n) * Complex(-own.imag(), own.real());
      sum = {sum.real() * re - sum.imag() * im + own.real(), sum.real() * im + sum.imag() * re + own.imag()};
    }
    values[Index(i)] = sum.real();
  }
  return values;
}

// The value of samples at times l / N of a cubic in between.
double interpolated(const Eigen::MatrixXd& values, const Eigen::MatrixXd& slopes, const Instant& at) {
  const Index samples = values.cols();
  const double place = (at.time - std::floor(at.time)) * double(samples);
  const auto l = std::min(Index(place), samples - 1), next = (l + 1) % samples;
  const double t = place - double(l), u0 = values(at.contact, l), u1 = values(at.contact, next),
               v0 = slopes(at.contact, l) / double(samples), v1 = slopes(at.contact, next) / double(samples);
  return u0 + t * (v0 + t * (3.0 * (u1 - u0) - 2.0 * v0 - v1 + t * (2.0 * (u0 - u1) + v0 + v1)));
}

// One evaluation of the equations: n forces, then m passages.
struct Evaluation {
  CellGrid grid;
  Eigen::VectorXd force;  // n, N
  Influence influence;
  Eigen::VectorXd residual;          // n + m
  Eigen::VectorXd tangent, damping;  // n: by displacement and by velocity per period
  Eigen::VectorXd own;               // n: of the residual by its force; 0 for a rigid law
  Eigen::VectorXd passing;           // m, m per period
  std::vector<int> released;         // m: the panel at whose end the force is zero instead, or -1
  double force_size = 0.0, displacement_size = 0.0;

  double softness() const { return displacement_size / force_size; }
  double force_error() const {
    return force.size() > 0 ? residual.head(force.size()).cwiseAbs().maxCoeff() / force_size : 0.0;
  }
  double error() const {
    const Index m = residual.size() - force.size();
    const double places = m > 0 ? residual.tail(m).cwiseAbs().maxCoeff() / displacement_size : 0.0;
    return std::max(force_error(), places);
  }
};

const Panel& panel_of(const CellGrid& grid, Index node, const LegendreNodes& nodes) {
  return grid.panels[static_cast<std::size_t>(node / nodes.count())];
}

// Where rigid contact is an equation for the velocity, the displacement stays at the gap, and contact ends
// with the force.
std::vector<int> released_panels(const PhaseModel& model, const Layout& layout, const CellGrid& grid) {
  std::vector<int> released(layout.passages.size(), -1);
  for (std::size_t p = 0; p < grid.panels.size(); ++p) {
    const Panel& panel = grid.panels[p];
    const Phase& phase = layout.phases[static_cast<std::size_t>(panel.phase)];
    const bool last = p + 1 == grid.panels.size() || grid.panels[p + 1].phase != panel.phase;
    if (last && phase.end >= 0 && model.laws[static_cast<std::size_t>(panel.contact)].jumps())
      released[static_cast<std::size_t>(phase.end)] = static_cast<int>(p);
  }
  return released;
}

// The value at the end of a panel, and its slope by x, of a polynomial with values 1 at one node.
Eigen::VectorXd end_values(const LegendreNodes& nodes) { return nodes.coefficients.colwise().sum(); }
Eigen::VectorXd end_slopes(const LegendreNodes& nodes) {
  const Eigen::ArrayXd k = Eigen::ArrayXd::LinSpaced(nodes.count(), 0.0, double(nodes.count() - 1));
  return nodes.coefficients.transpose() * (0.5 * k * (k + 1.0)).matrix();
}

Evaluation evaluate(const PhaseModel& model, const PhaseIterate& at, const LegendreNodes& nodes) {
  constexpr double tiny = 1e-300;
  Evaluation result;
  result.grid = at.layout.grid();
  std::vector<Instant> instants = instants_of(result.grid.panels, nodes), passages;
  const auto n = Index(instants.size()), m = Index(at.layout.passages.size());
  result.force.resize(n);
  for (Index i = 0; i < n; ++i)
    result.force[i] =
        at.forces.in_phase(panel_of(result.grid, i, nodes).phase, instants[static_cast<std::size_t>(i)].time);
  for (const Passage& passage : at.layout.passages) passages.push_back({passage.contact, passage.time});
  result.influence = model.response.influence(result.grid, nodes, model.velocity);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(n);
  if (model.velocity)
    v = model.free_velocity(instants) - result.influence.node_velocity.leftCols(n) * result.force;
  instants.insert(instants.end(), passages.begin(), passages.end());
  const Eigen::VectorXd u =
      model.free_displacement(instants) - result.influence.displacement.leftCols(n) * result.force;
  result.passing = model.free_velocity(passages) - result.influence.mark_velocity * result.force;
  result.residual.resize(n + m);
  result.tangent.resize(n);
  result.damping.resize(n);
  result.own.resize(n);
  double largest_law = 0.0;
  for (Index i = 0; i < n; ++i) {
    const Panel& panel = panel_of(result.grid, i, nodes);
    const int piece = at.layout.phases[static_cast<std::size_t>(panel.phase)].piece;
    const ForceSlopes law =
        model.laws[static_cast<std::size_t>(panel.contact)].at(piece, u[i], model.frequency * v[i]);
    const bool rigid = model.laws[static_cast<std::size_t>(panel.contact)].rigid();
    result.residual[i] = rigid ? -law.force : result.force[i] - law.force;
    result.own[i] = rigid ? 0.0 : 1.0;
    result.tangent[i] = law.tangent;
    largest_law = std::max(largest_law, std::abs(law.force));
    result.damping[i] = model.frequency * law.damping;
  }
  result.force_size = std::max({tiny, largest_law, n > 0 ? result.force.cwiseAbs().maxCoeff() : 0.0});
  result.displacement_size = std::max(tiny, u.size() > 0 ? u.cwiseAbs().maxCoeff() : 0.0);
  result.released = released_panels(model, at.layout, result.grid);
  for (Index i = 0; i < m; ++i) {
    const int panel = result.released[static_cast<std::size_t>(i)];
    result.residual[n + i] = panel < 0 ? u[n + i] - at.layout.passages[static_cast<std::size_t>(i)].breakpoint
                                       : result.softness() * end_values(nodes).dot(result.force.segment(
                                                                 nodes.count() * panel, nodes.count()));
  }
  return result;
}

// 1 for each force, and for each passage the impulse, N, that it adds if it comes later.
Eigen::VectorXd impulses_of(const PhaseIterate& at, const Evaluation& now, const LegendreNodes& nodes) {
  const PanelForces forces(now.grid, nodes, now.force);
  Eigen::VectorXd result = Eigen::VectorXd::Ones(now.residual.size());
  auto added = result.tail(now.passing.size());
  added.setZero();
  for (std::size_t p = 0; p < at.layout.phases.size(); ++p) {
    const Phase& phase = at.layout.phases[p];
    if (phase.begin < 0) continue;
    added[phase.end] += forces.in_phase(static_cast<int>(p), at.layout.end(phase));
    added[phase.begin] -= forces.in_phase(static_cast<int>(p), at.layout.begin(phase));
  }
  return result;
}

// The derivative of the residual by a motion that forces move towards them: displacements at nodes and
// passages, velocities at nodes, by any unknowns.
Eigen::MatrixXd residual_by_motion(const Evaluation& now, const Eigen::MatrixXd& displacement,
                                   const Eigen::MatrixXd& node_velocity) {
  const Index n = now.force.size(), m = now.passing.size();
  Eigen::MatrixXd result(n + m, displacement.cols());
  result.topRows(n) = now.tangent.asDiagonal() * displacement.topRows(n);
  if (node_velocity.size() > 0) result.topRows(n) += now.damping.asDiagonal() * node_velocity;
  result.bottomRows(m) = -displacement.bottomRows(m);
  for (Index i = 0; i < m; ++i)
    if (now.released[static_cast<std::size_t>(i)] >= 0) result.row(n + i).setZero();
  return result;
}

// The derivative of the residual by forces and passages, for their influence on the motion. The nodes move
// with the ends of their panels; since the residual is nearly zero along a phase, not only at its nodes, that
// has no part in it.
Eigen::MatrixXd jacobian(const PhaseIterate& at, const Evaluation& now, const LegendreNodes& nodes,
                         const Influence& influence) {
  const Index n = now.force.size(), m = now.passing.size();
  Eigen::MatrixXd result = residual_by_motion(now, influence.displacement, influence.node_velocity);
  result = result * impulses_of(at, now, nodes).asDiagonal();
  result.diagonal().head(n) += now.own;
  for (Index i = 0; i < m; ++i) {
    const int p = now.released[static_cast<std::size_t>(i)];
    if (p < 0) {
      result(n + i, n + i) += now.passing[i];
      continue;
    }
    const Index first = nodes.count() * p;
    result.row(n + i).segment(first, nodes.count()) = now.softness() * end_values(nodes).transpose();
    const double slope = end_slopes(nodes).dot(now.force.segment(first, nodes.count()));
    result(n + i, n + i) =
        now.softness() * 2.0 / now.grid.panels[static_cast<std::size_t>(p)].length() * slope;
  }
  return result;
}

// Newton's matrix of the first `count` unknowns.
Lu<double> factor_of(const PhaseIterate& at, const Evaluation& now, const LegendreNodes& nodes, Index count) {
  return Lu<double>(jacobian(at, now, nodes, now.influence).topLeftCorner(count, count));
}

// The largest part of the shifts of the passages that leaves each phase half of its length, and no passage
// more than a fiftieth of the period behind.
double admissible_part(const Layout& layout, const Eigen::VectorXd& shifts) {
  constexpr double longest = 0.02;
  double part = 1.0;
  if (shifts.size() > 0) part = std::min(part, longest / std::max(longest, shifts.cwiseAbs().maxCoeff()));
  for (const Phase& phase : layout.phases) {
    if (phase.begin < 0) continue;
    const double length = layout.end(phase) - layout.begin(phase);
    const double lost =
        shifts[phase.begin] - (phase.begin == phase.end ? shifts[phase.begin] : shifts[phase.end]);
    if (lost > 0.0) part = std::min(part, 0.5 * length / lost);
  }
  return part;
}

bool has_collapsed(const Layout& layout) {
  constexpr double shortest = 1e-11;
  return std::any_of(layout.phases.begin(), layout.phases.end(), [&](const Phase& phase) {
    const double length = layout.end(phase) - layout.begin(phase);
    return !(length > shortest && length < 1.0 + shortest);
  });
}

}  // namespace

PhaseModel::PhaseModel(const PhasesProblem& problem, double length)
    : response(problem.dynamics, 1.0 / problem.frequency),
      contact_free(problem.contact_free),
      frequency(problem.frequency) {
  for (int c = 0; c < problem.dynamics.contacts(); ++c) {
    const Yielding yielding{response.displacement_at_once(c), frequency * response.velocity_at_once(c)};
    laws.emplace_back(problem.laws[c], length, problem.dynamics.holding(), yielding);
  }
  velocity = problem.laws.depend_on_velocity() ||
             std::any_of(laws.begin(), laws.end(), [](const LawPieces& law) { return law.jumps(); });
}

Eigen::VectorXd PhaseModel::free_displacement(const std::vector<Instant>& instants) const {
  return sum_of_harmonics(contact_free, instants, 0);
}

Eigen::VectorXd PhaseModel::free_velocity(const std::vector<Instant>& instants) const {
  return sum_of_harmonics(contact_free, instants, 1);
}

ContactMotion PhaseModel::free_motion(const Eigen::VectorXd& times) const {
  ContactMotion result{Eigen::MatrixXd(response.contacts(), times.size()),
                       Eigen::MatrixXd(response.contacts(), times.size())};
  std::vector<Instant> instants(static_cast<std::size_t>(times.size()));
  for (int c = 0; c < response.contacts(); ++c) {
    for (Index l = 0; l < times.size(); ++l) instants[static_cast<std::size_t>(l)] = {c, times[l]};
    result.displacement.row(c) = free_displacement(instants).transpose();
    result.velocity.row(c) = free_velocity(instants).transpose();
  }
  return result;
}

ContactMotion PhaseModel::motion(const PanelForces& forces, const LegendreNodes& nodes,
                                 const Eigen::VectorXd& times) const {
  ContactMotion result = free_motion(times);
  const ContactMotion forced = response.motion(forces.grid(), forces.coefficients(), nodes, times);
  result.displacement -= forced.displacement;
  result.velocity -= forced.velocity;
  return result;
}

Eigen::MatrixXd monodromy_of(const PhaseModel& model, const PhaseIterate& iterate,
                             const LegendreNodes& nodes) {
  const Evaluation now = evaluate(model, iterate, nodes);
  const FreePeriod period = model.response.free_period(now.grid, nodes, model.velocity);
  const Lu<double> factor(jacobian(iterate, now, nodes, period.influence));
  if (factor.is_singular()) return {};
  const Eigen::MatrixXd unknowns =
      factor.solve(residual_by_motion(now, period.displacement_by, period.velocity_by));
  return period.states_by_states -
         product(period.states_by * impulses_of(iterate, now, nodes).asDiagonal(), unknowns);
}

Eigen::MatrixXd force_at(const PanelForces& forces, const PhaseModel& model, const Eigen::VectorXd& times) {
  Eigen::MatrixXd result(model.response.contacts(), times.size());
  for (Index k = 0; k < times.size(); ++k)
    for (Index c = 0; c < result.rows(); ++c) result(c, k) = forces.at(static_cast<int>(c), times[k]);
  return result;
}

std::vector<Instant> instants_of(const std::vector<Panel>& panels, const LegendreNodes& nodes) {
  std::vector<Instant> instants;
  for (const Panel& panel : panels)
    for (const double x : nodes.points) instants.push_back({panel.contact, panel.time(x)});
  return instants;
}

PanelForces forces_along(const PhaseModel& model, const Layout& layout, const LegendreNodes& nodes,
                         const ContactMotion& motion) {
  CellGrid grid = layout.grid();
  const std::vector<Instant> instants = instants_of(grid.panels, nodes);
  Eigen::VectorXd values(Index(instants.size()));
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(motion.velocity.rows(), motion.velocity.cols());
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const Panel& panel = panel_of(grid, Index(i), nodes);
    const int piece = layout.phases[static_cast<std::size_t>(panel.phase)].piece;
    const double u = interpolated(motion.displacement, motion.velocity, instants[i]),
                 v = model.frequency * interpolated(motion.velocity, none, instants[i]);
    values[Index(i)] = model.laws[static_cast<std::size_t>(panel.contact)].at(piece, u, v).force;
  }
  return {std::move(grid), nodes, values};
}

namespace {

double rms_at_nodes(const Eigen::VectorXd& displacements, Index nodes) {
  return nodes > 0 ? displacements.head(nodes).norm() / std::sqrt(double(nodes)) : 0.0;
}

// What the unknowns that a change of the residual asks for do to displacements at nodes and passages, towards
// their obstacles' other side.
Eigen::VectorXd displacements_of(const PhaseIterate& at, const Evaluation& now, const LegendreNodes& nodes,
                                 const Lu<double>& factor, const Eigen::VectorXd& residual) {
  const Eigen::VectorXd unknowns = factor.solve(Eigen::VectorXd(-residual));
  return now.influence.displacement * impulses_of(at, now, nodes).cwiseProduct(unknowns);
}

// The displacements that the last two Legendre coefficients of each panel make, and what answers them.
Eigen::VectorXd displacement_error(const PhaseIterate& at, const Evaluation& now, const LegendreNodes& nodes,
                                   const Lu<double>& factor) {
  const Index n = now.force.size();
  const Eigen::MatrixXd& coefficients = at.forces.coefficients();
  const Eigen::VectorXd parts =
      (nodes.values.middleCols(coefficients.rows() - 2, 2) * coefficients.bottomRows(2)).reshaped();
  const Eigen::VectorXd made = now.influence.displacement.leftCols(n) * parts;
  const Eigen::MatrixXd none;
  const Eigen::VectorXd residual = residual_by_motion(now, made, none);
  return made + displacements_of(at, now, nodes, factor, residual);
}

}  // namespace

PhaseNewtonResult solve_phases(const PhaseModel& model, PhaseIterate start, const LegendreNodes& nodes,
                               const NewtonLimits& limits) {
  constexpr double enough = 1e-9;
  PhaseNewtonResult result;
  result.iterate = std::move(start);
  double before = std::numeric_limits<double>::infinity();
  std::optional<Lu<double>> factor;
  for (;; ++result.iterations) {
    Evaluation now = evaluate(model, result.iterate, nodes);
    result.residual = now.error();
    result.iterate.forces = PanelForces(now.grid, nodes, now.force);
    const bool stands = result.residual < enough && result.residual > 0.5 * before;
    if (result.residual < limits.tolerance || stands) {
      result.converged = true;
      if (now.residual.size() > 0) {
        if (!factor || factor->size() != now.residual.size())
          factor = factor_of(result.iterate, now, nodes, now.residual.size());
        result.residual_error = rms_at_nodes(
            displacements_of(result.iterate, now, nodes, *factor, now.residual), now.force.size());
        result.resolution_error =
            rms_at_nodes(displacement_error(result.iterate, now, nodes, *factor), now.force.size());
      }
      result.tangent = std::move(now.tangent);
      result.damping = now.damping / model.frequency;
      return result;
    }
    before = result.residual;
    if (result.iterations == limits.max_iterations || !std::isfinite(result.residual)) return result;
    if (!goes_on(limits.observer, {"contact phases", result.iterations, result.residual})) return result;
    factor = factor_of(result.iterate, now, nodes, now.residual.size());
    const Eigen::VectorXd step = factor->solve(Eigen::VectorXd(-now.residual));
    if (!step.allFinite()) return result;
    const Index n = now.force.size(), m = step.size() - n;
    const double part = admissible_part(result.iterate.layout, step.tail(m));
    result.iterate.forces = PanelForces(now.grid, nodes, now.force + part * step.head(n));
    for (Index i = 0; i < m; ++i)
      result.iterate.layout.passages[static_cast<std::size_t>(i)].time += part * step[n + i];
    result.collapsed = has_collapsed(result.iterate.layout);
    if (result.collapsed) return result;
  }
}

PhaseNewtonResult solve_forces(const PhaseModel& model, PhaseIterate start, const LegendreNodes& nodes,
                               const NewtonLimits& limits) {
  PhaseNewtonResult result;
  result.iterate = std::move(start);
  for (;; ++result.iterations) {
    const Evaluation now = evaluate(model, result.iterate, nodes);
    result.residual = now.force_error();
    result.converged = result.residual < limits.tolerance;
    result.iterate.forces = PanelForces(now.grid, nodes, now.force);
    if (result.converged || result.iterations == limits.max_iterations || !std::isfinite(result.residual))
      return result;
    if (!goes_on(limits.observer, {"contact phases", result.iterations, result.residual})) return result;
    const Lu<double> factor = factor_of(result.iterate, now, nodes, now.force.size());
    const Eigen::VectorXd step = factor.solve(Eigen::VectorXd(-now.residual.head(now.force.size())));
    if (!step.allFinite()) return result;
    result.iterate.forces = PanelForces(now.grid, nodes, now.force + step);
  }
}

}  // namespace wavebalance::solvers::detail
