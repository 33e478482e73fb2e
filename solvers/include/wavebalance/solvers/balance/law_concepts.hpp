#pragma once
#include <concepts>
#include <optional>
#include <vector>

namespace wavebalance::solvers {

/// A force that depends on the displacement of one contact.
template <class Law>
concept DependsOnDisplacement = requires(const Law& law, double displacement) {
  { law.force(displacement) } -> std::convertible_to<double>;    // N, opposes a positive displacement
  { law.tangent(displacement) } -> std::convertible_to<double>;  // N/m; at a kink the right-hand slope
};

/// A force that depends on the displacement and the velocity of one contact, both towards the obstacle.
template <class Law>
concept DependsOnVelocity = requires(const Law& law, double displacement, double velocity) {
  { law.force(displacement, velocity) } -> std::convertible_to<double>;    // N
  { law.tangent(displacement, velocity) } -> std::convertible_to<double>;  // N/m, slope by the displacement
  { law.damping(displacement, velocity) } -> std::convertible_to<double>;  // N s/m, slope by the velocity
};

/// Requirements on a contact law. A law of the user is a struct with these four const members, or five where
/// its force depends on the velocity.
template <class Law>
concept ContactLaw = std::copy_constructible<Law> &&
    (DependsOnDisplacement<Law> || DependsOnVelocity<Law>)&&requires(const Law& law, double displacement) {
  { law.potential(displacement) } -> std::convertible_to<double>;  // J, the integral of the force at rest
  { law.gap() } -> std::convertible_to<double>;                    // m, where the force starts
};

/// A law that also computes force and tangent together. Its `evaluate(u)` returns members `force` and
/// `tangent` and is called where both are needed, so that an exponential law evaluates one exponential, not
/// two.
template <class Law>
concept EvaluatesTogether = requires(const Law& law, double displacement) {
  { law.evaluate(displacement).force } -> std::convertible_to<double>;    // N
  { law.evaluate(displacement).tangent } -> std::convertible_to<double>;  // N/m
};

/// A law that offers its resolvent in closed form, `resolvent(v, flexibility)` with members `force` and
/// `tangent`: the force f = force(v - flexibility f), flexibility in m/N, and its slope by v. Without it the
/// scalar equation is solved for by a Newton iteration within a bracket. A rigid obstacle is a law that has
/// nothing else to offer: its force beyond the gap is infinite.
template <class Law>
concept OffersResolvent = requires(const Law& law, double v, double flexibility) {
  { law.resolvent(v, flexibility).force } -> std::convertible_to<double>;    // N
  { law.resolvent(v, flexibility).tangent } -> std::convertible_to<double>;  // N/m
};

/// A law with `unilateral()`: whether it acts only beyond its gap. Without it the force below the gap is
/// evaluated.
template <class Law>
concept SaysWhereItActs = requires(const Law& law) {
  { law.unilateral() } -> std::convertible_to<bool>;
};

/// A law that lists the displacements at which its slope jumps, ascending, m. Without a list it has one at
/// its gap where it is unilateral, and otherwise where its slope jumps at its gap or at the opposite of it.
template <class Law>
concept SaysItsKinks = requires(const Law& law) {
  { law.kinks() } -> std::convertible_to<std::vector<double>>;
};

/// A law that lists the displacements at which its slope or the slope's slope jumps, ascending, m: the
/// knots of a table. Rules that integrate the slope over time are cut there. Without a list these are its
/// kinks.
template <class Law>
concept SaysItsBreakpoints = requires(const Law& law) {
  { law.breakpoints() } -> std::convertible_to<std::vector<double>>;
};

/// A rigid law that defines the fraction of its velocity with which a contact with mass leaves the obstacle
/// after an impact, 0..1; nothing of a contact without mass, which has no impacts.
template <class Law>
concept SaysItsRestitution = requires(const Law& law) {
  { law.restitution() } -> std::convertible_to<std::optional<double>>;
};

/// A law that declares whether its force decreases nowhere, so that its resolvent is one force for every v.
template <class Law>
concept SaysWhetherItRises = requires(const Law& law) {
  { law.monotone() } -> std::convertible_to<bool>;
};

}  // namespace wavebalance::solvers
