#include "results/vibration_record.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/sweep_axis.hpp"
#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {

PeakResolution peak_resolution(std::span<const double> places, std::span<const double> values,
                               std::size_t index) {
  if (index == 0 || index + 1 >= values.size()) return {};
  const auto [low, high] = std::minmax_element(places.begin(), places.end());
  const double extent = std::max(*high - *low, 1e-300), height = values[index];
  const auto distance = [&](std::size_t a, std::size_t b) {
    return std::hypot((places[a] - places[b]) / extent, (values[a] - values[b]) / height);
  };
  const double before = distance(index - 1, index), after = distance(index, index + 1);
  if (!(before > 0.0) || !(after > 0.0)) return {};
  const double rise = (values[index] - values[index - 1]) / before,
               fall = (values[index + 1] - values[index]) / after;
  const double slope = (rise * after + fall * before) / (before + after),
               curvature = (fall - rise) / (before + after);
  if (!(curvature < 0.0)) return {};
  const double way = -0.5 * slope / curvature;
  const std::size_t beside = way < 0.0 ? index - 1 : index + 1;
  return {std::abs(0.25 * slope * slope / curvature / height),
          std::abs(way / (way < 0.0 ? before : after) * (places[beside] - places[index]))};
}

void append_vibration(Summary& summary, const Scene& scene, const Sweep& sweep) {
  const solvers::FrequencySweep& curve = sweep.curve;
  const SweepAxis axis = sweep_axis(sweep);
  std::vector<double> places, values;
  double rms = missing;
  for (const solvers::SweepPoint& point : curve.points) {
    places.push_back(parameter_of(point, curve.parameter));
    values.push_back(point.vibration);
    rms = std::fmax(rms, point.rms_vibration);
  }
  const bool any = !values.empty();
  const std::size_t peak = any ? vibration_peak_of(curve) : 0;
  const PeakResolution resolution =
      any ? peak_resolution(places, values, peak) : PeakResolution{missing, missing};
  summary.emplace_back(quantities::vibration, any ? values[peak] : missing);
  summary.emplace_back(quantities::vibration_place(axis.unit), any ? places[peak] : missing);
  summary.emplace_back(quantities::rms_vibration, rms);
  summary.emplace_back(quantities::peak_value_resolution, resolution.value);
  summary.emplace_back(quantities::peak_place_resolution, resolution.place);
  if (!sweep.phases.empty() && !scene.analysis.exact)
    summary.emplace_back(quantities::error_of_vibration,
                         error_of_vibration(curve, sweep.phases.front().peak, scene.analysis.output_points));
}

void append_friction_along(Summary& summary, const Sweep& sweep) {
  if (sweep.friction.empty()) return;
  double slip = missing, open = missing;
  for (const FrictionShares& one : sweep.friction.front()) {
    slip = std::fmax(slip, one.slip);
    open = std::fmax(open, one.open);
  }
  summary.emplace_back(quantities::max_slip_fraction, slip);
  summary.emplace_back(quantities::max_open_fraction, open);
}

void leave_out_contact_fractions(const Scene& scene, Sweep& sweep) {
  const std::vector<SceneContact> contacts = contacts_of(scene);
  if (std::none_of(contacts.begin(), contacts.end(),
                   [](const SceneContact& one) { return acts_everywhere(one.law); }))
    return;
  const auto leave_out = [](solvers::FrequencySweep& curve) {
    for (solvers::SweepPoint& point : curve.points) point.contact_fraction = missing;
  };
  leave_out(sweep.curve);
  for (solvers::Branch& branch : sweep.branches) leave_out(branch.curve);
  for (Sweep& isola : sweep.isolas) leave_out(isola.curve);
}

}  // namespace wavebalance::app
