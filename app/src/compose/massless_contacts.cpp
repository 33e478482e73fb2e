#include "wavebalance/app/compose/compose.hpp"

#include "matrices/symmetric_part.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/solvers/structure/massless_contacts.hpp"

namespace wavebalance::app {

double frequency_change(const solvers::LinearStructure& from, const solvers::LinearStructure& to) {
  constexpr int first = 10, most = 1000;
  const auto moving = [](const solvers::LinearStructure& structure) {
    const Eigen::VectorXd masses = structure.mass.diagonal();
    return static_cast<int>((masses.array() != 0.0).count());
  };
  if (from.size() > most) return solvers::missing;
  const int count = std::min({first, moving(from), moving(to)});
  const Eigen::VectorXd before = fem::eigenmodes(symmetric_part(from.stiffness), from.mass, count).omega;
  const Eigen::VectorXd after = fem::eigenmodes(symmetric_part(to.stiffness), to.mass, count).omega;
  return ((after - before).cwiseAbs().array() / before.array()).maxCoeff();
}

void make_contacts_massless(StructureModel& model, int modes) {
  const solvers::LinearStructure& structure = model.structure;
  const auto all = fem::eigenmodes(symmetric_part(structure.stiffness), structure.mass, structure.size());
  if (all.status != fem::EigenmodesStatus::converged)
    throw std::runtime_error("contact.mass = \"redistribute\": the eigenvalue solver did not find all modes");
  solvers::MasslessContacts massless =
      solvers::with_massless_contacts(structure, modes, all.omega, all.shapes);
  model.structure = std::move(massless.structure);
  if (model.plane.size() > 0) model.plane = (model.plane * massless.recovery).eval();
  model.recovery =
      model.reduced() ? Eigen::MatrixXd(model.recovery * massless.recovery) : std::move(massless.recovery);
}

}  // namespace wavebalance::app
