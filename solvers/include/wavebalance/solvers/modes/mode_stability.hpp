#pragma once
#include <Eigen/Core>
#include <complex>
#include <vector>

#include "wavebalance/solvers/linalg/missing.hpp"
#include "wavebalance/solvers/modes/elastic_mode.hpp"
#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::solvers {

/// When a multiplier of a free motion counts as unstable.
struct ModeStabilityOptions {
  /// Growth per period, |mu| - 1, up to which a multiplier counts as one of the unit circle: damping of the
  /// ratio growth / (2 pi) stops as much.
  double growth = 1e-3;
  double max_closure = 0.1;  ///< largest ModeStability::closure; beyond it the status is too_few_harmonics
  double tolerance =
      1e-5;  ///< of bifurcation and grazing points: width of a bracket over the distance of two points
  int max_states = 800;    ///< twice the modes up to which multipliers are computed, at O(states^3)
  Observer observer = {};  ///< called after each point of a backbone

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// The stability of a free motion.
struct ModeStability {
  StabilityStatus status = StabilityStatus::no_response;
  int unstable = -1;  ///< multipliers with |mu| > 1 + growth; -1 unless converged
  int contacts = 0;   ///< intervals of contact within the period, of all contacts
  /// All but the two that are 1, by falling modulus: two for each other mode. Empty unless converged.
  Eigen::VectorXcd multipliers;
  /// The relative distance between the motion's own velocity and its image under the map over a period: the
  /// error of the discretisation.
  double closure = 0.0;
  /// Twice the way that the closure has moved the first multiplier, a bound of its error where that is small.
  /// NaN without multipliers.
  double error = missing;
};

/// The Floquet multipliers of the free motions of an elastic mode. The variational equations M v'' + K v +
/// S^T D(t) S v = 0 are Hamiltonian: with mu its reciprocal and its conjugate are multipliers, and two are
/// 1, for the velocity (the phase) and for the change along the family (the energy). A motion is linearly
/// stable if all are on the unit circle; multipliers inside it have reciprocals outside.
///
/// The map over one period is monodromy(), symplectic for any D(t). It maps the velocity of an approximate
/// motion not quite onto itself, so that the pair at 1 would lie at 1 +- sqrt(error). The least Hamiltonian
/// rotation (a Cayley transform) that brings the velocity's image back is therefore applied after it, and
/// the phase and the energy are removed: the rest is the map on the complement of the velocity in the
/// symplectic form, by the velocity. It is symplectic again, so that simple multipliers stay on the circle.
///
/// Modes above the highest harmonic of the trial functions act as springs at the contacts. They follow the
/// force quasi-statically, and the motion has no harmonics for their parametric resonances.
///
/// Immutable; may be shared between threads.
class ModeMultipliers {
 public:
  /// Throws std::invalid_argument as options.validate() does.
  explicit ModeMultipliers(const ElasticMode& mode, ModeStabilityOptions options = {});

  /// The stability of one motion; the linear mode below contact has all multipliers on the circle. Cost of
  /// monodromy(). too_few_harmonics where the closure is above its limit, effort_limit where there are more
  /// than max_states states or contact is too stiff for the monodromy, no_finite_stiffness for a rigid law
  /// at contacts that have mass, none of ModalModel::springs.
  ModeStability operator()(const ModePoint& point) const;

  const ModeStabilityOptions& options() const { return options_; }

 private:
  ElasticMode mode_;
  ModeStabilityOptions options_;
};

/// Where multipliers leave the unit circle or return to it between two points of a backbone.
struct ModeSpecialPoint {
  SpecialPointType type = SpecialPointType::branch;  ///< fold: the energy reverses
  double omega = 0.0;                                ///< rad/s, in the middle of the bracket
  double bracket = 0.0;                              ///< rad/s, between its ends
  double energy_ratio = 0.0;                         ///< as ModePoint::energy_ratio
  std::complex<double> multiplier;  ///< on the unstable side the one that has left the circle last, Im >= 0
  bool located = false;             ///< to the tolerance; otherwise no motion within the bracket was found
};

/// The stability along a backbone.
struct BackboneStability {
  std::vector<ModeStability> points;  ///< one for each point of the backbone; fewer if cancelled
  std::vector<ModeSpecialPoint> special_points;
  bool cancelled = false;  ///< the observer returned false

  /// The status of the first point whose stability is not known; converged if there is none.
  StabilityStatus status() const;
};

/// The stability of every point of a backbone of `mode`, those on internal resonances too, and its
/// bifurcation and grazing points: where neighbours differ in the count, the curve between them is halved.
/// Two changes between neighbours that cancel each other are not noticed. One monodromy() per point, about 20
/// per bifurcation or grazing point.
BackboneStability backbone_stability(const ElasticMode& mode, const ElasticBackbone& backbone,
                                     const ModeStabilityOptions& options = {});

}  // namespace wavebalance::solvers
