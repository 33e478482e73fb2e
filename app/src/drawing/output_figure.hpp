#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "drawing/period_window.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {

/// Outputs that one picture shows, a panel each.
inline constexpr std::size_t most_drawn_outputs = 12;
/// Those whose harmonics are drawn.
inline constexpr std::size_t most_drawn_harmonics = 4;

/// Half the peak-to-peak value of each output along a sweep, its branches and isolas: the vibration apart
/// from what static loads deflect. Dashed where motions are unstable.
Figure outputs_figure(const Sweep& sweep, const SweepOutputs& outputs,
                      const std::vector<SceneContact>& contacts);

/// "Vibration of row 19", "Velocity of row 3".
std::string vibration_title(const Output& output);

/// Takes the amplitudes over which `figure` draws a sweep to a readable multiple of their unit.
void scale_amplitudes(Figure& figure, const SweepAxis& axis);

/// The vibration along a sweep, its branches and isolas with their bifurcation and grazing points: half the
/// peak-to-peak value and the rms without the mean, of an output or, without one, of the contact that
/// vibrates most, whose displacement has the unit `of_contacts`.
Panel vibration_panel(const Sweep& sweep, const SweepOutputs& outputs, std::optional<std::size_t> output,
                      const std::string& of_contacts);

/// Each output over one period, which a response has; `motion` is outputs x points.
Figure outputs_figure(const std::vector<Output>& outputs, const Eigen::MatrixXd& motion,
                      const PeriodWindow& window);

}  // namespace wavebalance::app
