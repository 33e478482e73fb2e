#include "wavebalance/app/compare/solve_point.hpp"

#include "compare/exact_reference.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

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
                  const solvers::Observer& observer, const StartMotion& start)
      : scene_(scene),
        model_(model),
        start_motion_(start),
        seconds_(seconds),
        observer_([this, &observer](const solvers::Progress& progress) {
          interrupted_ = interrupted_ || !goes_on(observer, {"reference"});
          return !interrupted_ && clock_.seconds() < allowed_ && next_level_fits(progress);
        }) {
    scene_.analysis.output_points = points;
    scene_.time.sample_offset = 0.0;  // the levels of a refinement share their points at the left ends
  }

  Reference find() {
    Reference reference;
    try {
      std::optional<Reference> found;
      if (start_motion_.contacts.empty()) {
        found = linear();
        if (!found) found = beside_guide();
      } else {
        found = beside_start();
      }
      reference =
          found ? std::move(*found) : missing_reference(interrupted_ ? "interrupted" : "no_reference");
      if (reference.converged && reference.kind != "linear" && start_motion_.contacts.empty())
        reference.reached_directly = starts_directly();
    } catch (const solvers::SingularSystem&) {
      reference = missing_reference("singular");
    }
    reference.wall_seconds = clock_.seconds();
    return reference;
  }

 private:
  /// After a level of a refinement: whether the next one is expected to end within the time allowed. A
  /// level cannot be stopped while its Newton matrix is factorized. The first motion is computed in any
  /// case.
  bool next_level_fits(const solvers::Progress& progress) {
    if (progress.phase != "refinement" || tolerance_ >= coarse_guide) return true;
    const double now = clock_.seconds(), seconds = now - std::exchange(level_began_, now);
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
    std::optional<Reference> found = rigid_intervals();
    if (found) return found;
    if (!add_guide(balance(coarse_guide))) return std::nullopt;
    const std::size_t first = guides_.size() - 1;
    if (guides_.back().estimated_error > fine_guide && !is_rigid(scene_.contact.law)) add_finer_guide();
    const std::size_t coarse = guides_.size() - 1;
    found = exact();
    if (found) return found;
    refine_balance();
    return by_balance(guides_[model_.contacts() <= few_contacts ? coarse : first]);
  }

  /// Whether Newton's method from the response without contact finds a balance with few functions.
  bool starts_directly() try {
    constexpr int few_functions = 7;
    allowed_ = std::numeric_limits<double>::infinity();
    const auto few = sized_guide(scene_, model_, few_functions, observer_);
    return few && few->response.strategy == solvers::Strategy::newton;
  } catch (const solvers::SingularSystem&) {
    return false;  // only with few functions, because the reference is known
  }

  /// A reference near the start.
  std::optional<Reference> beside_start() {
    std::optional<Reference> found = exact_of_sizes(start_sizes);
    if (found || guides_.size() < 2) return found;
    if (without_exact_.empty()) without_exact_ = exact_refusal(model_);
    return by_balance(guides_[model_.contacts() <= few_contacts ? guides_.size() - 1 : 0]);
  }

  /// The response without contact, where it keeps away from every obstacle.
  std::optional<Reference> linear() {
    if (!model_.structure.forces.empty()) return std::nullopt;  // of other harmonics, too
    if (model_.structure.is_free()) return std::nullopt;        // its position follows from contact
    const Scene three = discretised(scene_, {"fourier", "fourier"}, 3, 8);
    const solvers::CondensedProblem problem = make_problem(three, model_);
    const Eigen::MatrixXd samples = solvers::by_contact(problem.linear_response(), model_.contacts());
    // A cosine of 8 samples: its amplitude follows from its rms.
    const Eigen::VectorXd amplitude = std::sqrt(2.0 / 8.0) * samples.rowwise().norm();
    const bool open = scene_.contact.law == no_law || ((amplitude.array() < model_.gaps.array()).all() &&
                                                       make_laws(scene_).force(-amplitude).isZero(0.0));
    if (!open) return std::nullopt;
    ResponseOptions options;
    options.stability = scene_.analysis.stability;
    const Response response = weighted_residual_response(three, model_, options);
    if (!response.converged) return std::nullopt;
    constexpr double rounding = 1e-14;
    Reference reference = found_reference("linear", "the exact linear response, because no contact closes",
                                          std::max(rounding, response.rounding_error), response.contacts);
    if (response.stability) reference.stability = *response.stability;
    return reference;
  }

  /// The balance with Fourier functions to a tolerance, within a share of the time allowed.
  std::optional<Guide> balance(double tolerance, double share = 1.0) {
    allowed_ = share * seconds_;
    tolerance_ = tolerance;
    level_began_ = clock_.seconds();
    level_seconds_ = std::numeric_limits<double>::infinity();  // the first level needs hardly any time
    return refined_guide(scene_, model_, tolerance, observer_);
  }

  /// Whether there is one.
  bool add_guide(std::optional<Guide> found) {
    if (found) guides_.push_back(std::move(*found));
    return found.has_value();
  }

  /// Whether a motion agrees with the balances and is not another one.
  bool is_of_guide(const solvers::Motion& motion) const {
    const double near = std::clamp(10.0 * guides_.back().estimated_error, 0.02, 0.1);
    return displacement_error(motion, guides_.back().contacts) < near;
  }

  /// With rigid contact, from few functions: the force oscillates in finer balances, which then seem to
  /// have many contact intervals.
  std::optional<Reference> rigid_intervals() {
    if (!is_rigid(scene_.contact.law) || !exact_refusal(model_).empty()) return std::nullopt;
    return exact_of_sizes(rigid_sizes);
  }

  /// From balances with so many functions each; the error of each is its distance from the one before.
  std::optional<Reference> exact_of_sizes(std::span<const int> sizes) {
    allowed_ = exact_share * seconds_;
    for (const int functions : sizes) {
      std::optional<Guide> guide = sized_guide(scene_, model_, functions, observer_, start_motion_);
      if (!guide) continue;
      if (!guides_.empty())
        guide->estimated_error = displacement_error(guides_.back().contacts, guide->contacts);
      guides_.push_back(std::move(*guide));
    }
    const std::size_t starts = guides_.size();
    refused_ = !exact_refusal(model_).empty();
    std::optional<Reference> found;
    for (std::size_t i = 0; i < starts && starts > 1 && !found && !refused_ && !interrupted_; ++i)
      found = exact_from(guides_[i], 1.0 / static_cast<double>(sizes.size()));
    return found;
  }

  /// From the guide, and from finer ones where no motion is found near it.
  std::optional<Reference> exact() {
    if (!refused_) without_exact_ = exact_refusal(model_);
    refused_ = refused_ || !without_exact_.empty();
    std::optional<Reference> found;
    for (bool more = !refused_; more && !interrupted_; more = !found && !refused_ && add_finer_guide())
      found = exact_from(guides_.back(), 1.0);
    return found;
  }

  /// In a part of the time that is left for them.
  std::optional<Reference> exact_from(Guide& start, double part) {
    allowed_ = clock_.seconds() + part * std::max(0.0, exact_share * seconds_ - clock_.seconds());
    ExactReference found = exact_reference(start, observer_);
    const bool known = found.missing_because.empty();
    if (known && is_of_guide(found.contacts)) return by_exact(std::move(found), start);
    without_exact_ = known ? phrase_of(solvers::ExactStatus::not_found) : found.missing_because;
    refused_ = found.refused;
    return std::nullopt;
  }

  bool add_finer_guide() {
    const double error = guides_.back().estimated_error;
    return error > finest_guide &&
           add_guide(balance(error > fine_guide ? fine_guide : finest_guide, exact_share));
  }

  Reference by_exact(ExactReference found, Guide& guide) {
    Reference reference =
        found_reference("phases", "the exact periodic solution", found.error, std::move(found.contacts));
    reference.force_error = found.force_error;
    if (scene_.analysis.stability)
      reference.stability = guide.problem.stability(guide.response, &found.motion);
    return reference;
  }

  void refine_balance() {
    for (double tolerance = 1e-3; tolerance > 5e-9 && !interrupted_; tolerance /= 10.0) {
      if (guides_.back().estimated_error <= tolerance) continue;
      std::optional<Guide> finer = balance(tolerance);
      if (!finer || !is_of_guide(finer->contacts)) break;
      guides_.push_back(std::move(*finer));
    }
  }

  /// The finest balance, whose stability is only a guide. With many contacts a count of multipliers needs
  /// longer than the solution.
  Reference by_balance(Guide& counted) {
    const Guide& last = guides_.back();
    Reference reference = found_reference("finer_balance",
                                          "harmonic balance with " + std::to_string(last.functions) +
                                              " functions and " + std::to_string(last.points) + " points",
                                          last.estimated_error, last.contacts);
    if (guides_.size() > 1)
      reference.force_error = force_error(guides_[guides_.size() - 2].contacts, last.contacts);
    if (scene_.analysis.stability && !interrupted_)
      reference.stability = counted.problem.stability(counted.response);
    reference.without_exact = without_exact_;
    return reference;
  }

  static constexpr double least_growth = 2.0, largest_growth = 8.0;  // of the times of two levels
  static constexpr double exact_share = 1.0 / 3.0;                   // of the time
  // Errors of the balances used as starts of exact solutions, and sizes of the balances before them.
  static constexpr double coarse_guide = 1e-2, fine_guide = 1e-3, finest_guide = 1e-4;
  static constexpr std::array rigid_sizes{15, 31, 63};
  static constexpr std::array start_sizes{31, 63, 127, 255};
  static constexpr int few_contacts = 6;

  Scene scene_;
  const StructureModel& model_;
  const StartMotion& start_motion_;
  double seconds_;
  double allowed_ = 0.0;
  double tolerance_ = 0.0, level_began_ = 0.0, level_seconds_ = 0.0;  // of the refinement under way
  bool interrupted_ = false;
  WallClock clock_;
  solvers::Observer observer_;
  std::vector<Guide> guides_;  // of falling errors
  std::string without_exact_;
  bool refused_ = false;  // exact solutions, wherever they start
};

}  // namespace

Reference find_reference(const Scene& scene, const StructureModel& model, int points, double seconds,
                         const solvers::Observer& observer, const StartMotion& start) {
  return ReferenceSearch(scene, model, points, seconds, observer, start).find();
}

}  // namespace wavebalance::app
