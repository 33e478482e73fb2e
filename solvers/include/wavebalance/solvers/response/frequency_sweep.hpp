#pragma once
#include <functional>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/continuation/arc_length.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {

/// How a response curve ended.
enum class SweepStatus {
  reached_end,  ///< the curve left the frequency interval at its far end
  returned,     ///< the curve left the interval at the end where it started
  no_start,     ///< no periodic response was found at the first frequency
  closed,     ///< the curve came back to an earlier point of itself in the same direction, with shorter steps
              ///< and with every grazing event solved for, too
  lost,       ///< no further point was found, neither along the tangent nor at a grazing event
  unbounded,  ///< the response grew past all bounds, as at an undamped resonance: of a Nyquist coefficient
              ///< that the pair keeps
  point_limit,  ///< max_points was reached
  ended,        ///< SweepStart::ends
  cancelled     ///< the observer returned false
};

std::string_view to_string(SweepStatus status);

/// A point of a response curve. Each value is the largest among the contacts, but min_displacement, which is
/// the least.
struct SweepPoint {
  double frequency = 0.0;             ///< Hz, CondensedProblem::load_frequency()
  double max_displacement = 0.0;      ///< m, over output_points of the period
  double rms_displacement = 0.0;      ///< m
  double max_abs_displacement = 0.0;  ///< m
  double min_displacement = 0.0;      ///< m
  double max_force = 0.0;             ///< N, over the points and contacts; of laws on both sides the modulus
  double contact_fraction = 0.0;      ///< share of the quadrature points at which a contact has a force
  double residual = 0.0;              ///< relative
  bool grazing = false;               ///< a sample reaches its gap, so that the law's slope jumps
  Eigen::VectorXd unknown;            ///< PeriodicResponse::unknown; empty unless keep_unknowns
  double load_scale = 1.0;            ///< CondensedProblem::load_scale()
  double vibration = 0.0;             ///< m, half the peak-to-peak value
  double rms_vibration = 0.0;         ///< m, rms without the mean
};

/// The parameter that varies along a curve.
enum class SweepParameter { frequency, load_scale };

/// Half the peak-to-peak value, and the rms without the mean, of the row of displacements (rows x points)
/// that vibrates most. 0 without rows.
struct Vibration {
  double half_peak_to_peak = 0.0, rms = 0.0;
};
Vibration largest_vibration(const Eigen::MatrixXd& displacements);

/// The arc length's parameter of that kind.
const CurveParameter& curve_parameter(SweepParameter parameter);

/// The unit of a curve of the problem: Hz, or CondensedProblem::load_unit().
std::string_view unit_of(const CondensedProblem& problem, SweepParameter parameter);

/// The frequency (Hz) or load scale of a point or turning point, whichever varies.
template <class Point>
double parameter_of(const Point& point, SweepParameter parameter) {
  return parameter == SweepParameter::frequency ? point.frequency : point.load_scale;
}

/// The SweepPoint of a solution, with its unknown; the system is left at its frequency or load scale. O(C (N
/// log N + points log points)), and a condensation.
SweepPoint sweep_point(ContactSystem& system, TrialEvaluator& evaluator, const CurvePoint& point,
                       SweepParameter parameter = SweepParameter::frequency);

/// A point where the curve reverses in frequency or load scale: a smooth fold or a grazing event. With a
/// sampled stop each sample that touches gives a kink, and near folds the curve reverses at many of them.
struct TurningPoint {
  double frequency = 0.0;             ///< Hz
  double max_displacement = 0.0;      ///< m, as in SweepPoint
  double max_abs_displacement = 0.0;  ///< m
  bool grazing = false;               ///< as in SweepPoint
  double load_scale = 1.0;            ///< as in SweepPoint
};

/// Where a curve starts and ends, and how it is followed.
struct FrequencySweepOptions {
  double from = 0.0;         ///< Hz, of the load
  double to = 0.0;           ///< Hz, either side of `from`
  int output_points = 1024;  ///< times per period at which the maximum and the rms are taken
  int max_points = 20000;
  bool keep_unknowns = false;  ///< 8 bytes for each sample of each contact at each point
  /// Hz; turning points between which the frequency goes back by less are left out. 0 means a thousandth of
  /// the interval. Where grazing_events is not all, long steps may miss small ones, too.
  double smallest_return = 0.0;
  /// A displacement_scale of 0 means the largest gap, or without contact the rms response at `from`. A
  /// parameter_scale of 0 means a 20th of the interval.
  ArcLengthOptions arc_length{
      .displacement_scale = 0.0, .parameter_scale = 0.0, .grazing_events = GrazingEvents::automatic};
  ForcedResponseOptions start;  ///< the solver of the first point
  /// Called after each point with its frequency, and during the solution of the first. A curve that ends as
  /// unbounded is followed again with other steps, and its points are then counted anew; one that returns to
  /// itself is followed again from an earlier point.
  Observer observer;

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// A curve's first point where it is known.
struct SweepStart {
  PeriodicResponse response;  ///< at a frequency within the interval; the curve has its form
  /// The direction of the unknown in which the curve is followed, samples() values; empty: towards `to`.
  Eigen::VectorXd direction;
  /// Called after each step with the points before and after it; where it returns true, the curve ends with
  /// the former. Empty: the curve ends as any other.
  std::function<bool(const CurvePoint& before, const CurvePoint& after)> ends;
};

/// A curve of periodic responses.
struct FrequencySweep {
  SweepStatus status = SweepStatus::no_start;
  /// For a closed curve: whether it returned to its first point and is complete. Another earlier point is
  /// one at which curves cross, or after which a step has jumped.
  bool closed_at_start = false;
  SweepParameter parameter = SweepParameter::frequency;
  ContactForm form = ContactForm::displacement;  ///< of the whole curve
  Eigen::VectorXd series_flexibility;            ///< PeriodicResponse::series_flexibility of the whole curve
  std::vector<SweepPoint> points;
  std::vector<TurningPoint> turning_points;
  /// The largest Condensation::condition() of the curve's points and PeriodicResponse::condition of the
  /// first.
  double condition = 0.0;
  double rounding_error = 0.0;  ///< the largest CondensedProblem::rounding_error() of the curve's points
};

/// The curve of periodic responses over the forcing frequency [JL14, section 5.6], by arc length through
/// folds and grazing events, from `from` until it leaves the interval.
///
/// A long step may jump to another, closed curve. A curve that returns to an earlier point of itself, to
/// 1e-6 of arc length and in the same direction, is therefore followed again from before that point with
/// half and a quarter of the largest step, and then through every grazing event. If it still returns, it is
/// `closed`. It is compared with its points of number 2^n, so that a cycle is noticed before four times the
/// points up to the end of its first round have been computed.
///
/// Throws std::invalid_argument for
/// frequencies that are not positive, finite and different, and for laws that are neither one nor one per
/// contact. O(points (active^3 + N log N)).
FrequencySweep frequency_sweep(CondensedProblem& problem, const ContactLaws& laws,
                               const FrequencySweepOptions& options);

/// The same from a response that is known, `options.start` without effect. A response that has not converged
/// is no start. The curve may start between the ends of the interval, of which `from` is then the one at
/// which it has `returned`.
FrequencySweep frequency_sweep(CondensedProblem& problem, const ContactLaws& laws,
                               const FrequencySweepOptions& options, const SweepStart& start);

/// The curve of periodic responses over the amplitude of the load at the frequency of the problem, followed
/// in the same way: `from`, `to`, `smallest_return` and the parameter scale are values of
/// CondensedProblem::load_scale(), the factor on all of the load but its static part. The problem is left at
/// another one. Throws std::invalid_argument also for a problem without a frequency.
FrequencySweep amplitude_sweep(CondensedProblem& problem, const ContactLaws& laws,
                               const FrequencySweepOptions& options);
/// The same from a response that is known, as frequency_sweep() starts from one.
FrequencySweep amplitude_sweep(CondensedProblem& problem, const ContactLaws& laws,
                               const FrequencySweepOptions& options, const SweepStart& start);

}  // namespace wavebalance::solvers
