#include "stability/friction_monodromy.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "stability/monodromy_map.hpp"
#include "stability/pole_states.hpp"
#include "stability/smooth_pieces.hpp"

namespace wavebalance::solvers {
namespace {

using State = FrictionPart::State;

bool acts(const PeriodicStiffness& stiffness, int contact, double time) {
  return std::ranges::any_of(stiffness.intervals, [&](const ContactInterval& one) {
    return one.contact == contact && lies_in(one, time);
  });
}

// Instants at which any contact changes what it does, and the ends of the period.
std::vector<double> cuts_of(const PeriodicStiffness& stiffness) {
  std::vector<double> cuts{0.0, 1.0};
  const auto add = [&](double time) { cuts.push_back(time - std::floor(time)); };
  for (const FrictionAlong& contact : stiffness.friction)
    for (const FrictionPart& part : contact.parts) add(part.begin);
  for (const ContactInterval& interval : stiffness.intervals) {
    add(interval.begin);
    add(interval.end);
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

// The local laws of the contacts, f = stiffness u - slider w.
struct LocalLaw {
  Eigen::MatrixXd stiffness;  // C x C, N/m
  Eigen::MatrixXd slider;     // C x C, N/m, diagonal
};

class FrictionPropagator {
 public:
  FrictionPropagator(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness, double period)
      : dynamics_(dynamics),
        stiffness_(stiffness),
        period_(period),
        states_(dynamics, period),
        displaced_(states_.free_motion(0.0)),
        struck_(states_.after_impulse(0.0)) {}

  Eigen::MatrixXd map() const {
    const Index size = states_.size() + contacts();
    Eigen::MatrixXd map = Eigen::MatrixXd::Identity(size, size);
    const std::vector<double> cuts = cuts_of(stiffness_);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double before = i > 0 ? 0.5 * (cuts[i - 1] + cuts[i]) : 0.5 * (cuts[cuts.size() - 2] + 1.0);
      set_sliders(cuts[i], law_at(before), map);
      map = detail::product(over(cuts[i], cuts[i + 1]), map);
    }
    return map;
  }

 private:
  Index contacts() const { return dynamics_.contacts(); }

  LocalLaw law_at(double time) const {
    LocalLaw law{-dynamics_.holding() * Eigen::MatrixXd::Identity(contacts(), contacts()),
                 Eigen::MatrixXd::Zero(contacts(), contacts())};
    for (int c = 0; c < contacts(); ++c)
      if (acts(stiffness_, c, time)) law.stiffness(c, c) += stiffness_.tangent(c, time);
    for (const FrictionAlong& contact : stiffness_.friction)
      add_friction(contact, contact.part_at(time), law);
    return law;
  }

  void add_friction(const FrictionAlong& contact, const FrictionPart& part, LocalLaw& law) const {
    if (part.state == State::open) return;
    const FrictionConstants& constants = contact.constants;
    const Index tangent = contact.row + constants.normal_rows;
    if (constants.normal_rows > 0) law.stiffness(contact.row, contact.row) += constants.normal_stiffness;
    if (part.state == State::slip) {
      if (constants.normal_rows > 0)
        law.stiffness(tangent, contact.row) += part.sign * constants.friction * constants.normal_stiffness;
      return;
    }
    for (Index i = tangent; i < tangent + constants.tangents; ++i) {
      law.stiffness(i, i) += constants.tangential_stiffness;
      law.slider(i, i) = constants.tangential_stiffness;
    }
  }

  // Forces over states and sliders: u = displaced a - G f, f = D u - S w.
  Eigen::MatrixXd forces(const LocalLaw& law) const {
    Eigen::MatrixXd matrix = detail::product(law.stiffness, dynamics_.constant());
    matrix.diagonal().array() += 1.0;
    Eigen::MatrixXd right(contacts(), states_.size() + contacts());
    right << detail::product(law.stiffness, displaced_), -law.slider;
    return detail::Lu<double>(matrix).solve(right);
  }

  Eigen::MatrixXd displacements(const LocalLaw& law) const {
    Eigen::MatrixXd result = -detail::product(dynamics_.constant(), forces(law));
    result.leftCols(states_.size()) += displaced_;
    return result;
  }

  Eigen::MatrixXd exponential(double begin, double end) const {
    const Index size = states_.size();
    Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(size + contacts(), size + contacts());
    rate.topLeftCorner(size, size) = states_.generator();
    rate.topRows(size) -= detail::product(struck_, forces(law_at(0.5 * (begin + end))));
    return detail::exponential((end - begin) * period_ * rate);
  }

  bool is_constant(double begin, double end) const {
    for (int c = 0; c < contacts(); ++c) {
      const double middle = 0.5 * (begin + end);
      if (!acts(stiffness_, c, middle)) continue;
      const double at = stiffness_.tangent(c, middle);
      for (const double share : {0.25, 0.75})
        if (std::abs(stiffness_.tangent(c, begin + share * (end - begin)) - at) > 1e-12 * std::abs(at))
          return false;
    }
    return true;
  }

  // The mid-point rule in parts, extrapolated, until it changes little.
  Eigen::MatrixXd over(double begin, double end) const {
    Eigen::MatrixXd before = exponential(begin, end);
    if (stiffness_.intervals.empty() || is_constant(begin, end)) return before;
    constexpr int most = 1 << 12;
    constexpr double settled = 1e-9;
    Eigen::MatrixXd extrapolated = before;
    for (int parts = 2; parts <= most; parts *= 2) {
      Eigen::MatrixXd now = Eigen::MatrixXd::Identity(before.rows(), before.cols());
      for (int i = 0; i < parts; ++i)
        now = detail::product(
            exponential(begin + (end - begin) * i / parts, begin + (end - begin) * (i + 1) / parts), now);
      const Eigen::MatrixXd next = (4.0 * now - before) / 3.0;
      const double change = (next - extrapolated).norm();
      extrapolated = next;
      before = std::move(now);
      if (change <= settled * extrapolated.norm()) return extrapolated;
    }
    return Eigen::MatrixXd::Constant(before.rows(), before.cols(), missing);
  }

  // The sliders from `time` on: of contacts that begin to stick from the displacements just before. Those
  // that are not stuck, or always, have no part in the perturbation.
  void set_sliders(double time, const LocalLaw& before, Eigen::MatrixXd& map) const {
    Eigen::MatrixXd sliders = Eigen::MatrixXd::Zero(contacts(), map.cols());
    for (const FrictionAlong& contact : stiffness_.friction) {
      const FrictionPart& part = contact.part_at(time);
      if (part.state != State::stick || contact.always_sticks()) continue;
      const FrictionConstants& constants = contact.constants;
      const Index tangent = contact.row + constants.normal_rows;
      sliders.middleRows(tangent, constants.tangents) =
          map.middleRows(states_.size() + tangent, constants.tangents);
      if (part.begin != time) continue;
      const Eigen::MatrixXd moved = detail::product(displacements(before), map);
      const double ratio = part.sign != 0.0 ? part.sign * constants.friction * constants.normal_stiffness /
                                                  constants.tangential_stiffness
                                            : part.ratio;
      for (Index row = tangent; row < tangent + constants.tangents; ++row) {
        sliders.row(row) = moved.row(row);
        if (constants.normal_rows > 0) sliders.row(row) -= ratio * moved.row(contact.row);
      }
    }
    map.bottomRows(contacts()) = sliders;
  }

  const ContactDynamics& dynamics_;
  const PeriodicStiffness& stiffness_;
  double period_;
  PoleStates states_;
  Eigen::MatrixXd displaced_, struck_;
};

}  // namespace

Eigen::VectorXcd friction_monodromy(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                    double frequency) {
  return detail::map_multipliers(FrictionPropagator(dynamics, stiffness, 1.0 / frequency).map());
}

}  // namespace wavebalance::solvers
