#include "wavebalance/solvers/problem/contact_problem.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "balance/free_contacts.hpp"
#include "wavebalance/solvers/balance/contact_form.hpp"
#include "wavebalance/solvers/branches/subharmonic_response.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"
#include "wavebalance/solvers/response/curve_responses.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
#include "wavebalance/solvers/stability/slip_points.hpp"
#include "wavebalance/solvers/structure/contact_mass.hpp"

namespace wavebalance::solvers {
namespace {

// One period of the load in harmonic `periods`.
CondensedProblem with_cosine(TimePair pair, const LinearStructure& structure, int periods) {
  Eigen::VectorXcd cosine = Eigen::VectorXcd::Zero(std::max(periods, 1) + 1);
  cosine[std::max(periods, 1)] = 1.0;
  CondensedProblem problem(std::move(pair), structure, std::move(cosine));
  problem.set_periods(periods);
  return problem;
}

// The same options, and whether their observer stops the work.
ForcedResponseOptions watched(ForcedResponseOptions options, bool& cancelled) {
  options.observer = [&cancelled, observer = std::move(options.observer)](const Progress& progress) {
    cancelled = cancelled || !goes_on(observer, progress);
    return !cancelled;
  };
  return options;
}

// The last period of an integration, at so many points as a start needs.
Motion start_of(const AttractorMotion& settled, int contacts) {
  constexpr int points = 1024;
  const auto samples = [&](const Eigen::MatrixXd& values) {
    return by_contact(resample(values, points, settled.start), contacts);
  };
  return {samples(settled.last.displacement), {}, samples(settled.last.force)};
}

}  // namespace

ContactProblem::ContactProblem(TimePair pair, const LinearStructure& structure, ContactLaws laws, int periods)
    : ContactProblem(with_cosine(std::move(pair), structure, periods), std::move(laws)) {}

ContactProblem::ContactProblem(CondensedProblem problem, ContactLaws laws,
                               std::shared_ptr<StructureDynamics> dynamics)
    : condensed_(std::move(problem)), laws_(std::move(laws)), dynamics_(std::move(dynamics)) {
  if (structure().turns()) dynamics_ = std::make_shared<StructureDynamics>();  // others turn at other speeds
  require_well_posed();
}

void ContactProblem::require_well_posed() const {
  laws_.require(contacts());
  for (int row = 0; row < contacts(); row += laws_[row].rows())  // friction without mass may be added
    if (laws_[row].is_rigid() && !laws_[row].friction() && !laws_[row].restitution())
      return require_massless_rigid_contacts(structure(), laws_);
}

bool need_events(const ContactLaws& laws, const LinearStructure& structure) {
  if (laws.have_impacts()) return true;
  if (!laws.act_over_period()) return false;
  const int contacts = static_cast<int>(structure.contacts());
  for (int row = 0; row < contacts; row += laws[row].rows())
    if (const auto friction = laws[row].friction(); friction && friction->needs_states) return true;
  return !laws.have_finite_force() && !contacts_are_massless(structure, laws.rigid(contacts));
}

bool ContactProblem::moves_by_events() const {
  if (need_events(laws_, structure())) return true;
  return laws_.act_over_period() && dynamics() != nullptr && dynamics()->holding() > 0.0;
}

ExactAttractor ContactProblem::exact_attractor(double frequency, const TimeSteppingOptions& stepping,
                                               const CollocationOptions& options) {
  return attractor_motion(exact_problem(frequency), stepping, options);
}

void ContactProblem::set_laws(ContactLaws laws) {
  laws_ = std::move(laws);
  require_well_posed();
}

ContactProblem ContactProblem::over_periods(int times) const {
  CondensedProblem longer(pair(), structure(), solvers::over_periods(condensed_.load_harmonics(), times));
  longer.set_threads(condensed_.threads());
  longer.set_periods(times * condensed_.periods());
  longer.set_load_unit(condensed_.full_load(), condensed_.load_unit());
  return {std::move(longer), laws_, dynamics_};
}

void ContactProblem::hold(const PeriodicResponse& response) {
  condensed_.set_load_scale(response.load_scale);
  condensed_.set_frequency(response.frequency);
}

void ContactProblem::hold(const FrequencySweep& curve) {
  if (!curve.points.empty()) condensed_.set_load_scale(curve.points.front().load_scale);
}

void ContactProblem::load_fully(double frequency) {
  condensed_.set_load_scale(condensed_.full_load());
  condensed_.set_load_frequency(frequency);
}

PeriodicResponse ContactProblem::respond(double frequency, const ForcedResponseOptions& options,
                                         const ResponseStart& start) {
  load_fully(frequency);
  PeriodicResponse response;
  if (condensed_.periods() == 1) {
    response = forced_response(condensed_, laws_, options, start.displacement, start.force);
  } else {
    SubharmonicOptions several;
    several.response = options;
    several.floquet.stability = stability_options(condensed_);
    response = subharmonic_response(condensed_, laws_, dynamics(), several, start.displacement);
  }
  if (response.converged() && response.rounding_error > largest_rounding_error)
    response.status = SolveStatus::inaccurate;
  return response;
}

Motion ContactProblem::motion(const PeriodicResponse& response, int points) {
  hold(response);
  return contact_motion(condensed_, response, laws_, points);
}

Motion ContactProblem::structure_motion(const PeriodicResponse& response, int points) {
  hold(response);
  return solvers::structure_motion(condensed_, response, points);
}

ExactProblem ContactProblem::exact_problem_here() {
  if (dynamics() == nullptr)
    throw std::invalid_argument(
        "exact motions are solved for by the modes of the structure, and it has none to compute");
  if (!free_contacts_)
    free_contacts_ = std::make_shared<detail::FreeContacts>(structure(), condensed_.load_harmonics(),
                                                            dynamics()->holding());
  ExactProblem problem{*dynamics(), laws_.at(condensed_.load_frequency()),
                       free_contacts_->at(condensed_.frequency(), condensed_.load_factor()),
                       condensed_.frequency()};
  if (structure().turns()) problem.kept = dynamics_->of(structure());
  return problem;
}

std::optional<ExactNearResponse> ContactProblem::exact_near(const PeriodicResponse& response,
                                                            const CollocationOptions& options) {
  if (!dynamics()) return std::nullopt;
  hold(response);
  return exact_near_response(condensed_, response, exact_problem_here(), options, exact_motion);
}

std::optional<ExactSolution> ContactProblem::exact_near(double frequency, const AttractorMotion& settled,
                                                        const CollocationOptions& options) {
  if (!settled.integrated()) return std::nullopt;
  return exact_near(frequency, start_of(settled, contacts()), options);
}

std::optional<ExactSolution> ContactProblem::exact_near(double frequency, const Motion& start,
                                                        const CollocationOptions& options) {
  if (!dynamics()) return std::nullopt;
  return exact_motion(exact_problem(frequency), start.displacement, options, start.force);
}

ExactStructureMotion ContactProblem::structure_motion(double frequency, const ExactSolution& motion,
                                                      int points, const ExactStructureOptions& options) {
  load_fully(frequency);
  return exact_structure_motion(condensed_, motion, points, options);
}

MotionStability ContactProblem::stability(double frequency, const ExactSolution& motion) {
  if (!dynamics()) return {};
  if (!motion.converged()) {
    MotionStability unknown;
    unknown.status = to_string(motion.status);
    return unknown;
  }
  load_fully(frequency);
  return motion_stability(condensed_, laws_, {}, *dynamics(), &motion);
}

MotionStability ContactProblem::stability(const PeriodicResponse& response, const ExactSolution* motion) {
  if (!dynamics()) return {};
  hold(response);
  return motion_stability(condensed_, laws_, response, *dynamics(), motion);
}

FloquetExponents ContactProblem::exponents(const PeriodicResponse& response, int most) {
  if (!dynamics()) return {};
  hold(response);
  FloquetOptions options;
  options.stability = stability_options(condensed_);
  options.max_exponents = most;
  return floquet_exponents(*dynamics(), condensed_, laws_, response, options);
}

FrequencySweep ContactProblem::sweep(const FrequencySweepOptions& options) {
  condensed_.set_load_scale(condensed_.full_load());
  return frequency_sweep(condensed_, laws_, options);
}

FrequencySweep ContactProblem::sweep(const FrequencySweepOptions& options, const PeriodicResponse& first) {
  hold(first);
  return frequency_sweep(condensed_, laws_, options, {first, {}, {}});
}

FrequencySweep ContactProblem::amplitude_sweep(double frequency, const FrequencySweepOptions& options) {
  condensed_.set_load_frequency(frequency);
  return solvers::amplitude_sweep(condensed_, laws_, options);
}

std::pair<FrequencySweep, PeriodicResponse> ContactProblem::amplitude_sweep(
    double frequency, const FrequencySweepOptions& options, const ResponseStart& start) {
  condensed_.set_load_frequency(frequency);
  condensed_.set_load_scale(options.from);
  PeriodicResponse first = forced_response(condensed_, laws_, options.start, start.displacement, start.force);
  FrequencySweep curve = solvers::amplitude_sweep(condensed_, laws_, options, {first, {}, {}});
  return {std::move(curve), std::move(first)};
}

ExactSolution ContactProblem::motion_here(const ExactCurveOptions& options, const ForcedResponseOptions& how,
                                          const ResponseStart& start) {
  // The curve is of motions of one period.
  if (laws_.have_impacts_alone(contacts()) && dynamics()->holding() == 0.0) {
    ImpactResponse found = impact_response(exact_problem_here(), {.observer = how.observer});
    return !found.lasts() || found.load_periods == 1 ? std::move(found.motion) : ExactSolution();
  }
  if (moves_by_events()) {
    TimeSteppingOptions stepping;
    stepping.observer = how.observer;
    ExactAttractor found = attractor_motion(exact_problem_here(), stepping, options.exact);
    return found.load_periods == 1 ? std::move(found.motion) : ExactSolution();
  }
  const PeriodicResponse response = forced_response(condensed_, laws_, how, start.displacement, start.force);
  if (response.status == SolveStatus::cancelled) return {};
  if (response.converged()) {
    // If no exact solution is found from a balance, it often is from the attractor, and its curves are
    // faster than curves of the flow.
    ExactNearResponse found = exact_near_response(condensed_, response, exact_problem_here(), options.exact,
                                                  laws_.act_over_period() ? flow_motion : collocation_motion);
    if (found.motion.parts != nullptr) return found.motion;
  }
  AttractorOptions settling;
  settling.observer = how.observer;
  const AttractorMotion settled = solvers::settle(condensed_, laws_, settling);
  if (!settled.integrated()) return {};
  const Motion last = start_of(settled, contacts());
  return exact_motion(exact_problem_here(), last.displacement, options.exact, last.force);
}

ExactCurve ContactProblem::exact_curve_here(SweepParameter parameter, const ExactCurveOptions& options,
                                            const ForcedResponseOptions& how, const ResponseStart& start) {
  bool cancelled = false;
  const ExactSolution first = motion_here(options, watched(how, cancelled), start);
  if (first.parts != nullptr) return exact_curve({condensed_, laws_, *dynamics(), parameter}, first, options);
  ExactCurve none;
  none.status = cancelled ? SweepStatus::cancelled : SweepStatus::no_start;
  none.start = first.status;
  return none;
}

ExactCurve ContactProblem::exact_sweep(const ExactCurveOptions& options, const ForcedResponseOptions& how,
                                       const ResponseStart& start) {
  options.validate();
  if (!dynamics()) return {};
  load_fully(options.from);
  return exact_curve_here(SweepParameter::frequency, options, how, start);
}

ExactCurve ContactProblem::exact_amplitude_sweep(double frequency, const ExactCurveOptions& options,
                                                 const ForcedResponseOptions& how,
                                                 const ResponseStart& start) {
  options.validate();
  if (!dynamics()) return {};
  condensed_.set_load_frequency(frequency);
  condensed_.set_load_scale(options.from);
  return exact_curve_here(SweepParameter::load_scale, options, how, start);
}

std::vector<ExactCurve> ContactProblem::doubled_curves(const ExactCurve& curve, SweepParameter parameter,
                                                       double frequency, const ExactCurveOptions& options) {
  load_fully(frequency);
  const ProblemFamily family(condensed_, laws_, *dynamics(), parameter);
  std::vector<ExactCurve> doubled;
  for (const ExactEvent& event : curve.events)
    if (event.type == SpecialPointType::period_doubling)
      doubled.push_back(doubled_curve(family, event, options));
  return doubled;
}

ExactCurve ContactProblem::exact_curve_from(double frequency, const ExactSolution& motion,
                                            const ExactCurveOptions& options) {
  if (!dynamics()) return {};
  load_fully(frequency);
  return exact_curve_through({condensed_, laws_, *dynamics(), SweepParameter::frequency}, frequency, motion,
                             options);
}

CurveStability ContactProblem::stability(const FrequencySweep& curve, int output_points,
                                         const Observer& observer, bool special_points) {
  if (!dynamics() || curve.points.empty()) return {};
  CurveStabilityOptions options;
  constexpr int most_states_with_friction = 120;  // beyond, a point needs seconds
  options.stability = stability_options(condensed_);
  options.stability.max_states_with_friction = most_states_with_friction;
  options.special_points = special_points;
  options.output_points = output_points;
  options.observer = observer;
  hold(curve);
  CurveStability stability = curve_stability(condensed_, laws_, curve, *dynamics(), options);
  if (!stability.cancelled && special_points) add_slip_points(curve, output_points, stability);
  return stability;
}

// In the order of the curve; what else happens between the same neighbours comes after the first slip.
void ContactProblem::add_slip_points(const FrequencySweep& curve, int output_points,
                                     CurveStability& stability) {
  hold(curve);
  for (SpecialPoint& point : slip_points(condensed_, laws_, curve, output_points)) {
    const auto after =
        std::find_if(stability.special_points.begin(), stability.special_points.end(),
                     [&](const SpecialPoint& other) { return other.next_point >= point.next_point; });
    stability.special_points.insert(after, std::move(point));
  }
}

std::vector<Branch> ContactProblem::branches(const FrequencySweep& curve, const CurveStability& stability,
                                             const PairOfPeriods& pairs, BranchOptions options) {
  if (!dynamics()) return {};
  options.stability.stability = stability_options(condensed_);
  options.load_periods = condensed_.periods();
  const auto problems = [&](int periods) {
    CondensedProblem problem(pairs(periods), structure(),
                             solvers::over_periods(condensed_.load_harmonics(), periods));
    problem.set_load_unit(condensed_.full_load(), condensed_.load_unit());
    problem.set_threads(condensed_.threads());
    return problem;
  };
  return follow_branches(problems, laws_, *dynamics(), curve, stability, options);
}

PeriodicResponse ContactProblem::response(const FrequencySweep& curve, double value,
                                          const Eigen::VectorXd& unknown) {
  hold(curve);
  return curve_response(condensed_, laws_, curve, value, unknown);
}

CurvePeak ContactProblem::peak(const FrequencySweep& curve, std::size_t index, const CurveHeight& height) {
  hold(curve);
  return curve_peak(condensed_, laws_, curve, index, height);
}

std::vector<PeriodicResponse> ContactProblem::responses_at(const FrequencySweep& curve, double value) {
  hold(curve);
  return solvers::responses_at(condensed_, laws_, curve, value);
}

void ContactProblem::require_no_impacts() const {
  if (laws_.have_impacts())
    throw std::invalid_argument(
        "the laws have a restitution, whose motions are integrated from impact to impact; take impacts()");
}

ImpactResponse ContactProblem::impacts(double frequency, const ImpactResponseOptions& options) {
  return impact_response(exact_problem(frequency), options);
}

ExactProblem ContactProblem::exact_problem(double frequency) {
  load_fully(frequency);
  return exact_problem_here();
}

AttractorMotion ContactProblem::settle(double frequency, const AttractorOptions& options) {
  require_no_impacts();
  load_fully(frequency);
  return solvers::settle(condensed_, laws_, options);
}

}  // namespace wavebalance::solvers
