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
  bool converged = true;        ///< of one at a requested place: whether Newton's method solved for it
  double residual = 0.0;        ///< relative
  solvers::Motion contacts;     ///< of all contacts, analysis.output_points points
  int contact = 0;              ///< the leading one, see leading_contact()
  Eigen::MatrixXd structure;    ///< of the reduced structure at analysis.motion_points instants, m; or empty
  Eigen::MatrixXd plane;        ///< of StructureModel::plane, 2 x output_points, m; or empty
  ResponseStability stability;  ///< with analysis.stability; else its status is empty
  /// With analysis.stability or analysis.phases; where it is not empty, the stability belongs to the motion
  /// found, and is not known if none is near.
  ExactAlongSweep::Point phases;
  /// Where it is known: the motion of the structure itself near this one, with its phases of contact.
  std::optional<solvers::ExactNearResponse> near;
};

/// The motions of analysis.motion_at: at the point with the largest displacement, at bifurcation and
/// grazing points in their order along the curve, and at all points with a given frequency or amplitude,
/// numbered if there are several. Branches are left out. A place that the curve does not pass has none.
/// `sweep` is one of the scene with motion_at. A response, its phases and its stability for each. If the
/// observer stops, the remaining ones are named in sweep.motions_left_out.
std::vector<CurveMotion> curve_motions(const Scene& scene, const StructureModel& model, Sweep& sweep,
                                       const Observer& observer = {});

}  // namespace wavebalance::app
