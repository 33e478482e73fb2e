#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers {

/// A closed curve on which a map turns points by one angle: the section of a quasi-periodic motion.
struct InvariantCurve {
  double rotation = 0.0;  ///< turns from a point to the next one, up to 1/2
  /// The largest distance of the points of the record's second half from where the curve, fitted to the first
  /// half, predicts them, relative to the largest distance of a point from their mean. Infinite without a
  /// curve.
  double residual = 0.0;
  Eigen::MatrixXd coefficients;  ///< (2 K + 1) x rows: the mean, then cosines, then sines of 1 to K turns

  int harmonics() const { return static_cast<int>(coefficients.rows() / 2); }
  /// The point after a number of turns, rows of the section.
  Eigen::VectorXd at(double turns) const;
};

/// The Fourier series whose values at equal turns are nearest to the points, columns in their order, of
/// which the last 4096 count. The strongest line of the spectrum under the window exp(-1 / (t (1 - t))) of
/// weighted Birkhoff averages [S. Das et al., Nonlinearity 30, 2017, doi:10.1088/1361-6544/aa84c2] is the
/// first to fourth harmonic of the rotation; from there rotation and coefficients follow by least squares,
/// with as many harmonics as make the residual less. The first of these rotations with a residual of at
/// most `tolerance`, else the one with the least. A chaotic section has no small residual, whatever the
/// harmonics. O(points^2 + points harmonics^2).
InvariantCurve invariant_curve(const Eigen::MatrixXd& points, double tolerance);

}  // namespace wavebalance::solvers
