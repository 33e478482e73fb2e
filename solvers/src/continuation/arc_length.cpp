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

void FrequencyParameter::set(ContactSystem& system, double p) const {
  system.problem().set_load_frequency(p);
}

void FrequencyParameter::slope(ContactSystem& system, Eigen::VectorXd& slope) const {
  system.problem().apply_slope(system.force(), slope);
  slope -= system.problem().linear_response_slope();
  system.add_velocity_slope(slope);
  system.add_law_slope(slope);
  slope /= system.problem().periods();
}

bool LoadScaleParameter::contains(double p) const { return std::isfinite(p); }

void LoadScaleParameter::set(ContactSystem& system, double p) const { system.problem().set_load_scale(p); }

void LoadScaleParameter::slope(ContactSystem& system, Eigen::VectorXd& slope) const {
  slope = -system.problem().linear_response_by_scale();
}

void ArcLengthOptions::validate() const {
  constexpr const char* who = "ArcLengthOptions";
  for (const auto& [name, value] :
       {std::pair{"displacement_scale", displacement_scale}, std::pair{"parameter_scale", parameter_scale}})
    if (!(std::isfinite(value) && value >= 0.0)) detail::reject(who, name, value, "at least 0 and finite");
  if (!(least_scale > 0.0 && least_scale <= 1.0))
    detail::reject(who, "least_scale", least_scale, "in (0, 1]");
  detail::require_positive(who, "initial_step", initial_step);
  detail::require_positive(who, "min_step", min_step);
  detail::require_positive(who, "max_step", max_step);
  detail::require_positive(who, "tolerance", tolerance);
  detail::require_at_least(who, "max_corrections", max_corrections, 1);
  if (!(max_operations > 0.0)) detail::reject(who, "max_operations", max_operations, "positive");
}

ArcLength::ArcLength(ContactSystem& system, const CurveParameter& parameter, ArcLengthOptions options)
    : CurveCorrector(detail::ResponseEquations(system, parameter, options)),
      system_(system),
      parameter_(parameter),
      options_(options),
      step_(options.initial_step) {
  const CondensedProblem& problem = system.problem();
  const bool undamped = problem.pair().functions() % 2 == 0 && !problem.pair().drops_nyquist();
  const bool automatic = options_.grazing_events == GrazingEvents::automatic;
  events_first_ =
      options_.grazing_events == GrazingEvents::all || (automatic && !undamped && !curve().many_samples);
}

detail::ResponseEquations::ResponseEquations(ContactSystem& contacts, const CurveParameter& along,
                                             const ArcLengthOptions& lengths)
    : system(contacts), parameter(along), options(lengths) {
  constexpr int few_samples = 512;
  // The pieces of laws over a period meet nowhere that is known beforehand: there are no events to follow.
  many_samples = system.problem().samples() > few_samples || system.laws().act_over_period();
  scales.setConstant(system.problem().contacts(), options.displacement_scale);
}

double detail::ResponseEquations::evaluate(const CurvePoint& point, const LawSegments* sides) {
  if (!parameter.contains(point.parameter) || system.operations() > operation_limit)
    return std::numeric_limits<double>::infinity();
  parameter.set(system, point.parameter);
  return sides ? system.evaluate(point.displacement, *sides) : system.evaluate(point.displacement);
}

bool detail::ResponseEquations::solve_bordered(const Eigen::VectorXd& row, double last,
                                               const Eigen::VectorXd& right, double last_right,
                                               Eigen::VectorXd& change, double& parameter_change) {
  parameter.slope(system, slope);
  return system.factorize_bordered(slope, row, last) &&
         system.solve_bordered(right, last_right, change, parameter_change);
}

Eigen::VectorXd detail::ResponseEquations::weighted(const Eigen::VectorXd& tangent) const {
  const auto points = tangent.size() / scales.size();
  Eigen::VectorXd result(tangent.size());
  for (Eigen::Index c = 0; c < scales.size(); ++c)
    result.segment(c * points, points) =
        tangent.segment(c * points, points) / scales[c] / (double(tangent.size()) * scales[c]);
  return result;
}

// A contact that hardly vibrates is measured by a part of what the others do.
void detail::ResponseEquations::set_scales(const Eigen::VectorXd& displacement) {
  constexpr double part_of_largest = 0.1;
  const int contacts = system.problem().contacts();
  scales.setConstant(contacts, options.displacement_scale);
  if (options.least_scale == 1.0) return;
  const auto points = displacement.size() / contacts;
  for (int c = 0; c < contacts; ++c) {
    const auto own = displacement.segment(c * points, points).array();
    scales[c] = std::sqrt((own - own.mean()).square().mean());
  }
  const double least =
      std::max(part_of_largest * scales.maxCoeff(), options.least_scale * options.displacement_scale);
  scales = scales.cwiseMax(least);
  if (!system.laws().act_over_period()) scales = scales.cwiseMin(options.displacement_scale);
}

// Long steps of few samples are halved soon: grazing events are then followed. Steps with many samples
// contain many events and need a correction for every few of them.
int detail::ResponseEquations::max_corrections(bool in_piece) const {
  if (in_piece) return options.max_corrections;
  return many_samples ? 2 * options.max_corrections : (options.max_corrections + 1) / 2;
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
  point_.residual = curve().evaluate(point_, nullptr);
  curve().set_scales(point_.displacement);
  previous_scales_ = curve().scales;
  previous_ = point_;
  last_step_ = 0.0;
  orientation_unknown_ = false;
  piecewise_arc_length_ = reversal_step_ = 0.0;
  curve().operation_limit = system_.operations() + options_.max_operations;
  return tangent_at(point_, along) ? Status::advanced : Status::no_point;
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
LawSegments ArcLength::sides_of(const CurvePoint& point) const {
  LawSegments sides(point.displacement.size());
  for (int l = 0; l < sides.size(); ++l) {
    const int kink = kink_at(point, l);
    sides[l] = kink < 0 ? system_.piece_at(l, point.displacement[l])
                        : kink + (point.displacement_tangent[l] > 0.0 ? 1 : 0);
  }
  return sides;
}

// Whether a sample is in contact or, of a law that acts everywhere, beyond a kink.
bool ArcLength::touches(const LawSegments& pieces) const {
  for (int l = 0; l < pieces.size(); ++l)
    if (pieces[l] != system_.rest_piece(l)) return true;
  return false;
}

// True if the chord to the candidate is within max_angle of the present tangent, and the tangent there within
// max_turn.
bool ArcLength::is_ahead(const CurvePoint& candidate, double max_turn) const {
  const CurvePoint way = chord(point_, candidate);
  return inner(point_, candidate) >= std::cos(max_turn) &&
         inner(point_, way) >= std::cos(options_.max_angle) * std::sqrt(inner(way, way));
}

// Where contacts begin to slip the curve has a corner that no sample predicts: a short step passes it, to a
// point that is not behind.
bool ArcLength::is_beyond_corner(const CurvePoint& candidate) const {
  constexpr double short_steps = 10.0, longest_chord = 3.0;  // over min_step, over the step
  if (!system_.laws().act_over_period() || step_ > short_steps * options_.min_step) return false;
  const CurvePoint way = chord(point_, candidate);
  const double length = std::sqrt(inner(way, way));
  return length <= longest_chord * step_ && inner(point_, way) > 0.0 && inner(candidate, way) > 0.0;
}

// A point of the curve after a corner along its tangent, and not backwards, where the displacement also
// turns: with the orientation of point_, or else `other`, ahead of it. A tangent belongs to a segment that
// begins at the corner if a point along it is in this segment; a few substitutions find it.
std::optional<CurvePoint> ArcLength::point_from_corner(double length, bool backwards,
                                                       std::optional<CurvePoint>& other) {
  constexpr int substitutions = 6;
  constexpr double straight = 0.98, longest = 5.0;  // cosine, over the length
  CurvePoint way = point_;
  for (int k = 0; k < substitutions; ++k) {
    CurvePoint next = ahead(way, length), candidate;
    if (!std::isfinite(curve().evaluate(next, nullptr)) || !tangent_at(next, way)) break;
    const double sign = backwards && k == 0 ? -1.0 : 1.0;
    way.displacement_tangent = sign * next.displacement_tangent;
    way.parameter_tangent = sign * next.parameter_tangent;
    int corrections = 0;
    if (!correct(way, length, nullptr, candidate, corrections)) continue;
    const CurvePoint chord_to = chord(point_, candidate);
    const double far = std::sqrt(inner(chord_to, chord_to));
    const bool goes_on =
        curve().weighted(point_.displacement_tangent).dot(chord_to.displacement_tangent) > 0.0;
    const bool back = inner(point_, chord_to) < -straight * far && !goes_on;
    if (back || far > longest * length || inner(candidate, chord_to) < straight * far) continue;
    if (candidate.orientation * point_.orientation >= 0) return candidate;
    if (!other && inner(point_, candidate) > 0.0) other = std::move(candidate);
  }
  return std::nullopt;
}

// Where friction begins to act otherwise a curve may turn by more than a right angle, and no point lies
// ahead. Steps within the piece have led to the corner. The way back has the other orientation; but so has a
// way ahead where samples of symmetric contacts change together.
bool ArcLength::turn_corner() {
  if (!system_.laws().act_over_period()) return false;
  std::optional<CurvePoint> next, other;
  const double longest = 10.0 * options_.min_step, shortest = 1e-3 * options_.min_step;
  for (double length = longest; !next && length >= shortest; length *= 0.1)
    for (const bool backwards : {false, true})
      if (!next) next = point_from_corner(length, backwards, other);
  if (!next) next = std::move(other);
  if (!next) return false;
  accept(std::move(*next), LawSegments());
  step_ = options_.min_step;
  return true;
}

// The tangents of a curve with many kinks vary about its direction, which the chord shows.
double ArcLength::max_turn() const {
  return curve().many_samples ? 2.0 * options_.max_angle : options_.max_angle;
}

// Factor on the next long step.
double ArcLength::growth(int corrections, double turn) const {
  const int comfortable_corrections = curve().many_samples ? 7 : 3;
  constexpr double least = 0.6, share = 0.7;
  const double factor = corrections < comfortable_corrections    ? 1.6
                        : corrections == comfortable_corrections ? 1.1
                                                                 : least;
  if (!curve().many_samples || turn <= 0.0) return factor;
  return std::min(factor, std::max(least, share * max_turn() / turn));
}

void ArcLength::accept(CurvePoint&& candidate, const LawSegments& sides) {
  last_step_ = inner(point_, chord(point_, candidate));
  last_sides_ = sides;
  orientation_unknown_ = orientation_unknown_ || candidate.orientation * point_.orientation < 0;
  previous_ = std::move(point_);
  point_ = std::move(candidate);
  previous_scales_ = curve().scales;
  curve().set_scales(point_.displacement);
  normalize(point_);
}

ArcLength::Status ArcLength::advance() {
  const bool far =
      (curve().many_samples || !orientation_unknown_) && options_.grazing_events != GrazingEvents::all;
  if (far && !events_first_ && piecewise_arc_length_ <= 0.0 && step_far()) return Status::advanced;
  if (!step_in_piece())
    return (far && events_first_ && step_far()) || turn_corner() ? Status::advanced : Status::no_point;
  const bool turned = previous_.parameter_tangent * point_.parameter_tangent <= 0.0;
  piecewise_arc_length_ = turned ? reversal_step_ : piecewise_arc_length_ - last_step_;
  return Status::advanced;
}

// True if the step contains a turning point at a grazing event, or the first or the last contact. The curve
// is then followed piece by piece.
bool ArcLength::skips_grazing_turn(const CurvePoint& candidate) const {
  const LawSegments here = sides_of(point_), there = sides_of(candidate);
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
  return halve_until_taken(step_, options_.min_step, [&] {
    const bool found = correct(point_, step_, nullptr, candidate, corrections) &&
                       (is_ahead(candidate, max_turn()) || is_beyond_corner(candidate));
    if (!found || (!orientation_unknown_ && candidate.orientation * point_.orientation < 0))
      return step_ < few * nearest ? StepAttempt::lost : StepAttempt::too_long;
    const bool turns = point_.parameter_tangent * candidate.parameter_tangent <= 0.0;
    if (curve().many_samples && automatic) {
      if (turns && step_ > turning_step) return StepAttempt::too_long;
    } else if (options_.grazing_events != GrazingEvents::where_needed && skips_grazing_turn(candidate)) {
      if (turns && touches(sides_of(point_))) piecewise_arc_length_ = reversal_step_ = step_;
      return StepAttempt::lost;
    }
    const double turn = std::acos(std::min(1.0, inner(point_, candidate)));
    accept(std::move(candidate), LawSegments());
    step_ = std::clamp(step_ * growth(corrections, turn), options_.min_step, options_.max_step);
    return StepAttempt::taken;
  });
}

bool ArcLength::locate(const std::function<double(const CurvePoint&)>& value, CurvePoint& point) {
  constexpr double width = 1e-10;
  return locate(value, width, point);
}

// Where tangents jump at kinks only bisection narrows the bracket, and the parameter hardly changes.
bool ArcLength::locate_turning_point(CurvePoint& point) {
  const double width = curve().many_samples && last_sides_.size() == 0 ? 1e-4 : 1e-10;
  return locate([](const CurvePoint& at) { return at.parameter_tangent; }, width, point);
}

bool ArcLength::locate(const std::function<double(const CurvePoint&)>& value, double width,
                       CurvePoint& point) {
  constexpr int max_steps = 60;
  detail::Bracket bracket{0.0, 1.0, value(previous_), value(point_)};
  if (!bracket.has_sign_change() || last_step_ == 0.0) return false;
  if (last_step_ < 0.0) {  // behind a corner, which is the previous point
    point = previous_;
    return true;
  }
  int corrections = 0;
  const LawSegments* sides = last_sides_.size() > 0 ? &last_sides_ : nullptr;
  const Eigen::VectorXd scales = std::exchange(curve().scales, previous_scales_);
  const auto value_at = [&](double fraction) -> std::optional<double> {
    if (!correct(previous_, fraction * last_step_, sides, point, corrections)) return std::nullopt;
    return value(point);
  };
  const auto is_close = [width](const detail::Bracket& b, double) { return b.high - b.low <= width; };
  const bool found = detail::narrow(bracket, max_steps, value_at, is_close);
  curve().scales = scales;
  return found;
}

bool ArcLength::between(const CurvePoint& from, const CurvePoint& to, double fraction, CurvePoint& point,
                        double farthest) {
  int corrections = 0;
  curve().set_scales(from.displacement);
  return CurveCorrector::between(from, to, fraction, farthest, point, corrections);
}

double ArcLength::distance(const CurvePoint& from, const CurvePoint& to) {
  curve().set_scales(from.displacement);
  return CurveCorrector::distance(from, to);
}

}  // namespace wavebalance::solvers
