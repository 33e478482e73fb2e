#include "rotating_blade.hpp"

#include <stdexcept>

#include "wavebalance/fem/centrifugal.hpp"

namespace wavebalance::blade {

RotatingBlade::RotatingBlade(const app::Scene& scene) : at_rest_(app::make_model(scene)) {
  const auto& blade = scene.structure.blade;
  if (at_rest_.blade == nullptr || !at_rest_.reduced() || blade.rotation_speed != 0.0)
    throw std::invalid_argument("RotatingBlade: the scene's structure is not a reduced blade at rest");
  const fem::SolidModel& solid = at_rest_.blade->model;
  const auto& axis = blade.rotation_axis;
  const auto centrifugal =
      fem::centrifugal_stiffness(solid, fem::solid_matrices(solid).stiffness,
                                 {{axis[0], axis[1], axis[2]}, {0.0, 0.0, -blade.hub_radius}});
  const Eigen::SparseMatrix<double> added = centrifugal.geometric - centrifugal.softening;
  added_ = at_rest_.recovery.transpose() * (added * at_rest_.recovery);
  unit_displacement_ = solid.displacements(centrifugal.displacement).colwise().norm().maxCoeff();
}

app::StructureModel RotatingBlade::at(double speed) const {
  app::StructureModel model = at_rest_;
  const Eigen::MatrixXd stiffness = Eigen::MatrixXd(model.structure.stiffness) + speed * speed * added_;
  model.structure.stiffness = (0.5 * (stiffness + stiffness.transpose())).sparseView();
  return model;
}

}  // namespace wavebalance::blade
