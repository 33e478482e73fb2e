#pragma once
#include <string>

namespace wavebalance::reproduce {

enum class StructureType { bar };
enum class ContactLawType { none, exponential, linear, rigid };
enum class Formulation { strong, weak, distributional };
enum class InnerProducts { quadrature, exact };
enum class ModeFormulation { consistent, published };
enum class AnalysisType { forced_response, frequency_sweep, time_stepping, nonlinear_mode };

/// The vibrating structure: an axial bar, clamped at x = 0, whose tip x = length may touch an obstacle [JL14,
/// Fig. 1].
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

  bool operator==(const Structure&) const = default;
};

/// The contact force at the tip as a function of its displacement u; zero for u < gap. Rigid contact has no
/// such function: u <= gap, force >= 0, product 0.
struct Contact {
  ContactLawType law = ContactLawType::none;
  double constant = 0.0;   ///< N, > 0, a_c of the exponential law [JL14, eq. (5)]
  double exponent = 0.0;   ///< 1/m, > 0, alpha of the exponential law
  double stiffness = 0.0;  ///< N/m, > 0, slope of the linear law
  double gap = 0.0;        ///< m, displacement at which contact starts

  bool operator==(const Contact&) const = default;
};

/// The force amplitude * cos(2 pi frequency t) at the tip. Nonlinear modes do not use it.
struct Forcing {
  double amplitude = 0.0;  ///< N
  double frequency = 0.0;  ///< Hz, > 0; a frequency sweep does not use it

  bool operator==(const Forcing&) const = default;
};

/// The discretisation of one period. Basis names: "fourier", "haar", "bspline", "daubechies<even number >=
/// 2>". Time stepping and nonlinear modes do not use it.
struct Time {
  std::string trial;
  std::string weight;
  int functions = 0;  ///< trial functions, >= 1; a power of two when a wavelet basis takes part
  Formulation formulation = Formulation::distributional;
  int quadrature_points = 0;  ///< uniform points of one period, >= functions
  InnerProducts inner_products = InnerProducts::quadrature;

  bool operator==(const Time&) const = default;
};

/// What is computed, and how finely it is written down.
struct Analysis {
  AnalysisType type = AnalysisType::forced_response;
  int output_points = 1024;  ///< uniform points of one period in the output

  double frequency_from = 0.0;  ///< Hz, frequency_sweep: where the branch starts
  double frequency_to = 0.0;    ///< Hz, frequency_sweep: where it ends; may lie below frequency_from
  double first_step = 0.0;      ///< Hz, frequency_sweep: first step along the branch
  double largest_step = 0.0;    ///< Hz, frequency_sweep: no step along the branch is larger
  int max_points = 20000;       ///< frequency_sweep: the branch is given up after so many points

  double tolerance = 1e-7;  ///< time_stepping: relative rms difference of two successive periods
  int max_periods = 5000;   ///< time_stepping: given up after so many periods

  ModeFormulation formulation = ModeFormulation::consistent;  ///< nonlinear_mode
  int mode = 1;                       ///< nonlinear_mode: the linear mode that is continued, from 1
  int harmonics = 10;                 ///< nonlinear_mode: N of the Fourier series
  int samples = 0;                    ///< nonlinear_mode: m >= 2N uniform times at which contact is enforced
  bool cosine_only = false;           ///< nonlinear_mode: motions that are even in time only
  double energy_ratio = 0.0;          ///< nonlinear_mode: the one motion of this energy; 0: the whole curve
  double largest_energy = 10.0;       ///< nonlinear_mode: energy ratio at which the curve ends
  double last_frequency_ratio = 1.3;  ///< nonlinear_mode: or frequency over the linear one
  int points =
      200;  ///< nonlinear_mode: uniform in frequency up to last_frequency_ratio; published: in energy

  bool operator==(const Analysis&) const = default;
};

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
std::string name_of(ContactLawType value);
std::string name_of(Formulation value);
std::string name_of(InnerProducts value);
std::string name_of(ModeFormulation value);
std::string name_of(AnalysisType value);

/// Number of coefficients of the Daubechies basis called `basis` ("daubechies6" gives 6), 0 for any other
/// basis. Throws std::invalid_argument if `basis` names no basis.
int daubechies_coefficients(const std::string& basis);

/// True for "haar", "bspline" and "daubechiesN", false for "fourier". Throws std::invalid_argument for other
/// names.
bool is_wavelet(const std::string& basis);

}  // namespace wavebalance::reproduce
