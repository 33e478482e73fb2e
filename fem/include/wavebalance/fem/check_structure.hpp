#pragma once
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "wavebalance/fem/matrices.hpp"

namespace wavebalance::fem {

/// The matrix at fault in a StructureFault.
enum class StructureMatrix { mass, damping, stiffness };

/// "mass", "damping" or "stiffness".
std::string_view to_string(StructureMatrix matrix);

/// Thrown when one of the matrices of a structure cannot be used.
class StructureFault : public std::invalid_argument {
 public:
  StructureFault(StructureMatrix matrix, const std::string& reason);

  /// The matrix at fault.
  StructureMatrix matrix() const { return matrix_; }
  /// The error without the name of the matrix: "is not symmetric: row 2, column 1 differs ..".
  const std::string& reason() const { return reason_; }

 private:
  StructureMatrix matrix_;
  std::string reason_;
};

/// Properties that check_structure() accepts.
struct StructureChecks {
  bool allow_free = false;            ///< accept a singular stiffness: a structure that can move freely
  bool unsymmetric = false;           ///< accept a damping and a stiffness without symmetry
  bool semidefinite_mass = false;     ///< accept motions without mass, which a reduction to modes leaves out
  double symmetry_tolerance = 1e-10;  ///< of the largest entry, >= 0
  int first_index = 0;                ///< number of the first row in errors; 1 for Matrix Market files
};

/// Throws StructureFault if a matrix is empty, not square or of another size than the stiffness (damping may
/// be 0 x 0), has an entry that is not finite, is not symmetric (but for damping and stiffness if
/// unsymmetric), or if the mass is not positive definite, or semidefinite if that is accepted; unless
/// allow_free, also if the stiffness is singular or indefinite. Definite means that each pivot of the matrix
/// with its diagonal scaled to ones exceeds 1e-13, of an unsymmetric stiffness of its symmetric part, which
/// excludes static divergence. The definiteness of the damping is not checked; see positive_semidefinite().
/// One or two sparse factorizations.
void check_structure(const Matrices& matrices, const StructureChecks& checks = {});

/// Whether a symmetric n x n matrix A is positive semidefinite to a tolerance: whether the smallest
/// eigenvalue of D^-1/2 A D^-1/2 exceeds -tolerance, with D the diagonal of A. A row whose diagonal entry is
/// zero (below tolerance^2 times the largest) must be zero (below tolerance times the largest). The default
/// accepts matrices that were written with nine digits. A damping matrix that fails adds energy to some
/// motion, so that the structure is unstable without any contact. An empty matrix passes. One sparse
/// factorization, of the scaled matrix plus tolerance times the identity. Throws std::invalid_argument if the
/// matrix is not square or the tolerance is not positive and finite.
bool positive_semidefinite(const Eigen::SparseMatrix<double>& matrix, double tolerance = 1e-8);

/// Throws std::invalid_argument naming the list if an entry is not in 0..unknowns-1 or occurs twice.
void check_unknowns(std::span<const int> list, int unknowns, const std::string& name);

}  // namespace wavebalance::fem
