#pragma once

#include "wavebalance/app/analysis/motions.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/analysis/whirl.hpp"
#include "wavebalance/app/attractors/bifurcation.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/drawing/stability_figure.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/modes/mode_stability.hpp"

/// Panels of one motion in addition to its displacement and force.
namespace wavebalance::app {

/// Whirl frequencies over the speed by their direction, the line on which both are equal, and the critical
/// speeds on it.
Figure campbell_figure(const CampbellDiagram& diagram);

/// Displacements of the section over frequency or amplitude as dots, over them the exact curve, dashed where
/// it is unstable, and below the period found at each value. Without panels where there is no value.
Figure diagram_figure(const Diagram& diagram);

/// Figures of a motion that did not repeat: the Poincare section and the power spectral density of its
/// leading place.
std::vector<Panel> recorded_panels(const RecordedMotion& motion);

/// An output of a mode as pictures draw it.
struct ModeOutput {
  Output output;
  /// Half its peak-to-peak value where contacts begin to act; not a number where that is not known.
  double at_onset = std::numeric_limits<double>::quiet_NaN();
};

/// Frequency over energy from a backbone_table(): accepted points, the root of the generalised Rayleigh
/// quotient, and points on internal resonances as marks. The output that leads comes before it.
Figure backbone_figure(const Scene& scene, const Table& backbone, const ModeOutput* leading = nullptr);

/// Frequency and damping ratio from a damped_table(), over the amplitude or the vibration of the output that
/// leads.
Figure damped_figure(const Scene& scene, const Table& backbone, const ModeOutput* leading = nullptr);

/// Frequency and, where the table has it, damping ratio over the vibration of each output.
Figure outputs_figure(const Scene& scene, const Table& backbone, const std::vector<ModeOutput>& outputs);

/// Draws the stability of a backbone_table(), unstable parts dashed, in each panel of a figure of it, whose
/// first series are frequencies, with the bifurcation and grazing points.
void draw_stability(Figure& figure, const Table& backbone, const solvers::BackboneStability& stability);

/// The period that a picture of a motion shows. It begins half way between two contacts, so that no contact
/// is cut in two by the edges of the picture.
class PeriodWindow {
 public:
  /// The window of the first contact of `response`; from 0 on if it is always open or always closed, or if
  /// the motion does not repeat.
  explicit PeriodWindow(const Response& response);

  /// Where it begins, in [-0.5, 0.5), a multiple of 1 / points.
  double start() const { return start_; }
  Axis axis() const;  ///< "Time (fraction of a period)"
  /// `values` at uniform instants of the period from 0 on, with the first one again at the end where the
  /// motion repeats.
  Series curve(const Eigen::VectorXd& values) const;
  /// A fraction of the period as the instant of the window.
  double instant(double fraction) const;
  /// From `begin` to `end` >= begin, in one part, or in two where it passes the end of the window.
  std::vector<std::pair<double, double>> spans(double begin, double end) const;

 private:
  int periods_;
  bool repeats_;
  double start_ = 0.0;
};

/// A row of samples of a period, times `factor`, with the first one again at the end.
Eigen::VectorXd once_around(const Eigen::MatrixXd& rows, int row, double factor);

/// Where the contact that `response` leads with is closed, by the exact motion. Nothing of one that never
/// opens.
std::vector<std::pair<double, double>> contact_spans(const Scene& scene, const Response& response,
                                                     const PeriodWindow& window);

/// Adds the loops of friction force over tangential displacement of the contacts that dissipate most, and a
/// map of what each contact does over the period. Nothing without friction.
void add_friction(Figure& figure, const Scene& scene, const Response& response, const PeriodWindow& window);

/// The velocity of a contact over the period, sampled at uniform instants (m/s), with both values at each of
/// its impacts, so that these are drawn as jumps.
void add_velocity_with_jumps(Figure& figure, const PeriodWindow& window, const std::string& title,
                             const std::vector<solvers::Impact>& all, int contact,
                             const Eigen::VectorXd& velocity);

/// The impulses of a contact as lines at their instants.
void add_impulses(Figure& figure, const PeriodWindow& window, const std::string& title,
                  const std::vector<solvers::Impact>& all, int contact);

/// All coexisting motions of one contact, the first motion's leading one, over time and as velocity over
/// displacement; dashed where they are unstable. Without panels where there is no motion.
Figure motions_figure(const Scene& scene, const Motions& all);

/// The path of a point in a plane over one period of its motion, at uniform times from 0 on.
struct Orbit {
  std::string motion;    ///< which of several motions it is of; empty for the only one
  Eigen::VectorXd x, y;  ///< m
};

/// The orbits of all motions in one plane.
struct OrbitPlane {
  std::string title;
  double clearance;  ///< m, radius of a ring about the origin; NaN without
  std::vector<Orbit> orbits;
};

/// y over x of each plane, with its clearance circle, a mark at t = 0 and an arrow along the motion there.
Figure orbits_figure(const std::vector<OrbitPlane>& planes);

/// Outputs that one picture shows, a panel each.
inline constexpr std::size_t most_drawn_outputs = 12;
/// Those whose harmonics are drawn.
inline constexpr std::size_t most_drawn_harmonics = 4;

/// Half the peak-to-peak value of each output along a sweep, its branches and isolas: the vibration apart
/// from what static loads deflect. Dashed where motions are unstable.
Figure outputs_figure(const Sweep& sweep, const SweepOutputs& outputs,
                      const std::vector<SceneContact>& contacts);

/// "Vibration of row 19", "Velocity of row 3".
std::string vibration_title(const Output& output);

/// Takes the amplitudes over which `figure` draws a sweep to a readable multiple of their unit.
void scale_amplitudes(Figure& figure, const SweepAxis& axis);

/// The vibration along a sweep, its branches and isolas with their bifurcation and grazing points: half the
/// peak-to-peak value and the rms without the mean, of an output or, without one, of the contact that
/// vibrates most, whose displacement has the unit `of_contacts`.
Panel vibration_panel(const Sweep& sweep, const SweepOutputs& outputs, std::optional<std::size_t> output,
                      const std::string& of_contacts);

/// Each output over one period, which a response has; `motion` is outputs x points.
Figure outputs_figure(const std::vector<Output>& outputs, const Eigen::MatrixXd& motion,
                      const PeriodWindow& window);

/// Displacement, velocity and contact force over one period. The title of an iterate that did not converge
/// has its status, and the curves are dashed and grey.
Figure response_figure(const Scene& scene, const Response& response);

/// The motion of a nonlinear mode at `frequency`, Hz.
Figure motion_figure(const Scene& scene, const Response& response, double frequency);

/// How a scene is solved and of which size, as titles of its pictures begin.
std::string method_title(const Scene& scene);

/// A sweep over its frequency or amplitude, with its bifurcation and grazing points. The first panel is the
/// vibration of the first output or of analysis.peak_of. Without outputs it is the vibration of the
/// contacts if static loads, preloads or a rigid obstacle dominate their largest displacement. The largest
/// and rms displacement of the contacts follow with their gap, and with impacts their impulses and speeds.
Figure sweep_figure(const Scene& scene, const Sweep& sweep, const SweepOutputs& outputs = {});

/// One of the curves of a sweep as pictures draw it.
struct SweepLine {
  std::string name;       ///< "branch 1", "isola 1"; empty of the curve of the sweep itself
  std::string long_name;  ///< "branch 1, 2 periods"
  const solvers::FrequencySweep& curve;
  StabilityAlong stability;
  const std::vector<solvers::SpecialPoint>& special_points;
  const std::vector<MeasuredPoint>* measured;  ///< of its outputs; null where there are none
  Colour colour;

  bool is_unstable() const;
  /// Half the peak-to-peak value at each point, or the rms without the mean, of an output or else of the
  /// contacts.
  std::vector<double> vibration(std::optional<std::size_t> output, bool rms = false) const;
  /// The amplitude of harmonic `n` of the load, from 1, of an output at each point.
  std::vector<double> harmonic(std::size_t output, int n) const;
  /// `values` at its points, times `factor`, over its frequencies or amplitudes.
  Series series(const std::string& label, const std::vector<double>& values, double factor) const;
  /// Its bifurcation and grazing points at the ordinates that `height` has for them.
  std::vector<PlacedPoint> placed(const std::function<double(const solvers::SpecialPoint&)>& height) const;
};

/// The curve of a sweep, its branches and its isolas, which `sweep` and `outputs` hold.
std::vector<SweepLine> lines_of(const Sweep& sweep, const SweepOutputs& outputs = {});

}  // namespace wavebalance::app
