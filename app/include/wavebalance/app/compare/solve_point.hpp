#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// Trial and weighting functions, by the names of Time::trial and Time::weight, or exact().
struct BasisPair {
  std::string trial, weight;

  /// The exact solution among the pairs of bases: it has no weighting functions.
  static BasisPair exact() { return {"phases", ""}; }
  bool is_exact() const { return *this == exact(); }
  bool is_fourier() const { return trial == "fourier" && weight == "fourier"; }
  bool operator==(const BasisPair&) const = default;
};

/// "haar:fourier", as a command's argument and a table have it; "phases".
std::string name_of(const BasisPair& pair);
/// "Haar:Fourier", "DB6:DB6", "collocation": in pictures and sentences.
std::string label_of(const BasisPair& pair);

/// Reads "fourier:fourier,haar:fourier". Throws std::invalid_argument, which names what is wrong and what is
/// allowed, for anything else, unknown bases and a pair that is there twice.
std::vector<BasisPair> parse_pairs(std::string_view text);

/// Every pair of "fourier", "haar", "bspline" and "daubechies6", admissible or not, Fourier:Fourier first,
/// and "daubechies10" with itself and with Fourier weights.
std::vector<BasisPair> common_pairs();

/// Whether the pair can be taken with the scene's formulation and inner products, and if not, the reason.
solvers::Admissibility admissibility_of(const BasisPair& pair, const Scene& scene);

/// How a pair is drawn, in every picture.
struct PairStyle {
  Colour colour = Colour::grey;
  int marker = 8;
  Dash dash = Dash::solid;
};

/// The six pairs of JL14's Table 2 have a colour each and are solid; others have the colour of their trial
/// functions and dashes by their weights.
PairStyle style_of(const BasisPair& pair);

/// `series` in this style; the exact solution is black and wider.
Series styled(Series series, const BasisPair& pair);

/// Which relative rms error of a motion decides in a comparison.
enum class ErrorMeasure {
  displacement,  ///< of the displacements of all contacts
  force,         ///< of their forces
  both           ///< the larger of the two
};

std::string_view to_string(ErrorMeasure measure);

/// The argument of `--error`. Throws std::invalid_argument, which names the option, the text and what is
/// allowed.
ErrorMeasure parse_error_measure(const std::string& text);

/// "the displacement", "the force", "displacement and force": what an error is of, for a sentence.
std::string subject_of(ErrorMeasure measure);

/// The error that decides, of one of the displacement and one of the force. NaN where a part of it is.
double weighed_error(ErrorMeasure measure, double of_displacement, double of_force);

/// The response that others are measured against: which one it is and how accurate.
struct Reference {
  bool converged = false;
  std::string kind;    ///< "linear", "phases" or "finer_balance"; empty if none was found
  std::string status;  ///< "converged" or why not
  std::string text;    ///< what it is, for a sentence: "collocation"
  /// Estimated relative rms errors of its displacements and forces: smaller differences from it are not
  /// significant. The error of the forces is NaN if it is not known or no force acts.
  double error = solvers::missing, force_error = solvers::missing;
  solvers::Motion motion;  ///< displacements and forces of all contacts, without velocities
  ResponseStability stability;
  /// Why the exact solution is not the reference, a phrase; empty where it is, and where contact never
  /// closes.
  std::string without_exact;
  /// Whether Newton's method from the response without contact finds a balance with few functions. If not,
  /// the time of a solve from there does not depend on its size only.
  bool reached_directly = true;
  double wall_seconds = 0.0;

  double error_by(ErrorMeasure measure) const { return weighed_error(measure, error, force_error); }
};

/// The reference of a scene's forced response at `points` uniform times, a power of two:
///
///   contact never closes in the response without contact   that response
///   elastic laws, rigid ones of contacts without mass      exact periodic solution
///   everything else, and where no such motion is found     the balance with Fourier functions, refined
///
/// Exact solutions start from harmonic balance with an error of 1e-3, or 1e-4 if that fails. With rigid
/// contact 15, 31 and 63 functions are tried before, because the force oscillates with more. They are
/// solved to tolerances down to 1e-12, and once more with more nodes. The error of the forces is the
/// difference of the last two; the error of the displacements is the estimate, corrected by the error of
/// the previous estimate. They use a third of `seconds` (wall time). Structures with reduced dynamics are
/// not supported. The exact solution is accepted only near the finest balance, because there may be several
/// motions.
///
/// The balance is refined to tolerances of 1e-2 to 1e-8 until `seconds` are used; the error of its
/// displacements is the estimate of the refinement, the error of its forces the difference of the last two
/// levels.
///
/// With a start the balances begin with it instead of the linear response, and have 31 to 255 functions;
/// the error of each is its distance from the one before. An observer that returns false leaves the
/// reference not converged, with the status "interrupted". Throws what weighted_residual_response() throws.
Reference find_reference(const Scene& scene, const StructureModel& model, int points, double seconds,
                         const solvers::Observer& observer = {}, const StartMotion& start = {});

/// One way to compute a scene's response, and what came of it. Numbers that have no meaning are NaN.
struct SolvePoint {
  std::string method = "weighted_residual";  ///< or "phases", or a baseline of bench
  BasisPair pair = {};
  std::string inner_products = {};  ///< "exact" or "quadrature"
  int functions = 0;  ///< M, of the balance that exact solutions start from; 0 where there is none
  int points = 0;     ///< N
  double tolerance = solvers::missing;  ///< of exact solutions and time stepping
  double construction_seconds = solvers::missing;
  double seconds = solvers::missing;  ///< least of several solves from the linear response, plans made before
  double error = solvers::missing;    ///< that which decides: one of the following or, of both, the larger
  double displacement_error = solvers::missing;  ///< relative rms of all contacts against the reference
  double force_error = solvers::missing;         ///< the same of their forces
  bool converged = false;
  std::string status = {};  ///< why not; "not_run" when smaller sizes took too long
  bool on_front = false;
};

/// Marks the converged points that no other one beats in both time and error.
void mark_front(std::vector<SolvePoint>& points);
/// The converged points of a set that no other one of the set beats, by rising time.
std::vector<SolvePoint> envelope(std::vector<SolvePoint> points);
/// The weighted residuals of one pair, or the exact solution for the pair that represents it.
std::vector<SolvePoint> points_of(const BasisPair& pair, const std::vector<SolvePoint>& points);

/// Processor seconds that this thread has used. Measured work runs in one thread, so other programs and
/// threads hardly affect it.
double processor_seconds();

struct Repetition {
  double budget = 0.02;      ///< s, no further call is started after it
  int least = 2;             ///< calls at least, unless the first takes more than `max_seconds`
  double max_seconds = 0.5;  ///< s
};

/// The least processor seconds of one call of `work` among those that fit into the budget.
double least_seconds(const std::function<void()>& work, const Repetition& repetition = {});

/// Decides from the times so far whether the next of a series of doubling sizes is run.
class TimeLimit {
 public:
  explicit TimeLimit(double limit) : limit_(limit) {}
  void took(double seconds);
  /// Whether a size `growth` times the last is expected to stay within the limit: from the last two points,
  /// as something between proportional to the size and its third power.
  bool allows(double growth = 2.0) const;

 private:
  double limit_;
  double last_ = 0.0, before_ = 0.0;
};

/// Subject of a comparison: a scene, its structure composed before, and its reference response.
struct MeasuredScene {
  Scene scene;
  StructureModel model;
  /// Displacements and forces of all contacts at uniform points; no forces where they are not compared.
  solvers::Motion reference;
  ErrorMeasure measure = ErrorMeasure::displacement;  ///< which error decides
  StartMotion start = {};                             ///< of each solve; empty: the response without contact
};

/// Which sizes are solved and how each is timed.
struct SizeStudyOptions {
  std::vector<int> functions;            ///< rising powers of two
  std::vector<int> points_per_function;  ///< rising
  double max_seconds = 1.0;              ///< s: longer solves are not started, and a homotopy ends there
  double smallest_error = 0.0;           ///< a series of sizes ends at the first one with no larger error
  Repetition solve = {};
  Repetition construction = {.budget = 0.0, .least = 2, .max_seconds = 0.1};
  /// Whether an even number of Fourier functions, whose Nyquist coefficient the scene drops, is left out if
  /// the odd number with the same functions is used.
  bool without_equals = true;
  /// > 0: a solve ends after so many times the fastest converged time with as many functions and points,
  /// ten times as many for Fourier:Fourier, but not before 5 ms. It has not converged then.
  double longest_ratio = 0.0;
  /// > 0: a series of sizes ends, except for Fourier:Fourier, with the second size in a row, of 64
  /// functions or 10 ms or more, that fails or takes so many times as long as another solve with no larger
  /// error.
  double dominated_ratio = 0.0;
  int threads = 1;  ///< that solve the pairs of a size together; 0: one per core
  /// Called before each size with its pair as the phase, by one thread at a time. No size is begun after it
  /// has returned false, and one that was begun is `not_run`.
  solvers::Observer observer = {};
};

/// The scene in every pair over functions and points, a pair of Fourier functions also with one function
/// less: an odd number has no Nyquist coefficient. Sizes rise for all pairs together, so that an early end
/// leaves all of them equally far, with a dominated_ratio leading pairs first. Rows are ordered by series.
std::vector<SolvePoint> size_study(const MeasuredScene& measured, const std::vector<BasisPair>& pairs,
                                   const SizeStudyOptions& options);

/// The scene with another pair and sizes, or with them instead of its tolerance.
Scene discretised(Scene scene, const BasisPair& pair, int functions, int points);

/// The problem before its condensation, which is part of a solve.
solvers::ContactProblem uncondensed_problem(const Scene& scene, const StructureModel& model);

/// The samples of a start in a scene's sizes; none of an empty motion.
solvers::ResponseStart response_start(const StartMotion& start, const Scene& scene);

/// The response of a scene's problem near a start, or near the response without contact, with the
/// condensation.
solvers::PeriodicResponse response_near(const Scene& scene, solvers::ContactProblem& problem,
                                        const solvers::ResponseStart& start,
                                        const solvers::Observer& observer);

/// A scene's own pair and sizes, not solved yet.
SolvePoint unsolved_point(const Scene& scene);

/// The problem of an unsolved point, which is given the time of its construction; nothing, with the status
/// "refused", of a pair that has as many Fourier functions as points at the middles.
std::optional<solvers::ContactProblem> timed_problem(const MeasuredScene& measured, const Scene& scene,
                                                     const Repetition& repetition, SolvePoint& point);

/// Sets the time of `solve`. False, with the status "singular", where it throws solvers::SingularSystem.
bool time_solve(const std::function<void()>& solve, const Repetition& repetition, SolvePoint& point);

/// Sets the errors of a motion, which are at least the errors of the reference where these are given.
void set_errors(const MeasuredScene& measured, const solvers::Motion& motion, SolvePoint& point,
                double least_displacement = 0.0, double least_force = 0.0);

/// Relative rms errors of all contacts together; NaN where the reference is zero or missing.
double displacement_error(const solvers::Motion& motion, const solvers::Motion& reference);
double force_error(const solvers::Motion& motion, const solvers::Motion& reference);

/// To what tolerances exact solutions are computed and how that is timed.
struct ExactStudyOptions {
  std::vector<double> tolerances = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10};
  int first_functions = 31;  ///< of the coarsest harmonic balance used as a start
  int largest_functions = 1023;
  double max_seconds = 1.0;  ///< s: after a longer solve no finer start is tried
  Repetition solve = {};
  Repetition construction = {.budget = 0.0, .least = 1, .max_seconds = 0.0};
  /// Called before each solve with what is solved as the phase, and within it. The solve ends `cancelled`
  /// when it returns false, and no other is begun.
  solvers::Observer observer = {};
};

/// The exact periodic solution of the scene, from nothing: a balance with M Fourier functions
/// and 4 (M + 1) points from the linear response, the poles of the structure, and the exact solutions near
/// the balance. The balance is the one from which exact solutions to a tolerance of 1e-6 are found soonest,
/// of 31, 63, ... functions until the time rises; those from which the exact solutions are not found are
/// among the rows. Then come the other tolerances. Errors are those against the reference, which has more
/// nodes, and no smaller than its own.
std::vector<SolvePoint> exact_study(const MeasuredScene& measured, const Reference& reference,
                                    const ExactStudyOptions& options);

}  // namespace wavebalance::app
