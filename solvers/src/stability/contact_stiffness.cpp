#include "wavebalance/solvers/stability/contact_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "linalg/enum_table.hpp"
#include "linalg/index.hpp"
#include "stability/contact_along.hpp"
#include "stability/friction_along.hpp"

namespace wavebalance::solvers {
namespace {

using detail::ContactAlong;
using detail::ContactCurve;
using detail::CoupledAlong;
using detail::crossing;
using detail::InstantAlong;

// Whether a curve, value(sample), rises above the level between samples about l that are all below it: the
// vertex of the parabola through three samples is a candidate, the curve decides.
template <class Value>
bool passes_between_samples(const Eigen::VectorXd& samples, const Value& value, double level, Index l) {
  const Index count = samples.size();
  const double before = samples[(l + count - 1) % count], at = samples[l], after = samples[(l + 1) % count];
  if (at < before || at < after) return false;
  const double bend = 2.0 * at - before - after, slope = 0.5 * (after - before);
  if (!(bend > 0.0) || at + slope * slope / bend < level) return false;
  constexpr int parts = 32;
  for (int part = -parts; part <= parts; ++part)
    if (value(double(l) + double(part) / parts) > level) return true;
  return false;
}

using Intervals = std::vector<ContactInterval>;

// Those that hold a sample, and whether these are all.
struct SampledIntervals {
  Intervals intervals;
  bool complete = true;
};

// The intervals in which a law acts(l) at samples l, which change(l) at times between l and the next; not all
// where one of them holds no sample, passes(l) about sample l.
template <class Acts, class Change, class Passes>
SampledIntervals intervals_of_action(int contact, Index count, const Acts& acts, const Change& change,
                                     const Passes& passes) {
  SampledIntervals result;
  std::vector<bool> at(static_cast<std::size_t>(count));
  for (Index l = 0; l < count; ++l) at[static_cast<std::size_t>(l)] = acts(l);
  std::vector<double> openings, closings;
  for (std::size_t l = 0; l < at.size(); ++l) {
    const bool before = at[(l + at.size() - 1) % at.size()], next = at[(l + 1) % at.size()];
    if (at[l] != next) (next ? closings : openings).push_back(change(Index(l)));
    if (!at[l] && !before && !next && passes(Index(l))) result.complete = false;
  }
  Intervals& intervals = result.intervals;
  if (closings.empty() && at.front()) intervals.push_back({contact, 0.0, 1.0});
  for (const double begin : closings) {  // to the next end
    const auto end = std::upper_bound(openings.begin(), openings.end(), begin);
    const double shift = std::floor(begin);
    intervals.push_back(
        {contact, begin - shift, (end == openings.end() ? openings.front() + 1.0 : *end) - shift});
  }
  return result;
}

// The time between samples l and l + 1 of a curve at which a law begins or ceases to act.
template <class Along>
double change_of_action(const Along& along, const ContactCurve& curve, Index l) {
  double low = curve.time_of(double(l)), high = curve.time_of(double(l + 1));
  const bool before = along.acts(low);
  while (high - low > 1e-15) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) break;
    (along.acts(middle) == before ? low : high) = middle;
  }
  return high;
}

template <class Along, class Passes>
SampledIntervals intervals_of_action(const Along& along, const ContactCurve& curve, int contact,
                                     const Passes& passes) {
  return intervals_of_action(
      contact, curve.samples().size(), [&](Index l) { return along.acts(curve.time_of(double(l))); },
      [&](Index l) { return change_of_action(along, curve, l); }, passes);
}

// The levels of the curve at displacements, in the force form levels of v = u + flexibility f.
std::vector<double> levels(const ContactAlong& along, std::vector<double> displacements) {
  if (along.flexibility > 0.0)
    for (double& level : displacements) level += along.flexibility * along.law.force(level);
  return displacements;
}

// The times (in periods) at which a curve crosses ascending levels; nothing of more than `most`. O(N log
// levels + crossings).
std::vector<double> crossings(const ContactCurve& curve, const std::vector<double>& at, std::size_t most) {
  std::vector<double> times;
  const Eigen::VectorXd& samples = curve.samples();
  const Index count = samples.size();
  for (Index l = 0; l < count && !at.empty(); ++l) {
    const auto [low, high] = std::minmax(samples[l], samples[(l + 1) % count]);
    const auto first = std::lower_bound(at.begin(), at.end(), low);
    const auto last = std::lower_bound(first, at.end(), high);
    if (static_cast<std::size_t>(last - first) + times.size() > most) return {};
    for (auto level = first; level != last; ++level) times.push_back(crossing(curve, *level, l));
  }
  return times;
}

// Whether the law has a slope somewhere in the interval.
bool has_slope(const ContactAlong& along, const ContactInterval& interval) {
  constexpr int parts = 16;
  for (int part = 1; part < parts; ++part)
    if (along.tangent(interval.begin + interval.length() * part / parts) != 0.0) return true;
  return false;
}

// The intervals between the kinks of a law that acts on both sides of its gap, less those without slope.
Intervals intervals_between_kinks(const ContactAlong& along, int contact) {
  constexpr auto no_limit = std::numeric_limits<std::size_t>::max();
  std::vector<double> times = crossings(along.curve, levels(along, along.law.kinks()), no_limit);
  for (double& time : times) time -= std::floor(time);
  std::sort(times.begin(), times.end());
  if (times.empty()) times.push_back(0.0);
  Intervals intervals;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const ContactInterval one{contact, times[i], i + 1 < times.size() ? times[i + 1] : times.front() + 1.0};
    if (one.length() > 0.0 && has_slope(along, one)) intervals.push_back(one);
  }
  return intervals;
}

// The times (in periods) at which a contact passes the breakpoints of its law that are not its kinks, where
// intervals end as it is. Nothing of more than 64, since a table that dense is nearly smooth and rules that
// check themselves cut it as finely as they need.
std::vector<double> cut_times(const ContactAlong& along) {
  constexpr std::size_t most = 64;
  const std::vector<double> all = along.law.breakpoints(), kinks = along.law.kinks();
  std::vector<double> smooth;
  std::set_difference(all.begin(), all.end(), kinks.begin(), kinks.end(), std::back_inserter(smooth));
  return crossings(along.curve, levels(along, std::move(smooth)), most);
}

SampledIntervals find_intervals(const ContactAlong& along, int contact) {
  const ContactCurve& curve = along.curve;
  const double gap = along.law.gap();
  const auto passes = [&](Index l) {
    return along.unilateral &&
           passes_between_samples(
               curve.samples(), [&](double sample) { return curve(curve.time_of(sample)); }, gap, l);
  };
  if (along.has_velocity()) return intervals_of_action(along, curve, contact, passes);
  if (!along.unilateral) return {intervals_between_kinks(along, contact)};
  return intervals_of_action(
      contact, curve.samples().size(), [&](Index l) { return curve.samples()[l] > gap; },
      [&](Index l) { return crossing(curve, gap, l); }, passes);
}

bool comes_before(const ContactInterval& a, const ContactInterval& b) {
  return std::pair(a.contact, a.begin) < std::pair(b.contact, b.begin);
}

}  // namespace

std::string_view to_string(StabilityStatus status) {
  using enum StabilityStatus;
  return detail::name_in<StabilityStatus>({{converged, "converged"},
                                           {no_response, "no_response"},
                                           {no_finite_stiffness, "no_finite_stiffness"},
                                           {too_few_samples, "too_few_samples"},
                                           {too_few_harmonics, "too_few_harmonics"},
                                           {undamped, "undamped"},
                                           {on_unit_circle, "on_unit_circle"},
                                           {coupled_massless, "coupled_massless"},
                                           {too_many_states, "too_many_states"},
                                           {structural_damping, "structural_damping"},
                                           {effort_limit, "effort_limit"},
                                           {unsupported_law, "unsupported_law"}},
                                          status);
}

PeriodicStiffness contact_stiffness(const CondensedProblem& problem, const ContactLaws& laws,
                                    const PeriodicResponse& response) {
  laws.require(problem.contacts());
  PeriodicStiffness stiffness;
  if (!response.converged()) {
    stiffness.status = StabilityStatus::no_response;
    return stiffness;
  }
  if (response.unknown.size() != problem.samples())
    throw std::invalid_argument("contact_stiffness: the response has " +
                                std::to_string(response.unknown.size()) + " samples; the problem has " +
                                std::to_string(problem.samples()));
  const ContactUnknowns unknowns{
      response.unknown_coefficients, response.unknown.reshaped(problem.points(), problem.contacts()),
      response.series_flexibility, problem.pair().first_sample(), response.frequency};
  return contact_stiffness(problem.pair().trial(), laws.at(problem.periods() * response.frequency), unknowns);
}

namespace {

// The displacements of the rows of a law from row c on.
std::vector<ContactCurve> curves_of(const AnyTimeBasis& trial, const ContactLaws& laws,
                                    const ContactUnknowns& unknowns, int c) {
  std::vector<ContactCurve> curves;
  for (int row = c; row < c + laws[c].rows(); ++row)
    curves.emplace_back(trial, unknowns.coefficients.col(row), unknowns.samples.col(row),
                        unknowns.first_sample);
  return curves;
}

using AllCoupled = std::vector<CoupledAlong>;

AllCoupled coupled_along(const AnyTimeBasis& trial, const ContactLaws& laws,
                         const ContactUnknowns& unknowns) {
  AllCoupled all;
  for (int c = 0; c < static_cast<int>(unknowns.samples.cols()); c += laws[c].rows())
    if (const AnyCoupledLaw* law = laws[c].coupled())
      all.push_back({*law, c, curves_of(trial, laws, unknowns, c)});
  return all;
}

using AllInstant = std::vector<InstantAlong>;

AllInstant instant_along(const AnyTimeBasis& trial, const ContactLaws& laws,
                         const ContactUnknowns& unknowns) {
  AllInstant all;
  for (int c = 0; c < static_cast<int>(unknowns.samples.cols()); c += laws[c].rows())
    if (laws[c].acts_at_instants())
      all.emplace_back(laws[c], c, curves_of(trial, laws, unknowns, c), unknowns.frequency);
  return all;
}

// Adds the intervals of a law of several rows to each of them; false where one of them holds no sample.
bool add_intervals(const CoupledAlong& along, Intervals& intervals) {
  const ContactCurve& curve = along.curves.front();
  const auto value = [&](double sample) { return along.penetration(curve.time_of(sample)); };
  Eigen::VectorXd samples(curve.samples().size());
  for (Index l = 0; l < samples.size(); ++l) samples[l] = value(double(l));
  const auto passes = [&](Index l) { return passes_between_samples(samples, value, 0.0, l); };
  bool complete = true;
  for (int contact = along.row; contact < along.row + along.law.rows(); ++contact) {
    const auto own = intervals_of_action(along, curve, contact, passes);
    intervals.insert(intervals.end(), own.intervals.begin(), own.intervals.end());
    complete = complete && own.complete;
  }
  return complete;
}

// Adds the contacts with friction; false where one has slip along two tangents or is another law over a
// period.
bool add_friction(const AnyTimeBasis& trial, const ContactLaws& laws, const ContactUnknowns& unknowns,
                  PeriodicStiffness& stiffness) {
  const int count = static_cast<int>(unknowns.samples.cols());
  for (int c = 0; c < count; c += laws[c].rows()) {
    if (!laws[c].acts_over_period() || laws[c].coupled() || laws[c].acts_at_instants()) continue;
    if (!laws[c].friction()) return false;
    auto along = friction_along(laws[c], c, curves_of(trial, laws, unknowns, c));
    if (!along) return false;
    stiffness.friction.push_back(std::move(*along));
  }
  return stiffness.friction.empty() || !laws.depend_on_velocity();
}

using AllContacts = std::vector<ContactAlong>;

// Adds the intervals of one contact, of which it returns the number, and its cuts. The status reports other
// intervals without a sample.
int add_intervals(const ContactAlong& along, int contact, PeriodicStiffness& stiffness) {
  const auto [intervals, complete] = find_intervals(along, contact);
  stiffness.intervals.insert(stiffness.intervals.end(), intervals.begin(), intervals.end());
  if (!intervals.empty())
    for (const double time : cut_times(along)) stiffness.cuts.push_back({contact, time});
  if (!complete) stiffness.status = StabilityStatus::too_few_samples;
  return static_cast<int>(intervals.size());
}

// The law of several rows that has a contact; null for others.
template <class Along>
const Along* law_at(const std::vector<Along>& all, int contact) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const Along& one) { return one.has(contact); });
  return at == all.end() ? nullptr : &*at;
}

// By displacements and, where laws depend on them, by velocities, and where forces jump.
void set_slopes(AllContacts all, AllCoupled all_coupled, AllInstant all_instant, bool velocities,
                PeriodicStiffness& stiffness) {
  const auto contacts = std::make_shared<const AllContacts>(std::move(all));
  const auto coupled = std::make_shared<const AllCoupled>(std::move(all_coupled));
  const auto instant = std::make_shared<const AllInstant>(std::move(all_instant));
  const auto along = [contacts](int contact) -> const ContactAlong& {
    return (*contacts)[static_cast<std::size_t>(contact)];
  };
  stiffness.tangent = [along, coupled, instant](int contact, double time) {
    if (const CoupledAlong* one = law_at(*coupled, contact)) return one->slope(contact, contact, time);
    if (const InstantAlong* one = law_at(*instant, contact)) return one->tangent(contact, contact, time);
    return along(contact).tangent(time);
  };
  if (!coupled->empty() || !instant->empty())
    stiffness.coupling = [coupled, instant](int force, int displacement, double time) {
      if (const CoupledAlong* one = law_at(*coupled, force); one && one->has(displacement))
        return one->slope(force, displacement, time);
      if (const InstantAlong* one = law_at(*instant, force); one && one->has(displacement))
        return one->tangent(force, displacement, time);
      return 0.0;
    };
  if (!velocities) return;
  stiffness.damping = [along, instant](int contact, double time) {
    if (const InstantAlong* one = law_at(*instant, contact)) return one->damping(contact, contact, time);
    return along(contact).damping(time);
  };
  if (!instant->empty())
    stiffness.damping_coupling = [instant](int force, int velocity, double time) {
      const InstantAlong* one = law_at(*instant, force);
      return one && one->has(velocity) ? one->damping(force, velocity, time) : 0.0;
    };
  stiffness.impulse = [along, instant](int contact, double time) {
    return law_at(*instant, contact) ? 0.0 : along(contact).impulse(time);
  };
}

// Why no stiffness is known, whatever the motion.
StabilityStatus refusal_of(const ContactLaws& laws, const ContactUnknowns& unknowns) {
  bool coupled = false;
  for (int c = 0; c < static_cast<int>(unknowns.samples.cols()); ++c) {
    coupled = coupled || laws[c].coupled();
    if (laws[c].acts_over_period() && unknowns.flexibility.size() > 0)
      return laws[c].is_rigid() ? StabilityStatus::no_finite_stiffness : StabilityStatus::unsupported_law;
  }
  return coupled && laws.depend_on_velocity() ? StabilityStatus::unsupported_law : StabilityStatus::converged;
}

}  // namespace

PeriodicStiffness contact_stiffness(const AnyTimeBasis& trial, const ContactLaws& laws,
                                    const ContactUnknowns& unknowns) {
  const int count = static_cast<int>(unknowns.samples.cols());
  laws.require(count);
  PeriodicStiffness stiffness;
  const auto ended = [&](StabilityStatus status) {
    stiffness.status = status;
    return stiffness;
  };
  if (const StabilityStatus why = refusal_of(laws, unknowns); why != StabilityStatus::converged)
    return ended(why);
  AllCoupled coupled = coupled_along(trial, laws, unknowns);
  AllInstant instant = instant_along(trial, laws, unknowns);
  AllContacts contacts;
  if (!add_friction(trial, laws, unknowns, stiffness) ||
      (!(coupled.empty() && instant.empty()) && !stiffness.friction.empty()))
    return ended(StabilityStatus::unsupported_law);
  for (int c = 0; c < count; ++c)
    contacts.push_back(
        {laws[c], laws[c].unilateral(), unknowns.flexibility.size() > 0 ? unknowns.flexibility[c] : 0.0,
         ContactCurve(trial, unknowns.coefficients.col(c), unknowns.samples.col(c), unknowns.first_sample),
         unknowns.frequency});
  int rigid = 0, elastic = 0;  // intervals of contact
  for (int c = 0; c < count; ++c) {
    if (law_at(instant, c)) stiffness.intervals.push_back({c, 0.0, 1.0});
    if (laws[c].acts_over_period()) continue;
    (laws[c].is_rigid() ? rigid : elastic) +=
        add_intervals(contacts[static_cast<std::size_t>(c)], c, stiffness);
  }
  for (const CoupledAlong& one : coupled)
    if (!add_intervals(one, stiffness.intervals)) stiffness.status = StabilityStatus::too_few_samples;
  if (stiffness.status != StabilityStatus::converged) return stiffness;
  std::sort(stiffness.intervals.begin(), stiffness.intervals.end(), comes_before);
  if (rigid > 0) {
    if (elastic > 0 || !coupled.empty()) stiffness.intervals.clear();
    return ended(StabilityStatus::no_finite_stiffness);
  }
  set_slopes(std::move(contacts), std::move(coupled), std::move(instant), laws.depend_on_velocity(),
             stiffness);
  return stiffness;
}

}  // namespace wavebalance::solvers
