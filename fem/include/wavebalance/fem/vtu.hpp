#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <iosfwd>
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

/// How numbers are written.
enum class VtuFormat {
  ascii,           ///< 9 significant digits for the fields, 17 for the points
  appended_base64  ///< doubles, after the XML tree; half the size and exact
};

/// Writes an unstructured grid with point data, as ParaView and VTK read it; solids have quadratic (25) or
/// linear (12) hexahedra. O(size). Throws std::invalid_argument if the mesh is not valid, or if a field does
/// not have one column per node and 1 to 9 rows, has an entry that is not finite or an empty name;
/// std::runtime_error if writing fails.
void write_vtu(std::ostream& output, const Mesh& mesh, std::span<const PointField> fields,
               VtuFormat format = VtuFormat::appended_base64);
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

}  // namespace wavebalance::fem
