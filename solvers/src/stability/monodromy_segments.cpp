#include "stability/monodromy_segments.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "stability/smooth_segments.hpp"

namespace wavebalance::solvers {
namespace {

double largest_exponent(const ContactDynamics& dynamics) {
  double largest = 0.0;
  for (const ContactPole& pole : dynamics.poles()) largest = std::max(largest, std::abs(pole.exponent));
  return largest;
}

// The largest rate, 1/s, of the contact's stiffness on the neighbouring mass or damping, from h(t) at t =
// 0.
double contact_rate(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                    const std::vector<ContactInterval>& intervals) {
  const int contacts = dynamics.contacts();
  Eigen::VectorXd jump = Eigen::VectorXd::Zero(contacts), rise = jump;
  for (const ContactPole& pole : dynamics.poles()) {
    const double times = pole.exponent.imag() == 0.0 ? 1.0 : 2.0;
    const Eigen::VectorXcd squares = times * pole.residue * pole.shape.cwiseProduct(pole.left);
    jump += squares.real();
    rise += (pole.exponent * squares).real();
  }
  double fastest = 0.0;
  for (const ContactInterval& interval : intervals) {
    const int c = interval.contact;
    const double stop = largest_slope(stiffness.tangent, interval), yielding = dynamics.constant()(c, c);
    const double tangent = std::isinf(stop) ? 1.0 / yielding : stop / (1.0 + yielding * stop);
    fastest = std::max({fastest, std::abs(jump[c]) * tangent, std::sqrt(std::abs(rise[c]) * tangent)});
    if (stiffness.damping)
      fastest = std::max(fastest, std::abs(rise[c]) * largest_slope(stiffness.damping, interval));
  }
  return fastest;
}

// The pieces as intervals of each of their closed contacts.
std::vector<ContactInterval> closed_intervals(const std::vector<Piece>& pieces) {
  std::vector<ContactInterval> intervals;
  for (const Piece& piece : pieces)
    for (const int contact : piece.closed) intervals.push_back({contact, piece.begin, piece.end});
  return intervals;
}

}  // namespace

std::vector<Piece> pieces(const PeriodicStiffness& stiffness, double longest) {
  std::vector<double> ends{0.0, 1.0};
  for (const ContactInterval& interval : cut_intervals(stiffness))
    for (const double time : {interval.begin, interval.end}) ends.push_back(time - std::floor(time));
  std::sort(ends.begin(), ends.end());
  std::vector<Piece> result;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double length = ends[i] - ends[i - 1], middle = 0.5 * (ends[i] + ends[i - 1]);
    if (!(length > 0.0)) continue;
    std::vector<int> closed;
    for (const ContactInterval& interval : stiffness.intervals)
      if (lies_in(interval, middle)) closed.push_back(interval.contact);
    const int parts = closed.empty() ? 1 : std::max(1, int(std::ceil(length / longest)));
    result.push_back({ends[i - 1], ends[i], std::move(closed), parts});
  }
  return result;
}

std::optional<std::vector<Piece>> resolving_pieces(const ContactDynamics& dynamics,
                                                   const PeriodicStiffness& stiffness, double frequency,
                                                   const MonodromyOptions& options) {
  const double phase = options.max_phase * frequency, resolved = phase * options.max_segments;
  const double contact = contact_rate(dynamics, stiffness, cut_intervals(stiffness));
  if (!(contact <= resolved)) return std::nullopt;
  const std::vector<double> allowed = allowed_errors(stiffness);
  std::vector<Piece> result;
  for (const Piece& piece :
       pieces(stiffness, phase / std::clamp(largest_exponent(dynamics), contact, resolved))) {
    const auto parts = resolved_halves(
        stiffness, piece, [&](double) { return options.nodes; }, allowed, options.max_segments + piece.parts);
    if (!parts) return std::nullopt;
    result.insert(result.end(), parts->begin(), parts->end());
  }
  // Short pieces find peaks of the stiffness that samples of the whole interval pass by.
  const double peak = contact_rate(dynamics, stiffness, closed_intervals(result));
  if (!(peak <= resolved)) return std::nullopt;
  if (peak > contact)
    for (Piece& piece : result)
      if (!piece.closed.empty())
        piece.parts = std::max(piece.parts, int(std::ceil((piece.end - piece.begin) * peak / phase)));
  return result;
}

}  // namespace wavebalance::solvers
