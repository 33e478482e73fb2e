#pragma once
#include <vector>

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/problem/coexisting_motions.hpp"

namespace wavebalance::app {

/// One of the motions of a frequency, as it is written.
struct FoundMotion {
  solvers::CoexistingMotion found;  ///< of scenes with impacts without its motion by phases
  std::optional<solvers::ImpactResponse> impacts = {};  ///< of scenes with impacts
  int iterations = 0, unknowns = 0;                     ///< of Newton's method
  double residual = std::numeric_limits<double>::quiet_NaN();
  solvers::Motion contacts;   ///< of all contacts, analysis.output_points points of its whole period
  int contact = 0;            ///< the leading one, see leading_contact()
  Eigen::MatrixXd structure;  ///< of the reduced structure at analysis.motion_points instants, m; or empty
};

/// The motions at forcing.frequency.
struct Motions {
  std::string status = "not_settled";  ///< solvers::MotionsStatus, or with impacts solvers::ImpactStatus
  std::vector<FoundMotion> motions{};
  std::vector<solvers::UnsolvedMotion> unsolved{};
  int starts = 0, none = 0;                     ///< as of solvers::CoexistingMotions
  std::map<std::string, int> none_by_status{};  ///< with impacts, `none` by what the starts ended with
  std::vector<solvers::BoxSide> box{};
  double wall_seconds = 0.0;  ///< composition, search and samples
};

/// solvers::coexisting_motions() of a scene with analysis.type = "motions", with contact.restitution
/// solvers::impact_motions().
Motions coexisting_motions(const Scene& scene, const StructureModel& model,
                           const solvers::Observer& observer = {});

}  // namespace wavebalance::app
