#pragma once
#include <Eigen/Core>
#include <complex>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::solvers {

/// An undamped structure in its linear modes, with the shapes at its contact degrees of freedom.
struct ModalModel {
  Eigen::VectorXd omega_squared;   ///< r, (rad/s)^2, ascending, > 0
  Eigen::MatrixXd contact_shapes;  ///< c x r, mass-normalised mode shapes at the contact degrees of freedom
  Eigen::VectorXd gaps;            ///< c, m, > 0: a contact degree of freedom may move up to +gap
  /// How many of the last modes are deflections of contacts without mass: springs, with frequencies so far
  /// beyond the others that they have no dynamics.
  int springs = 0;

  int contacts() const { return static_cast<int>(gaps.size()); }
  int modes() const { return static_cast<int>(omega_squared.size()); }
  /// Throws std::invalid_argument naming the member that does not fit.
  void validate() const;
};

/// How a point of a nonlinear mode was found, or why none was.
enum class ModeStatus {
  converged,          ///< gap >= 0, force >= 0, product 0 at every sample
  linear,             ///< below contact: the linear mode
  no_contact,         ///< the active set emptied: only the motion at rest was found
  cycling,            ///< the active set came back to itself
  singular,           ///< the compliance of the active samples is singular
  internal_resonance  ///< "tongue": complementarity holds, but on an internal resonance, ModePoint::resonance
};

std::string_view to_string(ModeStatus status);

/// An internal resonance: harmonic `harmonic` of the motion drives linear mode `mode` (both from 1), which
/// holds `share` of the kinetic energy.
struct InternalResonance {
  int harmonic = 0;
  int mode = 0;
  double share = 0.0;
};

/// A point is on an internal resonance if one higher harmonic n of one mode j has this share of the kinetic
/// energy, and |n omega - omega_j| is below resonance_detuning omega_j.
inline constexpr double resonance_share = 0.15, resonance_detuning = 0.1;

/// The discretisation of a nonlinear mode, and when a solution is accepted.
struct NonlinearModeOptions {
  int mode = 1;              ///< the linear mode that the nonlinear one continues, from 1
  int harmonics = 10;        ///< N, n = -N..N
  int samples = 20;          ///< m >= 2N, uniform times t_k = k T/m at which complementarity holds
  bool cosine_only = false;  ///< seek motions that are even in time: half the unknowns
  double tolerance = 1e-10;  ///< penetration over the gap that counts as contact
  int max_iterations = 200;  ///< exchanges of the active set, per number of harmonics

  /// Throws std::invalid_argument for a number out of its range, whatever the model.
  void validate() const;
};

/// A point of a nonlinear mode: the periodic motion of frequency omega with rigid contact,
///   u(t) = Phi sum_{n=-N..N} q_n exp(i n omega t),   q_-n = conj q_n,
/// Phi the mass-normalised mode shapes, c x r at the contacts. q_n is half of an amplitude in cos and sin:
/// the motion a cos(n omega t) + b sin(n omega t) has q_n = (a - i b)/2.
struct ModePoint {
  ModeStatus status = ModeStatus::no_contact;
  double omega = 0.0;             ///< rad/s
  int iterations = 0;             ///< exchanges of the active set, over all numbers of harmonics
  std::vector<int> active;        ///< contact * samples + time of the samples in contact
  Eigen::MatrixXd force;          ///< c x m, N, contact force at the samples
  Eigen::MatrixXcd amplitudes;    ///< r x (N+1), m sqrt(kg), q_n for n = 0..N
  double energy_ratio = 0.0;      ///< gamma over its value at linear grazing; elastic: see ElasticMode
  double rayleigh = 0.0;          ///< generalised Rayleigh quotient r, (rad/s)^2 [LL10, eq. (24a)]
  double virial_residual = 0.0;   ///< |omega^2 - r - mean(force) g0 / m| / omega^2, zero for exact ones
  double max_penetration = 0.0;   ///< over the gap, between the samples too
  double min_force = 0.0;         ///< N, the smallest force at a sample
  double contact_fraction = 0.0;  ///< share of the samples with contact of any degree of freedom
  InternalResonance resonance;    ///< the strongest internal resonance, whatever its share
  double gamma_ratio = 0.0;       ///< elastic modes: gamma over its value at linear grazing
  double residual = 0.0;          ///< elastic modes: of the balance, with the work of the sampled force
  Eigen::VectorXd unknown;        ///< elastic modes: the unknowns of the balance, scaled

  bool accepted() const { return status == ModeStatus::converged || status == ModeStatus::linear; }
};

/// Nonlinear modes with rigid (Signorini) contact, condensed on the contact force samples. At a fixed omega
/// the motion is u = -G(omega) force, G the undamped dynamic compliance between samples (N harmonics), and
///   gap - u >= 0,   force >= 0,   product 0   at each of the m samples
/// is a linear complementarity problem, solved by an active set that starts from the previous point. The
/// harmonic balance K u_n - n^2 omega^2 M u_n = -force_n [LL10, eq. (17a) with its errors removed] then
/// holds exactly for n = 0..N, and the energy is a result. Owns no plans; immutable, may be shared between
/// threads.
class NonlinearMode {
 public:
  /// Throws std::invalid_argument for a model or options out of range, options first. O(1).
  NonlinearMode(ModalModel model, NonlinearModeOptions options);

  const ModalModel& model() const { return model_; }
  const NonlinearModeOptions& options() const { return options_; }
  double linear_omega() const;    ///< rad/s, of the linear mode continued
  double grazing_energy() const;  ///< gamma = m/2 [LL10, eq. (12)] of the linear mode that just reaches a gap

  /// The motion at omega from an active set; empty: the grazing linear mode. O(active^3 + c^2 (r N + m)).
  ModePoint at_frequency(double omega, const std::vector<int>& active = {}) const;
  /// The same, solved with 2, 3, .., N harmonics in turn, each from the previous active set. This reaches the
  /// mode beyond an internal resonance, where continuation in omega leads onto the resonance.
  ModePoint at_frequency_by_harmonic_continuation(double omega) const;
  /// The linear mode at an energy ratio <= 1.
  ModePoint linear_mode(double energy_ratio) const;

 private:
  std::vector<int> grazing_samples() const;
  ModalModel model_;
  NonlinearModeOptions options_;
};

/// The frequencies of a backbone.
struct BackboneOptions {
  double first_ratio = 1.001;  ///< omega / linear omega of the first point
  double last_ratio = 1.3;     ///< omega / linear omega of the last point
  int points = 200;            ///< uniform in omega
  double max_energy = 10.0;    ///< the curve ends once the energy ratio is above
  /// Largest change of ln(energy ratio) between accepted neighbours. Above it a point is solved anew by
  /// harmonic continuation.
  static constexpr double max_jump = 0.25;
  Observer observer = {};  ///< called before each point; the curve ends when it returns false

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// The points of a mode over omega. Points that failed or lie on an internal resonance are kept with their
/// status. If the energy of a point differs by more than max_jump from its accepted neighbour, it is solved
/// anew by harmonic continuation; if it still does, the point is on another branch and has the status
/// internal_resonance.
std::vector<ModePoint> backbone(const NonlinearMode& mode, const BackboneOptions& options);

/// The point of prescribed energy ratio on a backbone, by false position in omega between the first accepted
/// neighbours that enclose it; the linear mode for ratios <= 1. Status no_contact when no neighbours enclose
/// it.
ModePoint at_energy(const NonlinearMode& mode, const std::vector<ModePoint>& points, double energy_ratio,
                    double tolerance = 1e-10);

}  // namespace wavebalance::solvers
