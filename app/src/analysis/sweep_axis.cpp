#include "analysis/sweep_axis.hpp"

namespace wavebalance::app {

std::string SweepAxis::label() const {
  return (quantity == "frequency" ? "Frequency (" : "Amplitude of the load (") + unit + ")";
}

SweepAxis sweep_axis(const Sweep& sweep) {
  if (sweep.curve.parameter == solvers::SweepParameter::frequency) return {};
  const std::string& unit = sweep.amplitude_unit;
  return {"amplitude", unit, unit == "m/s^2" ? "m_per_s2" : unit};
}

}  // namespace wavebalance::app
