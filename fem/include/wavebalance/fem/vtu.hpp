#pragma once
#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "wavebalance/fem/mesh.hpp"

namespace wavebalance::fem {

/// Values at the nodes: one column per node and 1 to 9 rows. ParaView reads three rows as a vector and six as
/// a symmetric tensor in the order of nodal_stress().
struct PointField {
  std::string name;
  Eigen::MatrixXd values;
};

/// An unstructured grid with point data, as ParaView and VTK read it, its numbers in base64. O(size). Throws
/// std::invalid_argument if the mesh is not valid, or if a field does not have one column per node and 1 to 9
/// rows, has an entry that is not finite or an empty name.
std::string vtu_text(const Mesh& mesh, std::span<const PointField> fields);

/// A file of a series and its time (s, or any other abscissa).
struct PvdEntry {
  double time;
  std::string file;  ///< relative to the .pvd file
};

/// A ParaView collection. Throws std::invalid_argument if a time is not finite.
std::string pvd_text(std::span<const PvdEntry> entries);

}  // namespace wavebalance::fem
