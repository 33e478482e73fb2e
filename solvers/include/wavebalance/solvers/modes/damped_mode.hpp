#pragma once
#include <Eigen/Core>
#include <memory>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"
#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::solvers {

/// How far a damped mode is followed, and by which steps.
struct DampedBackboneOptions {
  double first_amplitude = 0.0;  ///< m, > 0: where the curve starts
  double last_amplitude = 0.0;   ///< m, above it: where it ends
  double initial_step = 0.05;    ///< arc length, equal to ln(amplitude) while shape and frequency stay
  double min_step = 1e-6;        ///< below it the curve is lost
  double max_step = 0.1;         ///< of the same
  static constexpr double frequency_scale =
      0.2;                   ///< a change of omega or xi over the linear omega by this has the length 1
  double tolerance = 1e-10;  ///< on the relative residual of the balance
  int max_points = 5000;     ///< the curve ends after so many points
  Observer observer = {};    ///< called before each point; the curve ends when it returns false

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// How the curve of a damped mode ended.
enum class DampedBackboneStatus {
  reached_amplitude,  ///< at last_amplitude
  lost,               ///< no further point was found, or the amplitude fell below the first one
  no_start,           ///< no point was found at first_amplitude
  point_limit,        ///< after max_points
  cancelled           ///< the observer returned false
};

std::string_view to_string(DampedBackboneStatus status);

/// A motion of a damped mode.
struct DampedPoint {
  double amplitude = 0.0;        ///< m, see DampedMode
  double omega = 0.0;            ///< rad/s
  double xi = 0.0;               ///< 1/s: C - xi M leaves the motion periodic
  double residual = 0.0;         ///< relative, of the balance
  int iterations = 0;            ///< Newton steps
  Eigen::MatrixXd displacement;  ///< C x N, m, of the contacts at the samples, with that at rest
  Eigen::MatrixXd force;         ///< C x N, N

  double damping_ratio() const { return xi / (2.0 * omega); }
};

/// The points of a damped mode in the order of the curve.
struct DampedBackbone {
  DampedBackboneStatus status = DampedBackboneStatus::no_start;
  std::vector<DampedPoint> points;
};

struct DampedProblem;

/// Nonlinear modes of structures that lose energy: frequency and damping over amplitude by the extended
/// periodic motion concept [M. Krack, Comput. Struct. 154, 2015, doi:10.1016/j.compstruc.2015.03.008]. The
/// free motion is made periodic by a damping -xi M that supplies the dissipated energy:
///
///   M q'' + (C - xi M) q' + K q + S^T f(S q) = static loads,   damping ratio xi / (2 omega).
///
/// The artificial damping acts on all harmonics, so that xi is the damping of a motion in which one mode
/// dominates. The family continues linear mode m of the structure at rest under its static loads, contacts
/// with the slopes that they have there: a contact with friction sticks. Any laws with a finite force,
/// friction and laws of the velocity, too, and any pair of bases with at least 3 functions.
///
/// The amplitude A is the first harmonic of the modal coordinate of mode m, times the largest displacement
/// among the contacts that its shape has: A is the amplitude of that contact as long as the shape equals
/// the linear mode. The phase is such that this harmonic is a cosine.
///
/// Immutable, may be shared between threads. A Newton step costs O((C M)^3 + M n^3).
class DampedMode {
 public:
  /// `mode` from 1. Throws std::invalid_argument for a mode out of range or one that moves no contact, for a
  /// rigid law, a law of the velocity where the trial functions have no derivative at points, matrices of
  /// mass and stiffness that are not symmetric, and a structure that is not held, also not by its contacts at
  /// rest; std::runtime_error where no state of rest or no linear modes are found. O(n^3).
  DampedMode(const LinearStructure& structure, const TimePair& pair, ContactLaws laws, int mode = 1);

  double linear_omega() const;          ///< rad/s, of linear mode m
  double linear_damping_ratio() const;  ///< xi / (2 omega) of it, where damping does not couple modes
  int unknowns() const;
  /// The amplitude up to which all laws are linear along the linear mode, m: that at which a contact first
  /// slips, opens or closes. 0 where they are not at any amplitude, infinite where they always are.
  double linear_amplitude() const;

  /// The curve between two amplitudes. Throws as the options' validate() does.
  DampedBackbone backbone(const DampedBackboneOptions& options) const;

  /// Amplitudes q_n, n = 0..N, of `places` (rows times the structure's degrees of freedom) in a motion of
  /// this mode, places x (N + 1), as ModePoint has them, with the state of rest: the structure follows the
  /// forces of its contacts by dynamic condensation at each harmonic, in which mode m at the first is
  /// given. N is half the number of samples unless the trial basis is Fourier. O(M n^3).
  Eigen::MatrixXcd amplitudes(const DampedPoint& point, const Eigen::MatrixXd& places) const;

 private:
  std::shared_ptr<const DampedProblem> problem_;
};

}  // namespace wavebalance::solvers
