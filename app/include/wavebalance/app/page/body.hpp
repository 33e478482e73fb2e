#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "wavebalance/fem/boundary_faces.hpp"

namespace wavebalance::app {

/// A body and its motion, as body.js moves it.
struct MovingBody {
  std::string label;                     ///< in the list of motions
  Eigen::Matrix3Xd points;               ///< m, at rest
  fem::MeshSurface surface;              ///< numbers of points
  std::vector<Eigen::Matrix3Xd> frames;  ///< m, displacements of all points at uniform instants of a period
  double times = 1.0;                    ///< as large displacements are drawn
};

/// Draws displacements so many times as large, 1, 2 or 5 times a power of ten and at least 1, that the
/// largest is about a tenth of the body.
double exaggeration(const MovingBody& body);

/// A script that defines wavebalance.bodies[name] with the points of the surface (integers of 1/20000 of the
/// body's size), its triangles and segments, and their displacements at each instant (integers of 1/2000 of
/// the largest). O(points frames).
std::string body_script(const std::string& name, const MovingBody& body);

}  // namespace wavebalance::app
