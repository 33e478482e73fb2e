#pragma once
#include <Eigen/Core>
#include <vector>

#include "surface.hpp"
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/fem/blade.hpp"

/// Measures of a blade's motions, and its surface for the pictures.
namespace wavebalance::blade {

/// Displacements of all nodes of the scene's blade, 3 x nodes (m), at `times` uniform times of a mode's
/// period from t = 0 on. O(n r times), n unknowns and r coordinates of the reduced blade.
std::vector<Eigen::Matrix3Xd> motion(const app::ModeStudy& study, const solvers::ModePoint& point, int times);

/// The rigid motion in planes z = const that is nearest to the displacements of the tip's contact nodes
/// (least squares).
struct TipMotion {
  Eigen::Vector2d translation = Eigen::Vector2d::Zero();  ///< m, of the nodes' centre
  double rotation = 0.0;                                  ///< rad, about z
  double radius = 0.0;                                    ///< m, of gyration of the nodes about their centre
  /// The share of rotation in the squared displacement of the rigid motion.
  double rotation_share() const;
};
/// displacements: 3 x nodes, m.
TipMotion tip_motion(const fem::Blade& blade, const Eigen::Matrix3Xd& displacements);

/// Half the difference of the largest and the smallest rotation of the tip over a period, rad.
double twist_amplitude(const fem::Blade& blade, const std::vector<Eigen::Matrix3Xd>& motion);

/// Which linear modes are torsion: those whose tip rotates more than it translates.
std::vector<bool> torsion_modes(const app::ModeStudy& study);

/// The share of the modes of `torsion` in the kinetic energy, mean over the period. Linear modes are
/// orthogonal, so that this energy is the sum over harmonics n and modes j of n^2 |a_jn|^2.
double torsion_share(const std::vector<bool>& torsion, const solvers::ModePoint& point);

/// Fractions of the period at which samples bear a force, at the contact nodes of either half of the chord.
struct EdgeContact {
  std::vector<double> leading, trailing;
};
/// force: contacts x samples, N, contacts from the leading to the trailing edge.
EdgeContact edge_contact(const Eigen::MatrixXd& force);

/// The blade's surface in mm. displacements: 3 x nodes, m, or empty; added `scale` times.
Surface surface(const fem::Blade& blade, const Eigen::Matrix3Xd& displacements = {}, double scale = 0.0);

}  // namespace wavebalance::blade
