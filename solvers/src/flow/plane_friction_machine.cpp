#include <array>
#include <cmath>
#include <utility>

#include "flow/law_machines.hpp"

namespace wavebalance::solvers {
namespace {

/// Elastic Coulomb friction along two tangents. The force f = k (u - w) belongs to a spring between the
/// contact and a slider at w in the plane. In stick the slider rests while |f| < L, the limit of the normal
/// force. In slip it moves along the force so that |f| = L: w' = n (n.u' - L'/k), n = f / L, while that
/// rate is positive.
class PlaneFrictionMachine final : public LawMachine {
 public:
  /// rate, 1/s: at which a force near its limit returns to it.
  PlaneFrictionMachine(AnyContactLaw law, double rate)
      : law_(std::move(law)), c_(*law_.friction()), first_(std::size_t(c_.normal_rows)), rate_(rate) {}
  enum : int { open, stick, slip };

  int rows() const override { return c_.normal_rows + 2; }
  int memories() const override { return 2; }
  bool remembers(int state) const override { return state == stick || moves(state); }
  bool moves(int state) const override { return state == slip && rubs(); }

  ContactState kind(int state) const override {
    constexpr std::array<ContactState, 3> kinds{ContactState::open, ContactState::stick, ContactState::slip};
    return kinds[std::size_t(state)];
  }

  std::vector<RowForce> forces(int state) const override {
    std::vector<RowForce> result(std::size_t(rows()), RowForce{});
    if (state == open) return result;
    if (has_normal()) result[0].free = true;
    result[first_].free = result[first_ + 1].free = remembers(state);
    return result;
  }

  std::vector<StateExit> exits(int state) const override {
    if (state == open) return {{{stick, slip}}};
    std::vector<StateExit> result;
    if (rubs()) result.push_back({{state == stick ? slip : stick}});
    if (has_normal()) result.push_back({{open}});
    return result;
  }

  // The direction of the force, in which it vanishes, is singular.
  int singular_exit(int state) const override { return moves(state) && has_normal() ? 1 : -1; }

  void equations(int state, const LocalSignals& now, std::span<Dual> out) const override {
    if (has_normal()) out[0] = now.force[0] - normal(now);
    if (!remembers(state)) return;
    for (std::size_t i = 0; i < 2; ++i) out[first_ + i] = now.force[first_ + i] - elastic(now, i);
  }

  void rates(int, const LocalSignals& now, std::span<Dual> out) const override {
    const double flexibility = 1.0 / c_.tangential_stiffness;
    const Dual size = signed_size(now), x = elastic(now, 0) / size, y = elastic(now, 1) / size,
               &vx = now.velocity[first_], &vy = now.velocity[first_ + 1], along = x * vx + y * vy,
               rate = along + flexibility * (rate_ * (size - limit_of(now)) - limit_rate(now));
    out[0] = rate * x;
    out[1] = rate * y;
  }

  Dual guard(int state, int exit, const LocalSignals& now) const override {
    if (state == open) return -normal(now);
    if (exit == 1 || !rubs()) return normal(now);
    if (state == slip) return slip_rate(now);
    const Dual x = elastic(now, 0), y = elastic(now, 1), limit = limit_of(now);
    return limit * limit - x * x - y * y;
  }

  void remember(int state, int, const LocalSignals& now, std::span<Dual> out) const override {
    for (std::size_t i = 0; i < 2; ++i) out[i] = state == open ? now.displacement[first_ + i] : now.memory[i];
  }

  int choose(int, int, const LocalSignals& before, const LocalSignals&) const override {
    return rubs() && c_.tangential_stiffness * speed(before).value < limit_rate(before).value ? stick : slip;
  }

  Sliding sliding(int state, const LocalSignals& now) const override {
    Sliding result;
    if (state == open) return result;
    for (std::size_t i = first_; i < first_ + 2; ++i)
      result.power += now.force[i].value * now.velocity[i].value;
    if (state == slip && rubs()) result.speed = slip_rate(now).value / c_.tangential_stiffness;
    result.wear = normal(now).value * result.speed;
    return result;
  }

  int start(std::span<const double> displacement, std::span<double> memory) const override {
    std::array<double, 3> force{};
    const std::array<double, 3> none{};
    const auto count = std::size_t(rows());
    law_.start(displacement, {none.data(), count}, {force.data(), count});
    return at(displacement, {force.data(), count}, memory);
  }
  int at(std::span<const double> displacement, std::span<const double> force,
         std::span<double> memory) const override {
    constexpr double rounding = 1e-6;  // of a force that a balance has limited
    const double n = normal_at(displacement), limit = c_.friction * n,
                 size = std::hypot(force[first_], force[first_ + 1]);
    memory[0] = memory[1] = 0.0;
    if (has_normal() && n <= 0.0) return open;
    if (!rubs()) return slip;
    const bool slips = size >= (1.0 - rounding) * limit && limit > 0.0;
    const double part = (slips ? limit / size : 1.0) / c_.tangential_stiffness;
    for (std::size_t i = 0; i < 2; ++i) memory[i] = displacement[first_ + i] - part * force[first_ + i];
    return slips ? slip : stick;
  }

 private:
  bool has_normal() const { return c_.normal_rows > 0; }
  bool rubs() const { return c_.friction > 0.0; }

  double normal_at(std::span<const double> displacement) const {
    return c_.normal_load + (has_normal() ? c_.normal_stiffness * displacement[0] : 0.0);
  }
  Dual normal(const LocalSignals& now) const {
    return has_normal() ? Dual(c_.normal_load) + c_.normal_stiffness * now.displacement[0]
                        : Dual(c_.normal_load);
  }
  Dual limit_of(const LocalSignals& now) const { return c_.friction * normal(now); }
  Dual limit_rate(const LocalSignals& now) const {
    return has_normal() ? c_.friction * c_.normal_stiffness * now.velocity[0] : Dual();
  }
  /// By displacements, so that its rate is known at every instant.
  Dual elastic(const LocalSignals& now, std::size_t i) const {
    return c_.tangential_stiffness * (now.displacement[first_ + i] - now.memory[i]);
  }
  static Dual norm(const Dual& x, const Dual& y) {
    const double size = std::hypot(x.value, y.value);
    return size > 0.0 ? (x.value / size) * x + (y.value / size) * y : Dual();
  }
  Dual speed(const LocalSignals& now) const { return norm(now.velocity[first_], now.velocity[first_ + 1]); }
  /// |f|, or -|f| where the limit is negative: behind the instant at which a contact opens the equations of
  /// slip go on smoothly.
  Dual signed_size(const LocalSignals& now) const {
    const Dual size = norm(elastic(now, 0), elastic(now, 1));
    return limit_of(now).value < 0.0 ? -size : size;
  }
  /// Times the stiffness. As a contact closes and opens the force has no direction: slip turns it to the
  /// direction of the velocity.
  Dual slip_rate(const LocalSignals& now) const {
    constexpr double rounding = 1e-8;
    const double k = c_.tangential_stiffness, of_displacement = std::abs(now.displacement[first_].value) +
                                                                std::abs(now.displacement[first_ + 1].value) +
                                                                std::abs(now.memory[0].value) +
                                                                std::abs(now.memory[1].value);
    if (has_normal() && std::abs(limit_of(now).value) < rounding * k * of_displacement)
      return k * speed(now) - limit_rate(now);
    const Dual power = elastic(now, 0) * now.velocity[first_] + elastic(now, 1) * now.velocity[first_ + 1];
    return k * power / signed_size(now) - limit_rate(now);
  }

  AnyContactLaw law_;
  FrictionConstants c_;
  std::size_t first_;  // tangent
  double rate_;
};

}  // namespace

std::shared_ptr<const LawMachine> detail::plane_friction_machine(AnyContactLaw law, double rate) {
  return std::make_shared<PlaneFrictionMachine>(std::move(law), rate);
}

}  // namespace wavebalance::solvers
