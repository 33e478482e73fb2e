#pragma once

namespace wavebalance::contact {

/// What a law answers to one displacement.
struct Response {
  double force = 0.0;    ///< N
  double tangent = 0.0;  ///< N/m, d force / d displacement
};

}  // namespace wavebalance::contact
