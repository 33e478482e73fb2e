#pragma once
#include <Eigen/Core>
#include <optional>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/structure/condensation.hpp"

namespace wavebalance::solvers::detail {

/// The structure, and where it is free to move with the springs ContactDynamics::holding() along all
/// contacts.
LinearStructure held_by_springs(const LinearStructure& structure, double holding);

/// The same at rest, where motions that no contact resists are held, too: a load that balances leaves their
/// position open. Nothing for a structure without such motions.
std::optional<LinearStructure> held_at_rest(const LinearStructure& structure, double holding);

/// How the contacts move without contact forces, with the springs ContactDynamics::holding(), over frequency
/// and size of the load. One object per thread.
class FreeContacts {
 public:
  /// `harmonics` as of CondensedProblem. O(n^3), or a reordering of the sparse matrices.
  FreeContacts(const LinearStructure& structure, Eigen::VectorXcd harmonics, double holding);

  /// C x (H + 1), m: column n belongs to Re(a exp(2 pi i n t)), t in periods. Frequency of the problem in
  /// Hz; every harmonic of the load but the static one is multiplied by `factor`. O(n^3) for each harmonic
  /// of the load.
  Eigen::MatrixXcd at(double frequency, double factor);

 private:
  LinearStructure structure_;
  Eigen::VectorXcd harmonics_;
  int repeats_;
  Condensation condensation_;
  std::optional<Condensation> at_rest_;  // of held_at_rest()
};

}  // namespace wavebalance::solvers::detail
