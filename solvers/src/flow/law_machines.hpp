#pragma once
#include <memory>

#include "wavebalance/solvers/flow/law_machine.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"

namespace wavebalance::solvers::detail {

/// The velocity of a row by an impulse there, 1/kg; 0 where it has no mass and is displaced at once.
double inverse_mass_of(const ContactDynamics& dynamics, int row);

/// State machine of a law of several rows at one instant, open or closed.
std::shared_ptr<const LawMachine> coupled_machine(AnyCoupledLaw law);

/// State machine of Coulomb friction along one tangent. inverse_mass, 1/kg, as above; rate, 1/s: at which
/// rounding decays while it sticks.
std::shared_ptr<const LawMachine> friction_machine(AnyContactLaw law, double inverse_mass, double rate);

/// State machine of elastic Coulomb friction along two tangents. rate, 1/s: at which rounding in slip
/// decays.
std::shared_ptr<const LawMachine> plane_friction_machine(AnyContactLaw law, double rate);

}  // namespace wavebalance::solvers::detail
