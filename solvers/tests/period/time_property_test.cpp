#include <rapidcheck/gtest.h>

#include "period_oracle/shooting.hpp"
#include "support/oscillator.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::LinearContact;
using testing::Oscillator;

RC_GTEST_PROP(ShootingProperty, MultipliersMultiplyToTheDecayOfPhaseSpaceVolume, ()) {
  // Liouville: the contact force does no change of volume, so det = exp(-c T / m) whatever the contact.
  Oscillator oscillator;
  oscillator.damping = *rc::gen::inRange(20, 400);
  oscillator.frequency = *rc::gen::inRange(10, 60);
  const LinearContact contact{1e5 * *rc::gen::inRange(1, 100), 1e-5 * *rc::gen::inRange(-20, 60)};
  oracle::ShootingOptions options{.output_points = 16};
  const oracle::ShootingResult result =
      oracle::shoot(oscillator.structure(), contact, oscillator.frequency, options);
  const double expected = std::exp(-oscillator.damping / oscillator.mass / oscillator.frequency);
  RC_ASSERT(result.status != oracle::ShootingStatus::step_failure);
  RC_ASSERT(std::abs(result.floquet_multipliers.prod() - expected) <= 1e-9 * expected);
}

}  // namespace
}  // namespace wavebalance::solvers
