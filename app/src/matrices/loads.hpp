#pragma once

#include "matrices/structure_files.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/structure/periodic_force.hpp"

namespace wavebalance::app {

/// A file of samples or a table of a term that cannot be read, and why.
class SamplesFault : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Where the terms of a scene's forcing act on its n degrees of freedom.
struct LoadPlaces {
  Eigen::VectorXd force;                  ///< n, of forcing.amplitude, for 1 N
  Eigen::VectorXd inertia;                ///< n, M r, kg, for a base of which all move alike
  const StructureFiles* files = nullptr;  ///< of matrices, whose terms have places
  double stiffness_damping = 0.0;         ///< s
  Eigen::MatrixXd carried = {};           ///< carried_rows()
};

/// The series of a term over a period of forcing.frequency: a harmonic, or samples by FFT. Throws
/// SamplesFault for a file that is not there, without numbers, or with fewer than two.
Eigen::VectorXcd harmonics_of(const ForcingTerm& term);

/// The columns of a file amplitude_table; empty without one.
struct AmplitudeTable {
  std::vector<double> frequencies, amplitudes, phases;  ///< Hz, 1, degrees: as many of each

  bool empty() const { return frequencies.empty(); }
};
/// Throws SamplesFault for a file that is not there, without these columns, with fewer than two rows or a
/// number that is not finite, and for frequencies that do not ascend.
AmplitudeTable amplitude_table(const std::string& file);
/// The table, if there is one, holds all frequencies of the scene. Throws SamplesFault.
void check_amplitude_table(const Scene& scene, const std::string& file);
/// Forcing::amplitude, or 0 where it follows a table, by which forces_of() has it.
double plain_amplitude(const Forcing& forcing);

/// The forces of the weight, of an amplitude by a table and of all terms; forces of the same shape are
/// added. Throws as harmonics_of().
std::vector<solvers::PeriodicForce> forces_of(const Forcing& forcing, const LoadPlaces& places);

}  // namespace wavebalance::app
