#pragma once
#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/modes/damped_mode.hpp"
#include "wavebalance/solvers/modes/elastic_mode.hpp"
#include "wavebalance/solvers/modes/nonlinear_mode.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"
#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::app {

/// make_model(scene).structure: a bar is loaded and touches at its tip.
solvers::LinearStructure make_structure(const Scene& scene);

/// The law of [contact], of which contacts may have others [contacts_of()]. Throws contact::LawFault for
/// values that make none, and std::runtime_error for a file that cannot be read.
solvers::AnyContactLaw make_law(const Contact& contact);
/// One law per contact of contacts_of(), or one for all where they are equal. Throws as make_law().
solvers::ContactLaws make_laws(const Scene& scene);

/// The basis `name` of Time::trial and Time::weight. Throws std::invalid_argument for an unknown name, or a
/// wavelet basis whose number of functions is not a power of two.
solvers::AnyTimeBasis make_basis(const std::string& name, int functions);

/// How the inner products of trial and weight are computed: by the scene's key, except that Daubechies
/// Galerkin pairs always use connection coefficients, which are exact [JL14, section 4.1].
InnerProducts effective_inner_products(const Time& time);

/// Treatment of the Nyquist coefficient: by the scene's key, except that pairs without a force on it drop
/// it.
NyquistCoefficient effective_nyquist(const Time& time);

/// Whether the scene's bases can be paired, and if not, the reason.
solvers::Admissibility pair_admissibility(const Time& time);

/// Throws solvers::InadmissiblePair. With exact inner products against Haar functions, an even number of
/// Fourier functions ends with sin(M pi t) instead of cos(M pi t), whose inner product with Haar functions
/// is zero.
solvers::TimePair make_pair(const Time& time);

/// The structure without damping in its own linear modes, all of them.
struct StructureModes {
  solvers::ModalModel model;
  Eigen::MatrixXd shapes;  ///< n x r, mass-normalised
};

/// Frequencies with a smaller relative difference are equal up to mesh errors, as for a round pipe.
inline constexpr double equal_frequencies = 1e-5;

/// Modes of equal frequency are those combinations of them of which the first moves the contacts most, and
/// others less or not at all. Throws std::runtime_error if the eigenvalue solver does not converge. O(n^3), n
/// of the reduced structure.
StructureModes make_modes(const StructureModel& model);

/// The scene's nonlinear mode on these modes.
solvers::NonlinearMode make_nonlinear_mode(const Scene& scene, const solvers::ModalModel& model);

/// make_problem() with the scene's contact laws, and the dynamics of its structure composed before.
solvers::ContactProblem compose_problem(const Scene& scene, const StructureModel& model);

/// The scene's pair and structure, condensed on the contacts; at forcing.frequency if that is set. The
/// period of the problem is analysis.subharmonic forcing periods.
solvers::CondensedProblem make_problem(const Scene& scene);
/// The same for the scene's structure composed before.
solvers::CondensedProblem make_problem(const Scene& scene, const StructureModel& model);

/// Whether the scene is a nonlinear mode with friction, which dissipates energy.
bool is_damped_mode(const Scene& scene);

/// Whether the scene is a nonlinear mode with a contact law instead of a rigid obstacle.
bool is_elastic_mode(const Scene& scene);

/// The discretisation of an elastic mode: the scene's own if it names a trial basis, else 2 harmonics + 1
/// Fourier functions on analysis.samples points.
Time mode_time(const Scene& scene);

/// The scene's elastic mode on these modes. Throws std::invalid_argument for a pair of bases that damps a
/// free motion, and for scenes that load_scene() would have rejected.
solvers::ElasticMode make_elastic_mode(const Scene& scene, const solvers::ModalModel& model);

/// The scene's damped mode. Throws as solvers::DampedMode does.
solvers::DampedMode make_damped_mode(const Scene& scene, const StructureModel& model);

/// Replaces the structure by solvers::with_massless_contacts() with its `modes` lowest modes. Throws the
/// same errors. O(n^3).
void make_contacts_massless(StructureModel& model, int modes);

/// Largest relative difference of the first ten natural frequencies of two structures without contact, of as
/// many as both have; NaN beyond 1000 degrees of freedom. O(n^3).
double frequency_change(const solvers::LinearStructure& from, const solvers::LinearStructure& to);

/// The keys of a scene's file that do not belong to an analysis of the type `type`, each "section.key", or
/// "forcing.terms" for all of its terms: without meaning in it, for a nonlinear mode without friction also
/// dampings and loads. Other keys of the structure are kept, because they define it: the analysis refuses
/// them. Only overrides of type, law and method count. Throws SceneError for a file that cannot be read or
/// is not TOML.
std::vector<std::string> keys_beside_analysis(const std::filesystem::path& file, const std::string& type,
                                              const std::vector<std::string>& overrides = {});

/// A change of a scene as `--analysis`, `--set` and `--unset` make it, and tables that are added to its file.
struct SceneChange {
  std::string analysis = {};            ///< another analysis.type; empty: the same
  std::vector<std::string> set = {};    ///< each "section.key=value"
  std::vector<std::string> unset = {};  ///< each "section.key"
  std::string added = {};               ///< TOML, as "[[forcing.terms]]\nharmonic = 0"
};

/// The scene as a forced response, with usual bases and sizes where it has none; impacts have none.
SceneChange as_response(const Scene& scene);

/// The scene integrated in time for long enough to record statistics of a motion that does not repeat.
SceneChange statistics_in_time();

/// The scene with this change, if it passes the rules of a file. Keys that the change does not name and that
/// do not belong to the changed scene are left out, but not keys of the structure that are set. Matrices are
/// not read again, unless kept_modes is what changes.
std::optional<Scene> changed_scene(const Scene& scene, const SceneChange& change);
/// Whether there is one.
bool accepts(const Scene& scene, const SceneChange& change);

/// Static equilibrium under the static loads, with the contacts that they close.
struct RestState {
  bool converged = false;
  std::string status;            ///< "converged", or why not
  Eigen::VectorXd displacement;  ///< m, of each contact
  Eigen::VectorXd force;         ///< N, of each contact

  /// Whether nothing moves or presses.
  bool trivial() const { return converged && displacement.isZero(0.0) && force.isZero(0.0); }
};

/// The state of a scene whose structure is `model`: K x = f - S^T f_c(S x) by Newton's method and what
/// follows where that fails, with a single function of time. Nothing for a nonlinear mode without friction,
/// which has no load, and where the law has no force at rest. One static condensation.
std::optional<RestState> rest_state(const Scene& scene, const StructureModel& model);
/// The same of matrices before any reduction. One sparse factorisation.
std::optional<RestState> rest_state(const Scene& scene);

/// Reads the scene in `file`, drops the keys in `removed`, each "section.key", and applies `overrides`, each
/// "section.key=value" with a TOML value (text may go without its quotes), before anything is checked. The
/// result is complete and within range: every key that has a default is filled in. Throws SceneError when the
/// file cannot be read, is not TOML, or is not a scene.
Scene load_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {},
                 std::span<const std::string> removed = {});

/// The same for `text`, which messages call `name`. Files of matrices that `earlier` has read, too, are not
/// read again.
Scene parse_scene(std::string_view text, const std::string& name, std::span<const std::string> overrides = {},
                  std::span<const std::string> removed = {}, const Scene* earlier = nullptr);

/// `scene`, built or changed in a program, with the defaults that derive from other keys filled in where they
/// are unset. Throws SceneError if it could not have been loaded from a file.
Scene complete_scene(const Scene& scene);

}  // namespace wavebalance::app
