#pragma once
#include <complex>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/structure_model.hpp"

namespace wavebalance::app {

/// A free motion Re(X exp(lambda t)) of a structure that turns.
struct WhirlMode {
  std::complex<double> exponent;  ///< lambda, 1/s, Im > 0
  /// 2 (x x y) / (|x|^2 + |y|^2) of the ellipse that the plane of the model moves along, in [-1, 1]: 1 a
  /// circle in the sense from x to y, -1 one against it, 0 a line. NaN where the plane does not move, or
  /// without one.
  double circularity = 0.0;

  double frequency_hz() const;
  double damping_ratio() const { return -exponent.real() / std::abs(exponent); }
  /// "forward", "backward", "in a line", or "-" where the circularity is not known.
  std::string direction() const;
};

/// A speed at which a whirl has the frequency of the speed.
struct CriticalSpeed {
  double speed = 0.0;  ///< rad/s
  WhirlMode whirl;
};

/// Whirls over the speed.
struct CampbellDiagram {
  std::vector<double> speeds;  ///< rad/s, from 0 on
  std::vector<std::vector<WhirlMode>>
      lines;                            ///< one for each mode, by its frequency at rest; NaN where it ends
  std::vector<CriticalSpeed> critical;  ///< ascending
};

/// Whether a model has matrices that vary with a speed.
inline bool has_whirls(const StructureModel& model) {
  return model.turning.gyroscopic.size() > 0 || model.turning.stiffness.size() > 0;
}

/// The lowest whirls of a model without contact at a speed (rad/s), ascending; none where the structure has
/// no modes to compute. Beyond 100 degrees of freedom they are those that a block Krylov space of 48 vectors
/// from the plane has [solvers::ContactDynamics]. O(n^3).
std::vector<WhirlMode> whirls_at(const StructureModel& model, double speed, int most = 8);

/// The lowest whirls from rest to a speed, each followed by its exponent, and the speeds at which
/// Im lambda = speed by bracketing between neighbours on a line. Two crossings within one step of a line are
/// not noticed. 60 whirls_at(), and some 8 for each critical speed.
CampbellDiagram campbell_diagram(const StructureModel& model, double highest);

/// Whether gyroscopic forces raise the whirls against the sense of the plane and lower those along it: a
/// matrix G of the other sign than the unbalance. O(lines).
bool turns_against_plane(const CampbellDiagram& diagram);

}  // namespace wavebalance::app
