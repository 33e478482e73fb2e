#include "exact/map_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "collocation/collocation_refinement.hpp"
#include "collocation/exact_solution_parts.hpp"
#include "flow/closed_period.hpp"
#include "flow/flow_intervals.hpp"
#include "flow/flow_start.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

MapStart moved(MapStart start, const Eigen::VectorXd& step, double part = 1.0) {
  const Index states = start.state.size();
  start.state += part * step.head(states);
  start.value += part * step[states];
  return start;
}

// Sets how far the beginning is from events.
void set_calm(const ContactFlow& flow, MapPoint& point) {
  point.events = flow.events();
  if (point.events.empty()) return;
  const double first = point.events.front().time, last = point.events.back().time, whole = flow.period();
  point.nearest_event = std::min(first, whole - last) / whole;
  point.calm = longest_calm(point.events, whole).length / whole;
}

// In the middle a contact may be about to touch.
constexpr double share_of_calm = 0.375;

}  // namespace

/// A period from a start.
struct MapPath::Period {
  ContactFlow flow;
  Eigen::VectorXd change;        // of the state
  Eigen::MatrixXd displacement;  // m, R x points, from time 0
  double distance;
  bool returns;
};

/// A start and its period.
struct MapPath::Step {
  MapStart start;
  Period period;
  bool whole;
};

double MapPath::take_operations() const { return std::exchange(operations_, 0.0); }

std::optional<MapPath::Period> MapPath::period(const MapStart& start, double tolerance, bool with_map,
                                               int points) const {
  if (!(start.value > 0.0)) return std::nullopt;
  ContactFlow flow(begun_at(family().at(start.value), start.begin),
                   {.tolerance = tolerance, .margins = true, .keeps_states = keeps_states_});
  flow.start(start.state, start.contacts);
  const Index states = start.state.size(), rows = family().dynamics().contacts();
  if (with_map) flow.perturb(Eigen::MatrixXd::Identity(states, states));
  Eigen::MatrixXd displacement(rows, points);
  const auto first = Index(std::ceil(start.begin * points));  // after the beginning
  Index next = first;
  const auto sample = [&](const FlowSample& at) { displacement.col(next++ % points) = at.displacement; };
  const FlowStatus status = flow.advance_period(points, sample, double(first) - start.begin * points);
  operations_ += period_operations(flow, int(rows));
  if (status != FlowStatus::converged) return std::nullopt;
  const Eigen::VectorXd change = flow.state() - start.state, weights = flow.displacements_by_state();
  const double size = std::max(start.state.cwiseProduct(weights).norm(), vibration()),
               distance = change.cwiseProduct(weights).norm() / size;
  const bool returns = flow.contact_states() == start.contacts;
  if (!observer()({"exact curve", 0, distance, "relative change of a period"})) return std::nullopt;
  return Period{std::move(flow), change, std::move(displacement), distance, returns};
}

std::optional<MapSlopes> MapPath::slopes_at(const MapStart& start, double tolerance) const {
  constexpr double apart = 3e-6;  // of the parameter
  const auto own = period(start, tolerance, true);
  if (!own) return std::nullopt;
  MapStart above = start, below = start;
  above.value *= 1.0 + apart;
  below.value *= 1.0 - apart;
  const auto up = period(above, tolerance, false), down = period(below, tolerance, false);
  if (!up || !down) return std::nullopt;
  MapSlopes slopes{
      own->flow.perturbation(), (up->change - down->change) / (above.value - below.value), {}, {}, {}};
  slopes.multipliers = multipliers_of(slopes.map);
  slopes.rest = at_rest(slopes.map);
  for (const Index i : slopes.rest) slopes.by_parameter[i] = 0.0;
  add_middles(start, *own, tolerance, slopes);
  return slopes;
}

// How far sliders at rest get from the middle by such moves, by differences.
Eigen::MatrixXd MapPath::off_center_by_moves(const MapStart& start, const Period& own, double tolerance,
                                             const MapSlopes& slopes) const {
  constexpr double apart = 1e-6;  // of the vibration, and of the parameter
  const std::vector<Index> free = free_states(slopes.map);
  const Index states = start.state.size(), rest = Index(slopes.rest.size());
  const Eigen::MatrixXd moves = slopes.moves_that_return(free);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rest, rest + 1);
  result.leftCols(rest).setIdentity();
  const auto as_here = [&](const std::optional<Period>& there) {
    return there && there->flow.events().size() == own.flow.events().size();
  };
  for (Index j = 0; j <= rest; ++j) {
    const double part = apart * (j == rest ? start.value : vibration());
    Eigen::VectorXd step = Eigen::VectorXd::Zero(states + 1);
    step(free) = moves.col(j);
    step[j == rest ? states : slopes.rest[std::size_t(j)]] = 1.0;
    const auto ahead = period(moved(start, step, part), tolerance, false),
               behind = period(moved(start, step, -part), tolerance, false);
    if (as_here(ahead) && as_here(behind))
      result.col(j) =
          (off_center(ahead->flow, slopes.rest) - off_center(behind->flow, slopes.rest)) / (2.0 * part);
  }
  for (Index i = 0; i < rest; ++i)
    if (result.row(i).isZero(0.0)) result(i, i) = 1.0;  // rigid friction stays where it is
  return result;
}

void MapPath::add_middles(const MapStart& start, const Period& own, double tolerance,
                          MapSlopes& slopes) const {
  const std::vector<Index> free = free_states(slopes.map);
  const auto rest = Index(slopes.rest.size());
  if (rest == 0) return;
  const Eigen::MatrixXd by_moves = off_center_by_moves(start, own, tolerance, slopes);
  slopes.middles = by_moves.leftCols(rest);
  const Eigen::VectorXd follow = -Lu<double>(slopes.middles).solve(Eigen::VectorXd(by_moves.col(rest)));
  for (Index j = 0; j < rest; ++j) {
    slopes.by_parameter(free) += follow[j] * slopes.map.col(slopes.rest[std::size_t(j)])(free);
    slopes.by_parameter[slopes.rest[std::size_t(j)]] = follow[j];
  }
}

// As much of a step as leads nearer to what comes back.
std::optional<MapPath::Step> MapPath::part_of(const Eigen::VectorXd& step, const MapStart& start,
                                              double distance, double shortest, double tolerance) const {
  for (double part = 1.0; part >= shortest; part *= 0.5) {
    MapStart there = moved(start, step, part);
    auto next = period(there, tolerance, false);
    if (next && next->returns && next->distance < distance)
      return Step{std::move(there), std::move(*next), part == 1.0};
  }
  return std::nullopt;
}

// One period later, by which a slider finds the place at which it rests. If that does not converge it is
// repeated a few times.
std::optional<MapPath::Step> MapPath::passed(const MapStart& start, const Period& now, double tolerance,
                                             int& unsettled) const {
  constexpr double settling = 0.9, small = 1e-8;
  constexpr int most = 4;
  MapStart there = start;
  there.state += now.change;
  auto next = period(there, tolerance, false);
  if (!next || !next->returns) return std::nullopt;
  const bool settles = next->distance < settling * now.distance;
  if (!settles && (now.distance < small || ++unsettled > most)) return std::nullopt;
  return Step{std::move(there), std::move(*next), true};
}

// Newton's method on a fixed plane. Each step updates its matrix as long as a step leaves at most a third;
// a step by a new matrix that increases the residual is halved.
std::optional<MapPath::Closed> MapPath::closed_as_it_rests(MapStart start, const Eigen::VectorXd& held,
                                                           std::optional<MapSlopes> slopes,
                                                           double tolerance) const {
  constexpr double rounding = 1e-13, small = 1e-8, helps = 0.3, shortest = 1.0 / 32.0;
  auto now = period(start, tolerance, false);
  if (!now || !now->returns) return std::nullopt;
  int unsettled = 0, i = 0;
  for (bool stalls = false; now->distance >= rounding && !stalls; ++i) {
    // Where a slider is about to slip, steps to either side need more than these.
    if (i == options().exact.max_iterations) break;
    const bool own = !slopes;
    if (own) slopes = slopes_at(start, tolerance);
    if (!slopes) return std::nullopt;
    const Eigen::VectorXd step = slopes->step(held, now->change, 0.0);
    if (!step.allFinite()) return std::nullopt;
    auto next = part_of(step, start, now->distance, own ? shortest : 1.0, tolerance);
    const bool helpful = next && next->whole && next->period.distance <= helps * now->distance;
    if (helpful)
      slopes->learn(next->period.change, step,
                    plane_across(step, next->period.flow.displacements_by_state()));
    else if (next || !own)
      slopes.reset();
    else
      next = passed(start, *now, tolerance, unsettled);
    stalls = !next && own;
    if (!next) continue;
    start = std::move(next->start);
    now = std::move(next->period);
  }
  if (now->distance >= small) return std::nullopt;
  return Closed{std::move(start), std::move(now->flow), now->distance, i, std::move(slopes)};
}

// With the sliders at rest in the middle, by a secant method.
std::optional<MapPath::Closed> MapPath::closed(MapStart start, const Eigen::VectorXd& held,
                                               std::optional<MapSlopes> slopes, double tolerance) const {
  constexpr double near = 1e-11, nearly = 1e-8;  // of the vibration
  constexpr int most = 12;
  Eigen::VectorXd last, shift;
  for (int i = 0; i < most; ++i) {
    auto found = closed_as_it_rests(start, held, slopes, tolerance);
    const double allowed = (i + 1 < most ? near : nearly) * vibration();
    if (!found || found->flow.off_center().lpNorm<Eigen::Infinity>() <= allowed) return found;
    slopes = found->slopes;
    if (!slopes || slopes->rest != at_rest(slopes->map)) slopes = slopes_at(found->start, tolerance);
    if (!slopes || slopes->rest.empty()) return found;
    const Eigen::VectorXd off = off_center(found->flow, slopes->rest);
    if (shift.size() == off.size())
      slopes->middles += (off - last + slopes->middles * shift) * -shift.transpose() / shift.squaredNorm();
    last = off;
    shift = Lu<double>(slopes->middles).solve(off);
    if (!shift.allFinite()) return std::nullopt;
    start = std::move(found->start);
    for (std::size_t j = 0; j < slopes->rest.size(); ++j) start.state[slopes->rest[j]] -= shift[Index(j)];
  }
  return std::nullopt;
}

Eigen::VectorXd MapPath::plane_across(const Eigen::VectorXd& change, const Eigen::VectorXd& weights) const {
  Eigen::VectorXd all(change.size());
  all << weights / vibration(), 1.0 / parameter_scale();
  return all.cwiseAbs2().cwiseProduct(change);
}

// By differences over a part of a tangent, forwards and backwards.
std::optional<MapPath::Along> MapPath::along(const MapPoint& point, const Eigen::VectorXd& tangent,
                                             double part) const {
  const auto points = int(times().size());
  const auto ahead = period(moved(point.start, tangent, part), tolerance_, false, points),
             behind = period(moved(point.start, tangent, -part), tolerance_, false, points);
  if (!ahead || !behind) return std::nullopt;
  return Along{(ahead->displacement - behind->displacement).reshaped() / (2.0 * part),
               (ahead->change - behind->change) / (2.0 * part)};
}

// Near grazing a change of only the parameter may touch elsewhere than motions of the curve, so their
// residual shows the change by the parameter better.
bool MapPath::set_direction(MapPoint& point, const Eigen::VectorXd& held) const {
  constexpr double apart = 1e-4, comes_back = 1e-3;  // arc length; of a step
  constexpr int most = 4;
  const Index states = point.start.state.size();
  const auto length = [&](double moved, double parameter) {
    return std::hypot(moved / arc_scale(point), parameter / parameter_scale());
  };
  for (int i = 1;; ++i) {
    const Eigen::VectorXd tangent = point.slopes.step(held, Eigen::VectorXd::Zero(states), 1.0);
    if (!tangent.allFinite()) return false;
    const double rough = length(tangent.head(states).cwiseProduct(point.weights).norm(), tangent[states]);
    const auto change = along(point, tangent, apart / rough);
    if (!change) return false;
    const double speed = length(rms_of(change->displacement), tangent[states]);
    point.direction = tangent / speed;
    point.displacement_direction = change->displacement / speed;
    point.slope = point.direction[states];
    const bool returns = length(change->away.cwiseProduct(point.weights).norm(), 0.0) <= comes_back * rough;
    if (returns || i == most || !(std::abs(tangent[states]) > comes_back * rough * parameter_scale()))
      return true;
    point.slopes.by_parameter += change->away / tangent[states];
  }
}

std::shared_ptr<MapPoint> MapPath::point_of(Closed found, const Eigen::VectorXd& held) const {
  auto point = std::make_shared<MapPoint>();
  point->value = found.start.value;
  point->start = found.start;
  point->pattern = pattern_of(found.flow);
  set_calm(found.flow, *point);
  point->motion = motion_of(family().at(point->value), found.flow, point->start);
  const Eigen::MatrixXd displacement = point->motion.displacement(times());
  point->displacement = displacement.reshaped();
  point->vibration = vibration_of(displacement);
  const auto slopes = slopes_at(found.start, tolerance_);
  if (!slopes) return nullptr;
  point->slopes = *slopes;
  point->weights = found.flow.displacements_by_state();
  if (!set_direction(*point, held)) return nullptr;
  set_multipliers(point->motion, slopes->multipliers);
  point->motion.residual = found.distance;
  point->motion.iterations = found.iterations;
  point->motion.unknowns = int(found.start.state.size()) + 1;
  return point;
}

std::shared_ptr<MapPoint> MapPath::solved(const MapStart& start, const Eigen::VectorXd& held,
                                          const std::optional<MapSlopes>& slopes) const {
  constexpr double finest = 1e-12, coarser = 100.0, safety = 3.0;
  constexpr double known = 1e-6;  // near a grazing impact each tolerance leads elsewhere
  for (;; tolerance_ /= coarser) {
    auto found = closed(start, held, slopes, tolerance_);
    if (!found) return nullptr;
    const auto coarse =
        closed(found->start, held, found->slopes ? found->slopes : slopes, coarser * tolerance_);
    auto point = point_of(std::move(*found), held);
    if (!coarse || !point) return nullptr;
    const auto other = period(coarse->start, coarser * tolerance_, false, int(times().size()));
    if (!other) return nullptr;
    const double error =
        safety * (other->displacement.reshaped() - point->displacement).norm() / point->displacement.norm();
    point->motion.estimated_error = std::max(error, 1e-13);
    const bool met = error <= options().exact.tolerance;
    point->motion.status = met ? ExactStatus::converged : ExactStatus::tolerance_missed;
    if (met) return point;
    if (tolerance_ < 1.1 * finest) return error < known ? point : nullptr;
  }
}

MapStart MapPath::near_start(double value, const Eigen::MatrixXd& displacement,
                             const Eigen::MatrixXd& force) const {
  return {start_near(family().at(value), displacement, force, share_of_calm), value};
}

std::shared_ptr<MapPoint> MapPath::first(double value, const ExactSolution& motion, double forwards) const {
  const std::optional<PeriodStart>& known = motion.parts->start;
  const MapStart from = known ? MapStart{*known, value}
                              : near_start(value, motion.displacement(times()), motion.force(times()));
  return solved(from, forwards * along_parameter(from.state.size()), {});
}

std::shared_ptr<MapPoint> MapPath::begun_anew(const MapPoint& point) const {
  const ExactProblem problem = family().at(point.value);
  const auto from =
      point.events.empty()
          ? start_near(problem, point.motion.displacement(times()), point.motion.force(times()), 0.0)
          : calmed(problem, point.start, point.events, share_of_calm, {.tolerance = tolerance_});
  auto anew = from ? solved({*from, point.value}, along_parameter(from->state.size()), {}) : nullptr;
  if (!anew) return nullptr;
  const double scale = arc_scale(point), size = double(point.displacement.size());
  const double ahead =
      anew->displacement_direction.dot(point.displacement_direction) / (scale * scale * size) +
      anew->slope * point.slope / (parameter_scale() * parameter_scale());
  if (ahead < 0.0) anew->turn_around();
  anew->place = point.place;
  return anew;
}

std::shared_ptr<MapPoint> MapPath::solve(const MapStart& start, const MapPoint& beside) const {
  return solved(start, plane_across(beside.direction, beside.weights), beside.slopes);
}

// At a share of the chord, and the plane across it or, where the curve does not turn, of that parameter.
std::pair<MapStart, Eigen::VectorXd> MapPath::on_chord(const MapPoint& a, const MapPoint& b, double share,
                                                       bool turns) const {
  Eigen::VectorXd chord(a.start.state.size() + 1);
  chord << b.start.state - a.start.state, b.value - a.value;
  MapStart start = share < 0.5 ? a.start : b.start;
  start.state = a.start.state;
  start.value = a.value;
  start = moved(std::move(start), chord, share);
  if (turns) return {std::move(start), plane_across(chord, a.weights)};
  return {std::move(start), std::copysign(1.0, b.value - a.value) * along_parameter(a.start.state.size())};
}

PointOnCurve MapPath::between(const CurvePoint& from, const CurvePoint& to, double share, bool turns) const {
  const auto &a = static_cast<const MapPoint&>(from), &b = static_cast<const MapPoint&>(to);
  const auto [start, plane] = on_chord(a, b, share, turns);
  auto point = solved(start, plane, (share < 0.5 ? a : b).slopes);
  if (!point) return nullptr;
  point->place = a.place + share * (b.place - a.place);
  return point;
}

std::optional<std::pair<double, ContactPattern>> MapPath::pattern_between(const MapPoint& a,
                                                                          const MapPoint& b,
                                                                          double share) const {
  const auto [start, plane] = on_chord(a, b, share, a.slope * b.slope < 0.0);
  const auto found = closed(start, plane, (share < 0.5 ? a : b).slopes, tolerance_);
  if (!found) return std::nullopt;
  return std::pair(found->start.value, pattern_of(found->flow));
}

}  // namespace wavebalance::solvers::detail
