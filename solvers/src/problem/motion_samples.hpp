#pragma once
#include <optional>
#include <vector>

#include "linalg/index.hpp"
#include "wavebalance/solvers/problem/coexisting_motions.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers::detail {

/// At which motions are compared, mixed and measured, per period of the load.
inline constexpr int points_of_period = 256;

/// A motion of the contacts over some periods of the load, from t = 0.
struct MotionSamples {
  Motion contacts;
  int periods = 1;

  Index shift() const { return contacts.displacement.cols() / periods; }
};

MotionSamples samples_of(const ExactSolution& motion, int periods);
/// The first of some motions that is this one, also later by whole periods of the load.
std::optional<std::size_t> find_among(const std::vector<MotionSamples>& motions, const MotionSamples& motion);
/// Likewise one whose displacements differ by less than a share of what vibrates.
std::optional<std::size_t> find_near(const std::vector<MotionSamples>& motions, const MotionSamples& motion,
                                     double share);
/// Sets CoexistingMotion::share and its error.
void set_shares(CoexistingMotions& result);
/// The least number of periods of the load after which a motion repeats.
int least_periods(const MotionSamples& motion);
/// The mean of a motion and itself some periods of the load later.
MotionSamples mean_with_later(const MotionSamples& one, int later);
/// The first periods of a motion.
MotionSamples first_periods(const MotionSamples& samples, int periods);

}  // namespace wavebalance::solvers::detail
