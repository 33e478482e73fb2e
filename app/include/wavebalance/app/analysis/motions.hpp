#pragma once
#include <map>
#include <string>
#include <vector>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/problem/coexisting_motions.hpp"

namespace wavebalance::app {

/// One of the motions of a frequency, as it is written.
struct FoundMotion {
  solvers::CoexistingMotion found;
  solvers::Motion contacts;   ///< of all contacts, analysis.output_points points of its whole period
  int contact = 0;            ///< the leading one, see leading_contact()
  Eigen::MatrixXd structure;  ///< of the reduced structure at analysis.motion_points instants, m; or empty
};

/// The motions at forcing.frequency.
struct Motions {
  /// solvers::MotionsStatus, or solvers::ExactStatus if event-driven integration does not converge.
  std::string status = "not_settled";
  std::vector<FoundMotion> motions{};
  std::vector<solvers::UnsolvedMotion> unsolved{};
  int starts = 0, none = 0;  ///< as of solvers::CoexistingMotions
  std::map<std::string, int>
      none_by_status{};  ///< of motions from event to event, `none` by what starts ended with
  std::vector<solvers::BoxSide> box{};
  double wall_seconds = 0.0;  ///< composition, search and samples
};

/// solvers::coexisting_motions() of a scene with analysis.type = "motions".
Motions coexisting_motions(const Scene& scene, const StructureModel& model,
                           const solvers::Observer& observer = {});

}  // namespace wavebalance::app
