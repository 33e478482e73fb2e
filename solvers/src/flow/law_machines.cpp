#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "collocation/law_segments.hpp"
#include "flow/law_machines.hpp"
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

/// A law of the displacement, or of displacement and velocity: a state for each of its pieces, and where it
/// does not pull one more for each piece that is left before the displacement comes back.
class SegmentMachine final : public LawMachine {
 public:
  SegmentMachine(AnyContactLaw law, double length)
      : pulls_(!law.depends_on_velocity() || !law.unilateral()), law_(std::move(law), length, 0.0, {}) {
    for (int state = 0; state < 2 * law_.count(); ++state) ways_.push_back(ways_of(state));
  }

  ContactState kind(int state) const override {
    return acts(state) ? ContactState::closed : ContactState::open;
  }
  std::vector<RowForce> forces(int state) const override { return {acts(state) ? free_force() : no_force()}; }

  std::vector<StateExit> exits(int state) const override {
    std::vector<StateExit> result;
    for (const Way& way : ways_[std::size_t(state)]) result.push_back({{way.to}});
    return result;
  }

  void equations(int state, const LocalSignals& now, std::span<Dual> out) const override {
    out[0] = now.force[0] - force(state, now);
  }

  Dual guard(int state, int exit, const LocalSignals& now) const override {
    const Way way = ways_[std::size_t(state)][std::size_t(exit)];
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

  std::vector<Way> ways_of(int state) const {
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
  detail::LawSegments law_;
  std::vector<std::vector<Way>> ways_;  // by state
};

/// A rigid obstacle. At a contact with mass it rebounds, or stays closed, by a vanishing acceleration, until
/// its force does; without mass, and a restitution, it is closed as it is reached.
class RigidMachine final : public LawMachine {
 public:
  /// rate, 1/s: at which rounding in a closed contact with mass decays.
  RigidMachine(double gap, std::optional<double> restitution, double rate)
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
    if (!restitution_) return {{{closed}}};
    return {{{open, closed}, Impulse{0, *restitution_}}};
  }
  void equations(int, const LocalSignals& now, std::span<Dual> out) const override {
    out[0] = now.displacement[0] - gap_;
    if (restitution_) out[0] = now.acceleration[0] + 2.0 * rate_ * now.velocity[0] + rate_ * rate_ * out[0];
  }
  Dual guard(int state, int, const LocalSignals& now) const override {
    return state == open ? Dual(gap_) - now.displacement[0] : now.force[0];
  }
  // A rebound leaves; without one the contact stays where something presses.
  int choose(int, int, const LocalSignals&, const LocalSignals& after) const override {
    const bool leaves = after.velocity[0].value < 0.0;
    return leaves || after.acceleration[0].value <= 0.0 ? open : closed;
  }
  int after_impulse(int state, const LocalSignals&) const override { return restitution_ ? open : state; }
  int start(std::span<const double> displacement, std::span<double>) const override {
    return restitution_ || displacement[0] < gap_ ? open : closed;
  }
  int at(std::span<const double>, std::span<const double> force, std::span<double>) const override {
    return force[0] > 0.0 ? closed : open;
  }

 private:
  double gap_;
  std::optional<double> restitution_;
  double rate_;
};

/// Friction of this contact as a machine, or why there is none.
std::shared_ptr<const LawMachine> friction_machine_of(const AnyContactLaw& law, const FrictionConstants& c,
                                                      const ContactDynamics& dynamics, int row, double rate) {
  constexpr double closer = 2.5;  // a deviation of slip in a plane leaves 2e-14 in a period
  const bool rigid = std::isinf(c.tangential_stiffness);
  const std::string contact = "machines_of: contact " + std::to_string(row);
  if (c.tangents > 1 && rigid)
    throw std::invalid_argument(contact +
                                " has rigid friction along two tangents; expected a tangential stiffness");
  if (c.tangents > 1) return detail::plane_friction_machine(law, closer * rate);
  const double inverse_mass = inverse_mass_of(dynamics, row + c.normal_rows);
  if (rigid && inverse_mass == 0.0 && c.static_friction > c.friction)
    throw std::invalid_argument(contact +
                                " has rigid friction with a static coefficient and no mass, so that nothing "
                                "says how far it jumps; expected a tangential stiffness");
  return detail::friction_machine(law, inverse_mass, rate);
}

std::shared_ptr<const LawMachine> machine_of(const AnyContactLaw& law, const ContactDynamics& dynamics,
                                             int row, double length, double rate) {
  if (const auto constants = law.friction()) return friction_machine_of(law, *constants, dynamics, row, rate);
  if (law.coupled()) return detail::coupled_machine(*law.coupled());
  if (law.acts_over_period())
    throw std::invalid_argument("machines_of: contact " + std::to_string(row) +
                                " has a law over a period without states");
  if (!law.is_rigid()) return std::make_shared<SegmentMachine>(law, length);
  const bool mass = inverse_mass_of(dynamics, row) > 0.0;
  const auto restitution = mass ? law.restitution() : std::nullopt;
  if (!mass || restitution) return std::make_shared<RigidMachine>(law.gap(), restitution, rate);
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
