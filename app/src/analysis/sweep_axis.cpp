#include "analysis/sweep_axis.hpp"

namespace wavebalance::app {
namespace {

SweepAxis amplitude_axis(const std::string& unit) {
  return {"amplitude", unit, unit == "m/s^2" ? "m_per_s2" : unit};
}

const SweepAxis frequency_axis{"frequency", "Hz", "Hz"};

}  // namespace

std::string SweepAxis::label() const {
  return (quantity == "frequency" ? "Frequency (" : "Amplitude of the load (") + unit + ")";
}

SweepAxis sweep_axis(const Sweep& sweep) {
  if (sweep.curve.parameter == solvers::SweepParameter::frequency) return frequency_axis;
  return amplitude_axis(sweep.amplitude_unit);
}

std::optional<SweepAxis> axis_of(const Table& table) {
  for (const SweepAxis& one :
       {frequency_axis, amplitude_axis("N"), amplitude_axis("m"), amplitude_axis("m/s^2")})
    if (table.has_column(one.column())) return one;
  return std::nullopt;
}

}  // namespace wavebalance::app
