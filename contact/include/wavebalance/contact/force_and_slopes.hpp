#pragma once

namespace wavebalance::contact {

/// Force of a law that depends on displacement and velocity, with its slopes by either.
struct ForceAndSlopes {
  double force = 0.0;    ///< N
  double tangent = 0.0;  ///< N/m, d force / d displacement
  double damping = 0.0;  ///< N s/m, d force / d velocity
};

}  // namespace wavebalance::contact
