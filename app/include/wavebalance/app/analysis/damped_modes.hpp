#pragma once
#include <string>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/modes/damped_mode.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// A scene's nonlinear mode with friction or dampers. Immutable.
class DampedStudy {
 public:
  /// O(n^3). Throws as solvers::DampedMode does, and std::invalid_argument where no contact slips, opens
  /// or closes at any amplitude, so that there is none to begin at, or one does at all.
  DampedStudy(const Scene& scene, const StructureModel& model);

  const Scene& scene() const { return scene_; }
  const StructureModel& model() const { return model_; }
  const solvers::DampedMode& mode() const { return mode_; }
  /// m, at which a contact first slips, opens or closes
  double slip_amplitude() const { return slip_amplitude_; }

  /// From half the amplitude of first slip to `largest` times it.
  solvers::DampedBackbone curve(double largest, const solvers::Observer& observer) const;
  /// One period of the contacts at `points` uniform times.
  solvers::Motion contact_motion(const solvers::DampedPoint& point, int points) const;
  /// The same of `places`, rows times the degrees of freedom of the reduced structure, without forces. A
  /// condensation.
  solvers::Motion motion_of(const Eigen::MatrixXd& places, const solvers::DampedPoint& point,
                            int points) const;

 private:
  Scene scene_;
  StructureModel model_;
  solvers::DampedMode mode_;
  double slip_amplitude_;
};

/// amplitude_ratio, amplitude_m, frequency_Hz, frequency_ratio, damping_ratio, friction_work_J, the means
/// over contacts of stick_fraction, slip_fraction and open_fraction, all four only with friction, status,
/// residual; max_, min_, rms_ and max_abs_displacement_m of the contacts. O(points contacts output_points).
Table damped_table(const DampedStudy& study, const solvers::DampedBackbone& curve);

}  // namespace wavebalance::app
