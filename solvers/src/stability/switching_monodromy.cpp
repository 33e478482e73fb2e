#include "stability/switching_monodromy.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "stability/pole_states.hpp"
#include "stability/smooth_segments.hpp"

namespace wavebalance::solvers {
namespace {

using State = FrictionPart::State;

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
  for (const StiffnessCut& cut : stiffness.cuts) add(cut.time);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

// The laws of all contacts, f = D u - S w.
struct LocalLaw {
  Eigen::VectorXd own;  // N/m, the diagonal of D
  struct Coupling {
    Index force, displacement;
    double slope;  // N/m
  };
  std::vector<Coupling> couplings;  // the other entries of D
  struct Slider {
    Index contact, number;
    double stiffness;  // N/m
  };
  std::vector<Slider> stuck;
  std::vector<int> rows;  // of the contacts whose forces change

  // The rows of D times a matrix that has a row for each contact.
  Eigen::MatrixXd slopes_times(const Eigen::MatrixXd& motion) const {
    Eigen::MatrixXd all = own.asDiagonal() * motion;
    for (const Coupling& one : couplings) all.row(one.force) += one.slope * motion.row(one.displacement);
    return all(rows, Eigen::all);
  }
};

// Map of a segment of the period for states and the sliders that are stuck in it.
struct SegmentMap {
  Eigen::MatrixXd states, sliders;

  double norm() const { return std::hypot(states.norm(), sliders.norm()); }
  SegmentMap after(const SegmentMap& first) const {
    return {detail::product(states, first.states), detail::product(states, first.sliders) + sliders};
  }
};

class SwitchingPropagator {
 public:
  SwitchingPropagator(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness, double period,
                      double settled)
      : dynamics_(dynamics),
        stiffness_(stiffness),
        period_(period),
        settled_(settled),
        states_(dynamics, period),
        displaced_(states_.free_motion(0.0)),
        struck_(states_.after_impulse(0.0)) {
    for (const FrictionAlong& contact : stiffness.friction) {
      slider_of_.push_back(sliders_);
      if (!contact.always_sticks()) sliders_ += contact.constants.tangents;
    }
  }

  Eigen::MatrixXd map() const {
    const Index states = states_.size(), size = states + sliders_;
    Eigen::MatrixXd map = Eigen::MatrixXd::Identity(size, size);
    const std::vector<double> cuts = cuts_of(stiffness_);
    LocalLaw before = law_at(0.5 * (cuts[cuts.size() - 2] + 1.0));
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (sliders_ > 0) set_sliders(cuts[i], before, map);
      before = law_at(0.5 * (cuts[i] + cuts[i + 1]));
      const SegmentMap piece = over(cuts[i], cuts[i + 1], before);
      Eigen::MatrixXd next = detail::product(piece.states, map.topRows(states));
      for (Index k = 0; k < Index(before.stuck.size()); ++k)
        next += piece.sliders.col(k) * map.row(states + before.stuck[std::size_t(k)].number);
      map.topRows(states) = next;
    }
    return map;
  }

 private:
  // Contacts whose intervals hold a time.
  std::vector<int> closed_at(double time) const {
    std::vector<int> closed;
    for (const ContactInterval& interval : stiffness_.intervals)
      if (lies_in(interval, time)) closed.push_back(interval.contact);
    return closed;
  }

  LocalLaw law_at(double time) const {
    LocalLaw law;
    law.own.setConstant(dynamics_.contacts(), -dynamics_.holding());
    for (const int c : closed_at(time)) law.own[c] += stiffness_.tangent(c, time);
    for (std::size_t i = 0; i < stiffness_.friction.size(); ++i) add_friction(i, time, law);
    std::vector<bool> acts(std::size_t(law.own.size()), false);
    for (const LocalLaw::Coupling& one : law.couplings) acts[std::size_t(one.force)] = true;
    for (int c = 0; c < dynamics_.contacts(); ++c)
      if (acts[std::size_t(c)] || law.own[c] != 0.0) law.rows.push_back(c);
    return law;
  }

  void add_friction(std::size_t number, double time, LocalLaw& law) const {
    const FrictionAlong& contact = stiffness_.friction[number];
    const FrictionPart& part = contact.part_at(time);
    if (part.state == State::open) return;
    const FrictionConstants& constants = contact.constants;
    const Index tangent = contact.row + constants.normal_rows;
    if (constants.normal_rows > 0) law.own[contact.row] += constants.normal_stiffness;
    if (part.state == State::slip) {
      if (constants.normal_rows > 0)
        law.couplings.push_back(
            {tangent, contact.row, part.sign * constants.friction * constants.normal_stiffness});
      return;
    }
    for (int i = 0; i < constants.tangents; ++i) {
      law.own[tangent + i] += constants.tangential_stiffness;
      if (!contact.always_sticks())
        law.stuck.push_back({tangent + i, slider_of_[number] + i, constants.tangential_stiffness});
    }
  }

  // Forces of the contacts that act, over states and stuck sliders, where u = displaced a - G f.
  Eigen::MatrixXd forces(const LocalLaw& law) const {
    Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(dynamics_.contacts(), Index(law.stuck.size()));
    for (Index k = 0; k < loads.cols(); ++k)
      loads(law.stuck[std::size_t(k)].contact, k) = -law.stuck[std::size_t(k)].stiffness;
    Eigen::MatrixXd right(Index(law.rows.size()), states_.size() + loads.cols());
    right << law.slopes_times(displaced_), loads(law.rows, Eigen::all);
    const Eigen::MatrixXd at_once = dynamics_.constant()(Eigen::all, law.rows);
    if (at_once.isZero(0.0)) return right;
    Eigen::MatrixXd matrix = law.slopes_times(at_once);
    matrix.diagonal().array() += 1.0;
    return detail::Lu<double>(matrix).solve(right);
  }

  // More sliders than states enter by the integral of the exponential.
  SegmentMap exponential(double begin, double end, const LocalLaw& law) const {
    const Index states = states_.size(), stuck = Index(law.stuck.size()), inputs = std::min(states, stuck);
    const Eigen::MatrixXd rates =
        -detail::product(Eigen::MatrixXd(struck_(Eigen::all, law.rows)), forces(law));
    const Eigen::MatrixXd by_sliders = rates.rightCols(stuck);
    Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(states + inputs, states + inputs);
    rate.topLeftCorner(states, states) = states_.generator() + rates.leftCols(states);
    if (stuck <= states)
      rate.topRightCorner(states, inputs) = by_sliders;
    else
      rate.topRightCorner(states, inputs).setIdentity();
    const Eigen::MatrixXd grown = detail::exponential((end - begin) * period_ * rate);
    SegmentMap map{grown.topLeftCorner(states, states), grown.topRightCorner(states, inputs)};
    if (stuck > states) map.sliders = detail::product(map.sliders, by_sliders);
    return map;
  }

  bool is_constant(double begin, double end) const {
    for (const int c : closed_at(0.5 * (begin + end))) {
      const double at = stiffness_.tangent(c, 0.5 * (begin + end));
      for (const double share : {0.25, 0.75})
        if (std::abs(stiffness_.tangent(c, begin + share * (end - begin)) - at) > 1e-12 * std::abs(at))
          return false;
    }
    return true;
  }

  // The mid-point rule in parts, extrapolated, until it changes little.
  SegmentMap over(double begin, double end, const LocalLaw& law) const {
    SegmentMap before = exponential(begin, end, law);
    if (stiffness_.intervals.empty() || is_constant(begin, end)) return before;
    constexpr int most = 1 << 12;
    SegmentMap extrapolated = before;
    for (int parts = 2; parts <= most; parts *= 2) {
      SegmentMap now = part_of(begin, end, 0, parts);
      for (int i = 1; i < parts; ++i) now = part_of(begin, end, i, parts).after(now);
      const SegmentMap next{(4.0 * now.states - before.states) / 3.0,
                            (4.0 * now.sliders - before.sliders) / 3.0};
      const SegmentMap change{next.states - extrapolated.states, next.sliders - extrapolated.sliders};
      extrapolated = next;
      before = std::move(now);
      if (change.norm() <= settled_ * extrapolated.norm()) return extrapolated;
    }
    before.states.setConstant(missing);
    return before;
  }

  SegmentMap part_of(double begin, double end, int i, int parts) const {
    const double from = begin + (end - begin) * i / parts, to = begin + (end - begin) * (i + 1) / parts;
    return exponential(from, to, law_at(0.5 * (from + to)));
  }

  // The displacements of the contacts, over all states and sliders before the period.
  Eigen::MatrixXd displacements(const LocalLaw& law, const Eigen::MatrixXd& map) const {
    const Index states = states_.size();
    Eigen::MatrixXd moved = detail::product(displaced_, map.topRows(states));
    if (dynamics_.constant().isZero(0.0) || law.rows.empty()) return moved;
    const Eigen::MatrixXd by =
        detail::product(Eigen::MatrixXd(dynamics_.constant()(Eigen::all, law.rows)), forces(law));
    moved -= detail::product(by.leftCols(states), map.topRows(states));
    for (Index k = 0; k < Index(law.stuck.size()); ++k)
      moved -= by.col(states + k) * map.row(states + law.stuck[std::size_t(k)].number);
    return moved;
  }

  // The sliders from `time` on: of contacts that begin to stick from the displacements just before. Those
  // that are not stuck have no part in the perturbation.
  void set_sliders(double time, const LocalLaw& before, Eigen::MatrixXd& map) const {
    Eigen::MatrixXd sliders = Eigen::MatrixXd::Zero(sliders_, map.cols()), moved;
    for (std::size_t i = 0; i < stiffness_.friction.size(); ++i) {
      const FrictionAlong& contact = stiffness_.friction[i];
      const FrictionPart& part = contact.part_at(time);
      if (part.state != State::stick || contact.always_sticks()) continue;
      const FrictionConstants& constants = contact.constants;
      sliders.middleRows(slider_of_[i], constants.tangents) =
          map.middleRows(states_.size() + slider_of_[i], constants.tangents);
      if (part.begin != time) continue;
      if (moved.size() == 0) moved = displacements(before, map);
      const double ratio = part.sign != 0.0 ? part.sign * constants.friction * constants.normal_stiffness /
                                                  constants.tangential_stiffness
                                            : part.ratio;
      for (int k = 0; k < constants.tangents; ++k) {
        sliders.row(slider_of_[i] + k) = moved.row(contact.row + constants.normal_rows + k);
        if (constants.normal_rows > 0) sliders.row(slider_of_[i] + k) -= ratio * moved.row(contact.row);
      }
    }
    map.bottomRows(sliders_) = sliders;
  }

  const ContactDynamics& dynamics_;
  const PeriodicStiffness& stiffness_;
  double period_, settled_;
  PoleStates states_;
  Eigen::MatrixXd displaced_, struck_;
  std::vector<Index> slider_of_;  // the first of each contact with friction
  Index sliders_ = 0;             // of contacts that stick at times
};

// Without states of which nothing is left after the period.
Eigen::MatrixXd lasting(const Eigen::MatrixXd& map) {
  std::vector<Index> kept;
  for (Index i = 0; i < map.rows(); ++i)
    if (!map.row(i).isZero(0.0) && !map.col(i).isZero(0.0)) kept.push_back(i);
  return kept.empty() ? map : Eigen::MatrixXd(map(kept, kept));
}

}  // namespace

Eigen::VectorXcd switching_monodromy(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                     double frequency, double settled) {
  return detail::map_multipliers(
      lasting(SwitchingPropagator(dynamics, stiffness, 1.0 / frequency, settled).map()));
}

}  // namespace wavebalance::solvers
