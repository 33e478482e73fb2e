#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "wavebalance/fem/solid.hpp"

namespace wavebalance::fem {

/// Values at the nodes: one column a node and 1 to 9 rows; three rows are a vector to ParaView, six a
/// symmetric tensor in the order of nodal_stress().
struct PointField {
  std::string name;
  Eigen::MatrixXd values;
};

enum class VtuFormat {
  ascii,           ///< 9 significant digits for the fields, 17 for the points
  appended_base64  ///< doubles, behind the tree; half the size and exact
};

/// Writes an unstructured grid of quadratic (25) or linear (12) hexahedra with point data, as ParaView and
/// VTK read it. O(size). Throws std::invalid_argument if the mesh is not valid, a field has not one column a
/// node, no or more than 9 rows, an entry that is not finite or an empty name; std::runtime_error if writing
/// fails.
void write_vtu(std::ostream& output, const SolidMesh& mesh, std::span<const PointField> fields,
               VtuFormat format = VtuFormat::appended_base64);
void write_vtu(const std::filesystem::path& file, const SolidMesh& mesh, std::span<const PointField> fields,
               VtuFormat format = VtuFormat::appended_base64);

/// A file of a series and its time (s, or any other abscissa).
struct PvdEntry {
  double time;
  std::string file;  ///< relative to the .pvd file
};

/// Writes a ParaView collection. Throws std::invalid_argument if a time is not finite, std::runtime_error if
/// writing fails.
void write_pvd(std::ostream& output, std::span<const PvdEntry> entries);

/// Writes folder/stem.pvd and folder/stem_0000.vtu, ...: the field "displacement" (3 x n) at each time. The
/// folder must exist. Throws as write_vtu does, and if there is not one displacement a time.
void write_vtu_series(const std::filesystem::path& folder, const std::string& stem, const SolidMesh& mesh,
                      std::span<const double> times, std::span<const Eigen::Matrix3Xd> displacements,
                      VtuFormat format = VtuFormat::appended_base64);

}  // namespace wavebalance::fem
