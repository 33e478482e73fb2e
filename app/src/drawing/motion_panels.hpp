#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "drawing/period_window.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"

/// Panels of one motion in addition to its displacement and force.
namespace wavebalance::app {

/// Adds the loops of friction force over tangential displacement of the contacts that dissipate most, and a
/// map of what each contact does over the period. Nothing without friction.
void add_friction(Figure& figure, const Scene& scene, const Response& response, const PeriodWindow& window);

/// The velocity of a contact over the period, sampled at uniform instants (m/s), with both values at each of
/// its impacts, so that these are drawn as jumps.
void add_velocity_with_jumps(Figure& figure, const PeriodWindow& window, const std::string& title,
                             const std::vector<solvers::Impact>& all, int contact,
                             const Eigen::VectorXd& velocity);

/// The impulses of a contact as lines at their instants.
void add_impulses(Figure& figure, const PeriodWindow& window, const std::string& title,
                  const std::vector<solvers::Impact>& all, int contact);

}  // namespace wavebalance::app
