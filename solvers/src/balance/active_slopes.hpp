#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "time/rate_map.hpp"
#include "wavebalance/solvers/balance/period_law.hpp"

namespace wavebalance::solvers {

/// The derivative D of the contact forces by a motion, D = S B on the active samples, whose force changes
/// with the motion: B maps a motion to one number per active sample, S maps these to forces. If forces
/// depend only on the displacement of the same sample, S is that slope and B selects the samples of the
/// motion. Otherwise the scale S of a sample is the largest of its slopes, so that B has numbers of the
/// order of displacements.
class ActiveSlopes {
 public:
  /// `rates` gives the velocities of motions and is kept; null where no law reads velocities. O(samples +
  /// entries).
  void set(const PeriodSlopes& slopes, RateMap* rates, double frequency);

  std::span<const int> samples() const { return samples_; }  ///< ascending
  Eigen::Index count() const { return static_cast<Eigen::Index>(samples_.size()); }
  const Eigen::VectorXd& scale() const { return scale_; }  ///< S, N/m
  /// Whether B selects the samples of the motion.
  bool takes_samples() const { return own_.size() == 0; }

  /// B of a motion of samples(), m.
  Eigen::VectorXd read(const Eigen::VectorXd& motion);
  /// B^T of one number per active sample, samples() values.
  Eigen::VectorXd read_transposed(const Eigen::VectorXd& values, Eigen::Index samples);
  /// S times `values` at the active samples of `forces`, whose others are kept.
  void write(const Eigen::VectorXd& values, Eigen::VectorXd& forces) const {
    forces(samples_) = scale_.cwiseProduct(values);
  }

  /// Forces of one contact, one row per motion, N.
  struct ContactForces {
    int contact = 0;
    Eigen::MatrixXd force;
  };
  /// D of motions of one contact, the rows of `motions`, and where B reads velocities their `rates`: the
  /// forces of each contact that has any. O(entries of D times the number of motions).
  std::vector<ContactForces> forces_of(int contact, const Eigen::MatrixXd& motions,
                                       const Eigen::MatrixXd& rates) const;

  /// B K S + I into the leading block of `matrix`, of an operator K whose columns at the samples of one shift
  /// period are `columns`, as CondensedProblem::columns() has them; `rates` are their velocities where B
  /// reads these. O(count^2 + count entries).
  void fill(int points, int period, const Eigen::MatrixXd& columns, const Eigen::MatrixXd& rates,
            Eigen::MatrixXd& matrix) const;
  /// The velocities of `columns` of the contacts that have active samples; empty where B does not read them.
  Eigen::MatrixXd rates_of(const Eigen::MatrixXd& columns, std::span<const int> contacts, int period);

 private:
  bool reads_velocities() const { return of_velocity_.size() > 0; }

  RateMap* rates_ = nullptr;
  double frequency_ = 0.0;
  std::vector<int> samples_;
  Eigen::VectorXd scale_;
  // The entries of B: by the displacement and the velocity of the same sample, empty where these are 1 and 0,
  // and by others, whose `force` counts active samples.
  Eigen::VectorXd own_, of_velocity_;
  std::vector<SlopeEntry> others_;
};

}  // namespace wavebalance::solvers
