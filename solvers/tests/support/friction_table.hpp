#pragma once
#include <string>

#include "support/friction_scenes.hpp"

// Exact motions of scenes with friction.
namespace wavebalance::solvers::testing {

struct FrictionRow {
  std::string name;
  FrictionScene scene;
  int compared;  // row of the amplitude
  double amplitude;
  double largest = 0.0, second = 0.0;  // moduli of the Floquet multipliers
};

// From event-driven integrations with residuals of their period map below 1e-11.
inline std::vector<FrictionRow> friction_rows() {
  return {{"Jenkins 1", slider_on_oscillator(2.0, 1.0, 1.0), 0, 15.24880669, 0.85325385, 0.65482821},
          {"Jenkins 2", slider_on_oscillator(2.0, 1.0, 1.2), 0, 5.002826509, 0.64754840, 0.64754840},
          {"Jenkins 3", slider_on_oscillator(1.5, 1.0, 1.3), 0, 2.877360723, 0.53886293, 0.53886293},
          {"Jenkins 4", slider_on_oscillator(0.5, 1.0, 1.41), 0, 1.356058056, 0.22235916, 0.22235916},
          {"Jenkins 5", slider_on_oscillator(2.0, 1.0, 0.45), 0, 1.097855263, 0.34209596, 0.34209596},
          {"Jenkins 6", slider_on_oscillator(1.5, 10.0, 1.1), 0, 3.283576885, 0.50867709, 0.50867709},
          {"Jenkins 7", slider_on_oscillator(2.0, 10.0, 0.35), 0, 1.922715379, 0.20389380, 0.20389380},
          {"masses 1", rubbing_masses(1.0, 20.0, 1.0, 1.1), 0, 0.3190945734, 0.92711204, 0.58686155},
          {"masses 2", rubbing_masses(1.0, 2.0, 0.3, 1.0), 0, 15.49106365, 0.93907670, 0.90339657},
          {"masses 3", rubbing_masses(1.0, 2.0, 0.3, 1.7), 0, 2.410075263, 0.92230190, 0.92230190},
          {"masses 4", rubbing_masses(1.0, 2.0, 0.3, 0.6), 0, 0.3837520286, 0.77228987, 0.73216139},
          {"masses 5", rubbing_masses(0.3, 20.0, 1.0, 1.4), 0, 0.2490895418, 0.90334314, 0.90334314},
          {"lift-off 1", lift_off(2.0, 2.0, 0.6, 0.5, 3.0), 1, 0.8394928991, 0.63913085, 0.63913085},
          {"lift-off 2", lift_off(2.0, 0.3, 0.8, 0.5, 3.6), 1, 0.8480504295, 0.68426516, 0.68426516},
          {"lift-off 3", lift_off(1.0, 1.0, 0.6, 0.5, 2.4), 1, 0.16760139, 0.60672739, 0.60672739},
          {"lift-off 4", lift_off(3.0, 3.0, 0.6, 0.3, 4.5), 1, 0.1494001728, 0.73159211, 0.73159211},
          {"lift-off 5", lift_off(2.0, 2.0, 0.6, 0.5, 5.2), 1, 0.09885903968, 0.73791930, 0.73791930},
          {"beam 1", cantilever(200.0, 1e7, 500.0, 21.0), 0, 0.0002213141966, 0.71382433, 0.71382433},
          {"beam 2", cantilever(200.0, 1e7, 500.0, 23.0), 0, 0.0001398661067, 0.63596525, 0.63596525},
          {"beam 3", cantilever(1000.0, 1e7, 500.0, 30.0), 0, 0.0001678063563, 0.79077385, 0.79077385},
          {"beam 4", cantilever(200.0, 1e8, 300.0, 25.0), 0, 5.617511121e-05, 0.64718010, 0.64718010},
          {"chain 1", chain_of_three(6.0, 1.0), 0, 5.457548875, 0.83426451, 0.83426451},
          {"chain 2", chain_of_three(3.0, 0.85), 0, 6.92202665, 0.78746749, 0.78746749},
          {"plane 1", slip_in_a_plane(0.4, 1.1), 0, 3.062298476},
          {"plane 2", slip_in_a_plane(0.5, 1.6), 0, 0.702498735},
          {"plane 3", slip_in_a_plane(0.6, 0.6), 0, 0.823732656}};
}

}  // namespace wavebalance::solvers::testing
