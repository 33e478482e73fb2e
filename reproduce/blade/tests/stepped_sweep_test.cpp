#include "stepped_sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"

namespace wavebalance::blade {
namespace {

using solvers::CondensedProblem;
using Frequencies = std::vector<double>;

TEST(UniformFrequencies, HoldBothEndsAndStepsThatAreNotLarger) {
  EXPECT_EQ(uniform_frequencies(1.0, 2.0, 0.25, 100), (Frequencies{1.0, 1.25, 1.5, 1.75, 2.0}));
  EXPECT_EQ(uniform_frequencies(2.0, 1.0, 0.4, 100).size(), 4u);
  EXPECT_EQ(uniform_frequencies(1.0, 2.0, 5.0, 100), (Frequencies{1.0, 2.0}));
  EXPECT_EQ(uniform_frequencies(0.0, 0.3, 0.1, 100).size(), 4u) << "0.3 / 0.1 exceeds 3 by rounding";
}

TEST(UniformFrequencies, AreNoMoreThanAskedForHoweverSmallTheStep) {
  EXPECT_EQ(uniform_frequencies(1.0, 2.0, 0.25, 2), (Frequencies{1.0, 1.25}));
  EXPECT_EQ(uniform_frequencies(1.0, 2.0, 1e-300, 3).size(), 3u);
}

TEST(UniformFrequencies, NumbersThatAreNotFiniteOrPositiveAreRefused) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(uniform_frequencies(nan, 1.0, 1.0, 1), std::invalid_argument);
  EXPECT_THROW(uniform_frequencies(0.0, 1.0, 0.0, 1), std::invalid_argument);
  EXPECT_THROW(uniform_frequencies(0.0, 1.0, 1.0, 0), std::invalid_argument);
}

/// An oscillator of natural frequency 1 / (2 pi).
CondensedProblem oscillator(double damping) {
  return {solvers::testing::fourier_pair(3, 16), solvers::testing::unit_oscillator(damping, 1.0),
          solvers::testing::cosine_load()};
}

double amplitude(CondensedProblem& problem) { return problem.contact_free_response().maxCoeff(); }

TEST(SteppedSweep, IsAtEachFrequencyWhatAProblemOfItsOwnIs) {
  CondensedProblem problem = oscillator(0.1);
  const Frequencies frequencies{0.1, 0.15, 0.2};
  const auto found = steps_over(problem, frequencies, amplitude);
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t i = 0; i < found.size(); ++i) {
    CondensedProblem alone = oscillator(0.1);
    alone.set_frequency(frequencies[i]);
    ASSERT_TRUE(found[i]);
    EXPECT_EQ(*found[i], amplitude(alone));
  }
}

TEST(SteppedSweep, HoldsNothingWhereTheStructureIsSingular) {
  CondensedProblem problem = oscillator(0.0);
  const auto found = steps_over(problem, Frequencies{0.1, 0.5 / std::numbers::pi, 0.2}, amplitude);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_TRUE(found[0]);
  EXPECT_FALSE(found[1]);
  EXPECT_TRUE(found[2]);
}

TEST(SteppedSweep, EndsWhereItIsStopped) {
  CondensedProblem problem = oscillator(0.1);
  const auto found = steps_over(problem, Frequencies{0.1, 0.15, 0.2}, amplitude,
                                [](const solvers::Progress& progress) { return progress.step < 2; });
  EXPECT_EQ(found.size(), 2u);
}

}  // namespace
}  // namespace wavebalance::blade
