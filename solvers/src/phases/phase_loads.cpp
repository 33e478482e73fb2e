#include "phases/phase_loads.hpp"

#include <algorithm>
#include <vector>

#include "wavebalance/solvers/structure/periodic_force.hpp"

namespace wavebalance::solvers::detail {

Eigen::MatrixXcd loads_of(const CondensedProblem& problem, int repeats) {
  const LinearStructure& structure = problem.structure();
  const Eigen::VectorXcd& harmonics = problem.load_harmonics();
  std::vector<Eigen::VectorXcd> series{
      harmonics(Eigen::seqN(0, (harmonics.size() + repeats - 1) / repeats, repeats))};
  for (const PeriodicForce& force : structure.forces)
    series.push_back(force.amplitudes(repeats * problem.frequency()));
  Eigen::Index count = 1;
  for (const auto& load : series) count = std::max(count, load.size());
  Eigen::MatrixXcd loads = Eigen::MatrixXcd::Zero(Eigen::Index(series.size()), count);
  for (std::size_t l = 0; l < series.size(); ++l)
    loads.row(Eigen::Index(l)).head(series[l].size()) = series[l].transpose();
  loads.rightCols(count - 1) *= problem.load_factor();
  return loads;
}

LinearStructure held_by_springs(const LinearStructure& structure, double holding) {
  LinearStructure held = structure;
  if (!(holding > 0.0)) return held;
  const Eigen::SparseMatrix<double> springs =
      holding * structure.contact_directions.transpose() * structure.contact_directions;
  held.stiffness += springs;
  held.rigid_modes = {};
  return held;
}

}  // namespace wavebalance::solvers::detail
