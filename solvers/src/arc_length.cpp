#include "wavebalance/solvers/arc_length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace wavebalance::solvers {

bool FrequencyParameter::contains(double p) const { return std::isfinite(p) && p > 0.0; }

void FrequencyParameter::set(ContactSystem& system, double p) const { system.problem().set_frequency(p); }

void FrequencyParameter::slope(ContactSystem& system, Eigen::VectorXd& slope) const {
  system.problem().apply_slope(system.force(), slope);
  slope -= system.problem().free_response_slope();
}

bool StiffnessParameter::contains(double p) const { return std::isfinite(std::exp(p)); }

void StiffnessParameter::set(ContactSystem& system, double p) const {
  system.set_stiffness_factor(std::exp(p));
}

void StiffnessParameter::slope(ContactSystem& system, Eigen::VectorXd& slope) const {
  system.problem().apply(system.force(), slope);
}

ArcLength::ArcLength(ContactSystem& system, const CurveParameter& parameter, ArcLengthOptions options)
    : system_(system), parameter_(parameter), options_(options), step_(options.initial_step) {}

Eigen::VectorXd ArcLength::scaled(const Eigen::VectorXd& tangent) const {
  return tangent / (double(tangent.size()) * options_.displacement_scale * options_.displacement_scale);
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

// The tangent at an evaluated point, oriented along that of `along`.
bool ArcLength::tangent_at(CurvePoint& point, const CurvePoint& along) {
  parameter_.slope(system_, slope_);
  const double corner = along.parameter_tangent / (options_.parameter_scale * options_.parameter_scale);
  if (!system_.factorize_bordered(slope_, scaled(along.displacement_tangent), corner)) return false;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(slope_.size());
  if (!system_.solve_bordered(zero, 1.0, point.displacement_tangent, point.parameter_tangent)) return false;
  if (!point.displacement_tangent.allFinite() || !std::isfinite(point.parameter_tangent)) return false;
  const int sign = system_.determinant_sign();
  point.orientation = sign == 0 ? along.orientation : sign;
  normalize(point);
  return true;
}

ArcLength::Status ArcLength::start(const Eigen::VectorXd& displacement, double p, double direction) {
  point_ = {};
  point_.displacement = displacement;
  point_.parameter = p;
  parameter_.set(system_, p);
  point_.residual = system_.evaluate(displacement);
  CurvePoint along;
  along.displacement_tangent = Eigen::VectorXd::Zero(displacement.size());
  along.parameter_tangent = direction * options_.parameter_scale;
  previous_ = point_;
  return tangent_at(point_, along) ? Status::advanced : Status::no_point;
}

// Newton on R = 0 in the plane at distance `step` along the tangent of `from`.
bool ArcLength::correct(const CurvePoint& from, double step, CurvePoint& to, int& corrections) {
  to = {};
  to.displacement = from.displacement + step * from.displacement_tangent;
  to.parameter = from.parameter + step * from.parameter_tangent;
  const Eigen::VectorXd row = scaled(from.displacement_tangent);
  const double corner = from.parameter_tangent / (options_.parameter_scale * options_.parameter_scale);
  double parameter_change = 0.0;
  for (corrections = 0; corrections <= options_.max_corrections; ++corrections) {
    if (!parameter_.contains(to.parameter)) return false;
    parameter_.set(system_, to.parameter);
    to.residual = system_.evaluate(to.displacement);
    if (!std::isfinite(to.residual)) return false;
    if (to.residual <= options_.tolerance) return tangent_at(to, from);
    parameter_.slope(system_, slope_);
    if (!system_.factorize_bordered(slope_, row, corner)) return false;
    const double plane =
        row.dot(to.displacement - from.displacement) + corner * (to.parameter - from.parameter) - step;
    if (!system_.solve_bordered(system_.residual(), plane, change_, parameter_change)) return false;
    to.displacement -= change_;
    to.parameter -= parameter_change;
  }
  return false;
}

bool ArcLength::is_at_gap(const CurvePoint& point, int sample) const {
  return std::abs(point.displacement[sample] - system_.gap_at(sample)) <= 1e-8 * options_.displacement_scale;
}

bool ArcLength::same_sides(const CurvePoint& candidate) const {
  for (int l = 0; l < candidate.displacement.size(); ++l) {
    const double gap = system_.gap_at(l);
    const bool passed = (point_.displacement[l] > gap) != (candidate.displacement[l] > gap);
    if (passed && !is_at_gap(point_, l)) return false;
  }
  return true;
}

// Along a curve of a piecewise smooth system the sign of det [R_u R_p; tangent^T] stays, over folds and over
// corners: a candidate with the other sign lies on a part that the curve reaches later, facing back. Only
// where another curve crosses within one smooth piece does the sign change, however short the step.
bool ArcLength::continues(const CurvePoint& candidate, double step) const {
  if (inner(point_, candidate) < std::cos(options_.largest_angle)) return false;
  if (!oriented_ || candidate.orientation * point_.orientation >= 0) return true;
  return step < 2.0 * options_.smallest_step && same_sides(candidate);
}

// Curves cross at corners of structures with symmetries, where the sense is lost: then by the angle alone.
ArcLength::Status ArcLength::advance() {
  oriented_ = true;
  if (step_along()) return Status::advanced;
  oriented_ = false;
  return step_along() ? Status::advanced : Status::no_point;
}

bool ArcLength::step_along() {
  constexpr int comfortable_corrections = 3;
  CurvePoint candidate;
  int corrections = 0;
  for (double step = step_; step >= options_.smallest_step; step *= 0.5) {
    if (!correct(point_, step, candidate, corrections) || !continues(candidate, step)) {
      if (turn_corner(step)) return true;
      continue;
    }
    previous_ = std::move(point_);
    point_ = std::move(candidate);
    last_step_ = step;
    const double growth = corrections < comfortable_corrections    ? 1.6
                          : corrections == comfortable_corrections ? 1.1
                                                                   : 0.6;
    step_ = std::clamp(step * growth, options_.smallest_step, options_.largest_step);
    return true;
  }
  return turn_corner(options_.largest_step);
}

bool ArcLength::locate(const std::function<double(const CurvePoint&)>& value, CurvePoint& point) {
  double low = 0.0, high = 1.0;
  double low_value = value(previous_), high_value = value(point_);
  if (low_value * high_value > 0.0 || last_step_ == 0.0) return false;
  constexpr int limit = 60;
  constexpr double width = 1e-10;
  int corrections = 0;
  for (int i = 0; i < limit && high - low > width; ++i) {
    // Every third cut halves, so that a kink cannot hold false position on one side.
    const double regula = low + (high - low) * low_value / (low_value - high_value);
    const double fraction = i % 3 == 2 ? 0.5 * (low + high) : std::clamp(regula, low, high);
    if (!correct(previous_, fraction * last_step_, point, corrections)) return false;
    const double middle = value(point);
    if (middle == 0.0) return true;
    (low_value * middle > 0.0 ? low : high) = fraction;
    (low_value * middle > 0.0 ? low_value : high_value) = middle;
  }
  return true;
}

// The sample that the tangent takes through the gap first; -1 when none within `distance`.
int ArcLength::crossing_ahead(double& distance) const {
  int sample = -1;
  for (int l = 0; l < point_.displacement.size(); ++l) {
    const double rate = point_.displacement_tangent[l];
    const double ahead = (system_.gap_at(l) - point_.displacement[l]) / rate;
    // A sample that has just been turned at a corner lies at the gap up to rounding.
    const double rounding = 1e-9 * options_.displacement_scale / std::abs(rate);
    if (!(ahead > rounding) || ahead >= distance) continue;
    distance = ahead;
    sample = l;
  }
  return sample;
}

// The sample that passes its gap first between the point and a corner of `sample`; -1 when none does.
int ArcLength::passed_before(int sample, const CurvePoint& corner, double& fraction) const {
  int first = -1;
  fraction = 1.0;
  for (int l = 0; l < corner.displacement.size(); ++l) {
    if (l == sample || is_at_gap(corner, l) || is_at_gap(point_, l)) continue;
    const double gap = system_.gap_at(l), from = point_.displacement[l] - gap,
                 to = corner.displacement[l] - gap;
    if (from * to > 0.0 || from / (from - to) >= fraction) continue;
    fraction = from / (from - to);
    first = l;
  }
  return first;
}

// Newton on R = 0 with the sample held at the gap, from the side on which the curve arrives.
bool ArcLength::solve_corner(int sample, double distance, CurvePoint& corner) {
  corner = {};
  corner.corner = true;
  corner.displacement = point_.displacement + distance * point_.displacement_tangent;
  corner.parameter = point_.parameter + distance * point_.parameter_tangent;
  const double gap = system_.gap_at(sample);
  const bool arrives_free = point_.displacement_tangent[sample] > 0.0;
  Eigen::VectorXd row = Eigen::VectorXd::Zero(corner.displacement.size());
  row[sample] = 1.0;
  double parameter_change = 0.0;
  for (int i = 0; i <= options_.max_corrections; ++i) {
    if (!parameter_.contains(corner.parameter)) return false;
    parameter_.set(system_, corner.parameter);
    corner.residual = system_.evaluate(corner.displacement);
    const double miss = corner.displacement[sample] - gap;
    if (corner.residual <= options_.tolerance && std::abs(miss) <= 1e-9 * options_.displacement_scale)
      return true;
    system_.set_tangent(sample, arrives_free ? 0.0 : system_.law_at(sample).tangent(gap));
    parameter_.slope(system_, slope_);
    if (!system_.factorize_bordered(slope_, row, 0.0)) return false;
    if (!system_.solve_bordered(system_.residual(), miss, change_, parameter_change)) return false;
    corner.displacement -= change_;
    corner.parameter -= parameter_change;
  }
  return false;
}

std::vector<int> ArcLength::samples_at_gap(const CurvePoint& point) const {
  std::vector<int> samples;
  for (int l = 0; l < point.displacement.size(); ++l)
    if (is_at_gap(point, l)) samples.push_back(l);
  return samples;
}

// With `together`, the samples at their gaps, as stiff as `presses` says; the sample goes on `through` its
// gap, or as the orientation of the curve says.
bool ArcLength::corner_tangent(int sample, const std::vector<int>& together, const std::vector<bool>& presses,
                               bool through, CurvePoint& corner) {
  for (std::size_t i = 0; i < together.size(); ++i) {
    const double stiffness = system_.law_at(together[i]).tangent(system_.gap_at(together[i]));
    system_.set_tangent(together[i], presses[i] ? stiffness : 0.0);
  }
  parameter_.slope(system_, slope_);
  Eigen::VectorXd row = Eigen::VectorXd::Zero(corner.displacement.size());
  row[sample] = 1.0;
  if (!system_.factorize_bordered(slope_, row, 0.0)) return false;
  const int sign = system_.determinant_sign();
  const double onwards = point_.displacement_tangent[sample] > 0.0 ? 1.0 : -1.0;
  const int oriented = sign * point_.orientation;
  const double direction = through || oriented == 0 ? onwards : double(oriented);
  row.setZero();
  if (!system_.solve_bordered(row, direction, corner.displacement_tangent, corner.parameter_tangent))
    return false;
  if (!corner.displacement_tangent.allFinite() || !std::isfinite(corner.parameter_tangent)) return false;
  corner.orientation = sign == 0 ? point_.orientation : (direction > 0.0 ? sign : -sign);
  normalize(corner);
  return true;
}

// The tangent of the side ahead: every sample at its gap has the stiffness of the side to which that tangent
// moves it. That on which the sample goes on through its gap comes first.
bool ArcLength::leave_corner(int sample, CurvePoint& corner) {
  const std::vector<int> together = samples_at_gap(corner);
  std::vector<bool> presses, moves_in;
  for (const int l : together) presses.push_back(point_.displacement_tangent[l] > 0.0);
  for (std::size_t round = 0; round <= together.size(); ++round) {
    if (!corner_tangent(sample, together, presses, round == 0, corner)) return false;
    moves_in.clear();
    for (const int l : together) moves_in.push_back(corner.displacement_tangent[l] > 0.0);
    if (moves_in == presses) return true;
    presses = moves_in;
  }
  return false;
}

// False when no sample reaches its gap within that distance or the corner cannot be left.
bool ArcLength::turn_corner(double within) {
  constexpr int attempts = 10;
  double distance = within;
  int sample = crossing_ahead(distance);
  CurvePoint corner;
  for (int attempt = 0; sample >= 0 && attempt < attempts; ++attempt) {
    if (!solve_corner(sample, distance, corner)) return false;
    double fraction = 1.0;
    const int earlier = passed_before(sample, corner, fraction);
    if (earlier >= 0) {
      sample = earlier;
      distance *= fraction;
      continue;
    }
    if (!leave_corner(sample, corner)) return false;
    previous_ = std::move(point_);
    point_ = std::move(corner);
    last_step_ = distance;
    step_ = options_.initial_step;
    return true;
  }
  return false;
}

}  // namespace wavebalance::solvers
