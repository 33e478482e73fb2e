#include "analysis/sweep_axis.hpp"

namespace wavebalance::app {

std::string SweepAxis::label() const {
  return (quantity == "frequency" ? "Frequency (" : "Amplitude of the load (") + unit + ")";
}

SweepAxis sweep_axis(const Sweep& sweep) {
  if (sweep.curve.parameter == solvers::SweepParameter::frequency) return {"frequency", "Hz", "Hz"};
  return {"amplitude", sweep.amplitude_unit,
          sweep.amplitude_unit == "m/s^2" ? "m_per_s2" : sweep.amplitude_unit};
}

}  // namespace wavebalance::app
