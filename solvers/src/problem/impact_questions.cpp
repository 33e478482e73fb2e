#include <stdexcept>
#include <utility>

#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::solvers {

const ContactDynamics& ContactProblem::dynamics_of_impacts() const {
  const ContactDynamics* found = dynamics();
  if (found == nullptr)
    throw std::invalid_argument(
        "impacts are solved for by the modes of the structure, and it has none to compute");
  return *found;
}

ImpactsProblem ContactProblem::impacts_here() const {
  return impacts_problem(condensed_, dynamics_of_impacts(), laws_.gaps(contacts()),
                         laws_.restitution(contacts()));
}

ImpactFamily ContactProblem::impact_family(SweepParameter parameter) const {
  return {condensed_, dynamics_of_impacts(), laws_.gaps(contacts()), laws_.restitution(contacts()),
          parameter};
}

ImpactResponse ContactProblem::impacts(double frequency, const ImpactResponseOptions& options) {
  load_fully(frequency);
  return impact_response(impacts_here(), options);
}

ImpactMotions ContactProblem::coexisting_impacts(double frequency, const ImpactMotionsOptions& options) {
  load_fully(frequency);
  return impact_motions(impacts_here(), options);
}

ImpactCurve ContactProblem::traced_impacts(SweepParameter parameter, ImpactCurveOptions options,
                                           ImpactResponse* first) {
  options.validate();
  ImpactResponse start = impact_response(impacts_here(), {.observer = options.observer});
  ImpactCurve curve;
  if (start.motion.converged()) {
    options.periods = start.load_periods;
    curve = impact_curve(impact_family(parameter), start.motion, options);
  } else if (start.motion.status == ImpactStatus::cancelled) {
    curve.status = SweepStatus::cancelled;
  }
  if (first != nullptr) *first = std::move(start);
  return curve;
}

ImpactCurve ContactProblem::impact_sweep(ImpactCurveOptions options, ImpactResponse* first) {
  options.validate();
  load_fully(options.from);
  return traced_impacts(SweepParameter::frequency, std::move(options), first);
}

ImpactCurve ContactProblem::impact_amplitude_sweep(double frequency, ImpactCurveOptions options,
                                                   ImpactResponse* first) {
  options.validate();
  condensed_.set_load_frequency(frequency);
  condensed_.set_load_scale(options.from);
  return traced_impacts(SweepParameter::load_scale, std::move(options), first);
}

std::vector<ImpactCurve> ContactProblem::impact_branches(const ImpactCurve& curve, SweepParameter parameter,
                                                         double frequency,
                                                         const ImpactCurveOptions& options) {
  load_fully(frequency);
  const ImpactFamily family = impact_family(parameter);
  std::vector<ImpactCurve> branches;
  for (const ImpactEvent& event : curve.events)
    if (event.type == SpecialPointType::period_doubling)
      branches.push_back(doubled_curve(family, event, options));
  return branches;
}

StructurePhases ContactProblem::structure_motion(double frequency, const ImpactMotion& motion, int points,
                                                 const StructurePhasesOptions& options) {
  load_fully(frequency);
  const ContactSource source{[&](int count) { return motion.force_harmonics(count); },
                             [&](const Eigen::VectorXd& times) { return motion.displacement(times); }};
  return structure_motion_of(condensed_, source, points, options);
}

}  // namespace wavebalance::solvers
