#include "stability/friction_along.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "linalg/root.hpp"

namespace wavebalance::solvers {
namespace {

using detail::ContactCurve;
using State = FrictionPart::State;

// The state of a sample, and the sign of the force in slip.
struct SampleState {
  State state = State::open;
  double sign = 0.0;
  bool operator==(const SampleState&) const = default;
};

SampleState sample_of(int piece) {
  if (piece == 0) return {State::open, 0.0};
  if (piece == 1) return {State::stick, 0.0};
  return {State::slip, piece == 2 ? 1.0 : -1.0};
}

class FrictionCurve {
 public:
  FrictionCurve(const FrictionConstants& constants, const std::vector<ContactCurve>& curves)
      : constants_(constants), curves_(curves) {}

  const ContactCurve& tangent() const { return curves_.back(); }
  double normal_force(double time) const {
    return constants_.normal_load +
           (constants_.normal_rows > 0 ? constants_.normal_stiffness * curves_.front()(time) : 0.0);
  }
  double limit(double time) const { return constants_.friction * std::max(0.0, normal_force(time)); }
  // By how much the force of a stuck contact would leave the limit of its sign, N per period.
  double slip_rate(double time, double sign) const {
    const double limit_rate = constants_.normal_rows > 0 ? constants_.friction * constants_.normal_stiffness *
                                                               curves_.front().rate(time)
                                                         : 0.0;
    return sign * constants_.tangential_stiffness * tangent().rate(time) - limit_rate;
  }
  double ratio(double time) const { return tangent().rate(time) / curves_.front().rate(time); }
  // The position of the slider from `time` on, where a contact begins to stick.
  double slider(double time, double sign) const {
    return tangent()(time) - sign * limit(time) / constants_.tangential_stiffness;
  }
  double beyond_limit(double time, double slider, double sign) const {
    return sign * constants_.tangential_stiffness * (tangent()(time) - slider) - limit(time);
  }

 private:
  const FrictionConstants& constants_;
  const std::vector<ContactCurve>& curves_;
};

// The root of a function between two times, or the end at which it is smaller where it has one sign.
double root_between(double low, double high, const std::function<double(double)>& value) {
  constexpr double rounding = 1e-11;
  const double at_low = value(low), at_high = value(high);
  return detail::root(value, {low, at_low}, {high, at_high}, rounding)
      .value_or(std::abs(at_low) < std::abs(at_high) ? low : high);
}

// The instant between two samples at which the state changes. `slider`: of a stick.
double transition(const FrictionCurve& curve, const SampleState& from, const SampleState& to, double slider,
                  double low, double high) {
  if (from.state == State::open || to.state == State::open)
    return root_between(low, high, [&](double time) { return curve.normal_force(time); });
  // The last sample that slips may lie on either side of the reversal.
  if (from.state == State::slip)
    return root_between(low - (high - low), high,
                        [&](double time) { return curve.slip_rate(time, from.sign); });
  return root_between(low, high, [&](double time) { return curve.beyond_limit(time, slider, to.sign); });
}

// Parts from a sample that differs from the one before it, once around.
std::vector<FrictionPart> parts_from(const FrictionCurve& curve, const std::vector<SampleState>& samples,
                                     std::size_t first) {
  const std::size_t count = samples.size();
  std::vector<FrictionPart> parts;
  double slider = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t l = first + i;
    const SampleState &from = samples[(l + count - 1) % count], &to = samples[l % count];
    if (from == to) continue;
    const double low = curve.tangent().time_of(double(l) - 1.0), high = curve.tangent().time_of(double(l));
    const double time = transition(curve, from, to, slider, low, high);
    if (!parts.empty()) parts.back().end = time;
    FrictionPart part{to.state, time, 0.0, to.sign, 0.0};
    if (to.state == State::stick) {
      part.sign = from.sign;
      if (from.state == State::open) part.ratio = curve.ratio(time);
      slider = from.state == State::open ? curve.tangent()(time) : curve.slider(time, from.sign);
    }
    parts.push_back(part);
  }
  parts.back().end = parts.front().begin + 1.0;
  return parts;
}

void shift_into_period(std::vector<FrictionPart>& parts) {
  for (FrictionPart& part : parts) {
    const double whole = std::floor(part.begin);
    part.begin -= whole;
    part.end -= whole;
  }
}

}  // namespace

// The first part does not follow a stick, since the slider of a stick follows from its begin.
std::optional<FrictionAlong> friction_along(const AnyContactLaw& law, int row,
                                            const std::vector<ContactCurve>& curves) {
  FrictionAlong along{row, *law.friction(), {}};
  const auto points = static_cast<std::size_t>(curves.front().samples().size());
  std::vector<double> displacement, force(points * curves.size(), 0.0), slope = force;
  for (const ContactCurve& curve : curves)
    displacement.insert(displacement.end(), curve.samples().begin(), curve.samples().end());
  std::vector<SlopeEntry> others;
  std::vector<int> piece(force.size(), 0);
  PeriodForces forces{force, slope, {}, others, piece};
  law.evaluate({static_cast<int>(points), displacement, {}}, forces);
  std::vector<SampleState> samples;
  const auto tangent = static_cast<std::size_t>(along.constants.normal_rows) * points;
  for (std::size_t j = 0; j < points; ++j) samples.push_back(sample_of(piece[tangent + j]));
  const bool slips = std::any_of(samples.begin(), samples.end(),
                                 [](const SampleState& one) { return one.state == State::slip; });
  if (slips && along.constants.tangents > 1) return std::nullopt;
  std::size_t first = 0;
  while (first < points) {
    const SampleState& before = samples[(first + points - 1) % points];
    if (samples[first] != before && before.state != State::stick) break;
    ++first;
  }
  if (first == points) {
    along.parts.push_back({samples.front().state, 0.0, 1.0, samples.front().sign, 0.0});
    return along;
  }
  along.parts = parts_from(FrictionCurve(along.constants, curves), samples, first);
  shift_into_period(along.parts);
  return along;
}

}  // namespace wavebalance::solvers
