#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "modes/exact_bar_mode.hpp"
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/report/artefact.hpp"

/// Common parts of the figures of Laxalde & Legrand (2010), section 5.1.
namespace wavebalance::ll10 {

using app::Series;
using app::Table;
using report::axis;

/// "laxalde_legrand_2010", "LL10 Fig. 3", ...
report::Identity identity(const std::string& number, const std::string& title, const std::string& stem);

/// The scene's bar for the exact solution.
RigidObstacleBar exact_bar(const app::Scene& scene);
/// Its exact mode 1 at an energy ratio of LL10's measure.
ExactBarMode exact_mode(const app::Scene& scene, double energy_ratio);

/// A motion over one period at all nodes x = 0, ..., length, the clamped one included, in the units of LL10's
/// pictures: displacements over the gap, velocities over gap times linear frequency (rad/s).
struct Motion {
  Eigen::VectorXd position;      ///< nodes, x over length
  Eigen::VectorXd time;          ///< t/T
  Eigen::MatrixXd displacement;  ///< nodes x times
  Eigen::MatrixXd velocity;      ///< nodes x times
  double frequency_ratio = 1.0;  ///< over the linear frequency of the continuous rod
  std::vector<double> contact;   ///< t/T of the samples in contact; of the exact motion its begin and end
};

/// The point of the scene's mode at an energy ratio, with contact in the middle of the time axis. Throws
/// report::NotConverged when there is none.
Motion computed_motion(const app::ModeStudy& study, double energy_ratio, int times);
/// The exact solution at the same nodes and times; below contact the linear mode of the bar.
Motion exact_motion(const app::Scene& scene, double energy_ratio, int times);

/// Largest distance of a history from its first harmonic, over its range: zero for an ellipse in phase space.
/// Its last value is the first of the next period.
double beyond_ellipse(const Eigen::VectorXd& history);

/// "10 harmonics, 20 samples, 20 elements"
std::string discretisation(const app::Scene& scene);

/// Adds the statement with its reason.
void judge(report::Artefact& artefact, report::Statement statement, const std::string& because);

/// Why the statements on the blade are judged apart.
inline constexpr const char* on_our_blade = "on our blade";

}  // namespace wavebalance::ll10
