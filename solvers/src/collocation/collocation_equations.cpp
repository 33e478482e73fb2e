#include "collocation/collocation_equations.hpp"

#include <algorithm>
#include <cmath>

#include "collocation/collocation_evaluation.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

// The value of samples at times l / N of a cubic in between.
double interpolated(const Eigen::MatrixXd& values, const Eigen::MatrixXd& slopes, const Instant& at) {
  const Index samples = values.cols();
  const double place = (at.time - std::floor(at.time)) * double(samples);
  const auto l = std::min(Index(place), samples - 1), next = (l + 1) % samples;
  const double t = place - double(l), u0 = values(at.contact, l), u1 = values(at.contact, next),
               v0 = slopes(at.contact, l) / double(samples), v1 = slopes(at.contact, next) / double(samples);
  return u0 + t * (v0 + t * (3.0 * (u1 - u0) - 2.0 * v0 - v1 + t * (2.0 * (u0 - u1) + v0 + v1)));
}

const Panel& panel_of(const CellGrid& grid, Index node, const LegendreNodes& nodes) {
  return grid.panels[static_cast<std::size_t>(node / nodes.count())];
}

// The panels at whose ends forces vanish. Where a structure is held, panels without contact meet them there.
std::vector<Release> releases_of(const CollocationModel& model, const Layout& layout, const CellGrid& grid) {
  std::vector<Release> released(layout.passages.size());
  const auto note = [&](int passage, Release release) {
    if (passage >= 0 && layout.passages[static_cast<std::size_t>(passage)].released)
      released[static_cast<std::size_t>(passage)] = release;
  };
  for (std::size_t p = 0; p < grid.panels.size(); ++p) {
    const int number = grid.panels[p].interval;
    const LayoutInterval& interval = layout.intervals[static_cast<std::size_t>(number)];
    if (!model.laws[static_cast<std::size_t>(interval.contact)].exerts(interval.piece)) continue;
    const bool first = p == 0 || grid.panels[p - 1].interval != number,
               last = p + 1 == grid.panels.size() || grid.panels[p + 1].interval != number;
    if (first) note(interval.begin, {static_cast<int>(p), false});
    if (last) note(interval.end, {static_cast<int>(p), true});
  }
  return released;
}

// The value at an end of a panel, and its slope by x, of a polynomial with values 1 at one node.
struct EndRow {
  Eigen::VectorXd value, slope;
};

EndRow end_row(const LegendreNodes& nodes, bool at_end) {
  const Eigen::ArrayXd k = Eigen::ArrayXd::LinSpaced(nodes.count(), 0.0, double(nodes.count() - 1));
  Eigen::ArrayXd value = Eigen::ArrayXd::Ones(nodes.count()), slope = 0.5 * k * (k + 1.0);
  if (!at_end)
    for (Index i = 0; i < nodes.count(); ++i) (i % 2 == 0 ? slope : value)[i] *= -1.0;
  return {nodes.coefficients.transpose() * value.matrix(), nodes.coefficients.transpose() * slope.matrix()};
}

// By its law: the law of the panel less the holding spring.
double force_at_release(const Evaluation& now, const LegendreNodes& nodes, const Release& release,
                        double displacement) {
  return end_row(nodes, release.at_end)
             .value.dot(now.force.segment(nodes.count() * release.panel, nodes.count())) +
         now.holding * displacement;
}

}  // namespace

Evaluation evaluate(const CollocationModel& model, const CollocationIterate& at, const LegendreNodes& nodes,
                    std::shared_ptr<const PeriodCells> known) {
  constexpr double tiny = 1e-300;
  Evaluation result;
  result.grid = at.layout.grid();
  result.period = known ? std::move(known) : model.response.cells(result.grid, nodes);
  const CellGrid& grid = result.grid;
  std::vector<Instant> instants = instants_of(grid.panels, nodes), passages;
  const auto n = Index(instants.size()), m = Index(at.layout.passages.size());
  result.force.resize(n);
  for (Index i = 0; i < n; ++i)
    result.force[i] =
        at.forces.in_interval(panel_of(grid, i, nodes).interval, instants[static_cast<std::size_t>(i)].time);
  for (const Passage& passage : at.layout.passages) passages.push_back({passage.contact, passage.time});
  const Eigen::MatrixXd coefficients =
      nodes.coefficients * result.force.reshaped(nodes.count(), n / nodes.count());
  const ForcedMotion forced = model.response.forced_motion(*result.period, coefficients, model.velocity);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(n);
  if (model.velocity) v = model.free_velocity(instants) - forced.node_velocity;
  instants.insert(instants.end(), passages.begin(), passages.end());
  const Eigen::VectorXd u = model.free_displacement(instants) - forced.displacement;
  result.passing = model.free_velocity(passages) - forced.mark_velocity;
  result.residual.resize(n + m);
  result.tangent.resize(n);
  result.damping.resize(n);
  result.own.resize(n);
  double largest_law = 0.0;
  for (Index i = 0; i < n; ++i) {
    const Panel& panel = panel_of(grid, i, nodes);
    const int piece = at.layout.intervals[static_cast<std::size_t>(panel.interval)].piece;
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
  result.holding = model.holding;
  result.released = releases_of(model, at.layout, grid);
  for (Index i = 0; i < m; ++i) {
    const Release& release = result.released[static_cast<std::size_t>(i)];
    result.residual[n + i] = release.exists()
                                 ? result.softness() * force_at_release(result, nodes, release, u[n + i])
                                 : u[n + i] - at.layout.passages[static_cast<std::size_t>(i)].breakpoint;
  }
  return result;
}

Evaluation on_panels_of(const Layout& layout, const CollocationModel& model, const Evaluation& solved,
                        const LegendreNodes& nodes) {
  Evaluation result;
  result.grid = layout.grid();
  const std::vector<Instant> instants = instants_of(result.grid.panels, nodes);
  const auto values_of = [&](const Eigen::VectorXd& values) {
    const PanelForces polynomials(solved.grid, nodes, values);
    Eigen::VectorXd own(Index(instants.size()));
    for (Index i = 0; i < own.size(); ++i)
      own[i] =
          polynomials.in_interval(panel_of(result.grid, i, nodes).interval, instants[std::size_t(i)].time);
    return own;
  };
  result.force = values_of(solved.force);
  result.tangent = values_of(solved.tangent);
  result.damping = values_of(solved.damping);
  result.own.resize(result.force.size());
  for (Index i = 0; i < result.own.size(); ++i)
    result.own[i] = model.laws[std::size_t(panel_of(result.grid, i, nodes).contact)].rigid() ? 0.0 : 1.0;
  result.passing = solved.passing;
  result.released = releases_of(model, layout, result.grid);
  result.holding = solved.holding;
  result.force_size = solved.force_size;
  result.displacement_size = solved.displacement_size;
  return result;
}

Eigen::VectorXd impulses_of(const Layout& layout, const Evaluation& now, const LegendreNodes& nodes) {
  const PanelForces forces(now.grid, nodes, now.force);
  Eigen::VectorXd result = Eigen::VectorXd::Ones(now.force.size() + now.passing.size());
  auto added = result.tail(now.passing.size());
  added.setZero();
  for (std::size_t p = 0; p < layout.intervals.size(); ++p) {
    const LayoutInterval& interval = layout.intervals[p];
    if (interval.begin < 0) continue;
    added[interval.end] += forces.in_interval(static_cast<int>(p), layout.end(interval));
    added[interval.begin] -= forces.in_interval(static_cast<int>(p), layout.begin(interval));
  }
  return result;
}

Eigen::MatrixXd residual_by_motion(const Evaluation& now, const Eigen::MatrixXd& displacement,
                                   const Eigen::MatrixXd& node_velocity) {
  const Index n = now.force.size(), m = now.passing.size();
  Eigen::MatrixXd result(n + m, displacement.cols());
  result.topRows(n) = now.tangent.asDiagonal() * displacement.topRows(n);
  if (node_velocity.size() > 0) result.topRows(n) += now.damping.asDiagonal() * node_velocity;
  result.bottomRows(m) = -displacement.bottomRows(m);
  for (Index i = 0; i < m; ++i)
    if (now.released[static_cast<std::size_t>(i)].exists()) result.row(n + i) *= now.softness() * now.holding;
  return result;
}

// The nodes move with the ends of their panels; since the residual is nearly zero along an interval, not only
// at its nodes, that has no part in it.
Eigen::MatrixXd jacobian(const Evaluation& now, const Eigen::VectorXd& impulses, const LegendreNodes& nodes,
                         const Influence& influence) {
  const Index n = now.force.size(), m = now.passing.size();
  if (n + m == 0) return {};
  Eigen::MatrixXd result = residual_by_motion(now, influence.displacement, influence.node_velocity);
  result = result * impulses.asDiagonal();
  result.diagonal().head(n) += now.own;
  for (Index i = 0; i < m; ++i) {
    const Release& release = now.released[static_cast<std::size_t>(i)];
    if (!release.exists()) {
      result(n + i, n + i) += now.passing[i];
      continue;
    }
    const Index q = nodes.count(), first = q * release.panel;
    const EndRow row = end_row(nodes, release.at_end);
    const double rate = 2.0 / now.grid.panels[static_cast<std::size_t>(release.panel)].length() *
                        row.slope.dot(now.force.segment(first, q));
    result.row(n + i).segment(first, q) += now.softness() * row.value.transpose();
    result(n + i, n + i) += now.softness() * (rate + now.holding * now.passing[i]);
  }
  return result;
}

Eigen::MatrixXd force_at(const PanelForces& forces, const CollocationModel& model,
                         const Eigen::VectorXd& times) {
  Eigen::MatrixXd result(model.response.contacts(), times.size());
  for (Index k = 0; k < times.size(); ++k)
    for (Index c = 0; c < result.rows(); ++c) result(c, k) = forces.at(static_cast<int>(c), times[k]);
  return result;
}

PanelForces forces_along(const CollocationModel& model, const Layout& layout, const LegendreNodes& nodes,
                         const ContactMotion& motion) {
  CellGrid grid = layout.grid();
  const std::vector<Instant> instants = instants_of(grid.panels, nodes);
  Eigen::VectorXd values(Index(instants.size()));
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(motion.velocity.rows(), motion.velocity.cols());
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const Panel& panel = panel_of(grid, Index(i), nodes);
    const int piece = layout.intervals[static_cast<std::size_t>(panel.interval)].piece;
    const double u = interpolated(motion.displacement, motion.velocity, instants[i]),
                 v = model.frequency * interpolated(motion.velocity, none, instants[i]);
    values[Index(i)] = model.laws[static_cast<std::size_t>(panel.contact)].at(piece, u, v).force;
  }
  return {std::move(grid), nodes, values};
}

}  // namespace wavebalance::solvers::detail
