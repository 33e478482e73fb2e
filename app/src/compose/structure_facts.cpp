#include "compose/structure_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "compose/structure_files.hpp"
#include "compose/symmetric_part.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/fem/static_displacements.hpp"
#include "wavebalance/solvers/structure/condensation.hpp"

namespace wavebalance::app {
namespace {

/// phi^T C phi / (2 omega), the ratio to critical damping as far as C does not couple the modes.
Eigen::VectorXd damping_ratios_of(const Scene& scene, const StructureFiles& files,
                                  const fem::EigenmodesResult& modes) {
  const Structure& structure = scene.structure;
  if (structure.stiffness_damping > 0.0) return 0.5 * structure.stiffness_damping * modes.omega;
  Eigen::VectorXd ratios = Eigen::VectorXd::Constant(modes.omega.size(), structure.modal_damping);
  if (files.matrices.damping.size() == 0) return ratios;
  for (Eigen::Index mode = 0; mode < ratios.size(); ++mode) {
    const Eigen::VectorXd force = files.matrices.damping * modes.shapes.col(mode);
    ratios[mode] = modes.shapes.col(mode).dot(force) / (2.0 * modes.omega[mode]);
  }
  return ratios;
}

/// The scene with each of its pairs once.
Scene with_one_side(Scene scene) {
  for (ContactPair& pair : scene.contact.pairs) pair.side = ObstacleSide::positive;
  return scene;
}

/// The diagonal of S K^-1 S^T by an LU.
Eigen::VectorXd circulatory_compliances(const fem::Matrices& matrices,
                                        const solvers::ContactDirections& directions) {
  const Eigen::Index size = matrices.stiffness.rows();
  solvers::LinearStructure structure;
  structure.mass = matrices.mass;
  structure.damping.resize(size, size);
  structure.stiffness = matrices.stiffness;
  structure.load = Eigen::VectorXd::Zero(size);
  structure.contact_directions = directions;
  solvers::Condensation condensation(structure, solvers::CondensationMethod::sparse);
  return condensation.dynamic_compliance({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}).compliance.diagonal().real();
}

std::vector<std::string> names_of_contacts(const Scene& scene, const StructureFiles& files) {
  std::vector<std::string> names;
  for (const int dof : scene.structure.matrices.contact_dofs)
    names.push_back((dof < 0 ? "-" : "") + files.row_name(std::abs(dof) - 1));
  for (const ContactPair& pair : scene.contact.pairs) {
    std::vector<std::string> of_pair;
    for (const int dof : pair.dofs) of_pair.push_back(files.row_name(dof - 1));
    names.push_back(fmt::format("{}", fmt::join(of_pair, ", ")));
  }
  return names;
}

}  // namespace

StructureFacts structure_facts(const Scene& scene, int modes) {
  const auto files = structure_files(scene);
  const fem::Matrices& matrices = files->matrices;
  const auto size = static_cast<int>(matrices.stiffness.rows());
  const Eigen::SparseMatrix<double> elastic = symmetric_part(matrices.stiffness);
  const auto found = fem::eigenmodes(elastic, matrices.mass, std::min(modes, size));
  StructureFacts facts;
  facts.frequencies_hz = found.frequencies_hz;
  facts.damping_ratios = damping_ratios_of(scene, *files, found);
  const solvers::ContactDirections directions = contact_directions(with_one_side(scene), *files);
  const Eigen::MatrixXd loads = directions.transpose();
  if (solvers::is_symmetric(matrices.stiffness)) {
    const Eigen::MatrixXd displacements = fem::static_displacements(matrices.stiffness, loads);
    facts.compliances = loads.cwiseProduct(displacements).colwise().sum().transpose();
  } else {
    facts.compliances = circulatory_compliances(matrices, directions);
  }
  facts.contacts = names_of_contacts(scene, *files);
  return facts;
}

}  // namespace wavebalance::app
