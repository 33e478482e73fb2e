#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// A motion that a response or the first point of a sweep starts from.
struct StartMotion {
  std::string source;        ///< the file that holds it, for messages
  solvers::Motion contacts;  ///< displacement and force of all contacts; no velocity
  int periods = 1;           ///< of the load, over which it is given
  double frequency = 0.0;    ///< Hz, of a limit cycle 1 / its period; 0 where it is not known
};

/// Reads a motion from the results of a run: a folder with contacts.csv or response.csv, or one motion such
/// as DIR/motion_peak.csv, with DIR/motion_peak_contacts.csv for several contacts. summary.json in the same
/// folder has the number of forcing periods. Throws IoError, which names the motions of a folder that has
/// several, for missing and malformed files.
StartMotion read_start_motion(const std::filesystem::path& place);

/// Throws std::invalid_argument where a scene cannot start from this motion: an analysis without a start, a
/// tolerance instead of sizes, another number of contacts, or periods that do not divide
/// analysis.subharmonic. Empty motions fit everywhere.
void require_start_fits(const StartMotion& start, const Scene& scene);

/// Samples of a start at the scene's quadrature points, contact-major, repeated where the scene's motions
/// have more periods. Linear between the samples.
struct StartSamples {
  Eigen::VectorXd displacement;  ///< m
  Eigen::VectorXd force;         ///< N
};
StartSamples start_samples(const StartMotion& start, const Scene& scene);

}  // namespace wavebalance::app
