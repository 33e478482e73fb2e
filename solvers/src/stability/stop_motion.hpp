#pragma once
#include <map>
#include <optional>
#include <vector>

#include "stability/linear_stops.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers::detail {

/// The exact periodic motion of a structure between linear stops.
struct StopMotion {
  std::vector<double> instants;  ///< periods, at which stops close or open, ascending
  Eigen::MatrixXd map;           ///< of perturbations of the real states of all poles over a period
  /// Relative rms distance of the displacements of the contacts from those it was sought near.
  double distance = 0.0;
};

/// A motion near which an exact one is sought.
struct NearMotion {
  const std::vector<ContactInterval>& intervals;
  const Eigen::MatrixXcd& contact_free;  ///< C x (H + 1), m: FreeContacts::at()
  double frequency;                      ///< Hz
  const Eigen::MatrixXd& displacement;   ///< N x C, m, at the times first + l / N in periods
  double first;
};

/// Finds exact motions of a structure between linear stops, which is linear between two instants at which a
/// stop closes or opens: exact in all modes however stiff the stops. Newton's method on the instants, u = gap
/// there, in the order that the start has; where the motion found then opens or closes a stop elsewhere,
/// these instants join. Samples that look for them are the closer, the nearer the last instant is, since
/// there the fastest mode rings. One object per thread.
class StopMotions {
 public:
  /// Keeps a reference to the dynamics, which must not be those of a structure that is held or reduced.
  StopMotions(const ContactDynamics& dynamics, LinearStops stops);

  /// Nothing where Newton's method or the order of the instants does not settle. O(instants S^3) for each of
  /// about ten steps, S states.
  std::optional<StopMotion> near(const NearMotion& start);

  /// The structure while these stops are closed; null where it has no modes.
  const HeldByStops* held(const std::vector<int>& closed);
  const LinearStops& stops() const { return stops_; }
  /// S x C: what impulses at the contacts take from the states.
  const Eigen::MatrixXd& struck() const { return struck_; }

 private:
  const ContactDynamics& dynamics_;
  LinearStops stops_;
  Eigen::MatrixXd struck_;
  std::map<std::vector<int>, std::optional<HeldByStops>> held_;
};

}  // namespace wavebalance::solvers::detail
