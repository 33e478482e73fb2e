#pragma once
#include <Eigen/Core>
#include <array>

namespace wavebalance::solvers::detail {

/// Re sum_n a_n exp(2 pi i n t) over the time t in periods, with its first three derivatives by the time in
/// s. Few harmonics are summed as they are. Many are summed by FFTs at uniform instants once, where Taylor's
/// series about the nearest instant has the values between them to rounding: O(H log H) to make, and each
/// value O(1).
class HarmonicSeries {
 public:
  HarmonicSeries() = default;
  /// `rate`: 2 pi over the period, rad/s.
  HarmonicSeries(Eigen::VectorXcd amplitudes, double rate);

  /// The value and its derivatives.
  std::array<double, 4> at(double time) const;

 private:
  std::array<double, 4> summed(double time) const;

  Eigen::VectorXcd amplitudes_;
  double rate_ = 0.0;
  Eigen::MatrixXd taylor_;  // terms x instants, of powers of 2 pi times the way from the instant; or empty
};

}  // namespace wavebalance::solvers::detail
