#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "wavebalance/solvers/flow/contact_flow.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers {

/// How many periods of a motion in time pass by, and how many are recorded.
struct LongMotionOptions {
  int transient = 0;    ///< periods before the record
  int recorded = 512;   ///< periods of the record
  int points = 1;       ///< uniform samples of each of them, the first at its beginning
  bool growth = false;  ///< whether LongMotion::growth is measured
  Observer observer{};  ///< called after each period

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// Many periods of a motion in time, whatever it does.
struct LongMotion {
  FlowStatus ended = FlowStatus::converged;
  bool cancelled = false;
  /// Poincare section: the contacts at the beginning of each recorded period, R x periods, m and m/s.
  Eigen::MatrixXd displacement, velocity;
  /// For each recorded period the logarithm of the factor by which a small perturbation grew; their mean
  /// tends to the largest Lyapunov exponent, per period. Empty if not requested, and if the perturbation
  /// vanished, as when a contact comes to rest.
  std::vector<double> growth;

  int recorded() const { return static_cast<int>(displacement.cols()); }
};

/// Continues a flow, and calls `visit` after each recorded period with its samples; the flow then holds the
/// events and cycles of that period. A perturbation is carried along and scaled after each period [G.
/// Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, Meccanica 15, 1980, doi:10.1007/BF02128236], through
/// events by saltation, and begins some periods before the record, so that it has turned into the direction
/// that grows most. Throws std::invalid_argument for options out of range. The perturbation adds less than
/// half of the cost of the flow's periods.
LongMotion long_motion(ContactFlow& flow, const LongMotionOptions& options,
                       const std::function<void(const ContactFlow&, const Motion&)>& visit = {});

/// The highest and the lowest displacement of each row over a recorded period: of its samples, and of its
/// impacts, which are between them.
struct Reach {
  Eigen::VectorXd highest, lowest;
};
Reach reach_of(const ContactFlow& flow, const Motion& period);

/// 2 R x periods: displacements, and below them velocities over the angular frequency, which `frequency` (Hz)
/// makes lengths, too.
Eigen::MatrixXd section_points(const LongMotion& motion, double frequency);

/// The least number p <= longest of periods after which all points of the section come back, to `tolerance`
/// of the size of the motion; 0 without one. `length` (m) is the least size, velocities count by `frequency`
/// (Hz) of the period. The record must have more than p periods.
int section_period(const LongMotion& motion, int longest, double tolerance, double length, double frequency);

}  // namespace wavebalance::solvers
