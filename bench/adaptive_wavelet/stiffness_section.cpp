#include "stiffness_section.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace wavebalance::bench {

solvers::SelectedBalance stiffness_section(const solvers::CondensedProblem& problem,
                                           const solvers::LinearStructure& structure,
                                           const solvers::MultiscaleBasis& basis,
                                           const solvers::Selection& selection) {
  const double frequency = problem.frequency();
  const solvers::TimePair& pair = problem.pair();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes{Eigen::MatrixXd(structure.mass),
                                                                        Eigen::MatrixXd(structure.stiffness)};
  const Eigen::MatrixXd& shapes = modes.eigenvectors();  // of unit modal stiffness
  const Eigen::VectorXd damping = (shapes.transpose() * (structure.damping * shapes)).diagonal();
  const Eigen::MatrixXd inertia = frequency * frequency * basis.section(pair.symbol(2), selection);
  const Eigen::MatrixXd resistance = frequency * basis.section(pair.symbol(1), selection);
  const Eigen::MatrixXd gram = basis.section(pair.symbol(0), selection);
  const Eigen::MatrixXd along = structure.contact_directions * shapes;
  Eigen::MatrixXd compliance = Eigen::MatrixXd::Zero(gram.rows(), gram.cols());
  for (Eigen::Index j = 0; j < damping.size(); ++j) {
    const double tip = along(0, j);
    const Eigen::MatrixXd stiffness = modes.eigenvalues()[j] * inertia + damping[j] * resistance + gram;
    compliance += tip * tip * stiffness.partialPivLu().inverse();
  }
  const Eigen::VectorXcd cosine =
      pair.load(Eigen::Vector2cd(0.0, (structure.contact_directions * structure.load)[0]));
  const Eigen::VectorXd all = basis.analysis(cosine);
  solvers::SelectedBalance balance{selection, {}, {}, basis.samples(selection)};
  balance.free = compliance * all(selection);
  balance.effect = balance.values * compliance.transpose() / double(basis.points());
  return balance;
}

}  // namespace wavebalance::bench
