#pragma once
#include <span>

#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// A spring whose stiffness k(t) is periodic, as of gears in mesh: k(t) u or, with a backlash of 2 g, k(t)
/// (u - g) above the gap g and k(t) (u + g) below -g. The second of its two rows is a given signal s(t)
/// without a force: k(t) = k (1 + s(t) / signal_unit). So the law itself does not depend on the time.
///
/// O(1). Immutable, may be shared between threads.
class PeriodicStiffnessLaw {
 public:
  /// m, that the signal of k(t) = 2 k has: smaller than displacements, so that measures of both are of these.
  static constexpr double signal_unit = 1e-9;

  /// k > 0, N/m, the mean of k(t); g >= 0, m. Throws std::invalid_argument for others and such that are not
  /// finite.
  explicit PeriodicStiffnessLaw(double stiffness, double gap = 0.0);

  /// Its row of the catalogue, and the law of complete values. The harmonics of k(t) among them belong to the
  /// signal.
  static LawDescription description();
  static PeriodicStiffnessLaw of(const LawValues& values);

  static constexpr int rows() { return 2; }
  static constexpr bool reads_signal() { return true; }
  double stiffness() const { return stiffness_; }
  double gap() const { return gap_; }

  /// m, above 0 in contact: (u^2 - g^2) / (2 g), and 1 always without a gap. Writes its two slopes.
  double penetration(std::span<const double> rows, std::span<double> slopes) const;
  /// The two forces (N) in contact, the second zero, and their slopes (N/m), row after row. Those by the
  /// signal are left out, since it is known and nothing perturbs it.
  void closed(std::span<const double> rows, std::span<double> force, std::span<double> slopes) const;
  /// J, at the stiffness of the instant.
  double potential(std::span<const double> rows) const;

 private:
  double stiffness_, gap_;
};

}  // namespace wavebalance::contact
