#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <optional>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "support/friction_scenes.hpp"

namespace wavebalance::solvers::testing {

/// Motions with friction along one tangent, beside linear stops, in time, from event to event: between events
/// the equations are linear, and a state of displacements, velocities, tangential forces, 1, cos and sin of
/// the load goes on by a matrix exponential. It shares no code with the solvers.
class FrictionOracle {
 public:
  enum class Does { open, stick, slip_up, slip_down };

  struct State {
    Eigen::VectorXd z;
    std::vector<Does> does;
    std::vector<bool> closed;  ///< of the stops
    Eigen::MatrixXd by_start;  ///< the derivative by the state at the start, with the saltation of events
    int events = 0;
  };

  explicit FrictionOracle(const FrictionScene& scene)
      : scene_(scene),
        n_(scene.structure.mass.rows()),
        contacts_(Eigen::Index(scene.laws.size())),
        size_(2 * n_ + contacts_ + 3),
        mass_(scene.structure.mass),
        rows_(scene.structure.contact_directions) {
    loads_ = Eigen::MatrixXd::Zero(n_, 3);
    loads_.col(1) = scene.structure.load;
    for (const PeriodicForce& force : scene.structure.forces) {
      loads_.col(0) += force.harmonics[0].real() * force.shape;
      if (force.harmonics.size() < 2) continue;
      loads_.col(1) += force.harmonics[1].real() * force.shape;
      loads_.col(2) -= force.harmonics[1].imag() * force.shape;
    }
    Eigen::Index row = 0;
    for (const contact::CoulombLaw& law : scene.laws) {
      normal_.push_back(law.normal_rows() > 0 ? row : -1);
      tangent_.push_back(row + law.normal_rows());
      row += law.rows();
    }
    for (std::size_t i = 0; i < scene.stops.size(); ++i) stop_.push_back(row++);
  }

  Eigen::Index states() const { return 2 * n_ + contacts_; }

  State start(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity,
              const Eigen::VectorXd& tangential, std::vector<Does> does) const {
    State state{Eigen::VectorXd::Zero(size_), std::move(does), {}, Eigen::MatrixXd::Identity(size_, size_)};
    state.z << displacement, velocity, tangential, 1.0, 1.0, 0.0;
    for (std::size_t i = 0; i < stop_.size(); ++i) state.closed.push_back(pressing(i).dot(state.z) > 0.0);
    // The force of a contact that does not stick is no state of its own.
    for (Eigen::Index c = 0; c < contacts_; ++c)
      if (state.does[std::size_t(c)] != Does::stick) state.by_start(2 * n_ + c, 2 * n_ + c) = 0.0;
    return state;
  }

  /// One period of the load.
  State period(State state) const {
    constexpr int steps = 2000;  // what is shorter may be missed
    const double whole = 2.0 * std::numbers::pi / scene_.omega, step = whole / steps;
    Eigen::Index changed = -1;  // the contact that did just before: some of its rows begin at zero
    for (double time = 0.0; time < whole * (1.0 - 1e-14);) {
      const double length = std::min(step, whole - time);
      const Eigen::MatrixXd generator = this->generator(state);
      const std::optional<Event> event = first_event(state, generator, length, changed);
      const double taken = event ? event->after : length;
      const Eigen::MatrixXd moves = (taken * generator).exp();
      state.z = moves * state.z;
      state.by_start = moves * state.by_start;
      time += taken;
      changed = event ? event->row.contact : -1;
      if (event && ++state.events < 2000) pass(state, *event, generator);
    }
    return state;
  }

 private:
  enum class Kind { closing, opening, slipping_up, slipping_down, sticking, stopping };
  struct Row {
    Eigen::RowVectorXd row;  // an event is where it rises through zero
    Kind kind;
    Eigen::Index contact;  // stops behind those with friction
  };
  struct Event {
    Row row;
    double after;
  };

  const contact::CoulombLaw& law(Eigen::Index c) const { return scene_.laws[std::size_t(c)]; }
  bool has_normal(Eigen::Index c) const { return normal_[std::size_t(c)] >= 0; }
  Eigen::RowVectorXd unit(Eigen::Index i) const { return Eigen::RowVectorXd::Unit(size_, i); }
  Eigen::RowVectorXd along(Eigen::Index row, bool velocity) const {
    Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(size_);
    result.segment(velocity ? n_ : 0, n_) = rows_.row(row);
    return result;
  }
  Eigen::RowVectorXd normal_force(Eigen::Index c) const {
    Eigen::RowVectorXd row = law(c).raw_normal_force(0.0) * unit(2 * n_ + contacts_);
    if (has_normal(c)) row += law(c).normal_stiffness() * along(normal_[std::size_t(c)], false);
    return row;
  }
  Eigen::RowVectorXd normal_rate(Eigen::Index c) const {
    if (!has_normal(c)) return Eigen::RowVectorXd::Zero(size_);
    return law(c).normal_stiffness() * along(normal_[std::size_t(c)], true);
  }
  // The displacement of a stop beyond its gap.
  Eigen::RowVectorXd pressing(std::size_t i) const {
    return along(stop_[i], false) - scene_.stops[i].gap() * unit(2 * n_ + contacts_);
  }
  static double sign(Does does) { return does == Does::slip_up ? 1.0 : does == Does::slip_down ? -1.0 : 0.0; }
  Eigen::RowVectorXd tangential(Eigen::Index c, Does does) const {
    if (does == Does::open) return Eigen::RowVectorXd::Zero(size_);
    if (does == Does::stick) return unit(2 * n_ + c);
    return sign(does) * law(c).friction() * normal_force(c);
  }

  Eigen::MatrixXd generator(const State& state) const {
    Eigen::MatrixXd force = Eigen::MatrixXd::Zero(n_, size_), all = Eigen::MatrixXd::Zero(size_, size_);
    force.leftCols(n_) = -Eigen::MatrixXd(scene_.structure.stiffness);
    force.middleCols(n_, n_) = -Eigen::MatrixXd(scene_.structure.damping);
    force.rightCols(3) = loads_;
    for (Eigen::Index c = 0; c < contacts_; ++c) {
      const Does now = state.does[std::size_t(c)];
      if (now != Does::open && has_normal(c))
        force -= rows_.row(normal_[std::size_t(c)]).transpose() * normal_force(c);
      force -= rows_.row(tangent_[std::size_t(c)]).transpose() * tangential(c, now);
      if (now == Does::stick)
        all.row(2 * n_ + c) = law(c).tangential_stiffness() * along(tangent_[std::size_t(c)], true);
      else
        all.row(2 * n_ + c) = sign(now) * law(c).friction() * normal_rate(c);
    }
    for (std::size_t i = 0; i < stop_.size(); ++i)
      if (state.closed[i])
        force -= scene_.stops[i].stiffness() * rows_.row(stop_[i]).transpose() * pressing(i);
    all.block(0, n_, n_, n_).setIdentity();
    all.middleRows(n_, n_) = mass_.ldlt().solve(force);
    all(size_ - 2, size_ - 1) = -scene_.omega;
    all(size_ - 1, size_ - 2) = scene_.omega;
    return all;
  }

  std::vector<Row> rows_of(const State& state) const {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < stop_.size(); ++i)
      rows.push_back(
          {state.closed[i] ? -pressing(i) : pressing(i), Kind::stopping, contacts_ + Eigen::Index(i)});
    for (Eigen::Index c = 0; c < contacts_; ++c) {
      const Does now = state.does[std::size_t(c)];
      const Eigen::RowVectorXd normal = normal_force(c), limit = law(c).friction() * normal;
      if (now == Does::open) {
        rows.push_back({normal, Kind::closing, c});
        continue;
      }
      if (has_normal(c)) rows.push_back({-normal, Kind::opening, c});
      if (now == Does::stick) {
        rows.push_back({tangential(c, now) - limit, Kind::slipping_up, c});
        rows.push_back({-tangential(c, now) - limit, Kind::slipping_down, c});
      } else {
        const Eigen::RowVectorXd rate =
            law(c).tangential_stiffness() * along(tangent_[std::size_t(c)], true) -
            sign(now) * law(c).friction() * normal_rate(c);
        rows.push_back({-sign(now) * rate, Kind::sticking, c});
      }
    }
    return rows;
  }

  std::optional<Event> first_event(const State& state, const Eigen::MatrixXd& generator, double length,
                                   Eigen::Index changed) const {
    constexpr double of_step = 1e-3;
    std::optional<Event> first;
    const auto at = [&](double after, const Row& row) -> double {
      return row.row * ((after * generator).exp() * state.z);
    };
    for (const Row& row : rows_of(state)) {
      double low = row.contact == changed ? of_step * length : 0.0, high = length;
      if (!(at(high, row) > 0.0) || (low > 0.0 && at(low, row) > 0.0)) continue;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (at(middle, row) > 0.0 ? high : low) = middle;
      }
      if (!first || high < first->after) first = Event{row, high};
    }
    return first;
  }

  // Saltation: the state is reset by R, and z moves on by f+ in place of R f-.
  void pass(State& state, const Event& event, const Eigen::MatrixXd& before) const {
    const Eigen::Index c = event.row.contact, own = 2 * n_ + c;
    if (event.row.kind == Kind::stopping) {  // continuous
      state.closed[std::size_t(c - contacts_)].flip();
      return;
    }
    const Does was = state.does[std::size_t(c)];
    Eigen::MatrixXd reset = Eigen::MatrixXd::Identity(size_, size_);
    Does now = Does::stick;
    switch (event.row.kind) {
      case Kind::opening:
        now = Does::open;
        reset.row(own).setZero();
        break;
      case Kind::closing: {
        reset.row(own).setZero();
        const double speed = along(tangent_[std::size_t(c)], true) * state.z, rise = normal_rate(c) * state.z;
        if (law(c).tangential_stiffness() * std::abs(speed) > law(c).friction() * rise)
          now = speed > 0.0 ? Does::slip_up : Does::slip_down;
        break;
      }
      case Kind::slipping_up:
        now = Does::slip_up;
        break;
      case Kind::slipping_down:
        now = Does::slip_down;
        break;
      case Kind::stopping:
      case Kind::sticking:
        reset.row(own) = sign(was) * law(c).friction() * normal_force(c);
        break;
    }
    const Eigen::VectorXd rate = before * state.z;
    state.does[std::size_t(c)] = now;
    state.z = reset * state.z;
    const Eigen::VectorXd after = generator(state) * state.z;
    const double crossing = event.row.row * rate;
    const Eigen::MatrixXd saltation = reset + (after - reset * rate) * event.row.row / crossing;
    state.by_start = saltation * state.by_start;
  }

  const FrictionScene& scene_;
  Eigen::Index n_, contacts_, size_;
  Eigen::MatrixXd mass_, rows_, loads_;
  std::vector<Eigen::Index> normal_, tangent_, stop_;
};

}  // namespace wavebalance::solvers::testing
