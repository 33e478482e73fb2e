#include "friction/rubbing_parts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "phases/phase_motion_parts.hpp"
#include "wavebalance/solvers/friction/friction_phases.hpp"

namespace wavebalance::solvers {
namespace detail {
namespace {

int piece_of(const RubbingPhase& phase) {
  if (phase.state != RubbingState::slip) return 1;
  return phase.sign < 0.0 ? 3 : 2;
}

// The tangential velocity over the normal one as a contact closes. That of contacts without mass jumps there.
double ratio_at(const PhaseMotion& motion, const RubbingContact& contact, double time) {
  constexpr double step = 1e-5;
  if (motion.parts->dynamics->constant().isZero(0.0)) {
    const Eigen::MatrixXd velocity = motion.velocity(Eigen::VectorXd::Constant(1, time));
    return velocity(contact.tangent, 0) / velocity(contact.normal, 0);
  }
  const Eigen::MatrixXd u = motion.displacement(Eigen::Vector3d(time - 2.0 * step, time - step, time));
  const Eigen::VectorXd moved = u * Eigen::Vector3d(1.0, -4.0, 3.0);
  return moved[contact.tangent] / moved[contact.normal];
}

FrictionPart part_of_motion(const RubbingLayout& layout, const RubbingPhase& phase) {
  const double begin = layout.begin(phase), whole = std::floor(begin);
  return {phase.state, begin - whole, layout.end(phase) - whole, phase.sign, 0.0};
}

void append_phases(PhaseMotion& motion, const RubbingContact& contact, const RubbingPhase& phase,
                   const FrictionPart& part) {
  if (phase.state == RubbingState::open) return;
  if (contact.has_normal()) motion.phases.push_back({contact.normal, 1, part.begin, part.end});
  motion.phases.push_back({contact.tangent, piece_of(phase), part.begin, part.end});
}

}  // namespace

void set_rubbing_parts(PhaseMotion& motion, const RubbingModel& model, const RubbingIterate& solved,
                       const LegendreNodes& nodes, const ContactDynamics& dynamics) {
  const CellGrid& grid = solved.forces.grid();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(nodes.count() * Index(grid.panels.size()));
  const PanelForces slopes(grid, nodes, none);
  motion.parts = std::make_shared<PhaseMotion::Parts>(
      PhaseMotion::Parts{model.poles, PhaseIterate{solved.layout.panels, solved.forces}, nodes, slopes,
                         slopes, std::make_shared<ContactDynamics>(dynamics)});
  for (const RubbingContact& contact : model.contacts)
    motion.friction.push_back({contact.row(), contact.constants, {}});
  for (const RubbingPhase& phase : solved.layout.phases) {
    const RubbingContact& contact = model.contacts[static_cast<std::size_t>(phase.contact)];
    FrictionPart part = part_of_motion(solved.layout, phase);
    if (phase.state == RubbingState::stick && !phase.always() && phase.sign == 0.0)
      part.ratio = ratio_at(motion, contact, part.begin);
    append_phases(motion, contact, phase, part);
    motion.friction[static_cast<std::size_t>(phase.contact)].parts.push_back(part);
  }
  for (FrictionAlong& along : motion.friction)
    std::sort(along.parts.begin(), along.parts.end(),
              [](const FrictionPart& a, const FrictionPart& b) { return a.begin < b.begin; });
  std::sort(motion.phases.begin(), motion.phases.end(), [](const ContactPhase& a, const ContactPhase& b) {
    return std::pair(a.contact, a.begin) < std::pair(b.contact, b.begin);
  });
}

}  // namespace detail

namespace {

// m, by which the slider moves in a part in which it slips.
double slip_of(const PhaseMotion& motion, const FrictionAlong& along, const FrictionPart& part) {
  const int tangent = along.row + along.constants.normal_rows;
  const Eigen::MatrixXd u = motion.displacement(Eigen::Vector2d(part.begin, part.end));
  const Eigen::VectorXd moved = u.col(1) - u.col(0);
  const double of_limit = along.constants.normal_rows > 0
                              ? part.sign * along.constants.friction * along.constants.normal_stiffness /
                                    along.constants.tangential_stiffness * moved[along.row]
                              : 0.0;
  return std::abs(moved[tangent] - of_limit);
}

// J, the integral of force times change of displacement: of the Legendre series f and u of a panel twice the
// sum of f_k u_j over j > k with j - k odd.
double friction_work(const PhaseMotion& motion, int tangent) {
  const detail::LegendreNodes nodes(96);
  const detail::PanelForces& forces = motion.parts->iterate.forces;
  double work = 0.0;
  for (std::size_t p = 0; p < forces.panels().size(); ++p) {
    const detail::Panel& panel = forces.panels()[p];
    if (panel.contact != tangent) continue;
    const Eigen::VectorXd times =
        0.5 * (panel.begin + panel.end) + 0.5 * panel.length() * nodes.points.array();
    const Eigen::VectorXd u = nodes.coefficients * motion.displacement(times).row(tangent).transpose();
    for (Index k = 0; k < forces.coefficients().rows(); ++k)
      for (Index j = k + 1; j < u.size(); j += 2) work += 2.0 * forces.coefficients()(k, Index(p)) * u[j];
  }
  return work;
}

}  // namespace

std::vector<FrictionCycle> friction_cycles(const PhaseMotion& motion) {
  if (motion.parts == nullptr) throw std::invalid_argument("friction_cycles: there is no motion");
  std::vector<FrictionCycle> cycles;
  for (const FrictionAlong& along : motion.friction) {
    FrictionCycle cycle{.row = along.row,
                        .work = friction_work(motion, along.row + along.constants.normal_rows)};
    for (const FrictionPart& part : along.parts) {
      const double length = part.end - part.begin;
      (part.state == FrictionPart::State::open    ? cycle.open_share
       : part.state == FrictionPart::State::stick ? cycle.stick_share
                                                  : cycle.slip_share) += length;
      if (part.state == FrictionPart::State::slip) cycle.slip += slip_of(motion, along, part);
    }
    cycles.push_back(cycle);
  }
  return cycles;
}

}  // namespace wavebalance::solvers
