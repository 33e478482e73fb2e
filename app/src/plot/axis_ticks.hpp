#pragma once
#include <string>
#include <vector>

namespace wavebalance::app {

/// At most six round numbers of a linear axis from `lower` to `upper`, so that long ones do not touch.
std::vector<double> few_ticks(double lower, double upper);

/// Numbers of a logarithmic axis from `lower` to `upper`, both > 0: powers of ten where there are three,
/// else with 2 and 5 of each decade, or more if these are too few, and finally as on a linear axis.
std::vector<double> logarithmic_ticks(double lower, double upper);

/// A number of a logarithmic axis, "0.5", "20" or "2·10^{5}".
std::string tick_text(double value);

}  // namespace wavebalance::app
