#include "compare/phase_reference.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "wavebalance/app/compare/size_study.hpp"

namespace wavebalance::app {
namespace {

struct PhaseLevel {
  double tolerance;
  int nodes;  // of a panel at first
};

// The last one has other panels than the one before, so that their distance is an error.
constexpr std::array<PhaseLevel, 4> phase_levels{{{1e-6, 8}, {1e-9, 8}, {1e-12, 12}, {1e-12, 16}}};
constexpr double coarsest_reference = 1e-6;  // with a larger error a refined balance is as good
constexpr double least_error = 1e-14;        // rounding
// Where there is one motion alone, of which an estimate may say too little.
constexpr const char* unchecked = "no time was left to check them with more nodes";
constexpr int most_divided = 64;  // panels: rounding may keep the estimate above the tolerance

bool is_refusal(solvers::PhasesStatus status) {
  using enum solvers::PhasesStatus;
  return status == rigid_contact || status == velocity_and_no_mass || status == resonant ||
         status == structural_damping || status == slip_in_a_plane || status == law_over_period;
}

}  // namespace

std::string phrase_of(solvers::PhasesStatus status) {
  using enum solvers::PhasesStatus;
  switch (status) {
    case rigid_contact:
      return "the contact is rigid and has mass";
    case velocity_and_no_mass:
      return "a force of the velocity acts at a contact without mass";
    case resonant:
      return "the structure has a motion of this period without contact";
    case structural_damping:
      return "a loss factor has no equation in time";
    case slip_in_a_plane:
      return "a contact has rigid friction along two tangents";
    case law_over_period:
      return "a law acts over the period and has no states";
    case tolerance_missed:
      return "their error stays above 1e-6";
    case too_many_phases:
      return "they have too many unknowns";
    case not_found:
      return "no motion of the structure is found near the balance";
    case cancelled:
      return "no time was left for them";
    default:  // of curves and of impacts
      break;
  }
  return "";
}

std::string phases_refusal(const StructureModel& model) {
  const solvers::ContactDynamics* dynamics = model.contact_dynamics();
  if (dynamics == nullptr) return "the structure has no modes to compute";
  return dynamics->reduced() ? "the structure has too many degrees of freedom for all of its modes" : "";
}

solvers::Motion sampled(const solvers::PhaseMotion& motion, int points) {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  solvers::Motion samples;
  samples.displacement = motion.displacement(times);
  samples.force = motion.force(times);
  return samples;
}

PhaseReference phase_reference(Guide& guide, const solvers::Observer& observer) {
  PhaseReference best;
  best.error = coarsest_reference;
  int levels = 0;
  for (const auto& [tolerance, nodes] : phase_levels) {
    const auto found = guide.problem.phases(
        guide.response,
        {.tolerance = tolerance, .nodes = nodes, .max_panels = most_divided, .observer = observer});
    const solvers::PhaseMotion& motion = found->motion;
    const bool first = levels == 0;
    const bool better =
        motion.parts != nullptr && (motion.converged() || motion.estimated_error <= best.error);
    if (!better && first) {
      best.missing_because = phrase_of(motion.status);
      best.refused = is_refusal(motion.status);
    }
    if (!better) break;
    solvers::Motion contacts = sampled(motion, guide.contacts.points());
    // An estimate is as much too small, at most, as that of the motion before was.
    double too_small = 1.0;
    if (!first) {
      too_small = std::max(1.0, displacement_error(best.contacts, contacts) / best.error);
      best.force_error = std::max(least_error, force_error(best.contacts, contacts));
    }
    ++levels;
    best.contacts = std::move(contacts);
    best.error = std::max(least_error, too_small * motion.estimated_error);
    if (!motion.converged()) break;
    best.motion = motion;
  }
  if (levels == 1) best.missing_because = unchecked;
  return best;
}

}  // namespace wavebalance::app
