#pragma once
#include "linalg/index.hpp"
#include "wavebalance/solvers/phases/contact_phases.hpp"
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

MotionSamples samples_of(const PhaseMotion& motion, int periods);
/// Whether `other` is `one`, `periods` periods of the load later.
bool agree_after(const MotionSamples& one, const MotionSamples& other, int periods);
/// The least number of periods of the load after which a motion repeats.
int least_periods(const MotionSamples& motion);
/// The mean of a motion and itself some periods of the load later.
MotionSamples mean_with_later(const MotionSamples& one, int later);
/// The first periods of a motion.
MotionSamples first_periods(const MotionSamples& samples, int periods);

}  // namespace wavebalance::solvers::detail
