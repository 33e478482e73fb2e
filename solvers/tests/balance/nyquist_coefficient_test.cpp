// The coefficient over translates k = M/2 of an even M, kept or dropped.

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::CubicBasis;
using testing::HaarBasis;

constexpr auto drop = NyquistCoefficient::drop;

LinearStructure chain() {
  std::mt19937 generator(3);
  return testing::random_chain(5, generator);
}

CondensedProblem problem_of(const TimePair& pair, const LinearStructure& structure, double load_hz) {
  CondensedProblem problem(pair, structure, testing::cosine_load());
  problem.set_frequency(load_hz);
  return problem;
}

TimePair haar_cubic(int functions) {
  return testing::make_pair(HaarBasis{functions}, CubicBasis{functions}, 4 * functions,
                            Formulation::distributional, InnerProducts::quadrature, drop);
}

TEST(NyquistCoefficient, OfAnOddNumberIsNone) {
  const TimePair kept = testing::fourier_pair(7, 32), dropped = testing::fourier_pair(7, 32, drop);
  EXPECT_FALSE(dropped.drops_nyquist());
  EXPECT_EQ(dropped.solved_size(), kept.spectrum_size());
}

TEST(NyquistCoefficient, IsDroppedUnlessKeptExplicitly) {
  const spectral::FourierBasis basis(8);
  EXPECT_TRUE(TimePair(basis, basis, {}).drops_nyquist());
  TimePairOptions kept;
  kept.nyquist = NyquistCoefficient::keep;
  EXPECT_FALSE(TimePair(basis, basis, kept).drops_nyquist());
}

TEST(NyquistCoefficient, DroppedFromFourierLeavesTheFunctionsOfTheOddNumberBelow) {
  const LinearStructure structure = chain();
  for (const ContactForm form : {ContactForm::displacement, ContactForm::force}) {
    CondensedProblem even = problem_of(testing::fourier_pair(16, 64, drop), structure, 0.07);
    CondensedProblem odd = problem_of(testing::fourier_pair(15, 64), structure, 0.07);
    EXPECT_EQ(even.pair().shift_period(), 1);
    ForcedResponseOptions options;
    options.form = form;
    const testing::LinearContact law{1.0, 0.5 * odd.linear_response().maxCoeff()};
    const PeriodicResponse a = testing::solved_response(even, law, options),
                           b = testing::solved_response(odd, law, options);
    EXPECT_GT(a.contact_force.maxCoeff(), 0.0);
    EXPECT_LE((a.displacement - b.displacement).norm(), 1e-9 * b.displacement.norm());
  }
}

TEST(NyquistCoefficient, DroppedIsZeroInEveryCoefficientOfTheMotion) {
  for (const ContactForm form : {ContactForm::displacement, ContactForm::force}) {
    CondensedProblem problem = problem_of(haar_cubic(16), chain(), 0.07);
    ForcedResponseOptions options;
    options.form = form;
    const testing::LinearContact law{1.0, 0.5 * problem.linear_response().maxCoeff()};
    const PeriodicResponse found = testing::solved_response(problem, law, options);
    EXPECT_EQ(found.coefficients.bottomRows(1).norm(), 0.0);
    const Eigen::MatrixXcd full = problem.full_coefficients(found.contact_force);
    ASSERT_EQ(full.cols(), 9);
    EXPECT_EQ(full.rightCols(1).norm(), 0.0);
    EXPECT_GT(full.col(7).norm(), 0.0);
  }
}

// Without damping the alternating coefficient of an even number of functions resonates at f_n / (M/2).
TEST(NyquistCoefficient, DroppedIsNeverSingular) {
  testing::Oscillator oscillator;
  oscillator.damping = 0.0;
  const LinearStructure structure = oscillator.structure();
  const double natural = std::sqrt(oscillator.stiffness / oscillator.mass) / (2.0 * std::numbers::pi);
  const double load_hz = natural / 8.0;
  EXPECT_THROW(problem_of(testing::fourier_pair(16, 64), structure, load_hz), SingularSystem);
  EXPECT_NO_THROW(problem_of(testing::fourier_pair(16, 64, drop), structure, load_hz));
}

}  // namespace
}  // namespace wavebalance::solvers
