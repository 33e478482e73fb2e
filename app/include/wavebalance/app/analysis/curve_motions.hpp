#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"

namespace wavebalance::app {

/// The motion of one point of a sweep.
struct CurveMotion {
  std::string name;    ///< "motion_peak", "motion_fold_1", "motion_150Hz_2": its files without their ending
  std::string at;      ///< "peak", the solvers::SpecialPointType, "frequency" or "amplitude"
  double place = 0.0;  ///< of the load: its frequency (Hz), or its amplitude in an amplitude sweep
  bool converged = true;        ///< of one at a place asked for: whether Newton's method solved for it
  double residual = 0.0;        ///< relative
  solvers::Motion contacts;     ///< of all contacts, analysis.output_points points
  int contact = 0;              ///< the leading one, see leading_contact()
  Eigen::MatrixXd structure;    ///< of the reduced structure at analysis.motion_points instants, m; or empty
  Eigen::MatrixXd plane;        ///< of StructureModel::plane, 2 x output_points, m; or empty
  ResponseStability stability;  ///< with analysis.stability; else its status is empty
  /// With analysis.stability or analysis.phases; where it is not empty, the stability is that of the motion
  /// found, or not known where there is none near.
  ExactAlongSweep::Point phases;
  /// Where it is known: the motion of the structure itself near this one, with its phases of contact.
  std::optional<solvers::ExactNearResponse> near;
};

/// The motions of analysis.motion_at: that of the point with the largest displacement, those of the
/// bifurcation and grazing points in their order along the curve, and at each frequency or amplitude those of
/// all its points, in the same order and numbered if there are several. Those of the branches are left out. A
/// place that the curve does not pass has none. `sweep` is one of the scene with motion_at. A response, its
/// phases and its stability for each. Where the observer stops them, the others are left out and named in
/// sweep.motions_left_out.
std::vector<CurveMotion> curve_motions(const Scene& scene, const StructureModel& model, Sweep& sweep,
                                       const Observer& observer = {});

}  // namespace wavebalance::app
