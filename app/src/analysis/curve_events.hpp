#pragma once
#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::app {

/// A special point that was solved for with the parameter as unknown, with the measures of the motion there.
template <class Event>
solvers::SpecialPoint special_point_of(const Event& event, const solvers::SweepPoint& at) {
  solvers::SpecialPoint point;
  point.type = event.type;
  point.frequency = at.frequency;
  point.load_scale = at.load_scale;
  point.multiplier = event.multiplier;
  point.max_displacement = at.max_displacement;
  point.max_abs_displacement = at.max_abs_displacement;
  point.vibration = at.vibration;
  point.located = true;
  point.unknown_parameter = event.value;
  point.next_point = event.next_point;
  return point;
}

/// A turning point at a special point.
inline solvers::TurningPoint turning_point_at(const solvers::SpecialPoint& point, bool grazing) {
  return {point.frequency, point.max_displacement, point.max_abs_displacement, grazing, point.load_scale};
}

}  // namespace wavebalance::app
