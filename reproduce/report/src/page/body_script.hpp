#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "wavebalance/fem/solid.hpp"

namespace wavebalance::report {

/// A mesh and the displacements of its nodes at one instant (m), 3 x nodes.
struct Frame {
  fem::SolidMesh mesh;
  Eigen::Matrix3Xd displacement;
};

/// Reads what fem::write_vtu writes with appended data: a mesh and the point field "displacement". Throws
/// app::IoError naming `file` for anything else.
Frame parse_vtu(const std::string& text, const std::filesystem::path& file);

/// The motion that the series `pvd` holds, as a script that body.js moves: wavebalance.bodies["<stem>"] with
/// the corners of the surface (integers of 1/20000 of the body's size), its triangles, and their
/// displacements at each instant (integers of 1/2000 of the largest). The instants must be uniform over a
/// period. Throws app::IoError if a file is missing or no such series.
std::string body_script(const std::filesystem::path& pvd);

}  // namespace wavebalance::report
