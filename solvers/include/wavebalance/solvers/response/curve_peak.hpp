#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <functional>

#include "wavebalance/solvers/response/frequency_sweep.hpp"

namespace wavebalance::solvers {

/// The highest point of a curve near one of its points, by a measure of its motions.
struct CurvePeak {
  double value = 0.0;            ///< of the curve's parameter: Hz or load scale
  Eigen::VectorXd unknown = {};  ///< PeriodicResponse::unknown
  double height = 0.0;           ///< the measure
  double value_error = 0.0;      ///< how far from it the highest point may be, in the unit of the parameter
  double height_error = 0.0;     ///< by how much that is higher, over the height
  int solutions = 0;             ///< of the balance that were solved for
};

/// A measure of the motion at a value of the parameter with an unknown.
using CurveHeight = std::function<double(double value, const Eigen::VectorXd& unknown)>;

/// The highest point between the neighbours of point `index` of a curve that was traced on `problem` with
/// keep_unknowns, of which no neighbour is higher: by Brent's method over the arc length, with a new solution
/// of the balance for each place. The point itself at an end of the curve, where a neighbour is higher, and
/// where no point between was found, then with the distances to the neighbours as errors. The problem is left
/// at another value in the displacement form. `height` may not change it. Throws std::invalid_argument for a
/// point without unknown. About ten solutions.
CurvePeak curve_peak(CondensedProblem& problem, const ContactLaws& laws, const FrequencySweep& curve,
                     std::size_t index, const CurveHeight& height);

/// A maximum of a function between `left` and `right`, of which the value at `middle` between them is the
/// largest of three, by golden sections and parabolas, to `tolerance` of the distance of `left` and `right`.
/// A value that is not finite ends the search.
struct Maximum {
  double at = 0.0, value = 0.0;
  double left = 0.0, right = 0.0;  ///< between which it is
  double beside = 0.0;             ///< the larger value there
  bool complete = false;           ///< the tolerance is met
};
Maximum maximum_between(const std::function<double(double)>& function, double left, double middle,
                        double right, double tolerance);

}  // namespace wavebalance::solvers
