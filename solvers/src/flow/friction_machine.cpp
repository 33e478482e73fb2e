#include <array>
#include <cmath>
#include <utility>

#include "flow/law_machines.hpp"

namespace wavebalance::solvers {
namespace {

/// Coulomb friction along one tangent against a surface of speed V, of a constant normal force or of a normal
/// row that may open. The slider at w slips at the limit mu N and sticks, w' = V, up to the static limit. It
/// is held by a spring k and a dashpot c, T = k (u - w) + c (u' - w'), so that in slip c w' = c u' + k (u -
/// w) - (+-mu N); or rigidly: at a contact with mass, where sticking has no acceleration, or without.
class FrictionMachine final : public LawMachine {
 public:
  /// inverse_mass, 1/kg: of the tangent; 0 without mass. rate, 1/s: at which rounding decays while it sticks.
  FrictionMachine(AnyContactLaw law, double inverse_mass, double rate)
      : law_(std::move(law)), c_(*law_.friction()), inverse_mass_(inverse_mass), rate_(rate) {}
  /// Released: above the gap, where the dashpot would pull.
  enum : int { open, stick, forward, backward, released };

  int rows() const override { return c_.normal_rows + 1; }
  int memories() const override { return 1; }
  bool remembers(int state) const override {
    return (state == stick && !accelerates()) || (slips(state) && damped());
  }
  bool moves(int state) const override {
    return remembers(state) && (slips(state) || c_.surface_speed != 0.0);
  }
  std::optional<double> settling_rate(int state) const override {
    return slips(state) ? c_.tangential_stiffness / c_.tangential_damping : 0.0;
  }

  ContactState kind(int state) const override {
    if (!touches(state)) return ContactState::open;
    return state == stick ? ContactState::stick : ContactState::slip;
  }

  std::vector<RowForce> forces(int state) const override {
    std::vector<RowForce> result(std::size_t(rows()), RowForce{});
    if (!touches(state)) return result;
    if (has_normal()) result[0].free = true;
    RowForce& tangent = result.back();
    if (state == stick)
      tangent.free = true;
    else if (has_normal())
      tangent.of_rows[0] = sign(state) * c_.friction;
    else
      tangent.constant = sign(state) * c_.friction * c_.normal_load;
    return result;
  }

  std::vector<StateExit> exits(int state) const override {
    if (state == open) return {{{stick, forward, backward}}};
    if (state == released) return {{{stick, forward, backward}}, {{open}}};
    std::vector<StateExit> result;
    if (state == stick)
      result = {{{forward}}, {{backward}}};
    else if (accelerates())
      result = {{{stick, state == forward ? backward : forward}}};
    else if (c_.friction > 0.0)
      result = {{{stick}}};
    if (has_normal()) result.push_back({{open, released}});
    return result;
  }

  void equations(int state, const LocalSignals& now, std::span<Dual> out) const override {
    std::size_t next = 0;
    if (has_normal()) out[next++] = now.force[0] - normal(now);
    if (state != stick) return;
    if (accelerates())
      out[next] = now.acceleration.back() + rate_ * speed(now);
    else
      out[next] = rigid() ? now.displacement.back() - now.memory[0] : now.force.back() - stuck(now);
  }

  void rates(int state, const LocalSignals& now, std::span<Dual> out) const override {
    out[0] = Dual(c_.surface_speed);
    if (slips(state)) out[0].add(slip_rate(state, now), sign(state) / c_.tangential_damping);
  }

  Dual guard(int state, int exit, const LocalSignals& now) const override {
    if (state == open) return -spring(now);
    if (state == released) return exit == 0 ? -normal(now) : spring(now);
    if (exit == lifting(state)) return normal(now);
    if (state != stick) return slip_rate(state, now);
    const Dual limit = c_.static_friction * normal(now), force = rigid() ? now.force.back() : stuck(now);
    return exit == 0 ? limit - force : limit + force;
  }

  void remember(int state, int, const LocalSignals& now, std::span<Dual> out) const override {
    if (remembers(state)) {
      out[0] = now.memory[0];
      return;
    }
    out[0] = now.displacement.back();
    if (!rigid() && slips(state))
      out[0].add(normal(now), -sign(state) * c_.friction / c_.tangential_stiffness);
  }

  int choose(int state, int exit, const LocalSignals& before, const LocalSignals&) const override {
    if (state == released && exit == 1) return open;
    if (!touches(state)) return closing(before);
    if (exit == lifting(state)) return damps_normal() && spring(before).value > 0.0 ? released : open;
    if (!accelerates()) return exits(state)[std::size_t(exit)].targets.front();
    const double holds = before.force.back().value + before.acceleration.back().value / inverse_mass_;
    constexpr double rounding = 1e-7;  // what is more than stuck leaves at once
    if (std::abs(holds) <= (1.0 + rounding) * c_.static_friction * normal(before).value) return stick;
    return holds > 0.0 ? forward : backward;
  }

  // Rigid friction follows the sense of the velocity, which an impulse may start or reverse.
  int after_impulse(int state, const LocalSignals& after) const override {
    if (!touches(state) || !accelerates()) return state;
    return towards(speed(after).value);
  }

  Sliding sliding(int state, const LocalSignals& now) const override {
    if (!touches(state)) return {};
    const double n = normal(now).value;
    Sliding result{.power = now.force.back().value * speed(now).value};
    if (!slips(state)) return result;
    const double per = rigid() ? 1.0 : damped() ? c_.tangential_damping : c_.tangential_stiffness;
    result.speed = slip_rate(state, now).value / per;
    result.wear = n * result.speed;
    return result;
  }
  // Without a dashpot the force falls from the static limit at once.
  Sliding sudden(int state, int exit, const LocalSignals& now) const override {
    if (state != stick || exit > 1 || rigid() || damped()) return {};
    const double n = normal(now).value,
                 slip = (c_.static_friction - c_.friction) * n / c_.tangential_stiffness;
    return {.speed = slip, .wear = n * slip};
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
    if (accelerates() && c_.surface_speed != 0.0) return towards(-c_.surface_speed);
    const double limit = c_.friction * n, own = force[std::size_t(rows()) - 1];
    return c_.friction > 0.0 && (std::abs(own) < limit || limit == 0.0) ? stick : towards(own);
  }
  int at(std::span<const double> displacement, std::span<const double> force,
         std::span<double> memory) const override {
    constexpr double rounding = 1e-6;  // of a force that a balance has limited
    const double n = normal_at(displacement), own = force.back(), limit = c_.friction * n;
    memory[0] = 0.0;
    if (has_normal() && n <= 0.0) return open;
    const bool above = c_.static_friction > c_.friction && std::abs(own) > (1.0 + rounding) * limit;
    const int state = above || std::abs(own) < (1.0 - rounding) * limit ? stick : towards(own);
    if (remembers(state)) memory[0] = displacement.back() - (rigid() ? 0.0 : own / c_.tangential_stiffness);
    return state;
  }

 private:
  static double sign(int state) { return state == forward ? 1.0 : -1.0; }
  static int towards(double direction) { return direction > 0.0 ? forward : backward; }
  static bool slips(int state) { return state == forward || state == backward; }
  static bool touches(int state) { return state == stick || slips(state); }
  bool has_normal() const { return c_.normal_rows > 0; }
  /// The exit by which a contact opens; -1 without one.
  int lifting(int state) const {
    if (!has_normal()) return -1;
    return state == stick ? 2 : accelerates() || c_.friction > 0.0 ? 1 : 0;
  }
  bool rigid() const { return std::isinf(c_.tangential_stiffness); }
  bool accelerates() const { return rigid() && inverse_mass_ > 0.0; }
  bool damped() const { return c_.tangential_damping > 0.0; }
  bool damps_normal() const { return c_.normal_damping > 0.0; }

  double normal_at(std::span<const double> displacement) const {
    return c_.normal_load + (has_normal() ? c_.normal_stiffness * displacement[0] : 0.0);
  }
  /// N, only of the normal spring.
  Dual spring(const LocalSignals& now) const {
    return has_normal() ? Dual(c_.normal_load) + c_.normal_stiffness * now.displacement[0]
                        : Dual(c_.normal_load);
  }
  Dual normal(const LocalSignals& now) const {
    return damps_normal() ? spring(now) + c_.normal_damping * now.velocity[0] : spring(now);
  }
  Dual normal_rate(const LocalSignals& now) const {
    if (!has_normal()) return Dual();
    return c_.normal_stiffness * now.velocity[0] + c_.normal_damping * now.acceleration[0];
  }
  /// m/s, over the surface.
  Dual speed(const LocalSignals& now) const { return now.velocity.back() - Dual(c_.surface_speed); }
  /// N, of a stuck contact, by displacements, so that its rate is known at every instant.
  Dual stuck(const LocalSignals& now) const {
    const Dual result = c_.tangential_stiffness * (now.displacement.back() - now.memory[0]);
    return damped() ? result + c_.tangential_damping * speed(now) : result;
  }
  /// Positive while the slider goes on: its speed, times the dashpot or the spring that it has.
  Dual slip_rate(int state, const LocalSignals& now) const {
    if (rigid()) return sign(state) * speed(now);
    if (damped()) return sign(state) * stuck(now) - c_.friction * normal(now);
    return c_.tangential_stiffness * sign(state) * speed(now) - c_.friction * normal_rate(now);
  }
  /// Where forces are zero as a contact closes, their rates decide.
  int closing(const LocalSignals& before) const {
    const double v = speed(before).value;
    if (c_.friction == 0.0) return forward;
    if (rigid()) return v == 0.0 ? stick : towards(v);
    double force = c_.tangential_damping * std::abs(v), limit = c_.static_friction * normal(before).value;
    if (!damped() && !damps_normal()) {
      force = c_.tangential_stiffness * std::abs(v);
      limit = c_.static_friction * normal_rate(before).value;
    }
    return force < limit ? stick : towards(v);
  }

  AnyContactLaw law_;
  FrictionConstants c_;
  double inverse_mass_, rate_;
};

}  // namespace

std::shared_ptr<const LawMachine> detail::friction_machine(AnyContactLaw law, double inverse_mass,
                                                           double rate) {
  return std::make_shared<FrictionMachine>(std::move(law), inverse_mass, rate);
}

}  // namespace wavebalance::solvers
