#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "adaptive_rigid.hpp"
#include "adaptive_wavelet.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::bench {

/// Sizes of the studies.
struct Sizes {
  int points = 4096;             ///< samples of the contact force, and of every error
  int finest = 512;              ///< functions of the finest level of the wavelet studies
  int fourier_functions = 2047;  ///< of the Fourier pair under the force cells
  int largest = 192;             ///< functions or cells that adaptivity may take
};

/// One scene with what its errors are taken against.
struct Study {
  std::string name;  ///< "case1", "case2_rigid"
  Sizes sizes;
  Eigen::VectorXd reference;     ///< m, sizes.points samples
  std::vector<double> instants;  ///< fractions of the period at which contact closes and opens

  double error(const Eigen::VectorXd& displacement) const {
    return (displacement - reference).norm() / reference.norm();
  }
  /// With basis:basis of so many functions, exact inner products and so many points.
  app::Scene scene(const std::string& basis, int functions, int points) const;
};

/// study, basis, method, unknowns, converged, rms_relative_error, estimated_error, iterations, cpu_ms.
app::Table result_table();

/// With contact phases as the reference.
Study make_study(const std::string& name, const Sizes& sizes);

/// Uniform levels and adaptive selections of a wavelet Galerkin pair; rows are appended to the table. Returns
/// the adaptive rounds by the residual.
solvers::AdaptiveResponse wavelet_study(const Study& study, const std::string& basis, app::Table& table);

/// The rigid obstacle: uniform wavelet balance, uniform and adaptive cells. Returns the adaptive rounds.
solvers::AdaptiveCellResponse rigid_study(const Study& study, app::Table& table);

/// The selected functions of the basis of `study`: where they lie and how fine they are.
app::Table selection_table(const Study& study, const std::string& basis, const solvers::Selection& selection);

}  // namespace wavebalance::bench
