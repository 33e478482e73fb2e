#pragma once
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/modes/damped_mode.hpp"
#include "wavebalance/solvers/modes/elastic_mode.hpp"
#include "wavebalance/solvers/modes/nonlinear_mode.hpp"
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

/// Neighbouring points of a backbone that were not accepted.
struct Interruption {
  double first_ratio = 0.0;  ///< frequency over the linear one
  double last_ratio = 0.0;
  std::vector<std::string> resonances;  ///< internal resonances on it, "3:2" for harmonic 3 and linear mode 2
  std::string status;    ///< status of its first point that lies on no internal resonance; empty if all do
  bool bridged = false;  ///< accepted points with contact follow
};

/// A nonlinear mode over its frequency.
struct Backbone {
  std::vector<solvers::ModePoint>
      points;                     ///< with contact, in the order of their frequencies or of the curve
  std::vector<double> residuals;  ///< residuals of the equation of motion, see ModeStudy::residual()
  std::vector<Interruption> interruptions;
  double wall_seconds = 0.0;
  /// Where and why the curve ends before the energy that it was to reach; empty where it does not.
  std::string early_end;
  bool complete = true;  ///< it goes to that energy or to the last requested frequency

  int count(solvers::ModeStatus status) const;
  /// The branch is complete, and each interruption is on a named internal resonance.
  bool converged() const;
  /// "converged", early_end, or why the curve is not complete.
  std::string status() const;
};

/// Frequency over the linear one up to which points of a curve are spread where no last one is given.
inline constexpr double usual_frequency_ratio = 1.3;

/// How the curve of an elastic mode is followed, in steps of about the length of analysis.points.
solvers::ElasticBackboneOptions elastic_options(const Analysis& analysis, double largest_energy);

/// The curve of a rigid mode, solvers::backbone(), with uniform frequencies up to `last_ratio`. Where this is
/// 0 it goes on beyond usual_frequency_ratio, in intervals twice as long each of so many points, until its
/// motions have the energy or there are none.
std::vector<solvers::ModePoint> rigid_backbone(const solvers::NonlinearMode& mode, int points,
                                               double largest_energy, double last_ratio,
                                               const solvers::Observer& observer = {});

/// A scene's nonlinear mode and its linear modes, which are computed once. Immutable.
class ModeStudy {
 public:
  /// O(n^3). Throws std::invalid_argument for scenes that load_scene() would have rejected, and
  /// std::runtime_error if the linear modes are not found.
  explicit ModeStudy(const Scene& scene);
  /// The same for the scene's structure composed before.
  ModeStudy(const Scene& scene, StructureModel model);

  const Scene& scene() const { return scene_; }
  const StructureModel& model() const { return model_; }
  /// The mode with a rigid obstacle instead of the scene's law.
  const solvers::NonlinearMode& mode() const { return mode_; }
  /// The mode with the scene's law; empty where the obstacle is rigid.
  const std::optional<solvers::ElasticMode>& elastic_mode() const { return elastic_; }
  /// Unknowns after exact dynamic condensation.
  int unknowns() const;
  /// n x r, mass-normalised, of the (reduced) structure's own coordinates.
  const Eigen::MatrixXd& linear_shapes() const { return modes_.shapes; }
  const solvers::ModalModel& linear_modes() const { return modes_.model; }
  double linear_frequency() const;  ///< Hz

  /// The curve up to analysis.largest_energy or, where it is given, analysis.last_frequency_ratio.
  Backbone backbone(const solvers::Observer& observer = {}) const;
  /// The same up to another energy ratio.
  Backbone backbone(double largest_energy, const solvers::Observer& observer = {}) const;
  /// A point of the linear mode, energy ratio 0..1.
  solvers::ModePoint linear_mode(double energy_ratio) const;
  /// The branch below contact, energy ratios 0, 0.2, .., 1; empty where a law acts from rest on.
  std::vector<solvers::ModePoint> linear_points() const;
  /// The motion of an energy ratio > 0: the linear mode up to 1, beyond it a point of the curve.
  solvers::ModePoint at_energy(double energy_ratio) const;
  /// The same on a given curve of a mode with a rigid obstacle.
  solvers::ModePoint at_energy(const Backbone& curve, double energy_ratio) const;

  /// One period at `points` uniform times from the middle of the motion's symmetry on. The forces of a
  /// rigid obstacle are known at analysis.samples times only; each instant has the force of the nearest
  /// one. Empty unless the point is a solution. O(c N points).
  solvers::Motion contact_motion(const solvers::ModePoint& point, int points) const;
  /// The same of `places`, rows times the degrees of freedom of the reduced structure, without forces. O(rows
  /// (n r + N points)).
  solvers::Motion motion_of(const Eigen::MatrixXd& places, const solvers::ModePoint& point, int points) const;
  /// The same of all degrees of freedom; model().recover() gives the whole structure's displacements from
  /// these. O(n N points).
  solvers::Motion structure_motion(const solvers::ModePoint& point, int points) const;

  /// max over n of |K u_n - (n omega)^2 M u_n + e force_n| over the largest |K u_n|, in the (reduced)
  /// structure's coordinates; NaN without motion. With an elastic law it is relative to the motion. O(n N).
  double residual(const solvers::ModePoint& point) const;

 private:
  Scene scene_;
  StructureModel model_;
  StructureModes modes_;
  solvers::NonlinearMode mode_;
  std::optional<solvers::ElasticMode> elastic_;
};

/// "3:2"
std::string resonance_name(const solvers::InternalResonance& resonance);

/// One period of the motion with these amplitudes, as ModePoint has them (rows x (N + 1)), without forces.
solvers::Motion synthesised_motion(const Eigen::MatrixXcd& amplitudes, double omega, int points);

/// The extremes and the rms of the contacts' displacements u (contacts x instants), each at the contact where
/// it is largest, as columns of a table; missing without a motion.
void append_amplitudes(Summary& row, const Eigen::MatrixXd& u);

/// energy_ratio, frequency_Hz, frequency_ratio, rayleigh_frequency_ratio, contact_fraction, status,
/// residual, virial_residual, max_penetration_over_gap, min_contact_force_N, tongue, tongue_share: the
/// linear branch and the curve; with an elastic law also modal_energy_ratio; then max_, min_, rms_ and
/// max_abs_displacement_m of the contacts at analysis.output_points times, each of the contact where it is
/// largest (least). Values of points that are not solutions are missing.
Table backbone_table(const ModeStudy& study, const Backbone& curve);

}  // namespace wavebalance::app
