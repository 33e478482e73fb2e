#include "exact/exact_path.hpp"

#include <algorithm>
#include <cmath>

#include "collocation/collocation_refinement.hpp"
#include "collocation/exact_solution_parts.hpp"
#include "linalg/index.hpp"
#include "linalg/root.hpp"

namespace wavebalance::solvers::detail {
namespace {

// A force that changes by so much of the largest one has made a unit of arc length.
constexpr double force_scale = 0.5;

// Instants of contact that move much faster than all else count in the length of a step by this share.
constexpr double passage_share = 0.2;

// How far a passage has moved, periods.
double farthest_passage(const Layout& from, const Layout& to) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < std::min(from.passages.size(), to.passages.size()); ++i)
    farthest = std::max(farthest, std::abs(to.passages[i].time - from.passages[i].time));
  return farthest;
}

double& passage_of(CollocationIterate& iterate, Index i) {
  return iterate.layout.passages[static_cast<std::size_t>(i)].time;
}

Eigen::VectorXd lagrange_weights(const std::vector<const PathPoint*>& points, double place) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(Index(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j)
      if (j != i) weights[Index(i)] *= (place - points[j]->place) / (points[i]->place - points[j]->place);
  return weights;
}

// The forces of the points at the same share of an interval, weighted.
double weighted_force(const std::vector<const PathPoint*>& points, const Eigen::VectorXd& weights,
                      int interval, double share) {
  double sum = 0.0;
  for (std::size_t j = 0; j < points.size(); ++j) {
    const Layout& layout = points[j]->iterate.layout;
    const LayoutInterval& own = layout.intervals[static_cast<std::size_t>(interval)];
    const double begin = layout.begin(own), time = begin + share * (layout.end(own) - begin);
    sum += weights[Index(j)] * points[j]->iterate.forces.in_interval(interval, time);
  }
  return sum;
}

}  // namespace

double PathModel::arc_length(const PathPoint& from, const PathPoint& to) const {
  return std::max(CurvePath::arc_length(from, to),
                  passage_share * farthest_passage(from.iterate.layout, to.iterate.layout) / passage_scale);
}

Held PathModel::fastest(const PathPoint& at, bool parameter) const {
  const Index m = at.passages(), n = at.forces();
  Held best{Held::Kind::force, 0};
  double most = -1.0;
  const auto offer = [&](Held::Kind kind, Index index, double share) {
    if (share > most) {
      most = share;
      best = {kind, index};
    }
  };
  if (parameter) offer(Held::Kind::parameter, 0, std::abs(at.direction[n + m]) / parameter_scale());
  for (Index i = 0; i < m; ++i) offer(Held::Kind::passage, i, std::abs(at.direction[n + i]) / passage_scale);
  for (Index i = 0; i < n && m == 0; ++i)
    offer(Held::Kind::force, i, std::abs(at.direction[i]) / (force_scale * at.force_size));
  return best;
}

double PathModel::speed(const PathPoint& at) const {
  const Index m = at.passages(), n = at.forces();
  double fastest = std::abs(at.direction[n + m]) / parameter_scale();
  if (m > 0) fastest = std::max(fastest, at.direction.segment(n, m).cwiseAbs().maxCoeff() / passage_scale);
  if (n > 0)
    fastest = std::max(fastest, at.direction.head(n).cwiseAbs().maxCoeff() / (force_scale * at.force_size));
  return fastest;
}

double PathModel::sign_of(const PathPoint& at, const Held& held) const {
  return at.motion_of(held) < 0.0 ? -1.0 : 1.0;
}

double PathModel::cosine(const PathPoint& from, const PathPoint& to) const {
  return cosine(change(from, to.value, to.iterate.layout), to);
}

double PathModel::cosine(const PathPoint& from, const Prediction& to) const {
  return cosine(change(from, to.value, to.iterate.layout), from);
}

Eigen::VectorXd PathModel::change(const PathPoint& from, double value, const Layout& layout) const {
  const Index m = from.passages();
  Eigen::VectorXd way(m + 1);
  for (Index i = 0; i < m; ++i) {
    const auto number = static_cast<std::size_t>(i);
    way[i] = (layout.passages[number].time - from.iterate.layout.passages[number].time) / passage_scale;
  }
  way[m] = (value - from.value) / parameter_scale();
  return way;
}

double PathModel::cosine(const Eigen::VectorXd& way, const PathPoint& at) const {
  Eigen::VectorXd direction = at.direction.tail(at.passages() + 1) / passage_scale;
  direction[at.passages()] = at.motion_of_parameter() / parameter_scale();
  return way.dot(direction) / (way.norm() * direction.norm());
}

double PathModel::distance(const Prediction& expected, const PathPoint& found) const {
  return std::max(std::abs(found.value - expected.value) / parameter_scale(),
                  farthest_passage(expected.iterate.layout, found.iterate.layout) / passage_scale);
}

PathPoint PathModel::point_of(HeldSolution solution, const LegendreNodes& nodes, double error) const {
  const CollocationModel model(family().at(solution.value), length());
  const ContactMotion free = model.free_motion(times());
  const CollocationSolution own(model, std::move(solution.newton), nodes, times(), free);
  const bool fine = error <= options().exact.tolerance;
  PathPoint point;
  point.value = solution.value;
  point.iterate = own.newton.iterate;
  point.direction = std::move(solution.direction);
  point.displacement = own.motion.displacement.reshaped();
  point.vibration = vibration_of(own.motion.displacement);
  point.intervals_of_motion = own.intervals_of_motion;
  point.agrees = own.agrees();
  if (own.newton.iterate.forces.coefficients().size() > 0)
    point.force_size = own.newton.iterate.forces.coefficients().cwiseAbs().maxCoeff();
  point.slope = point.motion_of_parameter() / speed(point);
  point.motion.status = fine ? ExactStatus::converged : ExactStatus::tolerance_missed;
  point.motion.residual = own.newton.residual;
  point.motion.iterations = own.newton.iterations;
  point.motion.unknowns = static_cast<int>(point.direction.size());
  point.motion.estimated_error = error;
  set_parts(point.motion, model, own.newton, nodes);
  return point;
}

CollocationIterate PathModel::coarser(const PathPoint& last, CollocationIterate start) const {
  constexpr double much_better = 1e-3;
  const Index q = start.forces.coefficients().rows();
  if (q == 0 || !(last.motion.estimated_error < much_better * options().exact.tolerance)) return start;
  const Index fewer = std::max<Index>(options().exact.nodes, q - q / 4);
  if (fewer == q)
    for (LayoutInterval& interval : start.layout.intervals)
      if (interval.begin >= 0) interval.cuts.clear();
  return with_nodes(start, LegendreNodes(fewer));
}

bool PathModel::affords(const CollocationIterate& iterate, const LegendreNodes& nodes) const {
  constexpr double fewest_steps = 3.0;
  const double unknowns = double(nodes.count()) * double(iterate.layout.grid().panels.size()) +
                          double(iterate.layout.passages.size());
  return fewest_steps * step_operations(unknowns, double(family().dynamics().poles().size())) <=
         options().exact.max_operations;
}

std::optional<PathPoint> PathModel::solve(double value, CollocationIterate start, const Held& held,
                                          double forwards) const {
  constexpr double rounding = 1e-13;
  constexpr int most_refinements = 12;
  LegendreNodes nodes(start.forces.coefficients().rows() > 0 ? start.forces.coefficients().rows()
                                                             : Index(options().exact.nodes));
  for (int i = 0;; ++i) {
    HeldSolution found = solve_held(family(), length(), value, start, nodes, held,
                                    {options().exact.max_iterations, rounding, observer()});
    if (!found.newton.converged || !found.direction.allFinite()) return std::nullopt;
    const EstimatedError error = error_of(found.newton, vibration());
    if (!std::isfinite(error.resolution)) return std::nullopt;
    const LegendreNodes own = nodes;
    start = found.newton.iterate;
    value = found.value;
    const bool movable = held.kind != Held::Kind::force;  // the nodes of others are others
    if (error.resolution <= options().exact.tolerance || !movable || i == most_refinements ||
        !make_finer(start, nodes, error, options().exact) || !affords(start, nodes)) {
      found.direction *= forwards;
      return point_of(std::move(found), own, error.resolution);
    }
  }
}

CollocationIterate with_forces(Layout layout, const LegendreNodes& nodes, const ForceInPanel& force) {
  CellGrid grid = layout.grid();
  Eigen::VectorXd values(nodes.count() * Index(grid.panels.size()));
  for (std::size_t p = 0; p < grid.panels.size(); ++p)
    for (Index i = 0; i < nodes.count(); ++i)
      values[nodes.count() * Index(p) + i] = force(grid.panels[p], grid.panels[p].time(nodes.points[i]));
  return {std::move(layout), PanelForces(std::move(grid), nodes, values)};
}

CollocationIterate with_nodes(const CollocationIterate& iterate, const LegendreNodes& nodes) {
  return with_forces(iterate.layout, nodes, [&](const Panel& panel, double time) {
    return iterate.forces.in_interval(panel.interval, time);
  });
}

Prediction along_tangent(const PathPoint& at, double distance, double speed) {
  const double step = distance / speed;
  Prediction result{at.value + step * at.motion_of_parameter(), at.iterate};
  const Index m = at.passages(), n = at.forces();
  if (n > 0) {
    const PanelForces& forces = at.iterate.forces;
    const LegendreNodes nodes(forces.coefficients().rows());
    const Eigen::VectorXd values = (nodes.values.leftCols(nodes.count()) * forces.coefficients()).reshaped();
    result.iterate.forces = PanelForces(forces.grid(), nodes, values + step * at.direction.head(n));
  }
  for (Index i = 0; i < m; ++i) passage_of(result.iterate, i) += step * at.direction[n + i];
  return result;
}

Prediction through(const std::vector<const PathPoint*>& points, double place) {
  const Eigen::VectorXd weights = lagrange_weights(points, place);
  Prediction result{0.0, points.back()->iterate};
  Layout& layout = result.iterate.layout;
  for (Passage& passage : layout.passages) passage.time = 0.0;
  for (std::size_t j = 0; j < points.size(); ++j) {
    result.value += weights[Index(j)] * points[j]->value;
    for (std::size_t i = 0; i < layout.passages.size(); ++i)
      layout.passages[i].time += weights[Index(j)] * points[j]->iterate.layout.passages[i].time;
  }
  const Index q = points.back()->iterate.forces.coefficients().rows();
  if (q == 0) return result;
  const auto force = [&](const Panel& panel, double time) {
    const LayoutInterval& interval = layout.intervals[static_cast<std::size_t>(panel.interval)];
    const double begin = layout.begin(interval), length = layout.end(interval) - begin;
    return weighted_force(points, weights, panel.interval, (time - begin) / length);
  };
  result.iterate = with_forces(layout, LegendreNodes(q), force);
  return result;
}

PointOnCurve PathModel::between(const CurvePoint& from, const CurvePoint& to, double share,
                                bool turns) const {
  const auto &a = static_cast<const PathPoint&>(from), &b = static_cast<const PathPoint&>(to);
  const Held held = fastest(a, !turns);
  const double place = a.place + share * (b.place - a.place);
  Prediction expected = through({&a, &b}, place);
  std::optional<PathPoint> found = solve(expected.value, std::move(expected.iterate), held, sign_of(a, held));
  if (!found) return nullptr;
  found->place = place;
  return std::make_shared<PathPoint>(std::move(*found));
}

}  // namespace wavebalance::solvers::detail
