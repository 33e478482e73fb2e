#include "wavebalance/solvers/branches/branches.hpp"

#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/response/motion_periods.hpp"

namespace wavebalance::solvers {
namespace {

/// Problems of one period of the load with these sizes, and of several periods with as many times more.
BranchProblems problems_of(const LinearStructure& structure, int functions, int points) {
  return [&structure, functions, points](int periods) {
    Eigen::VectorXcd load = Eigen::VectorXcd::Zero(periods + 1);
    load[periods] = 1.0;
    const int odd = periods * (functions - 1) + 1;
    return CondensedProblem(testing::fourier_pair(odd, periods * points), structure, load);
  };
}

/// A curve, its stability and its branches.
struct TracedBranches {
  FrequencySweep curve;
  CurveStability stability;
  std::vector<Branch> branches;
};

TracedBranches trace_branches(const BranchProblems& problems, const LinearStructure& structure,
                              const ContactLaws& laws, double from, double to, int largest_period,
                              const Observer& observer = {}) {
  CondensedProblem problem = problems(1);
  BranchOptions options;
  options.sweep.from = from;
  options.sweep.to = to;
  options.sweep.keep_unknowns = true;
  options.largest_period = largest_period;
  options.observer = observer;
  const ContactDynamics dynamics(structure);
  TracedBranches traced;
  traced.curve = frequency_sweep(problem, laws, options.sweep);
  traced.stability = curve_stability(problem, laws, traced.curve, dynamics);
  traced.branches = follow_branches(problems, laws, dynamics, traced.curve, traced.stability, options);
  return traced;
}

std::vector<double> frequencies(const CurveStability& stability, SpecialPointType type, double unit) {
  std::vector<double> found;
  for (const SpecialPoint& point : stability.special_points)
    if (point.type == type) found.push_back(unit * point.frequency);
  return found;
}

/// The response of the problem of a branch at one of its points.
PeriodicResponse response_of(CondensedProblem& problem, const ContactLaws& laws, const SweepPoint& point) {
  problem.set_load_frequency(point.frequency);
  ContactSystem system(problem, laws);
  return response_at(system, point.unknown);
}

/// Every point but the two ends, which are motions of the parent, solves the balance and has the whole
/// period.
void expect_motions_of_the_period(const Branch& branch, const BranchProblems& problems,
                                  const ContactLaws& laws, double largest_residual = 1e-9) {
  CondensedProblem problem = problems(branch.periods);
  problem.set_periods(branch.periods);
  for (std::size_t i = 1; i + 1 < branch.curve.points.size(); ++i) {
    const PeriodicResponse response = response_of(problem, laws, branch.curve.points[i]);
    EXPECT_LE(response.residual, largest_residual);
    EXPECT_EQ(motion_periods(problem, response), branch.periods) << branch.curve.points[i].frequency;
  }
}

const LinearStructure impacting_oscillator = testing::unit_oscillator(0.1, 0.8);
const testing::LinearContact elastic_stop{10.0, 0.1};

// Subcritical at both ends: the motion of one period is stable between the doublings, the motion of two
// unstable.
TEST(Branches, OfTheBarWithASmallGapAreUnstableBetweenItsPeriodDoublings) {
  const LinearStructure bar = testing::jl14_bar(25, 1.25e-6);
  testing::ExponentialLaw law = testing::jl14_case_2.law;
  law.start = 1e-4;
  const auto problems = problems_of(bar, 63, 512);
  const TracedBranches traced = trace_branches(problems, bar, law, 2800.0, 3050.0, 2);
  ASSERT_EQ(traced.branches.size(), 1u);
  const Branch& branch = traced.branches[0];
  EXPECT_EQ(branch.end, BranchEnd::special_point);
  EXPECT_NEAR(branch.curve.points.front().frequency, 2840.476702, 0.5);
  EXPECT_NEAR(branch.curve.points.back().frequency, 2988.746353, 0.5);
  for (const PointStability& point : branch.stability.points) EXPECT_EQ(point.unstable, 1);
  for (const SweepPoint& point : branch.curve.points) {
    EXPECT_GT(point.frequency, 2840.0);
    EXPECT_LT(point.frequency, 2991.0);
  }
  expect_motions_of_the_period(branch, problems, law);
}

// Far from its bifurcation or grazing point a branch has folds like any curve, also where the motion of two
// periods is still small compared with its end: where it turns at its lowest frequency a multiplier passes
// 1.
TEST(Branches, OfTheBarHaveAFoldWhereTheyTurn) {
  const LinearStructure bar = testing::jl14_bar(25, 1.25e-6);
  testing::ExponentialLaw law = testing::jl14_case_2.law;
  law.start = 1e-4;
  const auto problems = problems_of(bar, 63, 512);
  const TracedBranches traced = trace_branches(problems, bar, law, 2550.0, 2900.0, 2);
  const auto from_grazing = std::find_if(
      traced.branches.begin(), traced.branches.end(),
      [](const Branch& branch) { return std::abs(branch.curve.points.front().frequency - 2734.17) < 0.5; });
  ASSERT_NE(from_grazing, traced.branches.end());
  const auto& points = from_grazing->curve.points;
  const auto lowest = std::min_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  ASSERT_GT(lowest - points.begin(), 2);
  ASSERT_GT(points.end() - lowest, 2);
  const auto folds = frequencies(from_grazing->stability, SpecialPointType::fold, 2.0);
  EXPECT_TRUE(std::any_of(folds.begin(), folds.end(), [&](double fold) {
    return std::abs(fold - 2.0 * lowest->frequency) < 0.5;
  })) << 2.0 * lowest->frequency;
  const auto count_at = [&](auto point) {
    return from_grazing->stability.points[std::size_t(point - points.begin())].unstable;
  };
  EXPECT_EQ(std::abs(count_at(lowest - 2) - count_at(lowest + 2)), 1);
}

// The motion between equal stops loses its symmetry, u(t + T/2) = -u(t), at two branch points. Both sides are
// the same motion mirrored.
TEST(Branches, OfAnOscillatorBetweenEqualStopsAreTheMotionsWithoutItsSymmetry) {
  LinearStructure structure = impacting_oscillator;
  structure.contact_directions = Eigen::MatrixXd{{1.0}, {-1.0}}.sparseView();
  const auto problems = problems_of(structure, 63, 512);
  const TracedBranches traced =
      trace_branches(problems, structure, elastic_stop, 1.6 / two_pi, 0.77 / two_pi, 1);
  const auto points = frequencies(traced.stability, SpecialPointType::branch, two_pi);
  ASSERT_EQ(points.size(), 2u);
  ASSERT_EQ(traced.branches.size(), 2u);
  const auto& left = traced.branches[0];
  const auto& right = traced.branches[1];
  for (const Branch& branch : traced.branches) {
    EXPECT_EQ(branch.end, BranchEnd::special_point);
    EXPECT_EQ(branch.periods, 1);
    EXPECT_NEAR(two_pi * branch.curve.points.front().frequency, points[0], 1e-12);
    EXPECT_NEAR(two_pi * branch.curve.points.back().frequency, points[1], 1e-12);
  }
  const auto middle = [](const Branch& branch) {
    return branch.curve.points[branch.curve.points.size() / 2];
  };
  ASSERT_EQ(left.curve.points.size(), right.curve.points.size());
  EXPECT_NEAR(middle(left).frequency, middle(right).frequency, 1e-6 * middle(left).frequency);
  const Eigen::Index half = 256;
  const Eigen::VectorXd u = middle(left).unknown.head(512), v = middle(right).unknown.head(512);
  Eigen::VectorXd mirrored(512);
  mirrored << -v.tail(half), -v.head(half);
  EXPECT_LE((u - mirrored).norm(), 1e-5 * u.norm());
  EXPECT_GE((u - v).norm(), 0.1 * u.norm());
}

TEST(Branches, StopWhenTheirObserverSaysSo) {
  const auto problems = problems_of(impacting_oscillator, 31, 256);
  const TracedBranches traced =
      trace_branches(problems, impacting_oscillator, elastic_stop, 2.1 / two_pi, 3.1 / two_pi, 2,
                     [](const Progress& progress) { return progress.step < 3; });
  ASSERT_EQ(traced.branches.size(), 1u);
  EXPECT_EQ(traced.branches[0].end, BranchEnd::cancelled);
}

TEST(Branches, NeedAProblemWithTheSamplesOfAllPeriods) {
  const auto problems = problems_of(impacting_oscillator, 31, 256);
  const BranchProblems too_small = [&](int) { return problems(1); };
  EXPECT_NE(testing::refusal([&] {
              trace_branches(too_small, impacting_oscillator, elastic_stop, 2.1 / two_pi, 3.1 / two_pi, 2);
            }).find("512"),
            std::string::npos);
}

}  // namespace
}  // namespace wavebalance::solvers
