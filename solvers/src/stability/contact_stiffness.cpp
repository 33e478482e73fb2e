#include "wavebalance/solvers/stability/contact_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "linalg/bracket.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// The displacement of one contact at any time, in periods.
class ContactCurve {
 public:
  // `samples` are those of the sum of trial functions with `coefficients`, a spectrum over translates, from
  // the time `first` on.
  ContactCurve(const AnyTimeBasis& trial, const Eigen::VectorXcd& coefficients, Eigen::VectorXd samples,
               double first)
      : samples_(std::move(samples)), first_(first), smooth_(trial.pointwise_derivatives() >= 1) {
    if (!trial.band_limited()) return;
    harmonics_.resize(coefficients.size());
    for (Eigen::Index n = 0; n < harmonics_.size(); ++n)
      harmonics_[n] = (n == 0 ? 1.0 : 2.0) * trial.fourier_coefficient(int(n)) * coefficients[n];
  }

  const Eigen::VectorXd& samples() const { return samples_; }
  /// The time of a sample, or of a place between two, in periods.
  double time_of(double sample) const { return first_ + sample / double(samples_.size()); }

  double operator()(double time) const {
    if (harmonics_.size() == 0) return interpolated(time);
    const Complex turn = std::polar(1.0, 2.0 * std::numbers::pi * time);
    double re = 0.0, im = 0.0;  // Horner's scheme
    for (Eigen::Index n = harmonics_.size() - 1; n >= 0; --n) {
      const double next = re * turn.real() - im * turn.imag() + harmonics_[n].real();
      im = re * turn.imag() + im * turn.real() + harmonics_[n].imag();
      re = next;
    }
    return re;
  }

 private:
  double interpolated(double time) const {
    const Eigen::Index count = samples_.size();
    const double since = time - first_;
    const double position = (since - std::floor(since)) * double(count);
    const auto left = static_cast<Eigen::Index>(position);
    const double x = position - double(left);
    const auto at = [&](Eigen::Index offset) { return samples_[(left + offset + count) % count]; };
    if (!smooth_) return (1.0 - x) * at(0) + x * at(1);
    return at(0) * (1.0 - x * x) * (2.0 - x) / 2.0 + at(1) * x * (1.0 + x) * (2.0 - x) / 2.0 -
           (at(-1) * (2.0 - x) + at(2) * (1.0 + x)) * x * (1.0 - x) / 6.0;
  }

  Eigen::VectorXd samples_;
  double first_;
  Eigen::VectorXcd harmonics_;  // u = Re sum harmonics exp(2 pi i n t); empty where there are too many
  bool smooth_;
};

// A law along the motion of its contact. In the force form the curve is that of v = u + flexibility f.
struct ContactAlong {
  AnyContactLaw law;
  bool unilateral;
  double flexibility;  // m/N; 0 in the displacement form
  ContactCurve curve;

  double tangent(double time) const {
    const double v = curve(time);
    const double u = flexibility > 0.0 ? v - flexibility * law.resolvent(v, flexibility).force : v;
    // At the end of an interval rounding may leave u below the gap.
    return law.tangent(unilateral ? std::max(u, law.gap()) : u);
  }
};

// The time between samples l and l + 1 at which the curve crosses the level.
double crossing(const ContactCurve& curve, double level, Eigen::Index l) {
  const Eigen::VectorXd& samples = curve.samples();
  detail::Bracket bracket{curve.time_of(double(l)), curve.time_of(double(l + 1)), samples[l] - level,
                          samples[(l + 1) % samples.size()] - level};
  double root = bracket.low;
  const auto value = [&](double time) -> std::optional<double> {
    root = time;
    return curve(time) - level;
  };
  const double scale = std::abs(bracket.low_value) + std::abs(bracket.high_value);
  detail::narrow(bracket, 60, value, [&](const detail::Bracket& now, double residual) {
    return std::abs(residual) < 1e-15 * scale || now.high - now.low < 1e-15;
  });
  return root;
}

// Whether the curve rises above the level between samples about l that are all below it: the vertex of the
// parabola through three samples says whether to look, the curve itself decides.
bool passes_between_samples(const ContactCurve& curve, double level, Eigen::Index l) {
  const Eigen::VectorXd& samples = curve.samples();
  const Eigen::Index count = samples.size();
  const double before = samples[(l + count - 1) % count], at = samples[l], after = samples[(l + 1) % count];
  if (at < before || at < after) return false;
  const double bend = 2.0 * at - before - after, slope = 0.5 * (after - before);
  if (!(bend > 0.0) || at + slope * slope / bend < level) return false;
  constexpr int parts = 32;
  for (int part = -parts; part <= parts; ++part)
    if (curve(curve.time_of(double(l) + double(part) / parts)) > level) return true;
  return false;
}

// The intervals of one contact; nothing where one of them holds no sample.
std::optional<std::vector<ContactInterval>> find_intervals(const ContactAlong& along, int contact) {
  const double gap = along.law.gap();
  const Eigen::VectorXd& samples = along.curve.samples();
  const Eigen::Index count = samples.size();
  const bool unilateral = along.unilateral;
  std::vector<double> openings, closings;
  for (Eigen::Index l = 0; l < count; ++l) {
    const bool above = samples[l] > gap, next = samples[(l + 1) % count] > gap;
    if (above != next) (next ? closings : openings).push_back(crossing(along.curve, gap, l));
    if (unilateral && !above && passes_between_samples(along.curve, gap, l) &&
        !(samples[(l + count - 1) % count] > gap) && !next)
      return std::nullopt;
  }
  std::vector<ContactInterval> intervals;
  if (closings.empty()) {
    if (samples[0] > gap || !unilateral) intervals.push_back({contact, 0.0, 1.0});
    return intervals;
  }
  const auto add = [&](const std::vector<double>& begins, const std::vector<double>& ends) {
    for (const double begin : begins) {
      const auto end = std::upper_bound(ends.begin(), ends.end(), begin);
      const double shift = std::floor(begin);
      intervals.push_back({contact, begin - shift, (end == ends.end() ? ends.front() + 1.0 : *end) - shift});
    }
  };
  add(closings, openings);
  if (!unilateral) add(openings, closings);
  std::sort(intervals.begin(), intervals.end(),
            [](const auto& a, const auto& b) { return a.begin < b.begin; });
  return intervals;
}

}  // namespace

std::string_view to_string(StabilityStatus status) {
  switch (status) {
    case StabilityStatus::converged:
      return "converged";
    case StabilityStatus::no_response:
      return "no_response";
    case StabilityStatus::no_finite_stiffness:
      return "no_finite_stiffness";
    case StabilityStatus::too_few_samples:
      return "too_few_samples";
    case StabilityStatus::too_few_harmonics:
      return "too_few_harmonics";
    case StabilityStatus::undamped:
      return "undamped";
    case StabilityStatus::coupled_massless:
      return "coupled_massless";
    case StabilityStatus::effort_limit:
      return "effort_limit";
  }
  return "unknown";
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
  const ContactUnknowns unknowns{response.unknown_coefficients,
                                 response.unknown.reshaped(problem.points(), problem.contacts()),
                                 response.regularization, problem.pair().first_sample()};
  return contact_stiffness(problem.pair().trial(), laws, unknowns);
}

PeriodicStiffness contact_stiffness(const AnyTimeBasis& trial, const ContactLaws& laws,
                                    const ContactUnknowns& unknowns) {
  const int count = static_cast<int>(unknowns.samples.cols());
  laws.require(count);
  PeriodicStiffness stiffness;
  int rigid = 0, elastic = 0;  // intervals of contact
  const auto contacts = std::make_shared<std::vector<ContactAlong>>();
  for (int c = 0; c < count; ++c) {
    const double flexibility = unknowns.flexibility.size() > 0 ? unknowns.flexibility[c] : 0.0;
    contacts->push_back(
        {laws[c], laws[c].unilateral(), flexibility,
         ContactCurve(trial, unknowns.coefficients.col(c), unknowns.samples.col(c), unknowns.first_sample)});
    const ContactAlong& along = contacts->back();
    const auto intervals = find_intervals(along, c);
    if (!intervals) {
      stiffness.status = StabilityStatus::too_few_samples;
      return stiffness;
    }
    (along.law.is_rigid() ? rigid : elastic) += static_cast<int>(intervals->size());
    stiffness.intervals.insert(stiffness.intervals.end(), intervals->begin(), intervals->end());
  }
  if (rigid > 0) {
    stiffness.status = StabilityStatus::no_finite_stiffness;
    if (elastic > 0) stiffness.intervals.clear();
    return stiffness;
  }
  stiffness.tangent = [contacts](int contact, double time) {
    return (*contacts)[static_cast<std::size_t>(contact)].tangent(time);
  };
  return stiffness;
}

}  // namespace wavebalance::solvers
