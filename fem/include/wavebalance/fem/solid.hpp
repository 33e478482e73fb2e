#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "wavebalance/fem/assembly.hpp"
#include "wavebalance/fem/matrices.hpp"

namespace wavebalance::fem {

/// Hexahedra with three displacements per node. Nodes are in the order of VTK: the corners of the face zeta
/// = -1 anticlockwise from (-1,-1), then of zeta = 1, then the edge midpoints of either face and of the
/// four edges along zeta.
enum class SolidElement {
  hexahedron8,          ///< trilinear with the incompatible modes 1 - xi^2, ... [TBW76], 2 x 2 x 2 points
  hexahedron20,         ///< serendipity, 3 x 3 x 3 points for the stiffness
  hexahedron20_reduced  ///< the same with 2 x 2 x 2 points for the stiffness
};

/// 8 or 20.
int nodes_per_element(SolidElement element);

/// Isotropic and linear elastic.
struct SolidMaterial {
  double youngs_modulus = 110e9;  ///< Pa, > 0
  double poissons_ratio = 0.31;   ///< in (-1, 1/2)
  double density = 4430.0;        ///< kg/m^3, > 0

  /// Throws std::invalid_argument naming the member, its value and what is allowed.
  void validate() const;
};

/// Nodes 3 x n (m) and elements, nodes_per_element x elements, numbers 0..n-1.
struct SolidMesh {
  SolidElement element = SolidElement::hexahedron20;
  Eigen::Matrix3Xd nodes;
  Connectivity elements;

  /// The coordinates of one element's nodes, 3 x nodes_per_element. Throws std::out_of_range.
  Eigen::Matrix3Xd coordinates(int index) const;
  /// Throws std::invalid_argument if a size does not fit, a node number is out of range or a coordinate is
  /// not finite.
  void validate() const;
};

/// Stiffness of an element (N/m), 3k x 3k with k nodes at the columns of coordinates, dof 3 i + direction.
/// Symmetric, with six zero eigenvalues. hexahedron20_reduced has six more, the hourglass modes, which
/// propagate along a row of single elements but not through a sheet or block: use at least two elements
/// across a beam. The incompatible modes are condensed. Their gradients use the Jacobian at the centre, so
/// that distorted elements represent constant strain exactly. Throws std::invalid_argument if sizes or
/// material do not fit or the Jacobian determinant is not positive at an integration point. O(k^2) products
/// per point.
Eigen::MatrixXd element_stiffness(SolidElement element, const Eigen::Matrix3Xd& coordinates,
                                  const SolidMaterial& material);

/// Consistent mass (kg), 3k x 3k, with 2 x 2 x 2 (8 nodes) or 3 x 3 x 3 points. Throws as element_stiffness.
Eigen::MatrixXd element_mass(SolidElement element, const Eigen::Matrix3Xd& coordinates,
                             const SolidMaterial& material);

/// A mesh, its material and the dofs (3 node + direction) that are free.
struct SolidModel {
  SolidMesh mesh;
  SolidMaterial material;
  FreeDofs dofs;

  /// 3 x n displacements of all nodes from the unknowns. Throws std::invalid_argument.
  Eigen::Matrix3Xd displacements(const Eigen::VectorXd& unknowns) const;
  /// The plan that assembles matrices over the unknowns. Throws std::invalid_argument.
  Assembly assembly() const;
};

/// The mesh with all three dofs of the listed nodes held. Throws std::invalid_argument if mesh, material or a
/// node do not fit.
SolidModel hold_nodes(SolidMesh mesh, const SolidMaterial& material, const std::vector<int>& nodes);

/// Mass and stiffness over the unknowns, and C = stiffness_damping (s) K. O(elements). Throws
/// std::invalid_argument, naming the element whose Jacobian determinant is not positive.
Matrices solid_matrices(const SolidModel& model, double stiffness_damping = 0.0);

/// Stress at all nodes, 6 x n (Pa), components in the order of VTK: xx, yy, zz, xy, yz, xz. The values at
/// 2 x 2 x 2 points, where they are most accurate, are extended trilinearly and averaged over the elements of
/// each node. displacements: 3 x n (m). O(elements). Throws std::invalid_argument if mesh, material or
/// displacements do not fit.
Eigen::Matrix<double, 6, Eigen::Dynamic> nodal_stress(const SolidModel& model,
                                                      const Eigen::Matrix3Xd& displacements);

/// A block of cells[0] x cells[1] x cells[2] hexahedra, bent by a mapping.
struct StructuredMesh {
  SolidMesh mesh;
  Eigen::Matrix3Xd parameters;  ///< of each node, in [0,1]^3, exactly 0 and 1 on the faces

  /// The nodes whose parameters satisfy a condition, ascending.
  std::vector<int> nodes_where(const std::function<bool(const Eigen::Vector3d&)>& condition) const;
};

/// Every node, midpoints too, lies at mapping(parameters). Nodes are numbered with the third parameter
/// slowest and the first fastest. Throws std::invalid_argument if a count of cells is below 1 or the nodes
/// are too many for an int.
StructuredMesh structured_mesh(SolidElement element, const std::array<int, 3>& cells,
                               const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& mapping);

}  // namespace wavebalance::fem
