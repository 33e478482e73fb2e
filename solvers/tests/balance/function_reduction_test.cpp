// The reduction of J = I + K D to the coefficients of the functions, against LU of the active samples.

#include <memory>

#include "balance/dense_block.hpp"
#include "balance/function_reduction.hpp"
#include "support/friction_scenes.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/contact/hunt_crossley_law.hpp"
#include "wavebalance/solvers/balance/contact_system.hpp"

namespace wavebalance::solvers {
namespace {

// A motion with contact in two stretches of the period, and pieces of stick and slip.
Eigen::VectorXd moving(const CondensedProblem& problem) {
  return Eigen::VectorXd::NullaryExpr(problem.samples(), [&](Eigen::Index l) {
    const double t = 2.0 * std::numbers::pi * double(l % problem.points()) / problem.points();
    const double phase = double(l / problem.points());
    return 0.3 + std::cos(t + phase) + 0.5 * std::cos(3.0 * t);
  });
}

/// Both reductions of one state.
class Reduced {
 public:
  Reduced(const TimePair& pair, const LinearStructure& structure, const ContactLaws& laws, double frequency)
      : problem_(pair, structure, testing::cosine_load()), system_(problem_, laws), contact_(problem_) {
    problem_.set_frequency(frequency);
    system_.set_linear_solver(LinearSolver::dense);
    system_.evaluate(moving(problem_));
    if (laws.depend_on_velocity()) rates_ = std::make_unique<RateMap>(pair);
    active_.set(system_.slopes(), rates_.get(), frequency);
    functions_.set(contact_, active_);
  }

  Eigen::Index active() const { return active_.count(); }
  bool remembers() const { return !system_.slopes().others.empty(); }

  void expect_equal(std::mt19937& generator, const std::string& name) {
    const auto random = [&] { return testing::random_vector(problem_.samples(), generator); };
    const Eigen::VectorXd r = random(), b = random(), c = random();
    Eigen::VectorXd expected, found;
    ASSERT_TRUE(system_.factorize() && system_.solve(r, expected)) << name;
    double expected_last = 0.0, last = 0.0;
    ASSERT_TRUE(block_.factorize(functions_)) << name;
    block_.solve(r, 0.0, found, last);
    EXPECT_LE((expected - found).norm(), allowed * expected.norm()) << name;
    EXPECT_EQ(block_.determinant_sign(), system_.determinant_sign()) << name;
    ASSERT_TRUE(system_.factorize_bordered(b, c, 0.7)) << name;
    ASSERT_TRUE(system_.solve_bordered(r, -0.4, expected, expected_last)) << name;
    ASSERT_TRUE(block_.factorize(functions_, {b, c, 0.7})) << name;
    block_.solve(r, -0.4, found, last);
    EXPECT_LE((expected - found).norm(), allowed * expected.norm()) << name;
    EXPECT_NEAR(expected_last, last, allowed * std::abs(expected_last)) << name;
    EXPECT_EQ(block_.determinant_sign(), system_.determinant_sign()) << name;
  }

 private:
  static constexpr double allowed = 1e-9;  // rounding of two LUs of moderate condition

  CondensedProblem problem_;
  ContactSystem system_;
  ContactOperator contact_;
  std::unique_ptr<RateMap> rates_;
  ActiveSlopes active_;
  FunctionReduction functions_;
  DenseBlock block_;
};

LinearStructure chain_of_three_contacts(std::mt19937& generator) {
  LinearStructure chain = testing::random_chain(5, generator);
  chain.contact_directions = contact_rows({0, 1, 4}, chain.size());
  return chain;
}

TEST(FunctionReduction, HasTheSolutionsAndSignsOfLuOfTheSamplesInEachPair) {
  std::mt19937 generator(1);
  const LinearStructure chain = chain_of_three_contacts(generator);
  std::vector<TimePair> pairs = testing::pair_kinds(16, 128);
  pairs.push_back(testing::fourier_pair(15, 128));
  pairs.push_back(testing::fourier_pair(16, 128, NyquistCoefficient::drop));
  for (std::size_t kind = 0; kind < pairs.size(); ++kind) {
    Reduced reduced(pairs[kind], chain, testing::LinearContact{3.0, 0.2}, 0.07);
    ASSERT_GT(reduced.active(), 0);
    reduced.expect_equal(generator, "pair " + std::to_string(kind));
  }
}

TEST(FunctionReduction, TakesLawsOfTheVelocity) {
  std::mt19937 generator(2);
  const LinearStructure chain = chain_of_three_contacts(generator);
  const contact::HuntCrossleyLaw law(3.0, 1.5, 0.4, 0.2);
  for (const int functions : {15, 16})
    Reduced(testing::fourier_pair(functions, 128), chain, law, 0.07)
        .expect_equal(generator, std::to_string(functions) + " functions");
}

TEST(FunctionReduction, TakesWhatAForceRemembersOfOtherSamples) {
  std::mt19937 generator(3);
  const testing::FrictionScene scene = testing::lift_off(1.0, 1.0, 0.5, 0.5, 1.1);
  for (const TimePair& pair : testing::pair_kinds(16, 128)) {
    Reduced reduced(pair, scene.structure, scene.contact_laws(), scene.frequency());
    EXPECT_TRUE(reduced.remembers());
    reduced.expect_equal(generator, "lift-off");
  }
}

TEST(FunctionReduction, IsTakenForLawsWithMemoryWhereFunctionsAreFewerThanSamples) {
  const testing::FrictionScene scene = testing::lift_off(1.0, 1.0, 0.5, 0.5, 1.1);
  constexpr int functions = 31;
  CondensedProblem problem = testing::fourier_problem(scene.structure, functions, 512, scene.frequency());
  ContactSystem system(problem, scene.contact_laws());
  system.evaluate(moving(problem));
  const double before = system.operations(), expected = 2.0 / 3.0 * std::pow(2.0 * functions, 3.0);
  ASSERT_TRUE(system.factorize());
  EXPECT_NEAR(system.operations() - before, expected, 1e-9 * expected);
}

}  // namespace
}  // namespace wavebalance::solvers
