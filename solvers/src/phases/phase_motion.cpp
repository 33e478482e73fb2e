#include <algorithm>
#include <complex>

#include "linalg/dense.hpp"
#include "phases/phase_motion_parts.hpp"

namespace wavebalance::solvers {

Eigen::MatrixXd PhaseMotion::displacement(const Eigen::VectorXd& times) const {
  return parts->model.motion(parts->iterate.forces, parts->nodes, times).displacement;
}

Eigen::MatrixXd PhaseMotion::velocity(const Eigen::VectorXd& times) const {
  return parts->model.frequency * parts->model.motion(parts->iterate.forces, parts->nodes, times).velocity;
}

Eigen::MatrixXd PhaseMotion::force(const Eigen::VectorXd& times) const {
  Eigen::MatrixXd forces = detail::force_at(parts->iterate.forces, parts->model, times);
  if (parts->model.holding() > 0.0) forces += parts->model.holding() * displacement(times);
  return forces;
}

bool PhaseMotion::depends_on_velocity() const { return parts != nullptr && parts->model.velocity; }

Eigen::VectorXcd PhaseMotion::multipliers(int max_states) const {
  Eigen::VectorXcd values = parts->model.response.free_multipliers();
  if (!parts->iterate.forces.panels().empty()) {
    const Eigen::MatrixXd map = detail::monodromy_of(parts->model, parts->iterate, parts->nodes);
    const bool computed = map.rows() <= max_states && map.allFinite();
    values = computed ? detail::eigenvalues(map) : Eigen::VectorXcd();
  }
  if (!values.allFinite()) return {};
  std::sort(values.begin(), values.end(),
            [](std::complex<double> a, std::complex<double> b) { return std::abs(a) > std::abs(b); });
  return values;
}

bool PhaseMotion::is_rigid() const {
  return parts != nullptr && std::any_of(parts->model.laws.begin(), parts->model.laws.end(),
                                         [](const detail::LawPieces& law) { return law.rigid(); });
}

double PhaseMotion::tangent(int contact, double time) const {
  return parts->tangent.at(contact, time) + parts->model.holding();
}

double PhaseMotion::damping(int contact, double time) const { return parts->damping.at(contact, time); }

}  // namespace wavebalance::solvers
