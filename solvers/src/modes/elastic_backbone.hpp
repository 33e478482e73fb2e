#pragma once
#include <deque>
#include <optional>

#include "modes/mode_curve.hpp"
#include "wavebalance/solvers/modes/elastic_mode.hpp"

namespace wavebalance::solvers {

/// Follows a curve of free motions to the end that the options name, past internal resonances.
class ModeFollower {
 public:
  ModeFollower(ModeCurve& curve, const ElasticBackboneOptions& options, bool starts_linear)
      : curve_(curve), options_(options), starts_linear_(starts_linear) {}

  ElasticBackbone follow();
  /// The motion of an energy ratio within the last step of follow().
  ModePoint at_energy(double energy_ratio, double tolerance);

 private:
  struct Accepted {
    CurveState state;
    double energy;
  };

  bool start();
  ModePoint measure(int iterations) const;
  bool pass_resonance();
  bool leap_over(double frequency, const Accepted& base);
  bool bridge(double frequency);
  bool raise_harmonics(CurveState& state, double frequency, int all);
  bool is_near(const ModePoint& point) const;
  void keep(ModePoint point);
  std::optional<BackboneStatus> step();
  std::optional<BackboneStatus> end_at(const ModePoint& point) const;

  ModeCurve& curve_;
  const ElasticBackboneOptions& options_;
  bool starts_linear_;
  CurveState state_, before_;  // the last point and the one that its step began at
  std::deque<Accepted> recent_;
  double largest_energy_ = 1.0;                // energy ratio of the points accepted
  double highest_ = 0.0;                       // frequency of the points accepted, over omega_m
  double energy_ = 1.0, before_energy_ = 1.0;  // energy ratios of state_ and before_
  bool bridged_ = false;                       // the last step was no arc length
  bool on_resonance_ = false;                  // of the last point, beyond which no other motion was found
  ElasticBackbone result_;
};

}  // namespace wavebalance::solvers
