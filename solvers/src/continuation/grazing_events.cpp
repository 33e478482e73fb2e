// Follows the curve piece by piece, from one grazing event to the next.
#include <algorithm>
#include <cmath>

#include "wavebalance/solvers/continuation/arc_length.hpp"

namespace wavebalance::solvers {

// The sample that reaches its gap first along the tangent; -1 if none does within `distance`.
int ArcLength::crossing_ahead(double& distance) const {
  int sample = -1;
  for (int l = 0; l < point_.displacement.size(); ++l) {
    if (is_at_gap(point_, l)) continue;
    const double ahead = (system_.gap_at(l) - point_.displacement[l]) / point_.displacement_tangent[l];
    if (!(ahead > 0.0) || ahead >= distance) continue;
    distance = ahead;
    sample = l;
  }
  return sample;
}

// The sample that changes sides first between point_ and the candidate; -1 if none does.
int ArcLength::passed(const CurvePoint& candidate, const ActiveMask& sides, double& fraction) const {
  int first = -1;
  fraction = 1.0;
  for (int l = 0; l < sides.size(); ++l) {
    const double to = candidate.displacement[l] - system_.gap_at(l);
    if (sides[l] == (to > 0.0) || is_at_gap(candidate, l)) continue;
    const double from = is_at_gap(point_, l) ? 0.0 : point_.displacement[l] - system_.gap_at(l);
    if (first >= 0 && from / (from - to) >= fraction) continue;
    fraction = from / (from - to);
    first = l;
  }
  return first;
}

// One step within the piece that point_ lies on, at most to the end of the piece.
bool ArcLength::step_in_piece() {
  constexpr double shortest = 1e-4;  // times min_step
  const ActiveMask sides = sides_of(point_);
  CurvePoint candidate;
  for (double length = step_; length >= shortest * options_.min_step;) {
    double distance = length, fraction = 1.0;
    int sample = crossing_ahead(distance);
    if (sample < 0) {
      if (step_smoothly(length, sides, candidate)) {
        sample = passed(candidate, sides, fraction);
        distance *= fraction;
        if (sample < 0) {
          accept(std::move(candidate), sides);
          step_ = std::clamp(1.6 * length, options_.min_step, options_.max_step);
          return true;
        }
      }
    }
    if (sample >= 0 && distance > 0.0 && pass_grazing_event(sample, distance, sides)) return true;
    length = 0.5 * (distance > 0.0 ? distance : length);
  }
  return false;
}

// At a branch point within the piece the orientation changes. A short step is then accepted.
bool ArcLength::step_smoothly(double step, const ActiveMask& sides, CurvePoint& candidate) {
  int corrections = 0;
  if (!correct(point_, step, &sides, candidate, corrections) || !is_ahead(candidate, options_.max_angle))
    return false;
  return candidate.orientation * point_.orientation >= 0 || step < 2.0 * options_.min_step;
}

// Ends the piece where a sample reaches its gap. False if that point is not found, or no tangent leaves it.
bool ArcLength::pass_grazing_event(int sample, double distance, const ActiveMask& sides) {
  constexpr int attempts = 10;
  Plane plane{Eigen::VectorXd::Zero(sides.size()), 0.0, 0.0, 1e-9 * options_.displacement_scale};
  int corrections = 0;
  for (int attempt = 0; sample >= 0 && attempt < attempts; ++attempt) {
    plane.row[sample] = 1.0;
    plane.offset = system_.gap_at(sample);
    CurvePoint event = ahead(point_, distance);
    event.grazing = true;
    if (!solve_in(plane, &sides, event, corrections)) return false;
    double fraction = 1.0;
    const int earlier = passed(event, sides, fraction);
    if (earlier < 0) {
      if (!leads_to(sample, sides, event) || !leave_grazing_event(sample, sides, event)) return false;
      accept(std::move(event), sides);
      step_ = std::clamp(1.6 * step_, options_.min_step, options_.max_step);
      return true;
    }
    if (fraction <= 0.0) return false;
    plane.row[sample] = 0.0;
    sample = earlier;
    distance *= fraction;
  }
  return false;
}

// True if the piece leads from point_ to the event without a large change of direction.
bool ArcLength::leads_to(int sample, const ActiveMask& sides, CurvePoint event) {
  return tangent_through(sample, !sides[sample], event) && is_ahead(event, options_.max_angle);
}

std::vector<int> ArcLength::samples_at_gap(const CurvePoint& point) const {
  std::vector<int> samples;
  for (int l = 0; l < point.displacement.size(); ++l)
    if (is_at_gap(point, l)) samples.push_back(l);
  return samples;
}

// The tangent along which the sample moves into contact or out of it, with the present stiffnesses.
bool ArcLength::tangent_through(int sample, bool inwards, CurvePoint& event) {
  parameter_.slope(system_, slope_);
  Eigen::VectorXd row = Eigen::VectorXd::Zero(event.displacement.size());
  row[sample] = 1.0;
  if (!system_.factorize_bordered(slope_, row, 0.0)) return false;
  const int sign = system_.determinant_sign() * (inwards ? 1 : -1);
  row.setZero();
  const double push = std::ldexp(1.0, std::ilogb(options_.displacement_scale));
  if (!system_.solve_bordered(row, inwards ? push : -push, event.displacement_tangent,
                              event.parameter_tangent))
    return false;
  if (!event.displacement_tangent.allFinite() || !std::isfinite(event.parameter_tangent)) return false;
  event.orientation = sign == 0 ? point_.orientation : sign;
  normalize(event);
  return true;
}

// The samples `together` are at their gaps and take the stiffness of the side given by `presses`. Finds the
// tangent along which each of them moves to that side. False if there is none.
bool ArcLength::grazing_tangent(int sample, const std::vector<int>& together,
                                const std::vector<bool>& presses, CurvePoint& event) {
  bool onwards = true;
  for (std::size_t i = 0; i < together.size(); ++i) {
    const double stiffness = system_.law_at(together[i]).tangent(system_.gap_at(together[i]));
    system_.set_tangent(together[i], presses[i] ? stiffness : 0.0);
    if (together[i] == sample) onwards = presses[i];
  }
  if (!tangent_through(sample, onwards, event)) return false;
  for (std::size_t i = 0; i < together.size(); ++i)
    if (presses[i] != (event.displacement_tangent[together[i]] > 0.0)) return false;
  return true;
}

// Finds how the curve continues when several samples are at their gaps.
// A single sample always passes through its gap.
// Samples of symmetric contacts pass through together.
// In general some pass and the others return to their sides; the first combination that keeps the orientation
// is taken.
bool ArcLength::leave_grazing_event(int sample, const ActiveMask& sides, CurvePoint& event) {
  constexpr std::size_t most = 8;
  const std::vector<int> together = samples_at_gap(event);
  for (const int l : together)
    orientation_unknown_ =
        orientation_unknown_ || l / system_.problem().points() != sample / system_.problem().points();
  std::vector<bool> through;
  for (const int l : together) through.push_back(is_at_gap(point_, l) ? sides[l] : !sides[l]);
  if (grazing_tangent(sample, together, through, event))
    return together.size() > 1 || event.orientation * point_.orientation >= 0;
  if (together.size() > most) return false;
  const unsigned all = 1u << together.size();
  for (const bool oriented : {true, false})
    for (unsigned back = 1; back + 1 < all; ++back) {
      std::vector<bool> presses = through;
      for (std::size_t i = 0; i < together.size(); ++i)
        if (back >> i & 1u) presses[i] = !presses[i];
      if (!grazing_tangent(sample, together, presses, event)) continue;
      if (!oriented || event.orientation == point_.orientation) return true;
    }
  return false;
}

}  // namespace wavebalance::solvers
