#pragma once
#include "wavebalance/app/attractors/bifurcation.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// Displacements of the section over frequency or amplitude as dots, over them the exact curve, dashed where
/// it is unstable, and below the period found at each value. Without panels where there is no value.
Figure diagram_figure(const Diagram& diagram);

/// Figures of a motion that did not repeat: the Poincare section and the power spectral density of its
/// leading place.
std::vector<Panel> recorded_panels(const RecordedMotion& motion);

}  // namespace wavebalance::app
