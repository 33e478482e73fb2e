#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/flow/dual.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {

/// Input of a law at an instant: each of its rows, and its memories.
struct LocalSignals {
  std::span<const Dual> displacement;  ///< m
  std::span<const Dual> velocity;      ///< m/s
  std::span<const Dual> acceleration;  ///< m/s^2
  std::span<const Dual> force;         ///< N
  std::span<const Dual> memory;
};

/// The force of a row in a state: free, so that an equation determines it, or a sum of the other rows' forces
/// and a constant.
struct RowForce {
  bool free = false;
  std::array<double, 3> of_rows{};
  double constant = 0.0;  ///< N
};

/// An impact: an impulse along a row that leaves it with -restitution times its velocity.
struct Impulse {
  int row = 0;
  double restitution = 0.0;  ///< 0..1
};

/// A way out of a state: the states that it may lead to, the first one unless choose() selects another.
struct StateExit {
  std::vector<int> targets;
  std::optional<Impulse> impulse{};
};

/// State of a contact with friction at an instant.
struct Sliding {
  double speed = 0.0;  ///< m/s, of the slider over its surface
  double wear = 0.0;   ///< W, the normal force times that speed [Archard]
  double power = 0.0;  ///< W, dissipated by the tangential force over the surface
};

/// A contact law as a state machine. A state defines the free forces, the equations that determine them,
/// and the exits by which it ends: each has a guard, positive within the state and zero at the instant, and
/// sets the memories of the next state. A law of the user derives from this class. Immutable.
class LawMachine {
 public:
  virtual ~LawMachine() = default;

  virtual int rows() const { return 1; }
  /// How many numbers it remembers, each a displacement, m.
  virtual int memories() const { return 0; }
  /// Whether its memories have a meaning in a state.
  virtual bool remembers(int /*state*/) const { return false; }
  /// Whether its memories move in a state, by rates().
  virtual bool moves(int /*state*/) const { return false; }
  /// 1/s, at which memories that move come to rest by themselves, which a panel has to resolve; nothing if
  /// they change at once with the forces.
  virtual std::optional<double> settling_rate(int /*state*/) const { return std::nullopt; }
  virtual ContactState kind(int state) const = 0;
  /// One per row.
  virtual std::vector<RowForce> forces(int state) const = 0;
  virtual std::vector<StateExit> exits(int state) const = 0;
  /// The exit at whose instant the equations of a state are singular, -1 for none.
  virtual int singular_exit(int /*state*/) const { return -1; }
  /// Writes what must vanish, one value per free row in their order.
  virtual void equations(int state, const LocalSignals& now, std::span<Dual> out) const = 0;
  /// Writes the rates of the memories, m/s, in a state in which they move.
  virtual void rates(int /*state*/, const LocalSignals& /*now*/, std::span<Dual> /*out*/) const {}
  virtual Dual guard(int state, int exit, const LocalSignals& now) const = 0;
  /// Writes the memories behind an exit, from the signals just before it.
  virtual void remember(int /*state*/, int /*exit*/, const LocalSignals& /*now*/,
                        std::span<Dual> /*out*/) const {}
  /// The state behind an exit with several targets, from the signals just before, and behind the impulse
  /// with the forces of before.
  virtual int choose(int state, int exit, const LocalSignals& /*before*/,
                     const LocalSignals& /*after*/) const {
    return exits(state)[static_cast<std::size_t>(exit)].targets.front();
  }
  /// The state behind an impulse at another contact that has changed the velocity of this one.
  virtual int after_impulse(int state, const LocalSignals& /*after*/) const { return state; }
  virtual Sliding sliding(int /*state*/, const LocalSignals& /*now*/) const { return {}; }
  /// The same times a time, of what happens at an exit at once.
  virtual Sliding sudden(int /*state*/, int /*exit*/, const LocalSignals& /*now*/) const { return {}; }
  /// The state in which displacements at rest begin, and its memories.
  virtual int start(std::span<const double> displacement, std::span<double> memory) const = 0;
  /// The state in which a motion has these displacements and forces at an instant, and its memories.
  virtual int at(std::span<const double> displacement, std::span<const double> force,
                 std::span<double> memory) const = 0;
};

/// The machine of a contact and its first row among the directions of the structure.
struct ContactMachine {
  std::shared_ptr<const LawMachine> law;
  int row = 0;
};

/// The machines of the laws of a structure, in the order of its directions. `length` (m) is typical of the
/// motion, `frequency` (Hz) belongs to its period. Throws std::invalid_argument for rigid friction along
/// two tangents, and for laws without states.
std::vector<ContactMachine> machines_of(const ContactLaws& laws, const ContactDynamics& dynamics,
                                        double length, double frequency);

}  // namespace wavebalance::solvers
