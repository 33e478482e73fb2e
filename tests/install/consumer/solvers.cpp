#include <wavebalance/solvers/response/forced_response.hpp>
#include <wavebalance/spectral/fourier_basis.hpp>

// One degree of freedom at rest deflection: m u'' + c u' + k u = k cos(2 pi f t) far below resonance.
int main() {
  using namespace wavebalance;
  solvers::LinearStructure structure;
  for (auto* matrix : {&structure.mass, &structure.damping, &structure.stiffness}) matrix->resize(1, 1);
  structure.mass.insert(0, 0) = 1e-6;
  structure.damping.insert(0, 0) = 1e-6;
  structure.stiffness.insert(0, 0) = 1.0;
  structure.load = Eigen::VectorXd::Ones(1);
  structure.contact_directions = solvers::contact_rows({0}, 1);
  const spectral::FourierBasis basis(3);
  Eigen::VectorXcd load(2);
  load << 0.0, 1.0;
  solvers::CondensedProblem problem({basis, basis, {.quadrature_points = 8}}, structure, load);
  problem.set_frequency(0.1);
  const auto response = solvers::forced_response(problem, {}, {});
  return response.converged() && response.displacement.maxCoeff() < 1.001 ? 0 : 1;
}
