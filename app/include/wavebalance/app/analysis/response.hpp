#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/flow/periodic_flow.hpp"
#include "wavebalance/solvers/impacts/impact_response.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/response/refinement.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

using solvers::Observer;
using solvers::Progress;

/// Checks of a response with rigid contact.
struct RigidContact {
  double max_penetration = 0.0;  ///< m, at the quadrature points, where contact is enforced; negative: none
  double min_force = 0.0;        ///< N, at the quadrature points
  double product = 0.0;  ///< largest force times distance, over the largest of each, at the quadrature points
};

/// How a scene with time.tolerance was resolved.
struct Refinement {
  std::string trial, weight;                     ///< the pair, of all levels
  double estimated_error = 0.0;                  ///< solvers::RefinementResult::estimated_error
  double seconds = 0.0;                          ///< wall time of all levels
  std::vector<solvers::RefinementLevel> levels;  ///< in the order solved
};

/// The attractor reached from rest, in addition to an unstable response.
struct AttractorFromRest {
  int periods = -1;               ///< of the load, solvers::AttractorMotion::attractor_periods
  double max_displacement = 0.0;  ///< m, of any contact in a period of the load; of periods > 0
  double max_force = 0.0;         ///< N, likewise
};

using ResponseStability = solvers::MotionStability;
using solvers::largest_rounding_error;

/// A periodic response of a scene's contacts, or the status and the last iterate if none was found.
struct Response {
  bool converged = false;
  /// Whether `contacts` hold a motion of the structure: a response, one that misses time.tolerance, or the
  /// last period of time stepping. Otherwise they hold the last iterate, which means nothing.
  bool moves = false;
  /// Whether it is time stepping without a repeating motion, which a RecordedMotion describes.
  bool recorded = false;
  std::string status;  ///< "converged" or why not
  double residual =
      0.0;  ///< relative; of the equations, or the difference of the last two periods (time stepping)
  int iterations = 0;  ///< Newton iterations; periods integrated (time stepping)
  int unknowns = 0;    ///< contact displacements in time; of exact solutions forces at nodes and instants;
                       ///< states of the integrator (time stepping)
  int attractor_periods = -1;  ///< solvers::AttractorMotion::attractor_periods; -1 where no attractor was
                               ///< computed
  std::optional<double> load_frequency{};  ///< Hz, of a motion of a curve; else forcing.frequency
  int periods = 1;         ///< of the load, over which the motion is written: analysis.subharmonic
  int motion_periods = 1;  ///< of the load, after which it repeats: solvers::motion_periods()
  double change_after_one = std::numeric_limits<double>::quiet_NaN();  ///< solvers::change_after() one period
  std::string strategy;  ///< solvers::Strategy that found it, or the start of an exact solution; empty for
                         ///< time stepping
  /// rms difference of the displacements at the quadrature points from ResponseOptions::guess, over the rms
  /// of the guess; NaN without one.
  double start_distance = std::numeric_limits<double>::quiet_NaN();
  std::string form;  ///< solvers::ContactForm in which it was solved; empty for references
  /// The unknown of the force form, solvers::PeriodicResponse::unknown_coefficients, and its 1 / epsilon of
  /// each contact (m/N); empty in the displacement form.
  Eigen::MatrixXcd unknown_coefficients;
  Eigen::VectorXd series_flexibility;
  /// The larger condition estimate of the dynamic stiffnesses and of the last Newton matrix; infinite where
  /// one is singular to working precision, NaN where no such system was solved (time stepping, exact
  /// solution).
  double condition = std::numeric_limits<double>::quiet_NaN();
  /// solvers::PeriodicResponse::rounding_error; NaN as above. Above largest_rounding_error the response has
  /// not converged, and the status is `inaccurate`.
  double rounding_error = std::numeric_limits<double>::quiet_NaN();
  double wall_seconds = 0.0;             ///< composition, solution and samples
  double exact_seconds = 0.0;            ///< of the exact motion near a harmonic balance response
  std::optional<RigidContact> rigid;     ///< set in scenes with rigid contact
  std::optional<Refinement> refinement;  ///< set in scenes with time.tolerance
  /// Set if converged, with ResponseOptions::stability.
  std::optional<ResponseStability> stability;
  /// Set if converged, with ResponseOptions::exact of a structure whose modes are known, and in scenes by
  /// time.method = "exact" where a motion was found, then without errors of a response.
  std::optional<solvers::ExactNearResponse> exact;
  std::vector<solvers::Impact> struck;  ///< the impacts of its period, by time
  /// Set in scenes whose contacts all have impacts. Unless one rests no contact exerts a force between them,
  /// so that `contacts` have none.
  std::optional<solvers::ImpactResponse> impacts;
  bool forces_are_known() const { return !impacts || impacts->lasts(); }
  /// Set in scenes that are integrated by events.
  std::optional<solvers::FlowMotion> flow;
  /// Set where the response is unstable and its motion has the load's period.
  std::optional<AttractorFromRest> settled;
  solvers::Motion contacts;   ///< of all contacts, analysis.output_points points; empty if none was found
  int contact = 0;            ///< the leading one, see leading_contact()
  solvers::Motion structure;  ///< of all degrees of freedom of the reduced structure, without forces;
                              ///< ResponseOptions::structure_points points
  /// TimeMethod of a forced response: "balance", or "exact" of scenes by collocation and of those whose
  /// time.tolerance exact solutions meet more cheaply; empty for references.
  std::string solved_by;
  int start_functions = 0;  ///< functions of the harmonic balance from which an exact solution started; 0
                            ///< without one
  /// Exact solutions (solvers::ExactStructureMotion): the harmonics of `structure`, and the error of the
  /// omitted ones.
  int structure_harmonics = 0;
  double structure_left_out = std::numeric_limits<double>::quiet_NaN();

  /// The motion of the contact with the largest force, 1 x output_points each, and its time histories:
  /// output_points values each, m, m/s and N.
  solvers::Motion leading() const { return contacts.contact(contact); }
  Eigen::VectorXd displacement() const { return leading().displacement.reshaped(); }
  Eigen::VectorXd velocity() const { return leading().velocity.reshaped(); }
  Eigen::VectorXd force() const { return leading().force.reshaped(); }
};

/// Optional parts of a response, and the start of its solution.
struct ResponseOptions {
  int structure_points = 0;       ///< uniform instants of Response::structure; 0: none. For time stepping 0
                                  ///< or analysis.output_points
  Eigen::VectorXd guess{};        ///< displacement at the quadrature points, m; empty: the linear response.
                                  ///< Not used with time.tolerance
  Eigen::VectorXd guess_force{};  ///< its contact force there, N; may be empty
  bool stay_near_guess = false;   ///< solvers::ForcedResponseOptions::stay_near_guess
  bool stability = false;         ///< of weighted_residual_response() and exact_response()
  bool exact = false;             ///< of weighted_residual_response(): Response::exact
  /// For weighted_residual_response() without time.tolerance: if the functions represent no motion, the
  /// exact motion that time integration converges to is the response. Response::solved_by names it.
  bool exact_instead = false;
  /// Estimated, of the periods of time stepping.
  double max_operations = std::numeric_limits<double>::infinity();
  Observer observer{};
};

/// The scene's response by weighted residuals in time with its pair of bases. A failure to converge or a
/// singular system is reported by `converged` and `status`; then `contacts` hold the last iterate. Throws
/// solvers::InadmissiblePair and std::invalid_argument for scenes that a loader would have rejected.
///
/// A stiff or rigid law is solved in the force form: its force is then the resolvent of the law, which holds
/// u <= gap of a rigid obstacle up to the discretisation error. Response::rigid reports that error.
///
/// With time.tolerance the functions and points are chosen by solvers::response_to_tolerance; it has
/// converged when the estimated error meets the tolerance. Below largest_exact_tolerance() exact solutions
/// are tried first, from coarse harmonic balances, unless the scene names a pair of other bases.
/// Response::solved_by names the method.
Response weighted_residual_response(const Scene& scene, const ResponseOptions& options = {});
/// The same for the scene's structure composed before.
Response weighted_residual_response(const Scene& scene, const StructureModel& model,
                                    const ResponseOptions& options = {});

/// Below this tolerance exact solutions are faster than refined harmonic balance. With one or two contacts
/// both are equally fast at 1e-5.
double largest_exact_tolerance(int contacts);

/// Whether the response is the exact periodic solution.
bool is_exact(const Response& response);

/// time.tolerance, or the default one of exact motions.
double exact_tolerance(const Scene& scene);

/// The exact periodic solution, to time.tolerance: of scenes with time.method =
/// "exact". It starts from a balance with the first of exact_starts Fourier functions near which there is a
/// motion, and where there is none from the attractor. The status is
/// solvers::ExactStatus, "no_start" where neither leads to a motion, or "no_modes" where the structure has
/// none to compute.
Response exact_response(const Scene& scene, const ResponseOptions& options = {});
Response exact_response(const Scene& scene, const StructureModel& model, const ResponseOptions& options = {});

/// The attractor with impacts, of scenes with contact.restitution: exact flights from impact to impact
/// until it nearly repeats, and of forced responses Newton's method on instants and impulses from there on
/// [solvers::impact_response()]. Time stepping accepts the integrated motion once it repeats to
/// analysis.tolerance. The whole structure's motion is summed from harmonics to 1e-4, because harmonics of
/// impulses do not decay. The status is a solvers::ImpactStatus, or "no_modes".
Response impacts_response(const Scene& scene, const StructureModel& model,
                          const ResponseOptions& options = {});

/// The scene's response in time from event to event, solvers::integrate_by_events(). Once two periods agree
/// to analysis.tolerance the period is closed, so that the motion is exact and has all its multipliers. The
/// status is a solvers::TimeSteppingStatus, "endless_events" or "no_modes".
Response flow_response(const Scene& scene, const StructureModel& model, const ResponseOptions& options = {});

}  // namespace wavebalance::app
