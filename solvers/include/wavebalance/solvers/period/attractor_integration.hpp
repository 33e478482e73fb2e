#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers {

/// How a motion is integrated until it repeats.
struct AttractorOptions {
  /// Initial state of the n degrees of freedom, at a maximum of the load's first harmonic (m and m/s);
  /// empty: none. Modes that deflect statically and degrees of freedom without mass do not keep them.
  Eigen::VectorXd displacement{}, velocity{};
  int steps = 1024;         ///< per period of the load between contacts; in contact, as many as are needed
  int max_periods = 600;    ///< of the load
  int longest = 16;         ///< periods of the load after which a motion may repeat
  double tolerance = 1e-6;  ///< of the state after its period, in the energy norm, relative
  static constexpr int max_modes = 120;  ///< of the structure; the others deflect statically
  int max_size = 400;                    ///< degrees of freedom up to which the modes are computed
  double max_operations = 2.6e10;  ///< three to four seconds; 0.4 times as much for motions near returns
  int max_returns = 12;            ///< segments of the motion that are kept if it does not converge
  Observer observer;               ///< called once per period

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// The motion that time integration converges to.
struct AttractorMotion {
  static constexpr int unknown = -1;
  /// Periods of the load after which the motion repeats: 1 for a motion of the load's period, 2, 3, ... for
  /// subharmonic ones, 0 for none within the options' limits, in at least a hundred periods of each
  /// accuracy. -1 where it is not known: nothing could be integrated, the operations ran out before, or
  /// integrations of different accuracy disagree.
  int attractor_periods = unknown;
  int periods = 0;         ///< integrated
  bool cancelled = false;  ///< the observer stopped it
  bool grows = false;      ///< the motion leaves every bound
  double start = 0.0;      ///< periods of the problem after t = 0 at which the columns begin
  /// The contacts in the last period of the problem, C x steps load_periods(); without columns where nothing
  /// could be integrated.
  Motion last;
  /// Where the motion does not converge to one of the problem's period: the unstable motions of that period
  /// near states that nearly return after it, by Newton's method on the map of the period, and where that
  /// finds none, the piece of the motion that nearly returns [D. Auerbach et al., Phys. Rev. Lett.
  /// 58, 1987, doi:10.1103/PhysRevLett.58.2387].
  std::vector<Motion> returns;

  bool integrated() const { return !last.empty(); }
  /// Whether it has a period of so many of the load.
  bool repeats_after(int load_periods) const {
    return attractor_periods > 0 && load_periods % attractor_periods == 0;
  }
  /// One whose last motion is `piece`, which belongs to the returns.
  AttractorMotion at(Motion piece) const {
    AttractorMotion there;
    there.start = start;
    there.last = std::move(piece);
    return there;
  }
};

/// Integrates M u'' + C u' + K u = load - contact forces of `problem` (frequency set before) from the state
/// of the options, at a maximum of the load's first harmonic. A number of periods is one that two of three
/// integrations agree on, each with a hundredth of the error of the one before. With friction the first has
/// even steps, a quarter as many, and up to twice as many returns are kept; of a structure
/// that is free to move none is integrated. Throws std::invalid_argument for options out of range or not
/// finite. O(n^3) once, O(m^2 + C m) per step.
AttractorMotion settle(const CondensedProblem& problem, const ContactLaws& laws,
                       const AttractorOptions& options = {});

/// A row per contact of values at uniform steps of the period from `start` (periods) on, interpolated
/// linearly at `points` points from t = 0 on: the samples of a problem whose first one is there,
/// contact-major.
Eigen::VectorXd resample(const Eigen::MatrixXd& by_contact, int points, double start = 0.0);

}  // namespace wavebalance::solvers
