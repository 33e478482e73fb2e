#pragma once
#include <string>
#include <vector>

#include "blade_motion.hpp"
#include "ll10.hpp"

/// What the figures of Laxalde & Legrand (2010), section 5.2, share.
namespace wavebalance::ll10 {

/// The energies of the paper's mode shapes [LL10, Fig. 8].
inline constexpr double shape_energies[] = {0.8, 4.7, 10.4};

/// A point of the backbone that an independent program found for this blade (N = 5, m = 20).
struct ListedPoint {
  double energy_ratio, frequency_ratio;
};
inline constexpr ListedPoint listed_points[] = {{1.2, 1.0069}, {2.0, 1.0377}, {3.0, 1.0808}, {7.0, 1.1931}};

/// The point of a backbone at an energy ratio. Throws report::NotConverged when there is none.
solvers::ModePoint accepted_at(const app::ModeStudy& study, const app::Backbone& curve, double energy_ratio);

/// Rows formulation, energy_ratio, frequency_ratio, rayleigh_frequency_ratio: published (frequency is the
/// root of r, points that were reached) and consistent (accepted points), both from the linear mode on.
Table blade_backbones(const app::ModeStudy& study, const app::Backbone& curve,
                      const std::vector<solvers::LagrangianPoint>& published);

/// energy_ratio, torsion_share (of the kinetic energy), tip_twist_degrees_per_gap (amplitude, for a gap of 1
/// mm), contact_fraction along the accepted points of a backbone.
Table blade_measures(const app::ModeStudy& study, const app::Backbone& curve);

/// The largest of the eight lowest frequencies of the reduced blade over those of the whole one, less 1.
double reduction_error(const app::ModeStudy& study);

}  // namespace wavebalance::ll10
