#pragma once

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Facts by which a user of matrices checks units, boundary conditions and files.
struct StructureFacts {
  int rigid_motions = 0;  ///< at 0 Hz, of a structure that is free to move
  Eigen::VectorXd
      frequencies_hz;  ///< of the first other linear modes without contact, by M and the symmetric part of K
  Eigen::VectorXd damping_ratios;  ///< phi^T C phi / (2 omega) of each
  /// m/N: static displacement along each direction of contact per force there; none of a structure that is
  /// free.
  Eigen::VectorXd compliances;
  std::vector<std::string> contacts;  ///< one per compliance: "node 7 z", "row 20", "node 7 z, node 9 z"
};

/// The names of contact degrees of freedom of a scene of matrices, each pair once: "node 7 z".
std::vector<std::string> contact_names(const Scene& scene);

/// Facts of a scene of matrices with at most `modes` modes: a pair with obstacles on both sides is one
/// contact. Two sparse factorisations and one per repeated count of modes. Throws std::domain_error, and
/// StructureFault as structure_files() does.
StructureFacts structure_facts(const Scene& scene, int modes = 5);

}  // namespace wavebalance::app
