#pragma once
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
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

}  // namespace wavebalance::app
