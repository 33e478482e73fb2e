#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// The path of a point in a plane over one period of its motion, at uniform times from 0 on.
struct Orbit {
  std::string motion;    ///< which of several motions it is of; empty for the only one
  Eigen::VectorXd x, y;  ///< m
};

/// The orbits of all motions in one plane.
struct OrbitPlane {
  std::string title;
  double clearance;  ///< m, radius of a ring about the origin; NaN without
  std::vector<Orbit> orbits;
};

/// y over x of each plane, with its clearance circle, a mark at t = 0 and an arrow along the motion there.
Figure orbits_figure(const std::vector<OrbitPlane>& planes);

}  // namespace wavebalance::app
