#include "wavebalance/solvers/continuation/arc_length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "linalg/bracket.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {

bool FrequencyParameter::contains(double p) const { return std::isfinite(p) && p > 0.0; }

void FrequencyParameter::set(ContactSystem& system, double p) const { system.problem().set_frequency(p); }

void FrequencyParameter::slope(ContactSystem& system, Eigen::VectorXd& slope) const {
  system.problem().apply_slope(system.force(), slope);
  slope -= system.problem().contact_free_response_slope();
  system.add_velocity_slope(slope);
}

bool LoadScaleParameter::contains(double p) const { return std::isfinite(p); }

void LoadScaleParameter::set(ContactSystem& system, double p) const { system.problem().set_load_scale(p); }

void LoadScaleParameter::slope(ContactSystem& system, Eigen::VectorXd& slope) const {
  slope = -system.problem().contact_free_response_by_scale();
}

void ArcLengthOptions::validate() const {
  constexpr const char* who = "ArcLengthOptions";
  for (const auto& [name, value] :
       {std::pair{"displacement_scale", displacement_scale}, std::pair{"parameter_scale", parameter_scale}})
    if (!(std::isfinite(value) && value >= 0.0)) detail::reject(who, name, value, "at least 0 and finite");
  detail::require_positive(who, "initial_step", initial_step);
  detail::require_positive(who, "min_step", min_step);
  detail::require_positive(who, "max_step", max_step);
  detail::require_positive(who, "max_angle", max_angle);
  detail::require_positive(who, "tolerance", tolerance);
  detail::require_at_least(who, "max_corrections", max_corrections, 1);
  if (!(max_operations > 0.0)) detail::reject(who, "max_operations", max_operations, "positive");
}

ArcLength::ArcLength(ContactSystem& system, const CurveParameter& parameter, ArcLengthOptions options)
    : system_(system), parameter_(parameter), options_(options), step_(options.initial_step) {
  constexpr int few_samples = 512;
  const CondensedProblem& problem = system.problem();
  const bool undamped = problem.pair().functions() % 2 == 0 && !problem.pair().drops_nyquist();
  const bool automatic = options_.grazing_events == GrazingEvents::automatic;
  many_samples_ = problem.samples() > few_samples;
  events_first_ = options_.grazing_events == GrazingEvents::all ||
                  (automatic && !undamped && problem.samples() <= few_samples);
}

Eigen::VectorXd ArcLength::scaled(const Eigen::VectorXd& tangent) const {
  return tangent / options_.displacement_scale / (double(tangent.size()) * options_.displacement_scale);
}

double ArcLength::inner(const CurvePoint& a, const CurvePoint& b) const {
  return scaled(a.displacement_tangent).dot(b.displacement_tangent) +
         a.parameter_tangent * b.parameter_tangent / (options_.parameter_scale * options_.parameter_scale);
}

void ArcLength::normalize(CurvePoint& point) const {
  const double length = std::sqrt(inner(point, point));
  point.displacement_tangent /= length;
  point.parameter_tangent /= length;
}

// Computes the tangent at an evaluated point, with the orientation of the tangent of `along`.
bool ArcLength::tangent_at(CurvePoint& point, const CurvePoint& along) {
  parameter_.slope(system_, slope_);
  const double last = along.parameter_tangent / (options_.parameter_scale * options_.parameter_scale);
  if (!system_.factorize_bordered(slope_, scaled(along.displacement_tangent), last)) return false;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(slope_.size());
  if (!system_.solve_bordered(zero, 1.0, point.displacement_tangent, point.parameter_tangent)) return false;
  if (!point.displacement_tangent.allFinite() || !std::isfinite(point.parameter_tangent)) return false;
  const int sign = system_.determinant_sign();
  point.orientation = sign == 0 ? along.orientation : sign;
  normalize(point);
  return true;
}

ArcLength::Status ArcLength::start(const Eigen::VectorXd& displacement, double p, double direction) {
  CurvePoint solution;
  solution.displacement = displacement;
  solution.parameter = p;
  solution.displacement_tangent = Eigen::VectorXd::Zero(displacement.size());
  solution.parameter_tangent = direction * options_.parameter_scale;
  return start(solution);
}

ArcLength::Status ArcLength::start(const CurvePoint& solution) {
  const CurvePoint along = solution;
  point_ = {};
  point_.displacement = solution.displacement;
  point_.parameter = solution.parameter;
  parameter_.set(system_, solution.parameter);
  point_.residual = system_.evaluate(solution.displacement);
  previous_ = point_;
  last_step_ = 0.0;
  orientation_unknown_ = false;
  piecewise_arc_length_ = reversal_step_ = 0.0;
  operation_limit_ = system_.operations() + options_.max_operations;
  return tangent_at(point_, along) ? Status::advanced : Status::no_point;
}

double ArcLength::Plane::miss(const CurvePoint& point) const {
  return row.dot(point.displacement) + parameter * point.parameter - offset;
}

double ArcLength::evaluate(const CurvePoint& point, const LawPieces* sides) {
  parameter_.set(system_, point.parameter);
  return sides ? system_.evaluate(point.displacement, *sides) : system_.evaluate(point.displacement);
}

// Long steps of few samples are halved soon: grazing events are then followed. Those of many samples contain
// many events and need a correction for every few of them.
int ArcLength::max_corrections(bool in_piece) const {
  if (in_piece) return options_.max_corrections;
  return many_samples_ ? 2 * options_.max_corrections : (options_.max_corrections + 1) / 2;
}

// Newton on R = 0 in the plane, on the smooth continuation of one piece when its sides are given.
bool ArcLength::solve_in(const Plane& plane, const LawPieces* sides, CurvePoint& point, int& corrections) {
  double parameter_change = 0.0;
  const int most = max_corrections(sides != nullptr);
  for (corrections = 0; corrections <= most; ++corrections) {
    if (!parameter_.contains(point.parameter) || system_.operations() > operation_limit_) return false;
    point.residual = evaluate(point, sides);
    if (!std::isfinite(point.residual)) return false;
    const double miss = plane.miss(point);
    if (point.residual <= options_.tolerance && std::abs(miss) <= plane.tolerance) return true;
    parameter_.slope(system_, slope_);
    if (!system_.factorize_bordered(slope_, plane.row, plane.parameter)) return false;
    if (!system_.solve_bordered(system_.residual(), miss, change_, parameter_change)) return false;
    point.displacement -= change_;
    point.parameter -= parameter_change;
  }
  return false;
}

CurvePoint ArcLength::ahead(const CurvePoint& from, double step) const {
  CurvePoint point;
  point.displacement = from.displacement + step * from.displacement_tangent;
  point.parameter = from.parameter + step * from.parameter_tangent;
  return point;
}

// Solves for the point in the plane at distance `step` along the tangent of `from`, and for its tangent.
bool ArcLength::correct(const CurvePoint& from, double step, const LawPieces* sides, CurvePoint& to,
                        int& corrections) {
  to = ahead(from, step);
  Plane plane{scaled(from.displacement_tangent),
              from.parameter_tangent / (options_.parameter_scale * options_.parameter_scale), 0.0, 1e-9};
  plane.offset = plane.miss(to);
  return solve_in(plane, sides, to, corrections) && tangent_at(to, from);
}

// The kink at which a sample lies; -1 for none.
int ArcLength::kink_at(const CurvePoint& point, int sample) const {
  const auto kinks = system_.kinks_at(sample);
  for (std::size_t i = 0; i < kinks.size(); ++i)
    if (std::abs(point.displacement[sample] - kinks[i].at) <= 1e-8 * options_.displacement_scale)
      return static_cast<int>(i);
  return -1;
}

// The pieces of the laws on which the curve continues. The tangent decides for a sample at a kink.
LawPieces ArcLength::sides_of(const CurvePoint& point) const {
  LawPieces sides(point.displacement.size());
  for (int l = 0; l < sides.size(); ++l) {
    const int kink = kink_at(point, l);
    sides[l] = kink < 0 ? system_.piece_at(l, point.displacement[l])
                        : kink + (point.displacement_tangent[l] > 0.0 ? 1 : 0);
  }
  return sides;
}

// Whether a sample is in contact or, of a law that acts everywhere, beyond a kink.
bool ArcLength::touches(const LawPieces& pieces) const {
  for (int l = 0; l < pieces.size(); ++l)
    if (pieces[l] != system_.rest_piece(l)) return true;
  return false;
}

// The straight line from point_ to a point, as a tangent that is not normalized.
CurvePoint ArcLength::chord(const CurvePoint& to) const {
  CurvePoint chord;
  chord.displacement_tangent = to.displacement - point_.displacement;
  chord.parameter_tangent = to.parameter - point_.parameter;
  return chord;
}

// True if the chord to the candidate is within max_angle of the present tangent, and the tangent there within
// max_turn.
bool ArcLength::is_ahead(const CurvePoint& candidate, double max_turn) const {
  const CurvePoint way = chord(candidate);
  return inner(point_, candidate) >= std::cos(max_turn) &&
         inner(point_, way) >= std::cos(options_.max_angle) * std::sqrt(inner(way, way));
}

// The tangents of a curve with many kinks vary about its direction, which the chord shows.
double ArcLength::max_turn() const { return many_samples_ ? 2.0 * options_.max_angle : options_.max_angle; }

// Factor on the next long step.
double ArcLength::growth(int corrections, double turn) const {
  const int comfortable_corrections = many_samples_ ? 7 : 3;
  constexpr double least = 0.6, share = 0.7;
  const double factor = corrections < comfortable_corrections    ? 1.6
                        : corrections == comfortable_corrections ? 1.1
                                                                 : least;
  if (!many_samples_ || turn <= 0.0) return factor;
  return std::min(factor, std::max(least, share * max_turn() / turn));
}

void ArcLength::accept(CurvePoint&& candidate, const LawPieces& sides) {
  last_step_ = inner(point_, chord(candidate));
  last_sides_ = sides;
  orientation_unknown_ = orientation_unknown_ || candidate.orientation * point_.orientation < 0;
  previous_ = std::move(point_);
  point_ = std::move(candidate);
}

ArcLength::Status ArcLength::advance() {
  const bool far = (many_samples_ || !orientation_unknown_) && options_.grazing_events != GrazingEvents::all;
  if (far && !events_first_ && piecewise_arc_length_ <= 0.0 && step_far()) return Status::advanced;
  if (!step_in_piece()) return far && events_first_ && step_far() ? Status::advanced : Status::no_point;
  const bool turned = previous_.parameter_tangent * point_.parameter_tangent <= 0.0;
  piecewise_arc_length_ = turned ? reversal_step_ : piecewise_arc_length_ - last_step_;
  return Status::advanced;
}

// True if the step contains a turning point at a grazing event, or the first or the last contact. The curve
// is then followed piece by piece.
bool ArcLength::skips_grazing_turn(const CurvePoint& candidate) const {
  const LawPieces here = sides_of(point_), there = sides_of(candidate);
  if ((here == there).all()) return false;
  return point_.parameter_tangent * candidate.parameter_tangent <= 0.0 || touches(here) != touches(there);
}

// A step of the whole system. It is halved until it stays on the curve, or few grazing events lie on its way.
bool ArcLength::step_far() {
  constexpr double few = 4.0;
  // Scaled arc length of a step that contains a turning point of many samples. Its frequency varies there by
  // the square.
  constexpr double turning_step = 0.02;
  const bool automatic = options_.grazing_events == GrazingEvents::automatic;
  CurvePoint candidate;
  int corrections = 0;
  double nearest = options_.max_step;
  crossing_ahead(nearest);
  for (; step_ >= options_.min_step; step_ *= 0.5) {
    const bool found =
        correct(point_, step_, nullptr, candidate, corrections) && is_ahead(candidate, max_turn());
    if (found && (orientation_unknown_ || candidate.orientation * point_.orientation >= 0)) {
      const bool turns = point_.parameter_tangent * candidate.parameter_tangent <= 0.0;
      if (many_samples_ && automatic) {
        if (turns && step_ > turning_step) continue;
      } else if (options_.grazing_events != GrazingEvents::where_needed && skips_grazing_turn(candidate)) {
        if (turns && touches(sides_of(point_))) piecewise_arc_length_ = reversal_step_ = step_;
        return false;
      }
      const double turn = std::acos(std::min(1.0, inner(point_, candidate)));
      accept(std::move(candidate), LawPieces());
      step_ = std::clamp(step_ * growth(corrections, turn), options_.min_step, options_.max_step);
      return true;
    }
    if (step_ < few * nearest) break;
  }
  step_ = std::max(step_, options_.min_step);
  return false;
}

bool ArcLength::locate(const std::function<double(const CurvePoint&)>& value, CurvePoint& point) {
  constexpr double width = 1e-10;
  return locate(value, width, point);
}

// Where tangents jump at kinks only bisection narrows the bracket, and the parameter hardly changes.
bool ArcLength::locate_turning_point(CurvePoint& point) {
  const double width = many_samples_ && last_sides_.size() == 0 ? 1e-4 : 1e-10;
  return locate([](const CurvePoint& at) { return at.parameter_tangent; }, width, point);
}

bool ArcLength::locate(const std::function<double(const CurvePoint&)>& value, double width,
                       CurvePoint& point) {
  constexpr int max_steps = 60;
  detail::Bracket bracket{0.0, 1.0, value(previous_), value(point_)};
  if (!bracket.has_sign_change() || last_step_ == 0.0) return false;
  int corrections = 0;
  const LawPieces* sides = last_sides_.size() > 0 ? &last_sides_ : nullptr;
  const auto value_at = [&](double fraction) -> std::optional<double> {
    if (!correct(previous_, fraction * last_step_, sides, point, corrections)) return std::nullopt;
    return value(point);
  };
  const auto is_close = [width](const detail::Bracket& b, double) { return b.high - b.low <= width; };
  return detail::narrow(bracket, max_steps, value_at, is_close);
}

bool ArcLength::between(const CurvePoint& from, const CurvePoint& to, double fraction, CurvePoint& point) {
  CurvePoint way;
  way.displacement_tangent = to.displacement - from.displacement;
  way.parameter_tangent = to.parameter - from.parameter;
  normalize(way);
  point = {};
  point.displacement = (1.0 - fraction) * from.displacement + fraction * to.displacement;
  point.parameter = (1.0 - fraction) * from.parameter + fraction * to.parameter;
  Plane plane{scaled(way.displacement_tangent),
              way.parameter_tangent / (options_.parameter_scale * options_.parameter_scale), 0.0, 1e-9};
  plane.offset = plane.miss(point);
  int corrections = 0;
  return solve_in(plane, nullptr, point, corrections);
}

}  // namespace wavebalance::solvers
