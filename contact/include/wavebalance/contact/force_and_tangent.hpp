#pragma once

namespace wavebalance::contact {

/// Force and slope of a contact law at one displacement.
struct ForceAndTangent {
  double force = 0.0;    ///< N
  double tangent = 0.0;  ///< N/m, d force / d displacement
};

}  // namespace wavebalance::contact
