#pragma once
#include <string>
#include <vector>

#include "blade_motion.hpp"
#include "curves.hpp"
#include "ll10.hpp"
#include "modes/mode_augmented_lagrangian.hpp"

/// Common parts of the figures of Laxalde & Legrand (2010), section 5.2.
namespace wavebalance::ll10 {

/// The energies of the paper's mode shapes [LL10, Fig. 8].
inline constexpr double shape_energies[] = {0.8, 4.7, 10.4};

/// A motion of the blade by the augmented Lagrangian of the consistent equations (Algorithm 1), started from
/// the condensed solution: a second solver for the same equations, on all coordinates.
struct SecondSolution {
  double energy_ratio = 0.0;
  double condensed = 0.0;   ///< frequency over the linear one
  double lagrangian = 0.0;  ///< the same by the second solver
};
/// The `energies` that both reach. Throws report::NotConverged where the curve has no such energy.
std::vector<SecondSolution> second_solutions(const app::ModeStudy& study, const app::Backbone& curve,
                                             const std::vector<double>& energies);

/// energy_ratio, torsion_share (of the kinetic energy), tip_twist_degrees_per_gap (amplitude, for a gap of 1
/// mm), contact_fraction along the accepted points of a backbone.
Table blade_measures(const app::ModeStudy& study, const app::Backbone& curve);

/// The largest of the eight lowest frequencies of the reduced blade over the whole one, less 1.
double reduction_error(const app::ModeStudy& study);

}  // namespace wavebalance::ll10
