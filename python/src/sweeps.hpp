#pragma once

#include "problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::python {

/// A curve with its stability; without points where that was not wanted or no modes were found.
struct Curve {
  std::shared_ptr<Problem> problem;
  solvers::ContactLaws laws;
  solvers::FrequencySweep curve;
  solvers::CurveStability stability;
  double wall_seconds = 0.0;

  std::size_t size() const { return curve.points.size(); }
};

}  // namespace wavebalance::python
