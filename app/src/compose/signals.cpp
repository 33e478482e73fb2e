#include "compose/compose_parts.hpp"

#include <cmath>
#include <numbers>

#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/contact/periodic_stiffness_law.hpp"

namespace wavebalance::app {
namespace {

/// The complex amplitudes of (k(t) / k - 1) signal_unit.
Eigen::VectorXcd signal_of(const contact::LawValues& values, double stiffness) {
  const std::vector<double>& harmonics = contact::list_of(values, "stiffness_harmonics");
  Eigen::VectorXcd signal = Eigen::VectorXcd::Zero(std::ssize(harmonics) + 1);
  for (std::size_t m = 0; m < harmonics.size(); ++m) {
    const double phase =
        values.contains("stiffness_phases") ? contact::list_of(values, "stiffness_phases")[m] : 0.0;
    signal[Eigen::Index(m) + 1] = contact::PeriodicStiffnessLaw::signal_unit * harmonics[m] / stiffness *
                                  std::polar(1.0, phase * std::numbers::pi / 180.0);
  }
  return signal;
}

void enlarge(Eigen::SparseMatrix<double>& matrix, Eigen::Index size) {
  if (matrix.size() > 0) matrix.conservativeResize(size, size);
}

void enlarge(Eigen::VectorXd& vector, Eigen::Index size) {
  vector.conservativeResizeLike(Eigen::VectorXd::Zero(size));
}

}  // namespace

void append_signals(solvers::LinearStructure& structure, const Scene& scene) {
  if (!names_signal(scene.contact)) return;
  const std::vector<SceneContact> contacts = contacts_of(scene);
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (is_signal(contacts[i])) rows.push_back(Eigen::Index(i));
  const Eigen::Index first = structure.size(), size = first + std::ssize(rows);
  for (auto* matrix : {&structure.mass, &structure.damping, &structure.stiffness,
                       &structure.turning.gyroscopic, &structure.turning.stiffness})
    enlarge(*matrix, size);
  enlarge(structure.load, size);
  for (solvers::PeriodicForce& force : structure.forces) enlarge(force.shape, size);
  if (structure.is_free())
    structure.rigid_modes.conservativeResizeLike(Eigen::MatrixXd::Zero(size, structure.rigid_modes.cols()));
  structure.contact_directions.conservativeResize(structure.contact_directions.rows(), size);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const contact::LawValues& values = contacts[std::size_t(rows[i])].values;
    const double stiffness = contact::number_of(values, "stiffness");
    const Eigen::Index own = first + Eigen::Index(i);
    structure.stiffness.coeffRef(own, own) = stiffness;
    structure.contact_directions.coeffRef(rows[i], own) = 1.0;
    structure.forces.push_back(
        {stiffness * Eigen::VectorXd::Unit(size, own), signal_of(values, stiffness), 0});
  }
  structure.contact_directions.makeCompressed();
}

void append_signals(StructureModel& model, const Scene& scene) {
  append_signals(model.structure, scene);
  for (Eigen::MatrixXd* matrix : {&model.recovery, &model.plane})
    if (matrix->size() > 0)
      matrix->conservativeResizeLike(Eigen::MatrixXd::Zero(matrix->rows(), model.size()));
}

}  // namespace wavebalance::app
