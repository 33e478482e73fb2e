#include "phases/phase_equations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;
constexpr double turn = 2.0 * std::numbers::pi;

// Sums of harmonics at instants, each times (2 pi i n)^derivative.
Eigen::VectorXd sum_of_harmonics(const Eigen::MatrixXcd& amplitudes, const std::vector<Instant>& instants,
                                 int derivative) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(Index(instants.size()));
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const Complex step = std::polar(1.0, turn * instants[i].time);
    Complex wave = 1.0, sum = 0.0;
    for (Index n = 0; n < amplitudes.cols(); ++n, wave *= step)
      sum +=
          wave * amplitudes(instants[i].contact, n) * (derivative > 0 ? Complex(0.0, turn * double(n)) : 1.0);
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
  std::vector<Panel> panels;
  Eigen::VectorXd force;             // n, N
  Influence influence;               // (n + m) x n
  Eigen::VectorXd residual;          // n + m
  Eigen::VectorXd tangent, damping;  // n: by displacement and by velocity per period
  Eigen::VectorXd passing;           // m, m per period
  Eigen::VectorXd slope;             // n, of the residual by time, N per period
  double force_size = 0.0, displacement_size = 0.0;

  double force_error() const {
    return force.size() > 0 ? residual.head(force.size()).cwiseAbs().maxCoeff() / force_size : 0.0;
  }
  double error() const {
    const Index m = residual.size() - force.size();
    const double places = m > 0 ? residual.tail(m).cwiseAbs().maxCoeff() / displacement_size : 0.0;
    return std::max(force_error(), places);
  }
};

Evaluation evaluate(const PhaseModel& model, const PhaseIterate& at, const LegendreNodes& nodes) {
  constexpr double tiny = 1e-300;
  Evaluation result;
  result.panels = at.layout.panels();
  std::vector<Instant> instants = instants_of(result.panels, nodes);
  const auto n = Index(instants.size()), m = Index(at.layout.passages.size());
  result.force.resize(n);
  for (Index i = 0; i < n; ++i)
    result.force[i] = at.forces.in_phase(result.panels[static_cast<std::size_t>(i / nodes.count())].phase,
                                         instants[static_cast<std::size_t>(i)].time);
  for (const Passage& passage : at.layout.passages) instants.push_back({passage.contact, passage.time});
  result.influence = model.response.influence(result.panels, nodes, instants, true);
  const Eigen::VectorXd u = model.free_displacement(instants) - result.influence.displacement * result.force,
                        v = model.free_velocity(instants) - result.influence.velocity * result.force;
  result.passing = v.tail(m);
  result.residual.resize(n + m);
  result.tangent.resize(n);
  result.damping.resize(n);
  result.slope.resize(n);
  const PanelForces forces(result.panels, nodes, result.force);
  for (Index i = 0; i < n; ++i) {
    const Panel& panel = result.panels[static_cast<std::size_t>(i / nodes.count())];
    const int piece = at.layout.phases[static_cast<std::size_t>(panel.phase)].piece;
    const ForceSlopes law =
        model.laws[static_cast<std::size_t>(panel.contact)].at(piece, u[i], model.frequency * v[i]);
    result.residual[i] = result.force[i] - law.force;
    result.tangent[i] = law.tangent;
    result.damping[i] = model.frequency * law.damping;
    result.slope[i] =
        forces.slope_in_phase(panel.phase, instants[static_cast<std::size_t>(i)].time) - law.tangent * v[i];
  }
  for (Index i = 0; i < m; ++i)
    result.residual[n + i] = u[n + i] - at.layout.passages[static_cast<std::size_t>(i)].breakpoint;
  result.force_size = std::max(tiny, n > 0 ? result.force.cwiseAbs().maxCoeff() : 0.0);
  result.displacement_size = std::max(tiny, u.size() > 0 ? u.cwiseAbs().maxCoeff() : 0.0);
  return result;
}

// What an end that comes later adds to the force of its phase, as an impulse: columns of displacement and
// velocity of all equations' instants, by the passages.
Influence by_passages(const PhaseModel& model, const PhaseIterate& at, const Evaluation& now,
                      const LegendreNodes& nodes) {
  std::vector<Instant> instants = instants_of(now.panels, nodes), passages;
  for (const Passage& passage : at.layout.passages) passages.push_back({passage.contact, passage.time});
  instants.insert(instants.end(), passages.begin(), passages.end());
  const PanelForces forces(now.panels, nodes, now.force);
  Eigen::VectorXd added = Eigen::VectorXd::Zero(Index(passages.size()));
  for (std::size_t p = 0; p < at.layout.phases.size(); ++p) {
    const Phase& phase = at.layout.phases[p];
    if (phase.begin < 0) continue;
    added[phase.end] += forces.in_phase(static_cast<int>(p), at.layout.end(phase));
    added[phase.begin] -= forces.in_phase(static_cast<int>(p), at.layout.begin(phase));
  }
  Influence result = model.response.impulses(passages, instants, model.velocity);
  result.displacement = result.displacement * added.asDiagonal();
  if (model.velocity) result.velocity = result.velocity * added.asDiagonal();
  return result;
}

// The nodes move with the ends of their panels, where the residual has a slope.
void add_drift(Eigen::Ref<Eigen::MatrixXd> by_passages, const Evaluation& now, const LegendreNodes& nodes) {
  for (Index i = 0; i < now.force.size(); ++i) {
    const Panel& panel = now.panels[static_cast<std::size_t>(i / nodes.count())];
    const double share = 0.5 * (1.0 + nodes.points[i % nodes.count()]);
    const auto add = [&](const Drift& drift, double part) {
      if (drift.first >= 0) by_passages(i, drift.first) += part * drift.by_first * now.slope[i];
      if (drift.second >= 0) by_passages(i, drift.second) += part * drift.by_second * now.slope[i];
    };
    add(panel.begin_drift, 1.0 - share);
    add(panel.end_drift, share);
  }
}

Eigen::MatrixXd jacobian(const PhaseModel& model, const PhaseIterate& at, const Evaluation& now,
                         const LegendreNodes& nodes) {
  const Index n = now.force.size(), m = now.residual.size() - n;
  const Influence passages = by_passages(model, at, now, nodes);
  Eigen::MatrixXd result(n + m, n + m);
  result.topLeftCorner(n, n) = now.tangent.asDiagonal() * now.influence.displacement.topRows(n);
  result.topRightCorner(n, m) = now.tangent.asDiagonal() * passages.displacement.topRows(n);
  if (model.velocity) {
    result.topLeftCorner(n, n) += now.damping.asDiagonal() * now.influence.velocity.topRows(n);
    result.topRightCorner(n, m) += now.damping.asDiagonal() * passages.velocity.topRows(n);
  }
  result.topLeftCorner(n, n).diagonal().array() += 1.0;
  add_drift(result.topRightCorner(n, m), now, nodes);
  result.bottomLeftCorner(m, n) = -now.influence.displacement.bottomRows(m);
  result.bottomRightCorner(m, m) = -passages.displacement.bottomRows(m);
  result.bottomRightCorner(m, m).diagonal() += now.passing;
  return result;
}

// By all unknowns, or by the first `count`. Not finite where the matrix is singular.
Eigen::VectorXd newton_step(const PhaseModel& model, const PhaseIterate& at, const Evaluation& now,
                            const LegendreNodes& nodes, Index count) {
  const Lu<double> factor(jacobian(model, at, now, nodes).topLeftCorner(count, count));
  return factor.solve(Eigen::VectorXd(-now.residual.head(count)));
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
  for (int c = 0; c < problem.dynamics.contacts(); ++c) laws.emplace_back(problem.laws[c], length);
  velocity = problem.laws.depend_on_velocity();
}

Eigen::VectorXd PhaseModel::free_displacement(const std::vector<Instant>& instants) const {
  return sum_of_harmonics(contact_free, instants, 0);
}

Eigen::VectorXd PhaseModel::free_velocity(const std::vector<Instant>& instants) const {
  return sum_of_harmonics(contact_free, instants, 1);
}

Influence PhaseModel::motion(const PanelForces& forces, const Eigen::VectorXd& times) const {
  Influence result = response.motion(forces.panels(), forces.coefficients(), times);
  Eigen::MatrixXcd waves(contact_free.cols(), times.size());
  for (Index l = 0; l < times.size(); ++l)
    for (Index n = 0; n < waves.rows(); ++n) waves(n, l) = std::polar(1.0, turn * double(n) * times[l]);
  Eigen::MatrixXcd rates = contact_free;
  for (Index n = 0; n < rates.cols(); ++n) rates.col(n) *= Complex(0.0, turn * double(n));
  result.displacement = (contact_free * waves).real() - result.displacement;
  result.velocity = (rates * waves).real() - result.velocity;
  return result;
}

std::vector<Instant> instants_of(const std::vector<Panel>& panels, const LegendreNodes& nodes) {
  std::vector<Instant> instants;
  for (const Panel& panel : panels)
    for (const double x : nodes.points) instants.push_back({panel.contact, panel.time(x)});
  return instants;
}

PanelForces forces_along(const PhaseModel& model, const Layout& layout, const LegendreNodes& nodes,
                         const Influence& motion) {
  const std::vector<Panel> panels = layout.panels();
  const std::vector<Instant> instants = instants_of(panels, nodes);
  Eigen::VectorXd values(Index(instants.size()));
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(motion.velocity.rows(), motion.velocity.cols());
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const Panel& panel = panels[i / static_cast<std::size_t>(nodes.count())];
    const int piece = layout.phases[static_cast<std::size_t>(panel.phase)].piece;
    const double u = interpolated(motion.displacement, motion.velocity, instants[i]),
                 v = model.frequency * interpolated(motion.velocity, none, instants[i]);
    values[Index(i)] = model.laws[static_cast<std::size_t>(panel.contact)].at(piece, u, v).force;
  }
  return {panels, nodes, values};
}

LawSlopes slopes_along(const PhaseModel& model, const PhaseIterate& iterate, const LegendreNodes& nodes) {
  const Evaluation at = evaluate(model, iterate, nodes);
  return {PanelForces(at.panels, nodes, at.tangent),
          PanelForces(at.panels, nodes, at.damping / model.frequency)};
}

PhaseNewtonResult solve_phases(const PhaseModel& model, PhaseIterate start, const LegendreNodes& nodes,
                               int max_iterations) {
  constexpr double rounding = 1e-12, enough = 1e-9;
  PhaseNewtonResult result;
  result.iterate = std::move(start);
  double before = std::numeric_limits<double>::infinity();
  for (;; ++result.iterations) {
    const Evaluation now = evaluate(model, result.iterate, nodes);
    result.residual = now.error();
    result.iterate.forces = PanelForces(now.panels, nodes, now.force);
    const bool stands = result.residual < enough && result.residual > 0.5 * before;
    if (result.residual < rounding || stands) {
      result.converged = true;
      result.displacement = now.influence.displacement.topRows(now.force.size());
      return result;
    }
    before = result.residual;
    if (result.iterations == max_iterations || !std::isfinite(result.residual)) return result;
    const Eigen::VectorXd step = newton_step(model, result.iterate, now, nodes, now.residual.size());
    if (!step.allFinite()) return result;
    const Index n = now.force.size(), m = step.size() - n;
    const double part = admissible_part(result.iterate.layout, step.tail(m));
    result.iterate.forces = PanelForces(now.panels, nodes, now.force + part * step.head(n));
    for (Index i = 0; i < m; ++i)
      result.iterate.layout.passages[static_cast<std::size_t>(i)].time += part * step[n + i];
    result.collapsed = has_collapsed(result.iterate.layout);
    if (result.collapsed) return result;
  }
}

PhaseNewtonResult solve_forces(const PhaseModel& model, PhaseIterate start, const LegendreNodes& nodes,
                               int max_iterations, double tolerance) {
  PhaseNewtonResult result;
  result.iterate = std::move(start);
  for (;; ++result.iterations) {
    const Evaluation now = evaluate(model, result.iterate, nodes);
    result.residual = now.force_error();
    result.converged = result.residual < tolerance;
    result.iterate.forces = PanelForces(now.panels, nodes, now.force);
    if (result.converged || result.iterations == max_iterations || !std::isfinite(result.residual))
      return result;
    const Eigen::VectorXd step = newton_step(model, result.iterate, now, nodes, now.force.size());
    if (!step.allFinite()) return result;
    result.iterate.forces = PanelForces(now.panels, nodes, now.force + step);
  }
}

}  // namespace wavebalance::solvers::detail
