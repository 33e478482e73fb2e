#pragma once

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/collocation/exact_structure_motion.hpp"
#include "wavebalance/solvers/exact/exact_curve.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"

namespace wavebalance::app {

/// A curve of the scene whose motions are exact, as a sweep: Sweep::exact_motions are set.
Sweep sweep_of(const solvers::ExactCurve& curve, const Scene& scene, const solvers::ContactProblem& problem);

/// The problem of a scene with exact motions. It has the scene's pair, or a small unused one if the scene
/// names none or has impacts only.
solvers::ContactProblem exact_problem(const Scene& scene, const StructureModel& model);

/// The contacts at so many points of the motion's period; with impacts only there are no forces.
solvers::Motion contacts_of(const solvers::ExactSolution& motion, int points);

/// The scene as a harmonic balance with so many Fourier functions, a start for exact solutions.
Scene balance_of(Scene scene, int functions);
/// The first of exact_starts with as many harmonics as the load of the scene.
int least_start_functions(const Scene& scene);

/// exact_response() of a scene with time.tolerance, from its coarse harmonic balances only; nothing if the
/// tolerance is not met, a refined balance is cheaper, or the scene names a pair of bases.
std::optional<Response> exact_to_tolerance(const Scene& scene, const StructureModel& model,
                                           const ResponseOptions& options);

/// Solves a scene with time.tolerance. Sets all of `result` except motions and wall_seconds. Throws
/// solvers::SingularSystem.
solvers::RefinementResult solve_to_tolerance(const Scene& scene, const StructureModel& model,
                                             const solvers::ContactLaws& laws, const ResponseOptions& options,
                                             Response& result);

/// Operations allowed for the exact motion near a response: seconds of one processor for a few contacts,
/// less than a minute for 100. A motion nearby usually needs a thousandth.
double most_operations_of_exact(int contacts);

/// Copies a solver's data of a response into `result`, which has its motions from elsewhere.
void copy_solution(Response& result, solvers::CondensedProblem& problem,
                   const solvers::PeriodicResponse& found, const Scene& scene, const StructureModel& model);

AttractorFromRest from_rest(const solvers::AttractorMotion& settled);

/// Sets Response::settled, unless it is known, if the response of the problem's load period at the scene's
/// frequency is unstable, and removes it otherwise.
void note_attractor(solvers::ContactProblem& problem, const Scene& scene, const Observer& observer,
                    Response& result);

/// Sets the numbers of an exact motion and, if there is one, what copy_motion() does. `load_periods`:
/// forcing periods per period of the motion.
void copy_exact(solvers::ContactProblem& problem, const solvers::ExactSolution& motion, int load_periods,
                const Scene& scene, const StructureModel& model, const ResponseOptions& options,
                Response& result);

/// Sets the contacts' exact motion, and its requested parts.
void copy_motion(solvers::ContactProblem& problem, const solvers::ExactSolution& motion, const Scene& scene,
                 const StructureModel& model, const ResponseOptions& options, Response& result);

/// Sets the motion of the whole structure, and what is left out of it.
void note_structure(Response& result, solvers::ExactStructureMotion whole);

/// `time` with the pair, functions and points that a response to a tolerance chose.
Time solved_time(Time time, const Response& response);

/// rms of `found` less `start` over the rms of `start`; NaN if that is empty.
double relative_distance(const Eigen::VectorXd& found, const Eigen::VectorXd& start);

/// The status of a result whose rounding error is above largest_rounding_error.
std::string inaccurate_status(double rounding_error);

/// How the curve of a scene is followed, in frequencies or amplitudes of the load.
solvers::FrequencySweepOptions sweep_options(const Scene& scene);

/// The same for a curve whose motions are exact.
solvers::ExactCurveOptions exact_options(const Scene& scene, const solvers::Observer& observer);

}  // namespace wavebalance::app
