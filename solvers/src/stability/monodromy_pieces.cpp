#include "stability/monodromy_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace wavebalance::solvers {
namespace {

bool is_closed(const ContactInterval& interval, double time) {
  const double since = time - interval.begin - std::floor(time - interval.begin);
  return since < interval.length();
}

double largest_exponent(const ContactDynamics& dynamics) {
  double largest = 0.0;
  for (const ContactPole& pole : dynamics.poles()) largest = std::max(largest, std::abs(pole.exponent));
  return largest;
}

// The largest rate, 1/s, of the contact's stiffness on the mass or the damping beside it, which are those of
// h(t) at t = 0.
double contact_rate(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness) {
  const int contacts = dynamics.contacts();
  Eigen::VectorXd jump = Eigen::VectorXd::Zero(contacts), rise = jump;
  for (const ContactPole& pole : dynamics.poles()) {
    const double times = pole.exponent.imag() == 0.0 ? 1.0 : 2.0;
    const Eigen::VectorXcd squares = times * pole.residue * pole.shape.cwiseProduct(pole.left);
    jump += squares.real();
    rise += (pole.exponent * squares).real();
  }
  constexpr int samples = 8;
  double fastest = 0.0;
  for (const ContactInterval& interval : stiffness.intervals)
    for (int i = 0; i <= samples; ++i) {
      const double time = interval.begin + interval.length() * i / samples;
      const double stop = std::abs(stiffness.tangent(interval.contact, time));
      const double yielding = dynamics.constant()(interval.contact, interval.contact);
      const double tangent = std::isinf(stop) ? 1.0 / yielding : stop / (1.0 + yielding * stop);
      fastest = std::max({fastest, std::abs(jump[interval.contact]) * tangent,
                          std::sqrt(std::abs(rise[interval.contact]) * tangent)});
      if (stiffness.damping)
        fastest =
            std::max(fastest, std::abs(rise[interval.contact] * stiffness.damping(interval.contact, time)));
    }
  return fastest;
}

}  // namespace

std::vector<Piece> pieces(const PeriodicStiffness& stiffness, double longest) {
  std::vector<double> ends{0.0, 1.0};
  for (const ContactInterval& interval : stiffness.intervals)
    for (const double time : {interval.begin, interval.end}) ends.push_back(time - std::floor(time));
  std::sort(ends.begin(), ends.end());
  std::vector<Piece> result;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double length = ends[i] - ends[i - 1], middle = 0.5 * (ends[i] + ends[i - 1]);
    if (!(length > 0.0)) continue;
    std::vector<int> closed;
    for (const ContactInterval& interval : stiffness.intervals)
      if (is_closed(interval, middle)) closed.push_back(interval.contact);
    const int parts = closed.empty() ? 1 : std::max(1, int(std::ceil(length / longest)));
    result.push_back({ends[i - 1], ends[i], std::move(closed), parts});
  }
  return result;
}

std::optional<std::vector<Piece>> resolving_pieces(const ContactDynamics& dynamics,
                                                   const PeriodicStiffness& stiffness, double frequency,
                                                   const MonodromyOptions& options) {
  const double phase = options.max_phase * frequency, resolved = phase * options.max_pieces;
  const double contact = contact_rate(dynamics, stiffness);
  if (!(contact <= resolved)) return std::nullopt;
  return pieces(stiffness, phase / std::clamp(largest_exponent(dynamics), contact, resolved));
}

}  // namespace wavebalance::solvers
