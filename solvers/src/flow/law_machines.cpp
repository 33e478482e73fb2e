#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "flow/law_machines.hpp"
#include "phases/law_pieces.hpp"
#include "wavebalance/solvers/flow/law_machine.hpp"

namespace wavebalance::solvers {

double detail::inverse_mass_of(const ContactDynamics& dynamics, int row) {
  if (dynamics.constant()(row, row) > 0.0) return 0.0;
  double displaced = 0.0, moved = 0.0, fastest = 0.0;
  for (const ContactPole& pole : dynamics.poles()) {
    const std::complex<double> own = pole.residue * pole.shape[row] * pole.left[row];
    const double weight = pole.exponent.imag() == 0.0 ? 1.0 : 2.0;
    displaced += weight * own.real();
    moved += weight * (pole.exponent * own).real();
    fastest = std::max(fastest, std::abs(pole.exponent));
  }
  constexpr double rounding = 1e-9;
  return moved > 0.0 && std::abs(displaced) * fastest <= rounding * moved ? moved : 0.0;
}

namespace {

using detail::inverse_mass_of;

RowForce free_force() { return {.free = true}; }
RowForce no_force() { return {}; }
RowForce constant_force(double value) { return {.constant = value}; }

/// A law of the displacement, or of displacement and velocity: a state for each of its pieces, and where it
/// does not pull one more for each piece that is left before the displacement comes back.
class PieceMachine final : public LawMachine {
 public:
  PieceMachine(AnyContactLaw law, double length)
      : pulls_(!law.depends_on_velocity() || !law.unilateral()), law_(std::move(law), length, 0.0, {}) {}

  ContactState kind(int state) const override {
    return acts(state) ? ContactState::closed : ContactState::open;
  }
  std::vector<RowForce> forces(int state) const override { return {acts(state) ? free_force() : no_force()}; }

  std::vector<StateExit> exits(int state) const override {
    std::vector<StateExit> result;
    for (const Way& way : ways(state)) result.push_back({{way.to}});
    return result;
  }

  void equations(int state, const LocalSignals& now, std::span<Dual> out) const override {
    out[0] = now.force[0] - force(state, now);
  }

  Dual guard(int state, int exit, const LocalSignals& now) const override {
    const Way way = ways(state)[std::size_t(exit)];
    switch (way.kind) {
      case Kind::up:
        return Dual(law_.breakpoint(piece(state))) - now.displacement[0];
      case Kind::down:
        return now.displacement[0] - Dual(law_.breakpoint(piece(state) - 1));
      case Kind::release:
        return force(state, now);
      default:
        return -force(piece(state), now);
    }
  }

  int start(std::span<const double> displacement, std::span<double>) const override {
    return law_.piece_at(displacement[0]);
  }
  int at(std::span<const double> displacement, std::span<const double> force,
         std::span<double>) const override {
    const int own = law_.piece_at(displacement[0]);
    return !pulls_ && law_.exerts(own) && force[0] <= 0.0 ? law_.released(own) : own;
  }

 private:
  enum class Kind { up, down, release, hold };
  struct Way {
    Kind kind;
    int to;
  };

  int piece(int state) const { return law_.without_release(state); }
  bool acts(int state) const { return state < law_.count() && law_.exerts(state); }

  std::vector<Way> ways(int state) const {
    const int own = piece(state);
    std::vector<Way> result;
    if (own + 1 < law_.count()) result.push_back({Kind::up, own + 1});
    if (own > 0) result.push_back({Kind::down, own - 1});
    if (state >= law_.count())
      result.push_back({Kind::hold, own});
    else if (!pulls_ && law_.exerts(own))
      result.push_back({Kind::release, law_.released(own)});
    return result;
  }

  Dual force(int state, const LocalSignals& now) const {
    const ForceSlopes at = law_.at(piece(state), now.displacement[0].value, now.velocity[0].value);
    Dual result(at.force);
    for (std::size_t i = 0; i < result.slope.size(); ++i)
      result.slope[i] = at.tangent * now.displacement[0].slope[i] + at.damping * now.velocity[0].slope[i];
    return result;
  }

  bool pulls_;
  detail::LawPieces law_;
};

/// A rigid obstacle at a contact with mass: it rebounds, or stays closed, by a vanishing acceleration, until
/// its force does.
class ImpactMachine final : public LawMachine {
 public:
  /// rate, 1/s: at which rounding in a closed contact decays.
  ImpactMachine(double gap, double restitution, double rate)
      : gap_(gap), restitution_(restitution), rate_(rate) {}
  enum : int { open, closed };

  ContactState kind(int state) const override {
    return state == open ? ContactState::open : ContactState::closed;
  }
  std::vector<RowForce> forces(int state) const override {
    return {state == open ? no_force() : free_force()};
  }
  std::vector<StateExit> exits(int state) const override {
    if (state == closed) return {{{open}}};
    return {{{open, closed}, Impulse{0, restitution_}}};
  }
  void equations(int, const LocalSignals& now, std::span<Dual> out) const override {
    out[0] =
        now.acceleration[0] + 2.0 * rate_ * now.velocity[0] + rate_ * rate_ * (now.displacement[0] - gap_);
  }
  Dual guard(int state, int, const LocalSignals& now) const override {
    return state == open ? Dual(gap_) - now.displacement[0] : now.force[0];
  }
  // A rebound leaves; without one the contact stays where something presses.
  int choose(int, int, const LocalSignals&, const LocalSignals& after) const override {
    const bool leaves = after.velocity[0].value < 0.0;
    return leaves || after.acceleration[0].value <= 0.0 ? open : closed;
  }
  int after_impulse(int, const LocalSignals&) const override { return open; }
  int start(std::span<const double>, std::span<double>) const override { return open; }
  int at(std::span<const double>, std::span<const double> force, std::span<double>) const override {
    return force[0] > 0.0 ? closed : open;
  }

 private:
  double gap_, restitution_, rate_;
};

/// A rigid obstacle at a contact without mass.
class ObstacleMachine final : public LawMachine {
 public:
  explicit ObstacleMachine(double gap) : gap_(gap) {}
  enum : int { open, closed };

  ContactState kind(int state) const override {
    return state == open ? ContactState::open : ContactState::closed;
  }
  std::vector<RowForce> forces(int state) const override {
    return {state == open ? no_force() : free_force()};
  }
  std::vector<StateExit> exits(int state) const override { return {{{state == open ? closed : open}}}; }
  void equations(int, const LocalSignals& now, std::span<Dual> out) const override {
    out[0] = now.displacement[0] - gap_;
  }
  Dual guard(int state, int, const LocalSignals& now) const override {
    return state == open ? Dual(gap_) - now.displacement[0] : now.force[0];
  }
  int start(std::span<const double> displacement, std::span<double>) const override {
    return displacement[0] < gap_ ? open : closed;
  }
  int at(std::span<const double>, std::span<const double> force, std::span<double>) const override {
    return force[0] > 0.0 ? closed : open;
  }

 private:
  double gap_;
};

/// Coulomb friction along one tangent, of a constant normal force or of a normal row that may open. It is
/// elastic, or rigid at a contact with mass, where sticking has no acceleration, or without.
class FrictionMachine final : public LawMachine {
 public:
  /// inverse_mass, 1/kg: of the tangent; 0 without mass. rate, 1/s: at which rounding decays while it sticks.
  FrictionMachine(AnyContactLaw law, double inverse_mass, double rate)
      : law_(std::move(law)), c_(*law_.friction()), inverse_mass_(inverse_mass), rate_(rate) {}
  enum : int { open, stick, forward, backward };

  int rows() const override { return c_.normal_rows + 1; }
  int memories() const override { return 1; }
  bool remembers(int state) const override { return state == stick && !accelerates(); }

  ContactState kind(int state) const override {
    constexpr std::array<ContactState, 4> kinds{ContactState::open, ContactState::stick, ContactState::slip,
                                                ContactState::slip};
    return kinds[std::size_t(state)];
  }

  std::vector<RowForce> forces(int state) const override {
    std::vector<RowForce> result(std::size_t(rows()), no_force());
    if (state == open) return result;
    if (has_normal()) result[0] = free_force();
    RowForce& tangent = result.back();
    if (state == stick)
      tangent = free_force();
    else if (has_normal())
      tangent.of_rows[0] = sign(state) * c_.friction;
    else
      tangent = constant_force(sign(state) * c_.friction * c_.normal_load);
    return result;
  }

  std::vector<StateExit> exits(int state) const override {
    if (state == open) return {{{stick, forward, backward}}};
    std::vector<StateExit> result;
    if (state == stick)
      result = {{{forward}}, {{backward}}};
    else if (accelerates())
      result = {{{stick, state == forward ? backward : forward}}};
    else if (c_.friction > 0.0)
      result = {{{stick}}};
    if (has_normal()) result.push_back({{open}});
    return result;
  }

  void equations(int state, const LocalSignals& now, std::span<Dual> out) const override {
    std::size_t next = 0;
    if (has_normal()) out[next++] = now.force[0] - normal(now);
    if (state != stick) return;
    if (accelerates())
      out[next] = now.acceleration.back() + rate_ * now.velocity.back();
    else
      out[next] = rigid() ? now.displacement.back() - now.memory[0] : now.force.back() - elastic(now);
  }

  Dual guard(int state, int exit, const LocalSignals& now) const override {
    const bool opens = state != open && has_normal() && exit + 1 == int(exits(state).size());
    if (state == open) return -normal(now);
    if (opens) return normal(now);
    const Dual limit = c_.friction * normal(now);
    if (state != stick) return slip_rate(state, now);
    const Dual force = rigid() ? now.force.back() : elastic(now);
    return exit == 0 ? limit - force : limit + force;
  }

  void remember(int state, int, const LocalSignals& now, std::span<Dual> out) const override {
    out[0] = now.displacement.back();
    if (!rigid() && state != open)
      out[0].add(normal(now), -sign(state) * c_.friction / c_.tangential_stiffness);
  }

  int choose(int state, int, const LocalSignals& before, const LocalSignals&) const override {
    if (state == open) return closing(before);
    if (!accelerates()) return stick;
    const double holds = before.force.back().value + before.acceleration.back().value / inverse_mass_;
    constexpr double rounding = 1e-7;  // what is more than stuck leaves at once
    if (std::abs(holds) <= (1.0 + rounding) * c_.friction * normal(before).value) return stick;
    return holds > 0.0 ? forward : backward;
  }

  // Rigid friction follows the sense of the velocity, which an impulse may start or reverse.
  int after_impulse(int state, const LocalSignals& after) const override {
    if (state == open || !accelerates()) return state;
    return after.velocity.back().value > 0.0 ? forward : backward;
  }

  int start(std::span<const double> displacement, std::span<double> memory) const override {
    std::array<double, 2> force{};
    const std::array<double, 2> none{};
    memory[0] = displacement.back();
    if (!rigid()) {
      law_.start(displacement, {none.data(), std::size_t(rows())}, {force.data(), std::size_t(rows())});
      memory[0] -= force[std::size_t(rows()) - 1] / c_.tangential_stiffness;
    }
    const double n = normal_at(displacement);
    if (has_normal() && n <= 0.0) return open;
    const double limit = c_.friction * n, own = force[std::size_t(rows()) - 1];
    if (c_.friction > 0.0 && (std::abs(own) < limit || limit == 0.0)) return stick;
    return own > 0.0 ? forward : backward;
  }
  int at(std::span<const double> displacement, std::span<const double> force,
         std::span<double> memory) const override {
    constexpr double rounding = 1e-6;  // of a force that a balance has limited
    const double n = normal_at(displacement), own = force.back();
    memory[0] = 0.0;
    if (has_normal() && n <= 0.0) return open;
    if (std::abs(own) >= (1.0 - rounding) * c_.friction * n) return own > 0.0 ? forward : backward;
    if (!accelerates()) memory[0] = displacement.back() - (rigid() ? 0.0 : own / c_.tangential_stiffness);
    return stick;
  }

 private:
  static double sign(int state) { return state == forward ? 1.0 : -1.0; }
  bool has_normal() const { return c_.normal_rows > 0; }
  bool rigid() const { return std::isinf(c_.tangential_stiffness); }
  bool accelerates() const { return rigid() && inverse_mass_ > 0.0; }

  double normal_at(std::span<const double> displacement) const {
    return c_.normal_load + (has_normal() ? c_.normal_stiffness * displacement[0] : 0.0);
  }
  Dual normal(const LocalSignals& now) const {
    return has_normal() ? Dual(c_.normal_load) + c_.normal_stiffness * now.displacement[0]
                        : Dual(c_.normal_load);
  }
  /// By displacements, so that its rate is known at every instant.
  Dual elastic(const LocalSignals& now) const {
    return c_.tangential_stiffness * (now.displacement.back() - now.memory[0]);
  }
  /// Positive while the slider goes on.
  Dual slip_rate(int state, const LocalSignals& now) const {
    Dual rate = sign(state) * now.velocity.back();
    if (!rigid()) {
      rate = c_.tangential_stiffness * rate;
      if (has_normal()) rate.add(now.velocity[0], -c_.friction * c_.normal_stiffness);
    }
    return rate;
  }
  int closing(const LocalSignals& before) const {
    const double v = before.velocity.back().value;
    if (c_.friction == 0.0) return forward;
    if (rigid()) return v == 0.0 ? stick : v > 0.0 ? forward : backward;
    const double grows = c_.friction * c_.normal_stiffness * before.velocity[0].value;
    if (c_.tangential_stiffness * std::abs(v) < grows) return stick;
    return v > 0.0 ? forward : backward;
  }

  AnyContactLaw law_;
  FrictionConstants c_;
  double inverse_mass_, rate_;
};

std::shared_ptr<const LawMachine> machine_of(const AnyContactLaw& law, const ContactDynamics& dynamics,
                                             int row, double length, double rate) {
  if (const auto constants = law.friction()) {
    constexpr double closer = 2.5;  // a deviation of slip in a plane leaves 2e-14 in a period
    const bool plane = constants->tangents > 1;
    if (plane && std::isinf(constants->tangential_stiffness))
      throw std::invalid_argument("machines_of: contact " + std::to_string(row) +
                                  " has rigid friction along two tangents; expected a tangential stiffness");
    if (plane) return detail::plane_friction_machine(law, closer * rate);
    return std::make_shared<FrictionMachine>(law, inverse_mass_of(dynamics, row + constants->normal_rows),
                                             rate);
  }
  if (law.coupled()) return detail::coupled_machine(*law.coupled());
  if (law.acts_over_period())
    throw std::invalid_argument("machines_of: contact " + std::to_string(row) +
                                " has a law over a period without states");
  if (!law.is_rigid()) return std::make_shared<PieceMachine>(law, length);
  if (inverse_mass_of(dynamics, row) == 0.0) return std::make_shared<ObstacleMachine>(law.gap());
  if (const auto restitution = law.restitution())
    return std::make_shared<ImpactMachine>(law.gap(), *restitution, rate);
  throw std::invalid_argument("machines_of: contact " + std::to_string(row) +
                              " is rigid and has mass, so that its law must have a restitution");
}

}  // namespace

std::vector<ContactMachine> machines_of(const ContactLaws& laws, const ContactDynamics& dynamics,
                                        double length, double frequency) {
  const double rate = 4.0 * std::numbers::pi * frequency;
  std::vector<ContactMachine> machines;
  for (int row = 0; row < dynamics.contacts(); row += machines.back().law->rows())
    machines.push_back({machine_of(laws[row], dynamics, row, length, rate), row});
  return machines;
}

}  // namespace wavebalance::solvers
