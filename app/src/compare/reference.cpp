#include "wavebalance/app/compare/reference.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "compare/guide.hpp"
#include "compare/phase_reference.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compare/size_study.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/period/rigid_reference.hpp"

namespace wavebalance::app {
namespace {

using SteadyClock = std::chrono::steady_clock;

Reference found_reference(const std::string& kind, const std::string& text, double error,
                          solvers::Motion motion) {
  Reference reference;
  reference.converged = true;
  reference.kind = kind;
  reference.status = "converged";
  reference.text = text;
  reference.error = error;
  reference.motion = std::move(motion);
  return reference;
}

/// One scene on the way to its reference.
class ReferenceSearch {
 public:
  ReferenceSearch(const Scene& scene, const StructureModel& model, int points, double seconds,
                  const solvers::Observer& observer)
      : scene_(scene),
        model_(model),
        seconds_(seconds),
        observer_([this, &observer](const solvers::Progress& progress) {
          interrupted_ = interrupted_ || !goes_on(observer, {"reference"});
          return !interrupted_ && elapsed() < allowed_ && next_level_fits(progress);
        }) {
    scene_.analysis.output_points = points;
    scene_.time.sample_offset = 0.0;  // the levels of a refinement share their points at the left ends
  }

  Reference find() {
    Reference reference;
    try {
      std::optional<Reference> found = linear();
      if (!found) found = beside_guide();
      reference =
          found ? std::move(*found) : missing_reference(interrupted_ ? "interrupted" : "no_reference");
    } catch (const solvers::SingularSystem&) {
      reference = missing_reference("singular");
    }
    reference.wall_seconds = elapsed();
    return reference;
  }

 private:
  double elapsed() const { return std::chrono::duration<double>(SteadyClock::now() - start_).count(); }

  /// After a level of a refinement: whether the next one is expected to end within the time allowed. A level
  /// cannot be stopped while its Newton matrix is factorized. The first motion is sought in any case.
  bool next_level_fits(const solvers::Progress& progress) {
    if (progress.phase != "refinement" || guides_.empty()) return true;
    const double now = elapsed(), seconds = now - std::exchange(level_began_, now);
    const double growth = seconds / std::exchange(level_seconds_, std::max(seconds, 1e-9));
    const bool is_last = progress.value <= tolerance_;
    return is_last || now + std::clamp(growth, least_growth, largest_growth) * seconds < allowed_;
  }

  static Reference missing_reference(const std::string& status) {
    Reference without;
    without.status = status;
    without.text = "none";
    return without;
  }

  /// A reference near the motion of a coarse balance.
  std::optional<Reference> beside_guide() {
    if (!add_guide(balance(1e-2))) return std::nullopt;
    if (guides_.back().estimated_error > 1e-3) add_guide(balance(1e-3, phases_share));
    const std::size_t coarse = guides_.size() - 1;
    std::optional<Reference> found = phases();
    if (found) return found;
    found = rigid_flows();
    if (!found) found = finer_balance();
    // Beyond a few contacts a count of multipliers takes longer than the solution.
    constexpr int few = 6;
    if (scene_.analysis.stability && !interrupted_) {
      Guide& counted = guides_[model_.contacts() <= few ? coarse : 0];
      found->stability = counted.problem.stability(counted.response);
    }
    found->without_phases = without_phases_;
    return found;
  }

  /// The response without contact, where it keeps away from every obstacle.
  std::optional<Reference> linear() {
    if (!model_.structure.forces.empty()) return std::nullopt;  // of other harmonics, too
    if (model_.structure.is_free()) return std::nullopt;        // its position follows from contact
    const Scene three = discretised(scene_, {"fourier", "fourier"}, 3, 8);
    const solvers::CondensedProblem problem = make_problem(three, model_);
    const Eigen::MatrixXd samples = solvers::by_contact(problem.contact_free_response(), model_.contacts());
    // A cosine of 8 samples: its amplitude is that of its rms.
    const Eigen::VectorXd amplitude = std::sqrt(2.0 / 8.0) * samples.rowwise().norm();
    const bool open = scene_.contact.law == no_law || ((amplitude.array() < model_.gaps.array()).all() &&
                                                       make_laws(scene_).force(-amplitude).isZero(0.0));
    if (!open) return std::nullopt;
    ResponseOptions options;
    options.stability = scene_.analysis.stability;
    const Response response = weighted_residual_response(three, model_, options);
    if (!response.converged) return std::nullopt;
    constexpr double rounding = 1e-14;
    Reference reference = found_reference("linear", "the exact linear solution, since contact never closes",
                                          std::max(rounding, response.rounding_error), response.contacts);
    if (response.stability) reference.stability = *response.stability;
    return reference;
  }

  /// The balance with Fourier functions to a tolerance, within a share of the time allowed.
  std::optional<Guide> balance(double tolerance, double share = 1.0) {
    allowed_ = share * seconds_;
    tolerance_ = tolerance;
    level_began_ = elapsed();
    level_seconds_ = std::numeric_limits<double>::infinity();  // the first level takes next to no time
    return refined_guide(scene_, model_, tolerance, observer_);
  }

  /// Whether there is one.
  bool add_guide(std::optional<Guide> found) {
    if (found) guides_.push_back(std::move(*found));
    return found.has_value();
  }

  /// Whether a motion is that of the balances and not another one.
  bool is_of_guide(const solvers::Motion& motion) const {
    const double near = std::max(0.02, 10.0 * guides_.back().estimated_error);
    return displacement_error(motion, guides_.back().contacts) < near;
  }

  /// From the guide, or from a finer one where no motion is found near the first.
  std::optional<Reference> phases() {
    without_phases_ = phases_refusal(model_);
    if (!without_phases_.empty()) return std::nullopt;
    const std::string too_coarse = phrase_of(solvers::PhasesStatus::no_motion_near);
    while (!interrupted_) {
      allowed_ = phases_share * seconds_;
      PhaseReference found = phase_reference(guides_.back(), observer_);
      const bool known = found.missing_because.empty();
      if (known && is_of_guide(found.contacts)) return by_phases(std::move(found));
      without_phases_ = known ? too_coarse : found.missing_because;
      const bool may_be_finer = guides_.back().estimated_error > finest_guide;
      if (without_phases_ != too_coarse || !may_be_finer) break;
      if (!add_guide(balance(finest_guide, phases_share))) break;
    }
    return std::nullopt;
  }

  Reference by_phases(PhaseReference found) {
    Reference reference = found_reference("phases", "contact phases", found.error, std::move(found.contacts));
    reference.force_error = found.force_error;
    Guide& guide = guides_.back();
    if (scene_.analysis.stability)
      reference.stability = guide.problem.stability(guide.response, &found.motion);
    return reference;
  }

  std::optional<Reference> rigid_flows() {
    if (interrupted_ || !is_rigid(scene_.contact.law) || scene_.structure.type != StructureType::bar ||
        model_.size() > largest_flow)
      return std::nullopt;
    try {
      Reference reference = rigid_flows_reference(scene_, model_, scene_.analysis.output_points);
      if (!reference.converged || !is_of_guide(reference.motion)) return std::nullopt;
      return reference;
    } catch (const std::invalid_argument&) {
      return std::nullopt;  // a tip that is not damped
    }
  }

  Reference finer_balance() {
    for (double tolerance = 1e-3; tolerance > 5e-9 && !interrupted_; tolerance /= 10.0) {
      if (guides_.back().estimated_error <= tolerance) continue;
      std::optional<Guide> finer = balance(tolerance);
      if (!finer || !is_of_guide(finer->contacts)) break;
      guides_.push_back(std::move(*finer));
    }
    const Guide& last = guides_.back();
    Reference reference =
        found_reference("finer_balance",
                        "the balance with " + std::to_string(last.functions) + " Fourier functions and " +
                            std::to_string(last.points) + " points",
                        last.estimated_error, last.contacts);
    if (guides_.size() > 1)
      reference.force_error = force_error(guides_[guides_.size() - 2].contacts, last.contacts);
    return reference;
  }

  static constexpr double least_growth = 2.0, largest_growth = 8.0;  // of the times of two levels
  static constexpr int largest_flow = 64;            // matrix exponentials and products of twice as many rows
  static constexpr double phases_share = 1.0 / 3.0;  // of the time
  static constexpr double finest_guide = 1e-4;       // from which the phases are sought

  Scene scene_;
  const StructureModel& model_;
  double seconds_;
  double allowed_ = 0.0;
  double tolerance_ = 0.0, level_began_ = 0.0, level_seconds_ = 0.0;  // of the refinement under way
  bool interrupted_ = false;
  SteadyClock::time_point start_ = SteadyClock::now();
  solvers::Observer observer_;
  std::vector<Guide> guides_;  // of falling errors
  std::string without_phases_;
};

}  // namespace

Reference find_reference(const Scene& scene, const StructureModel& model, int points, double seconds,
                         const solvers::Observer& observer) {
  return ReferenceSearch(scene, model, points, seconds, observer).find();
}

Reference rigid_flows_reference(const Scene& scene, const StructureModel& model, int points) {
  const auto at = [&](int samples) {
    return solvers::rigid_reference(model.structure, scene.contact.gap, scene.forcing.frequency, samples);
  };
  const auto found = at(points), fine = at(2 * points);
  const auto same = Eigen::seqN(0, points, 2);
  const Eigen::VectorXd displacement = fine.displacement(same), force = fine.contact_force(same);
  solvers::Motion motion;
  motion.displacement = found.displacement.transpose();
  motion.force = found.contact_force.transpose();
  Reference reference =
      found_reference("rigid_flows", "two linear motions joined where the contact opens and closes",
                      relative_rms_error(displacement, found.displacement), std::move(motion));
  reference.force_error = relative_rms_error(force, found.contact_force);
  reference.converged = found.converged && fine.converged;
  if (!reference.converged) reference.status = "iteration_limit";
  return reference;
}

}  // namespace wavebalance::app
