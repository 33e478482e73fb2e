// Follows the curve piece by piece, from one grazing event to the next.
#include <algorithm>
#include <cmath>

#include "wavebalance/solvers/continuation/arc_length.hpp"

namespace wavebalance::solvers {

// The sample that reaches a kink of its law first along the tangent; none if none does within `distance`.
ArcLength::Crossing ArcLength::crossing_ahead(double& distance) const {
  Crossing first;
  for (int l = 0; l < point_.displacement.size(); ++l) {
    const auto kinks = system_.kinks_at(l);
    const int at = kinks.empty() ? -1 : kink_at(point_, l);
    for (std::size_t i = 0; i < kinks.size(); ++i) {
      if (static_cast<int>(i) == at) continue;
      const double ahead = (kinks[i].at - point_.displacement[l]) / point_.displacement_tangent[l];
      if (!(ahead > 0.0) || ahead >= distance) continue;
      distance = ahead;
      first = {l, static_cast<int>(i)};
    }
  }
  return first;
}

// A sample that has left its piece at the candidate; none if none has.
ArcLength::Crossing ArcLength::passed(const CurvePoint& candidate, const LawSegments& sides) const {
  for (int l = 0; l < sides.size(); ++l) {
    const int piece = system_.piece_at(l, candidate.displacement[l]);
    if (sides[l] == piece) continue;
    const int kink = piece > sides[l] ? sides[l] : sides[l] - 1;
    if (kink_at(candidate, l) != kink) return {l, kink};
  }
  return {};
}

// One step within the piece that point_ lies on, at most to the end of the piece.
bool ArcLength::step_in_piece() {
  constexpr double shortest = 1e-4;  // times min_step
  const LawSegments sides = sides_of(point_);
  CurvePoint candidate;
  for (double length = step_; length >= shortest * options_.min_step;) {
    double distance = length;
    Crossing crossing = crossing_ahead(distance);
    if (crossing.sample < 0 && step_smoothly(length, sides, candidate)) {
      crossing = passed(candidate, sides);
      if (crossing.sample < 0) {
        accept(std::move(candidate), sides);
        step_ = std::clamp(1.6 * length, options_.min_step, options_.max_step);
        return true;
      }
    }
    if (crossing.sample >= 0 && pass_grazing_event(crossing, distance, sides)) return true;
    length = 0.5 * distance;
  }
  return false;
}

// At a branch point within the piece the orientation changes. A short step is then accepted.
bool ArcLength::step_smoothly(double step, const LawSegments& sides, CurvePoint& candidate) {
  int corrections = 0;
  if (!correct(point_, step, &sides, candidate, corrections) || !is_ahead(candidate, options_.max_angle))
    return false;
  return candidate.orientation * point_.orientation >= 0 || step < 2.0 * options_.min_step;
}

// Ends the piece where a sample reaches a kink. False if that point is not found, or no tangent leaves it.
bool ArcLength::pass_grazing_event(Crossing crossing, double distance, const LawSegments& sides) {
  constexpr int attempts = 10;
  Plane plane{Eigen::VectorXd::Zero(sides.size()), 0.0, 0.0, 1e-9 * options_.displacement_scale};
  int corrections = 0;
  for (int attempt = 0; crossing.sample >= 0 && attempt < attempts; ++attempt) {
    plane.row[crossing.sample] = 1.0;
    plane.offset = system_.kinks_at(crossing.sample)[static_cast<std::size_t>(crossing.kink)].at;
    CurvePoint event = ahead(point_, distance);
    event.grazing = true;
    if (!solve_in(plane, &sides, event, corrections)) return false;
    const Crossing earlier = passed(event, sides);
    if (earlier.sample < 0) {
      CurvePoint arrives = event;
      if (!leads_to(crossing, sides, arrives) || !leave_grazing_event(crossing.sample, arrives, event))
        return false;
      accept(std::move(event), sides);
      step_ = std::clamp(1.6 * step_, options_.min_step, options_.max_step);
      return true;
    }
    plane.row[crossing.sample] = 0.0;
    crossing = earlier;
  }
  return false;
}

// True if the piece leads from point_ to the event without a large change of direction. Sets its tangent
// there.
bool ArcLength::leads_to(Crossing crossing, const LawSegments& sides, CurvePoint& event) {
  const bool upwards = sides[crossing.sample] <= crossing.kink;
  return tangent_through(crossing.sample, upwards, event) && is_ahead(event, options_.max_angle);
}

std::vector<ArcLength::Crossing> ArcLength::samples_at_kinks(const CurvePoint& point) const {
  std::vector<Crossing> samples;
  for (int l = 0; l < point.displacement.size(); ++l)
    if (const int kink = kink_at(point, l); kink >= 0) samples.push_back({l, kink});
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

// The samples `together` are at kinks and have the slope of the side given by `beyond`. Finds the tangent
// along which each of them moves to that side. False if there is none.
bool ArcLength::grazing_tangent(int sample, const std::vector<Crossing>& together,
                                const std::vector<bool>& beyond, CurvePoint& event) {
  bool onwards = true;
  for (std::size_t i = 0; i < together.size(); ++i) {
    system_.take_side(together[i].sample, together[i].kink, beyond[i]);
    if (together[i].sample == sample) onwards = beyond[i];
  }
  if (!tangent_through(sample, onwards, event)) return false;
  for (std::size_t i = 0; i < together.size(); ++i)
    if (beyond[i] != (event.displacement_tangent[together[i].sample] > 0.0)) return false;
  return true;
}

// Finds how the curve continues when several samples are at kinks.
// A single sample always passes through its kink, the way in which it arrives there. That kink may be the one
// at which its piece began.
// Samples of symmetric contacts pass through together.
// In general some pass and the others return to their sides; the first combination that keeps the orientation
// is taken.
bool ArcLength::leave_grazing_event(int sample, const CurvePoint& arrives, CurvePoint& event) {
  constexpr std::size_t most = 8;
  const std::vector<Crossing> together = samples_at_kinks(event);
  for (const auto& [l, kink] : together)
    orientation_unknown_ =
        orientation_unknown_ || l / system_.problem().points() != sample / system_.problem().points();
  std::vector<bool> through;
  for (const auto& [l, kink] : together) through.push_back(arrives.displacement_tangent[l] > 0.0);
  if (grazing_tangent(sample, together, through, event))
    return together.size() > 1 || event.orientation * point_.orientation >= 0;
  if (together.size() > most) return false;
  const unsigned all = 1u << together.size();
  for (const bool oriented : {true, false})
    for (unsigned back = 1; back + 1 < all; ++back) {
      std::vector<bool> beyond = through;
      for (std::size_t i = 0; i < together.size(); ++i)
        if (back >> i & 1u) beyond[i] = !beyond[i];
      if (!grazing_tangent(sample, together, beyond, event)) continue;
      if (!oriented || event.orientation == point_.orientation) return true;
    }
  return false;
}

}  // namespace wavebalance::solvers
