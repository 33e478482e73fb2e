#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "wavebalance/solvers/branches/branches.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/collocation/exact_structure_motion.hpp"
#include "wavebalance/solvers/exact/exact_curve.hpp"
#include "wavebalance/solvers/flow/attractor_motion.hpp"
#include "wavebalance/solvers/impacts/impact_response.hpp"
#include "wavebalance/solvers/period/attractor_integration.hpp"
#include "wavebalance/solvers/period/time_stepping.hpp"
#include "wavebalance/solvers/problem/motion_stability.hpp"
#include "wavebalance/solvers/problem/structure_dynamics.hpp"
#include "wavebalance/solvers/response/curve_peak.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"

namespace wavebalance::solvers {

namespace detail {
class FreeContacts;
}

/// Rounding errors of the condensation that a converged response may have, relative to the motion; one with
/// larger ones has the status `inaccurate`.
inline constexpr double largest_rounding_error = 1e-3;

/// Starts of the search for a response, samples() values each.
struct ResponseStart {
  Eigen::VectorXd displacement{};  ///< m; empty: the linear response
  Eigen::VectorXd force{};         ///< N; empty where none is known
};

/// Whether no balance has motions of a structure that is held, under these laws: with impacts, rigid friction
/// at a contact with mass, or friction that needs states.
bool need_events(const ContactLaws& laws, const LinearStructure& structure);

/// A structure with its contacts and their laws in one pair of time bases, under a cosine load and its
/// other forces, with all analyses. Frequencies are forcing frequencies (Hz). A motion spans one forcing
/// period unless several are specified. Analyses may be called in any order. Owns plans and buffers: one
/// object per thread.
class ContactProblem {
 public:
  /// Throws std::invalid_argument for laws that are neither one nor one for each contact, for a rigid law
  /// at a contact with mass unless it has a restitution, and as CondensedProblem does. With restitution
  /// there are impacts, which have separate analyses below; the others throw std::invalid_argument.
  ContactProblem(TimePair pair, const LinearStructure& structure, ContactLaws laws, int periods = 1);
  /// Takes a problem with another load, or a structure whose dynamics are shared with others.
  ContactProblem(CondensedProblem problem, ContactLaws laws,
                 std::shared_ptr<StructureDynamics> dynamics = std::make_shared<StructureDynamics>());

  const TimePair& pair() const { return condensed_.pair(); }
  const LinearStructure& structure() const { return condensed_.structure(); }
  /// The same over so many forcing periods, in the same pair, whose functions then represent as many times
  /// fewer harmonics: for analyses without functions, as settle() and exact solutions. A condensation for
  /// each frequency.
  ContactProblem over_periods(int times) const;
  int contacts() const { return condensed_.contacts(); }
  int samples() const { return condensed_.samples(); }
  const ContactLaws& laws() const { return laws_; }
  /// Takes other laws, which are refused as in the constructor.
  void set_laws(ContactLaws laws);
  /// Null where the structure has no modes to compute. For a rotor they belong to the frequency of the last
  /// call. O(n^3) the first time.
  const ContactDynamics* dynamics() const { return dynamics_->of(structure()).get(); }
  /// The equations, at the frequency and load of the last question.
  CondensedProblem& condensed() { return condensed_; }
  const CondensedProblem& condensed() const { return condensed_; }

  /// A response at a frequency: forced_response(), or subharmonic_response() of several periods. One whose
  /// rounding error exceeds largest_rounding_error is `inaccurate`. Throws as these do.
  PeriodicResponse respond(double frequency, const ForcedResponseOptions& options = {},
                           const ResponseStart& start = {});

  /// contact_motion() and structure_motion() of a response.
  Motion motion(const PeriodicResponse& response, int points);
  Motion structure_motion(const PeriodicResponse& response, int points);
  /// The contact intervals near a response; nothing where the structure has no modes to compute.
  std::optional<ExactNearResponse> exact_near(const PeriodicResponse& response,
                                              const CollocationOptions& options = {});
  /// The exact solution near the motion that settle() found at a frequency; nothing if there is none, or no
  /// modes.
  std::optional<ExactSolution> exact_near(double frequency, const AttractorMotion& settled,
                                          const CollocationOptions& options = {});
  /// Whether its motions are solved for from event to event, because balance does not support them: impacts
  /// in addition to other laws, friction of a free structure, rigid friction at a contact with mass.
  bool moves_by_events() const;
  /// attractor_motion() at a frequency. Throws std::invalid_argument without modes.
  ExactAttractor exact_attractor(double frequency, const TimeSteppingOptions& stepping,
                                 const CollocationOptions& options = {});
  /// The contact intervals near displacements of the contacts, and with rigid laws forces, uniform over the
  /// period; nothing without modes.
  std::optional<ExactSolution> exact_near(double frequency, const Motion& start,
                                          const CollocationOptions& options = {});
  /// exact_structure_motion() of a motion at a frequency, and its stability where it has converged.
  ExactStructureMotion structure_motion(double frequency, const ExactSolution& motion, int points,
                                        const ExactStructureOptions& options = {});
  MotionStability stability(double frequency, const ExactSolution& motion);
  /// The stability of a response, or of the exact solution `motion` if it is not null.
  MotionStability stability(const PeriodicResponse& response, const ExactSolution* motion = nullptr);
  /// Its exponents of the largest multipliers, `most` at most; without values where the structure has no
  /// modes.
  FloquetExponents exponents(const PeriodicResponse& response, int most);

  /// frequency_sweep() from options.from to options.to at the full load.
  FrequencySweep sweep(const FrequencySweepOptions& options);
  /// The same from a response at options.from, respond() with options.start and `start`.
  FrequencySweep sweep(const FrequencySweepOptions& options, const PeriodicResponse& first);
  /// amplitude_sweep() at a frequency; from and to are in CondensedProblem::load_unit().
  FrequencySweep amplitude_sweep(double frequency, const FrequencySweepOptions& options);
  /// The same from the response at options.from that options.start leads to from a start, and that response.
  std::pair<FrequencySweep, PeriodicResponse> amplitude_sweep(double frequency,
                                                              const FrequencySweepOptions& options,
                                                              const ResponseStart& start);
  /// exact_curve() over the frequency, or at a frequency over the load scale, from the motion near the
  /// response at options.from: `how` and `start` as of respond(). If no exact motion is near the response,
  /// the curve starts from the motion that settle() finds. Status `no_start` where neither leads to a
  /// motion, or without modes.
  ExactCurve exact_sweep(const ExactCurveOptions& options, const ForcedResponseOptions& how = {},
                         const ResponseStart& start = {});
  ExactCurve exact_amplitude_sweep(double frequency, const ExactCurveOptions& options,
                                   const ForcedResponseOptions& how = {}, const ResponseStart& start = {});
  /// The curves of twice as many periods, doubled_curve(), from the period doublings of an exact curve of
  /// impacts over a parameter that was traced with `options`, an amplitude sweep at a frequency.
  std::vector<ExactCurve> doubled_curves(const ExactCurve& curve, SweepParameter parameter, double frequency,
                                         const ExactCurveOptions& options);
  /// exact_curve_through() over the frequency, from a motion that has converged at a frequency within the
  /// interval; without points without modes.
  ExactCurve exact_curve_from(double frequency, const ExactSolution& motion,
                              const ExactCurveOptions& options);
  /// The stability along a curve that was traced with keep_unknowns, and, if requested, its bifurcation and
  /// grazing points with its slip_points(); without points where the structure has no modes.
  CurveStability stability(const FrequencySweep& curve, int output_points = 1024,
                           const Observer& observer = {}, bool special_points = true);
  /// Makes the pair for motions of so many periods of the curve's, see BranchProblems.
  using PairOfPeriods = std::function<TimePair(int periods)>;
  /// follow_branches() of a curve and its stability.
  std::vector<Branch> branches(const FrequencySweep& curve, const CurveStability& stability,
                               const PairOfPeriods& pairs, BranchOptions options);
  /// The response at a value of the curve's parameter and an unknown there, as of one of its points.
  PeriodicResponse response(const FrequencySweep& curve, double value, const Eigen::VectorXd& unknown);
  /// curve_peak() of a curve of the problem.
  CurvePeak peak(const FrequencySweep& curve, std::size_t index, const CurveHeight& height);
  /// All responses of a curve at a value of its parameter, responses_at().
  std::vector<PeriodicResponse> responses_at(const FrequencySweep& curve, double value);

  /// impact_response() at a frequency of the load. Throws std::invalid_argument for laws without restitution,
  /// a structure without modes, and as this does.
  ImpactResponse impacts(double frequency, const ImpactResponseOptions& options = {});
  /// For what has exact motions at a frequency of the load. Throws std::invalid_argument without modes.
  ExactProblem exact_problem(double frequency);

  /// Motions in time, from rest or the state of the options: settle().
  AttractorMotion settle(double frequency, const AttractorOptions& options = {});

 private:
  void require_well_posed() const;
  void require_no_impacts() const;
  void hold(const PeriodicResponse& response);
  void hold(const FrequencySweep& curve);
  void load_fully(double frequency);
  void add_slip_points(const FrequencySweep& curve, int output_points, CurveStability& stability);
  ExactSolution motion_here(const ExactCurveOptions& options, const ForcedResponseOptions& how,
                            const ResponseStart& start);
  ExactProblem exact_problem_here();
  ExactCurve exact_curve_here(SweepParameter parameter, const ExactCurveOptions& options,
                              const ForcedResponseOptions& how, const ResponseStart& start);

  CondensedProblem condensed_;
  ContactLaws laws_;
  std::shared_ptr<StructureDynamics> dynamics_;
  std::shared_ptr<detail::FreeContacts> free_contacts_;  // once exact solutions are computed
};

}  // namespace wavebalance::solvers
