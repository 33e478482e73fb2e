#pragma once
#include "wavebalance/solvers/stability/contact_dynamics.hpp"

namespace wavebalance::solvers::detail {

/// The velocity of a row by an impulse there, 1/kg; 0 where it has no mass and is displaced at once.
double inverse_mass_of(const ContactDynamics& dynamics, int row);

}  // namespace wavebalance::solvers::detail
