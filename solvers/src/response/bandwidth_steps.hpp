#pragma once
#include <limits>
#include <optional>
#include <vector>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/continuation/arc_length.hpp"

namespace wavebalance::solvers::detail {

/// The frequency of a curve whose steps are no longer than half the half-power bandwidth that the least
/// damped mode above it has there: a superharmonic resonance of a mode of damping ratio zeta and any order
/// has the width 2 zeta f. Longer steps pass it as if it were not there.
class BandwidthSteps final : public CurveParameter {
 public:
  /// The bounds for the modes of a structure in an interval of frequencies, Hz, of which none is less than a
  /// 320th. Nothing for many degrees of freedom and where damping couples the modes. O(n^3).
  static std::optional<BandwidthSteps> make(const CondensedProblem& problem, double interval);

  /// Steps begin at this frequency from now on. Without contact there are no superharmonics and no bounds.
  void begin_at(double frequency, bool in_contact);

  bool contains(double p) const override;
  void set(ContactSystem& system, double p) const override { frequency_.set(system, p); }
  void slope(ContactSystem& system, Eigen::VectorXd& slope) const override {
    frequency_.slope(system, slope);
  }

 private:
  struct Mode {
    double frequency, damping_ratio;  // Hz
  };

  explicit BandwidthSteps(double least) : least_(least) {}

  FrequencyParameter frequency_;
  std::vector<Mode> modes_;
  double least_;
  double begin_ = 0.0, longest_ = std::numeric_limits<double>::infinity();
};

}  // namespace wavebalance::solvers::detail
