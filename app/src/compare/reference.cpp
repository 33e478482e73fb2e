#include "wavebalance/app/compare/reference.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compare/size_study.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/period/rigid_reference.hpp"
#include "wavebalance/solvers/period/shooting.hpp"

namespace wavebalance::app {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr double shooting_error = 1e-11;  // of the tolerances on which shooting and its steps end

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

ResponseStability stability_of(const Eigen::VectorXcd& multipliers) {
  ResponseStability stability;
  stability.unstable = static_cast<int>((multipliers.array().abs() > 1.0).count());
  stability.status = stability.unstable > 0 ? "unstable" : "stable";
  if (multipliers.size() > 0)
    stability.leading = {multipliers[0].real(), std::abs(multipliers[0].imag())};  // by falling modulus
  return stability;
}

/// Errors of the state grow by 1 / (1 - mu) from one period to the motion.
double error_of_shot(const solvers::ShootingResult& shot) {
  const double nearest = (1.0 - shot.floquet_multipliers.array()).abs().minCoeff();
  return std::max(shooting_error, shot.residual / nearest);
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
    if (progress.phase != "refinement" || !guide_) return true;
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

  /// A reference that is the motion of a coarse balance, the guide, where there is one.
  std::optional<Reference> beside_guide() {
    constexpr int few = 6;  // contacts, beyond which a count of multipliers takes longer than the solution
    const bool with_stability = model_.contacts() <= few;
    guide_ = balance(1e-2, with_stability);
    if (guide_ && guide_->refinement->estimated_error > 1e-3)
      if (auto finer = balance(1e-3, with_stability)) guide_ = std::move(finer);
    std::optional<Reference> found = shooting();
    if (!found) found = rigid_flows();
    if (!found) found = finer_balance();
    if (found && !with_stability) count_multipliers(*found);
    return found;
  }

  /// Those of the coarsest balance, after all others have had their time.
  void count_multipliers(Reference& reference) {
    const double seconds = std::exchange(seconds_, elapsed() + 0.5 * seconds_);
    if (const auto coarse = balance(1e-2, true); coarse && coarse->stability)
      reference.stability = *coarse->stability;
    seconds_ = seconds;
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

  /// The balance with Fourier functions to a tolerance, within the time allowed.
  std::optional<Response> balance(double tolerance, bool with_stability) {
    allowed_ = seconds_;
    tolerance_ = tolerance;
    level_began_ = elapsed();
    level_seconds_ = std::numeric_limits<double>::infinity();  // the first level takes next to no time
    Scene refined = discretised(scene_, {"fourier", "fourier"}, 0, 0);
    refined.time.tolerance = tolerance;
    ResponseOptions options;
    options.observer = observer_;
    options.stability = scene_.analysis.stability && with_stability;
    options.structure_points = model_.size() <= largest_dense ? scene_.analysis.output_points : 0;
    Response response = weighted_residual_response(refined, model_, options);
    if (!response.converged) return std::nullopt;
    return response;
  }

  /// Whether a motion is that of the balances and not another one.
  bool is_of_guide(const solvers::Motion& motion) const {
    if (!guide_) return true;
    const double near = std::max(0.02, 10.0 * guide_->refinement->estimated_error);
    return displacement_error(motion, guide_->contacts) < near;
  }

  solvers::ShootingResult shot() {
    solvers::ShootingOptions options;
    options.output_points = scene_.analysis.output_points;
    options.observer = observer_;
    if (guide_) {
      options.settling_periods = 0;
      options.initial_displacement = guide_->structure.displacement.col(0);
      options.initial_velocity = guide_->structure.velocity.col(0);
    }
    allowed_ = seconds_;
    return solvers::shoot(model_.structure, make_law(scene_.contact), scene_.forcing.frequency, options);
  }

  std::optional<Reference> shooting() {
    if (interrupted_ || model_.contacts() != 1 || is_rigid(scene_.contact.law) ||
        model_.size() > largest_dense)
      return std::nullopt;
    try {
      solvers::ShootingResult found = shot();
      if (found.status != solvers::ShootingStatus::converged || !is_of_guide(found.contacts))
        return std::nullopt;
      Reference reference =
          found_reference("shooting", "shooting", error_of_shot(found), std::move(found.contacts));
      reference.stability = stability_of(found.floquet_multipliers);
      return reference;
    } catch (const std::invalid_argument&) {
      return std::nullopt;  // a structure that shooting does not take
    }
  }

  std::optional<Reference> rigid_flows() {
    if (interrupted_ || !is_rigid(scene_.contact.law) || scene_.structure.type != StructureType::bar ||
        model_.size() > largest_flow)
      return std::nullopt;
    try {
      Reference reference = rigid_flows_reference(scene_, model_, scene_.analysis.output_points);
      if (!reference.converged || !is_of_guide(reference.motion)) return std::nullopt;
      if (guide_ && guide_->stability) reference.stability = *guide_->stability;
      return reference;
    } catch (const std::invalid_argument&) {
      return std::nullopt;  // a tip that is not damped
    }
  }

  std::optional<Reference> finer_balance() {
    if (!guide_) return std::nullopt;
    for (double tolerance = 1e-4; tolerance > 5e-9 && !interrupted_; tolerance /= 10.0) {
      if (guide_->refinement->estimated_error <= tolerance) continue;
      auto finer = balance(tolerance, false);
      if (!finer || !is_of_guide(finer->contacts)) break;
      finer->stability = guide_->stability;
      guide_ = std::move(finer);
    }
    const auto& last = guide_->refinement->levels.back();
    Reference reference =
        found_reference("finer_balance",
                        "the balance with " + std::to_string(last.functions) + " Fourier functions and " +
                            std::to_string(last.points) + " points",
                        guide_->refinement->estimated_error, guide_->contacts);
    if (guide_->stability) reference.stability = *guide_->stability;
    return reference;
  }

  static constexpr double least_growth = 2.0, largest_growth = 8.0;  // of the times of two levels
  static constexpr int largest_dense = 400;  // degrees of freedom: shooting takes seconds beyond
  static constexpr int largest_flow = 64;    // matrix exponentials and products of twice as many rows

  Scene scene_;
  const StructureModel& model_;
  double seconds_;
  double allowed_ = 0.0;
  double tolerance_ = 0.0, level_began_ = 0.0, level_seconds_ = 0.0;  // of the refinement under way
  bool interrupted_ = false;
  SteadyClock::time_point start_ = SteadyClock::now();
  solvers::Observer observer_;
  std::optional<Response> guide_;
};

}  // namespace

Reference find_reference(const Scene& scene, const StructureModel& model, int points, double seconds,
                         const solvers::Observer& observer) {
  return ReferenceSearch(scene, model, points, seconds, observer).find();
}

Reference shooting_reference(const Scene& scene) {
  const Response response = shooting_response(scene);
  Reference reference = found_reference("shooting", "shooting", shooting_error, response.contacts);
  reference.converged = response.converged;
  reference.status = response.status;
  return reference;
}

Reference rigid_flows_reference(const Scene& scene, const StructureModel& model, int points) {
  const auto at = [&](int samples) {
    return solvers::rigid_reference(model.structure, scene.contact.gap, scene.forcing.frequency, samples);
  };
  const auto found = at(points), fine = at(2 * points);
  const Eigen::VectorXd same = fine.displacement(Eigen::seqN(0, points, 2));
  solvers::Motion motion;
  motion.displacement = found.displacement.transpose();
  motion.force = found.contact_force.transpose();
  Reference reference =
      found_reference("rigid_flows", "two linear motions joined where the contact opens and closes",
                      relative_rms_error(same, found.displacement), std::move(motion));
  reference.converged = found.converged && fine.converged;
  if (!reference.converged) reference.status = "iteration_limit";
  return reference;
}

}  // namespace wavebalance::app
