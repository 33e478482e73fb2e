#pragma once
#include <Eigen/Core>
#include <set>

#include "wavebalance/solvers/modes/nonlinear_mode.hpp"

namespace wavebalance::solvers {

/// The complementarity problem of a nonlinear mode at one omega.
class ModeSolver {
 public:
  ModeSolver(const NonlinearMode& mode, double omega);

  /// Active-set iteration with `harmonics` <= N harmonics. At first it exchanges all samples that violate
  /// their condition. Once an active set recurs it exchanges only the worst one. When a set recurs again, the
  /// status is cycling.
  ModePoint solve(int harmonics, const std::vector<int>& active);

 private:
  // The samples that have the same force: the sample itself and, with cosine_only, its mirror in time.
  std::vector<int> time_mirror(int index) const;
  void assemble_lags(int harmonics);
  double compliance(int a, int b) const;  // between samples a and b (contact * m + time)
  bool solve_forces(const std::vector<int>& active, Eigen::VectorXd& force);
  double violation(int index, const Eigen::VectorXd& force, const std::vector<int>& active) const;
  std::vector<int> exchanges(const std::vector<int>& active, const Eigen::VectorXd& force,
                             bool worst_only) const;
  void finish(ModePoint& point, int harmonics, const Eigen::VectorXd& force) const;
  void measure_energy(ModePoint& point) const;
  void measure_complementarity(ModePoint& point) const;
  void classify_resonance(ModePoint& point) const;

  const NonlinearMode& mode_;
  double omega_;
  int samples_;
  int unknowns_;                       // contacts * samples
  std::vector<Eigen::MatrixXd> lags_;  // c x c, for each lag 0..m-1
};

}  // namespace wavebalance::solvers
