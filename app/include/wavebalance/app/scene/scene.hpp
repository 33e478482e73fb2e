#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wavebalance/contact/law_description.hpp"
#include "wavebalance/fem/solid.hpp"
#include "wavebalance/solvers/balance/contact_form.hpp"
#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::app {

using fem::SolidElement;
using solvers::ContactForm;
using solvers::Formulation;
using solvers::InnerProducts;
using solvers::NyquistCoefficient;

/// Kinds of structure, structure.type.
enum class StructureType { bar, blade, matrices };
/// Global direction of a blade's load.
enum class Direction { x, y, z };
/// Place of the load on a blade's tip.
enum class TipPlace { leading_edge, mid_chord, trailing_edge };
/// What becomes of the mass at the contacts, contact.mass: it stays, or the rest of the structure takes it.
/// `automatic` redistributes it where the law is rigid.
enum class ContactMass { automatic, keep, redistribute };
/// Where the obstacles of a contact direction stand, contact.pairs.side.
enum class ObstacleSide { positive, negative, both };
/// Analyses, analysis.type.
enum class AnalysisType {
  forced_response,
  frequency_sweep,
  amplitude_sweep,
  time_stepping,
  shooting,
  motions,
  nonlinear_mode
};
/// What a response solves for, time.method: the balance in a pair of bases, or the motion of the structure
/// itself by phases of contact.
enum class TimeMethod { balance, exact };
/// Fourier functions of the balances from which phases are sought, in turn until there is a motion.
inline constexpr std::array phases_starts{63, 127, 255, 511};
/// time.tolerance of phases unless it is said.
inline constexpr double default_phases_tolerance = 1e-9;
/// Whether the equation of motion is integrated in time, so that there are no functions: time stepping.
bool integrates_in_time(AnalysisType type);
/// Whether motions are followed over the frequency or the amplitude of the load.
bool is_sweep(AnalysisType type);
/// What a further load is, forcing.terms.kind: a force, or the motion of supports.
enum class LoadKind { force, base_displacement, base_acceleration, unbalance };

/// Contents of the files that a scene names; see structure_files.hpp.
struct StructureFiles;

/// What load_scene() has read and checked of the files that a scene names, so that nothing is read twice.
/// It does not count when scenes are compared, because the paths of the files identify them.
struct ReadFiles {
  std::shared_ptr<const StructureFiles> contents = {};

  bool operator==(const ReadFiles&) const { return true; }
};

/// A structure from any finite element code. Paths are absolute once loaded, in a file relative to it.
struct MatricesStructure {
  std::string mass = {};               ///< file of a matrix [fem::read_matrix], n x n, kg
  std::string stiffness = {};          ///< likewise, N/m
  std::string damping = {};            ///< likewise, N s/m; or empty
  std::string dof_map = {};            ///< file that names the n rows by nodes [fem::read_dof_map]; or empty
  std::string mesh = {};               ///< file of the nodes and elements [fem::read_mesh]; or empty
  bool unsymmetric = false;            ///< damping and stiffness may be unsymmetric
  std::string gyroscopic = {};         ///< file of G, skew-symmetric: C + spin_speed G; or empty
  std::string spin_stiffness = {};     ///< file of K_s, symmetric: K + spin_speed^2 K_s; or empty
  double spin_speed = 0.0;             ///< rad/s; 0: 2 pi Forcing::frequency, with the load
  bool free = false;                   ///< the structure is free to move
  std::vector<int> contact_dofs = {};  ///< from 1; -i: dof i with its obstacle on the negative side
  ReadFiles files = {};

  bool operator==(const MatricesStructure&) const = default;
};

/// A cambered, tapered, twisted blade, clamped at z = 0 [fem::BladeOptions]; its material and length are in
/// Structure. Pairs hold the values at root and tip. Its tip's corner nodes may touch an obstacle radially.
struct BladeStructure {
  std::array<double, 2> chord = {0.052, 0.056};           ///< m, > 0
  std::array<double, 2> thickness_ratio = {0.09, 0.031};  ///< over the chord, > 0
  std::array<double, 2> camber_ratio = {0.098, 0.011};    ///< over the chord
  std::array<double, 2> angle_degrees = {10.0, 35.0};
  double edge_thickness = 0.35;  ///< over that at mid chord, in (0, 1]
  double poissons_ratio = 0.31;
  SolidElement element = SolidElement::hexahedron20;
  int chord_elements = 11;
  int thickness_elements = 1;
  int span_elements = 16;
  double rotation_speed = 0.0;  ///< rad/s, >= 0
  double hub_radius = 0.2;      ///< m, >= 0: the axis passes through z = -hub_radius
  std::array<double, 3> rotation_axis = {1.0, 0.0, 0.0};  ///< direction of the axis

  bool operator==(const BladeStructure&) const = default;
};

/// The vibrating structure: an axial bar, clamped at x = 0, whose tip x = length may touch an obstacle [JL14,
/// Fig. 1]; a blade; or any structure as matrices.
struct Structure {
  StructureType type = StructureType::bar;
  double youngs_modulus = 0.0;        ///< Pa, > 0
  double density = 0.0;               ///< kg/m^3, > 0
  double area = 0.0;                  ///< m^2, > 0
  double length = 0.0;                ///< m, > 0
  int elements = 0;                   ///< two-node elements, >= 1; as many degrees of freedom
  double stiffness_damping = 0.0;     ///< s, beta in C = beta K, >= 0
  double lumped_mass_fraction = 0.0;  ///< 0 consistent mass, 1 lumped mass, between them a mixture
  bool massless_tip = false;          ///< the tip's mass is moved to its neighbour: forced_response and sweep
  double modal_damping = 0.0;         ///< ratio to critical of every mode; not a bar's
  double loss_factor = 0.0;           ///< eta in K (1 + i eta) at positive harmonics, >= 0
  int kept_modes = -1;                ///< modes that a Craig-Bampton reduction keeps; -1: no reduction
  MatricesStructure matrices = {};
  BladeStructure blade = {};

  bool operator==(const Structure&) const = default;
};

/// The contact.law of a scene without contact.
inline constexpr std::string_view no_law = "none";

/// One entry of [[contact.pairs]]: a direction of contact of matrices, which moves by the sum of coefficients
/// times degrees of freedom, and its law. Complete once loaded: what a file leaves out is that of [contact].
struct ContactPair {
  std::vector<int> dofs = {};             ///< from 1, none twice
  std::vector<double> coefficients = {};  ///< one each, not all zero; empty before loading: 1, or 1 and -1
  /// Of a law with friction the first tangent beside the normal direction above, and the second one; empty:
  /// the direction above is itself the tangent.
  std::vector<int> tangent = {}, second_tangent = {};
  std::vector<double> tangent_coefficients = {}, second_tangent_coefficients = {};
  ObstacleSide side = ObstacleSide::positive;
  std::string law{no_law};         ///< as in Contact
  contact::LawValues values = {};  ///< as in Contact
  double gap = 0.0;                ///< m, on every side that has an obstacle
  std::string name = {};           ///< by which texts and pictures show it, too; empty: by its number alone

  /// A value by its name. Throws std::out_of_range where none is set.
  double number(std::string_view parameter) const { return contact::number_of(values, parameter); }
  bool operator==(const ContactPair&) const = default;
};

/// The force at a contact as a function of its displacement u towards the obstacle, and how it is solved for.
/// contacts_of() lists the contacts that these keys and MatricesStructure::contact_dofs say together.
struct Contact {
  std::string law{no_law};  ///< a name of contact::law_catalogue()
  /// The law's parameters other than the gap, as far as they differ from their defaults.
  contact::LawValues values = {};
  ContactForm form = ContactForm::automatic;  ///< the unknown that is solved for
  ContactMass mass = ContactMass::automatic;  ///< of the contact degrees of freedom
  Direction tangent = Direction::y;           ///< blade with friction: along which its tip rubs, x or y
  double gap = 0.0;                           ///< m, displacement at which contact starts
  std::vector<double> gaps = {};  ///< m, one per contact in place of gap; empty: gap holds for all
  /// Directions of contact in place of MatricesStructure::contact_dofs, each with its own law and gap.
  std::vector<ContactPair> pairs = {};

  /// A value by its name. Throws std::out_of_range where none is set.
  double number(std::string_view parameter) const { return contact::number_of(values, parameter); }
  bool operator==(const Contact&) const = default;
};

/// Whether the law of this name begins where the displacement is its gap, contact.gap.
bool has_gap(std::string_view law);
/// Whether its force depends on the velocity.
bool is_damped(std::string_view law);
/// Whether it is a spring that may act below its gap, too.
bool acts_on_both_sides(std::string_view law);
/// Whether it is a spring without a gap, which no motion opens.
bool acts_everywhere(std::string_view law);
/// Whether its force beyond the gap is infinite.
bool is_rigid(std::string_view law);
/// Whether its force follows from the motion over a whole period: friction.
bool has_friction(std::string_view law);
/// Whether it acts along two directions together, beyond a gap along every radius: a ring.
bool acts_in_plane(std::string_view law);
/// Whether a law of [contact] or of a pair does.
bool names_plane(const Contact& contact);
/// Whether a law of [contact] or of a pair has friction that sticks or slips.
bool names_friction(const Contact& contact);
/// Whether a law of [contact] or of a pair takes energy from a motion: friction, or a force of the velocity.
bool takes_energy(const Contact& contact);
/// Whether one of these has friction without tangential_stiffness, which is rigid.
bool names_rigid_friction(const Contact& contact);
/// Whether one of these has friction against a surface that moves, with static_friction above friction, or
/// with dashpots beside its springs, so that its force follows from its states alone.
bool names_friction_of_states(const Contact& contact);
/// Whether it is a rigid law with contact.restitution, whose motions are found by their impacts.
bool has_impacts(const Contact& contact);

/// One entry of [[forcing.terms]]: amplitude cos(harmonic 2 pi frequency t + phase), or amplitude times a
/// periodic function given by samples.
struct ForcingTerm {
  LoadKind kind = LoadKind::force;
  int harmonic = 1;            ///< of Forcing::frequency; 0: static, without phase
  double amplitude = 1.0;      ///< in unit_of(kind)
  double phase = 0.0;          ///< degrees ahead of a cosine
  std::string samples = {};    ///< CSV file, its last column one period at uniform times; or empty
  std::vector<int> dofs = {};  ///< matrices: as Forcing::load_dofs; empty: where Forcing::amplitude acts
  std::string load = {};       ///< matrices: of a force, as Forcing::load; or empty
  /// Matrices with a dof map: along which a base_acceleration moves all nodes, "x" or "-z"; empty: dofs.
  std::string direction = {};

  bool operator==(const ForcingTerm&) const = default;
};

/// The force amplitude * cos(2 pi frequency t), at a bar's tip; along load (1/1) of matrices; at one place of
/// a blade's tip; and the terms. Nonlinear modes do not use it.
struct Forcing {
  double amplitude = 0.0;                   ///< N
  double frequency = 0.0;                   ///< Hz, > 0; a frequency sweep does not use it
  std::string load = {};                    ///< matrices: Matrix Market file of n values, or empty
  std::vector<int> load_dofs = {};          ///< matrices: from 1, each with value 1; -i: dof i with -1
  TipPlace place = TipPlace::leading_edge;  ///< blade
  Direction direction = Direction::y;       ///< blade
  /// Matrices with a dof map: m/s^2 along x, y and z, the static acceleration that all masses feel; or empty.
  std::vector<double> weight = {};
  std::vector<ForcingTerm> terms = {};  ///< beside it

  bool operator==(const Forcing&) const = default;
};

/// The discretisation of one period. Basis names: "fourier", "haar", "bspline", "daubechies<even number >=
/// 2>". Time stepping and nonlinear modes with rigid contact do not use it. A tolerance stands in place of
/// functions and quadrature_points, which are then chosen, and where it stands without trial and weight these
/// are too.
struct Time {
  std::string trial;
  std::string weight;
  int functions = 0;  ///< trial functions, >= 1; a power of two when a wavelet basis takes part
  Formulation formulation = Formulation::distributional;
  int quadrature_points = 0;  ///< uniform points of one period, >= functions
  InnerProducts inner_products = InnerProducts::quadrature;
  NyquistCoefficient nyquist = NyquistCoefficient::drop;  ///< of an even number of functions
  double sample_offset = 0.0;  ///< 0 or 0.5, of the points t_k = (k + sample_offset) / quadrature_points
  double tolerance = 0.0;      ///< > 0: relative rms error of the tip displacement to be met; 0: none
  TimeMethod method = TimeMethod::balance;  ///< forced_response

  bool operator==(const Time&) const = default;
};

/// The points of a sweep whose motions are written, analysis.motion_at.
struct MotionAt {
  bool peak = false;     ///< the point of the largest displacement
  bool special = false;  ///< the special points of the curve
  /// > 0, frequencies (Hz) or amplitudes in the unit of reference_load(): each point at which the curve
  /// passes one of them.
  std::vector<double> places = {};

  bool empty() const { return !peak && !special && places.empty(); }
  bool operator==(const MotionAt&) const = default;
};

/// What is computed, and how finely it is written down.
struct Analysis {
  AnalysisType type = AnalysisType::forced_response;
  int output_points = 1024;  ///< uniform points of one period in the output

  int motion_points = -1;  ///< instants of the period at which the whole structure's motion is written
  /// forced_response, sweeps: whether the motion of the structure near the response, or near every point of
  /// the curve, is solved for by phases of contact
  bool phases = false;
  /// sweeps: whether the curve is that of the motions of the structure, followed by phases of contact
  bool exact = false;
  bool stability = true;  ///< forced_response, frequency_sweep: whether Floquet multipliers are counted
  /// sweeps, with stability: whether the points of the curve between which counts or contacts change are
  /// located
  bool special_points = true;
  /// forced_response, frequency_sweep: periods of the load after which motions repeat. Time's functions and
  /// points and output_points are then those of all of them.
  int subharmonic = 1;
  bool branches = false;  ///< frequency_sweep: whether curves that begin at special points are followed
  /// frequency_sweep: whether motions on no known curve are sought, at frequencies that are at most
  /// isola_spacing (Hz) apart, from rest and isola_starts random states, and their curves followed
  bool isolas = false;
  double isola_spacing = 0.0;
  int isola_starts = 4;

  double frequency_from = 0.0;  ///< Hz, frequency_sweep: where the branch starts
  double frequency_to = 0.0;    ///< Hz, frequency_sweep: where it ends; may lie below frequency_from
  double amplitude_from = 0.0;  ///< amplitude_sweep: the same in the unit of reference_load()
  double amplitude_to = 0.0;
  double first_step = 0.0;    ///< Hz, or the unit of the amplitude: first step along the branch
  double largest_step = 0.0;  ///< the same: no step along the branch is larger
  int max_points = 20000;     ///< frequency_sweep: the branch is given up after so many points
  MotionAt motion_at = {};    ///< frequency_sweep, amplitude_sweep

  std::vector<int> outputs = {};  ///< rows of matrices or nodes of a bar, from 1; -i: row i, downwards
  bool contact_outputs = false;   ///< whether each contact is an output, too
  bool has_outputs() const { return !outputs.empty() || contact_outputs; }
  int output_harmonics = 3;  ///< of the load, whose amplitudes and phases are written of each output
  std::string peak_of = {};  ///< sweeps: the output whose vibration is largest at the peak; or empty

  double tolerance = 1e-7;  ///< time_stepping: relative rms difference of two successive periods
  int max_periods = 5000;   ///< time_stepping: given up after so many periods

  int random_starts = 24;  ///< motions: random states from which the structure settles
  int seed = 20140817;     ///< motions: of these states
  int longest_period = 4;  ///< motions: periods of the load after which a motion may repeat

  int mode = 1;                   ///< nonlinear_mode: the linear mode that is continued, from 1
  int harmonics = 10;             ///< nonlinear_mode: N of the Fourier series
  int samples = 0;                ///< nonlinear_mode: m >= 2N uniform times at which contact is enforced
  bool cosine_only = false;       ///< nonlinear_mode: motions that are even in time only
  double reference_length = 0.0;  ///< nonlinear_mode: m, in place of the gap of a law that has none; 0: none
  double energy_ratio = 0.0;      ///< nonlinear_mode: the one motion of this energy; 0: the whole curve
  double largest_energy = 10.0;   ///< nonlinear_mode: energy ratio at which the curve ends
  double last_frequency_ratio = 0.0;  ///< nonlinear_mode: or frequency over the linear one; 0: any
  int points = 200;  ///< nonlinear_mode: uniform in frequency up to last_frequency_ratio or 1.3
  /// nonlinear_mode with friction or dampers, of the amplitude over that at which a contact first acts: the
  /// one motion there, 0 for the whole curve; and where the curve ends
  double amplitude_ratio = 0.0, largest_amplitude = 10.0;

  bool operator==(const Analysis&) const = default;
};

/// Where the curve of a sweep starts and ends, Hz, or amplitudes of the load.
std::pair<double, double> sweep_interval(const Analysis& analysis);

/// Everything that defines one computation. SI units. Read from a TOML file by load_scene(), written by
/// write_scene(); scene_keys() describes each entry.
struct Scene {
  Structure structure;
  Contact contact;
  Forcing forcing;
  Time time;
  Analysis analysis;

  bool operator==(const Scene&) const = default;
};

/// The name of an enumerator as it stands in a scene file.
std::string name_of(StructureType value);
std::string name_of(SolidElement value);
std::string name_of(TipPlace value);
std::string name_of(Direction value);
std::string name_of(ObstacleSide value);
std::string name_of(Formulation value);
std::string name_of(InnerProducts value);
std::string name_of(NyquistCoefficient value);
std::string name_of(AnalysisType value);
std::string name_of(TimeMethod value);
std::string name_of(LoadKind value);
/// Of the amplitude of a term: "N", "m", "m/s^2" or "kg m", mass times eccentricity of an unbalance.
std::string_view unit_of(LoadKind kind);

/// The files that a scene names: of its matrices, loads and laws. Absolute where the scene was loaded.
std::vector<std::string> input_files(const Scene& scene);

/// Whether no balance has its motions, which are solved for from event to event: of impacts beside other laws
/// or of a structure that is free to move, of friction of such a structure or of states alone, and of rigid
/// friction at a contact that keeps its mass, as it does where the scene names no bases.
bool moves_by_events(const Scene& scene);
/// Whether its motions are solved for by instants and impulses of impacts, which need no functions.
bool solves_by_impacts(const Scene& scene);

/// Whether its coexisting motions are sought from event to event.
bool seeks_by_events(const Scene& scene);
/// Whether analysis and method, which are read before contacts, ask for exact motions of other laws than
/// impacts.
bool names_exact_method(const Scene& scene);
/// Whether its motion is solved for exactly, without functions and points of its own: time.method, and
/// analysis.type = "shooting", which is another name for the same, "motions", and responses that
/// moves_by_events().
bool solves_by_phases(const Scene& scene);

/// At which matrices with gyroscopic or spin_stiffness turn, rad/s; 0 for other structures.
double spin_speed(const Scene& scene);

/// The load whose amplitude an amplitude sweep varies, with all others in proportion: Forcing::amplitude or,
/// where that is 0, the first term that is not static. Null without any.
struct ReferenceLoad {
  double amplitude;       ///< of the scene
  std::string_view unit;  ///< of unit_of()
};
std::optional<ReferenceLoad> reference_load(const Forcing& forcing);

/// The scene whose motions have `times` times the period: with as many times the quadrature and output
/// points, and the functions of as many times the harmonics, so that it has the scene's motions repeated.
Scene with_longer_period(Scene scene, int times);

/// Whether the mass of the contacts is redistributed: in responses and sweeps as contact.mass says, in modes
/// where it says redistribute.
bool redistributes_mass(const Scene& scene);

/// Number of coefficients of the Daubechies basis called `basis` ("daubechies6" gives 6), 0 for any other
/// basis. Throws std::invalid_argument if `basis` names no basis.
int daubechies_coefficients(const std::string& basis);
/// True for "haar", "bspline" and "daubechiesN", false for "fourier"; else throws std::invalid_argument.
bool is_wavelet(const std::string& basis);

}  // namespace wavebalance::app
