#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/scene/analysis.hpp"
#include "wavebalance/app/scene/contact.hpp"
#include "wavebalance/app/scene/forcing.hpp"
#include "wavebalance/app/scene/structure.hpp"
#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::app {

using solvers::Formulation;
using solvers::InnerProducts;
using solvers::NyquistCoefficient;

/// Method of a response, time.method: harmonic or wavelet balance in a pair of bases, or the exact periodic
/// solution.
enum class TimeMethod { balance, exact };
/// Fourier functions of the harmonic balances used as starts of exact solutions, in turn until one
/// succeeds.
inline constexpr std::array exact_starts{63, 127, 255, 511};
/// Default of time.tolerance for exact solutions.
inline constexpr double default_exact_tolerance = 1e-9;

/// The discretisation of one period. Basis names: "fourier", "haar", "bspline", "daubechies<even number >=
/// 2>". Time stepping and nonlinear modes with rigid contact do not use it. A tolerance replaces functions
/// and quadrature_points, which are then chosen, and so are trial and weight if they are missing.
struct Time {
  std::string trial;
  std::string weight;
  int functions = 0;  ///< trial functions, >= 1; a power of two with a wavelet basis
  Formulation formulation = Formulation::distributional;
  int quadrature_points = 0;  ///< uniform points of one period, >= functions
  InnerProducts inner_products = InnerProducts::quadrature;
  NyquistCoefficient nyquist = NyquistCoefficient::drop;  ///< of an even number of functions
  double sample_offset = 0.0;  ///< 0 or 0.5, of the points t_k = (k + sample_offset) / quadrature_points
  double tolerance = 0.0;      ///< > 0: relative rms error of the tip displacement to be met; 0: none
  TimeMethod method = TimeMethod::balance;  ///< forced_response

  bool operator==(const Time&) const = default;
};

/// How results are drawn.
struct Plot {
  bool log = false;  ///< ordinates of curves over frequency, amplitude or energy are logarithmic

  bool operator==(const Plot&) const = default;
};

/// Everything that defines one computation. SI units. Read from a TOML file by load_scene(), written by
/// write_scene(); scene_keys() describes each entry.
struct Scene {
  Structure structure;
  Contact contact;
  Forcing forcing;
  Time time;
  Analysis analysis;
  Plot plot;

  bool operator==(const Scene&) const = default;
};

/// The name of an enumerator in a scene file.
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

/// The files that a scene names: of its matrices, loads and laws. Absolute where the scene was loaded.
std::vector<std::string> input_files(const Scene& scene);

/// The file of a path that may name a matrix in it, "job.pch" of "job.pch#KAAX".
std::string file_of_input(const std::string& path);

/// Whether its motions are solved for from event to event, because harmonic balance does not support them:
/// limit cycles; impacts in addition to other laws; impacts or friction of a free structure; friction laws
/// of states only; rigid friction at a contact that keeps its mass, as it does if the scene names no bases.
bool moves_by_events(const Scene& scene);
/// Whether its motions are solved for by instants and impulses of impacts, which need no functions.
bool solves_by_impacts(const Scene& scene);

/// Whether coexisting motions are searched for by event-driven integration.
bool seeks_by_events(const Scene& scene);
/// Whether analysis and method, which are read before contacts, request exact motions of other laws than
/// impacts.
bool names_exact_method(const Scene& scene);
/// Whether its motion is solved for exactly, without basis functions: time.method, its alias analysis.type
/// = "shooting", "motions", and responses that moves_by_events().
bool solves_exactly(const Scene& scene);

/// At which matrices with gyroscopic or spin_stiffness turn, rad/s; 0 for other structures.
double spin_speed(const Scene& scene);
/// Whether these matrices follow the frequency along a curve.
bool turns_along_curve(const Scene& scene);

/// The scene whose motions have `times` times the period: with as many times the quadrature and output
/// points, and the functions of as many times the harmonics, so that it has the scene's motions repeated.
Scene with_longer_period(Scene scene, int times);

/// Whether the contact mass is redistributed: by contact.mass, in modes only for redistribute.
bool redistributes_mass(const Scene& scene);

/// Number of coefficients of the Daubechies basis called `basis` ("daubechies6" gives 6), 0 for any other
/// basis. Throws std::invalid_argument if `basis` names no basis.
int daubechies_coefficients(const std::string& basis);
/// True for "haar", "bspline" and "daubechiesN", false for "fourier"; else throws std::invalid_argument.
bool is_wavelet(const std::string& basis);

}  // namespace wavebalance::app
