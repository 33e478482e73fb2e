#pragma once
#include <Eigen/Core>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::blade {

/// A blade at any speed from one reduction at rest: its geometric stiffness and softening by rotation are
/// projected on the coordinates of the blade at rest, which one prestress solve gives for all speeds.
class RotatingBlade {
 public:
  /// The scene's blade, which must be at rest, about the axis of the scene. Throws std::invalid_argument.
  explicit RotatingBlade(const app::Scene& scene);

  const app::StructureModel& at_rest() const { return at_rest_; }
  /// The reduced blade at `speed`, rad/s. Its load, gaps and damping are those at rest: the gap is what the
  /// rotating blade has. O(r^2).
  app::StructureModel at(double speed) const;
  /// Largest static displacement under the centrifugal load at `speed`, m.
  double static_displacement(double speed) const { return speed * speed * unit_displacement_; }

 private:
  app::StructureModel at_rest_;
  Eigen::MatrixXd added_;           // of the reduced blade for 1 rad/s
  double unit_displacement_ = 0.0;  // m for 1 rad/s
};

}  // namespace wavebalance::blade
