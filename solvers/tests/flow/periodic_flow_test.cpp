// Parts of the integration from event to event that no scene reaches: the observer, options, laws without a
// value.

#include "wavebalance/solvers/flow/periodic_flow.hpp"

#include "support/jl14_bar.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

TimeSteppingResult integrated(const ContactLaws& laws, const TimeSteppingOptions& options,
                              double load = 1.0) {
  LinearStructure bar = testing::jl14_bar(4, 5e-6);
  bar.load *= load;
  return integrate_by_events(testing::fourier_problem(bar, 7, 32, 1275.0), ContactDynamics(bar), laws,
                             options)
      .stepping;
}

TEST(PeriodicFlow, TellsItsObserverOfEveryPeriodAndMayBeCancelled) {
  std::vector<int> periods;
  std::vector<double> differences;
  TimeSteppingOptions options;
  options.observer = [&](const Progress& progress) {
    periods.push_back(progress.step);
    differences.push_back(progress.value);
    return progress.step < 3;
  };
  const TimeSteppingResult result = integrated(testing::jl14_case_2.law, options);
  EXPECT_EQ(result.status, TimeSteppingStatus::cancelled);
  EXPECT_EQ(periods, (std::vector<int>{1, 2, 3}));
  EXPECT_TRUE(std::isinf(differences.front()));
  EXPECT_EQ(std::vector<double>(differences.begin() + 1, differences.end()), result.period_error);
}

TEST(PeriodicFlow, EndsWhereItsPeriodsWouldTakeMoreOperationsThanAllowed) {
  TimeSteppingOptions options;
  options.max_operations = 1.0;
  const TimeSteppingResult result = integrated(testing::jl14_case_2.law, options);
  EXPECT_EQ(result.status, TimeSteppingStatus::iteration_limit);
  EXPECT_EQ(result.periods, 1);
  EXPECT_EQ(result.attractor_periods, -1);
}

TEST(PeriodicFlow, AStructureAtRestWithoutLoadStaysThere) {
  const TimeSteppingResult result = integrated(testing::jl14_case_2.law, {}, 0.0);
  EXPECT_EQ(result.status, TimeSteppingStatus::converged);
  EXPECT_TRUE(result.contacts.displacement.isZero(0.0));
}

TEST(PeriodicFlow, ALawWithoutAValueIsAStepFailure) {
  struct Undefined {
    double force(double u) const { return u > 1e-6 ? nan : 0.0; }
    double tangent(double) const { return 0.0; }
    double potential(double) const { return 0.0; }
    double gap() const { return 1e-6; }
  };
  const TimeSteppingResult result = integrated(AnyContactLaw(Undefined{}), {});
  EXPECT_EQ(result.status, TimeSteppingStatus::step_failure);
  EXPECT_EQ(to_string(result.status), "step_failure");
}

TEST(PeriodicFlow, RejectsOptionsOutOfRangeAndNamesThem) {
  const auto expect = [&](const char* name, auto&& change) {
    TimeSteppingOptions options;
    change(options);
    EXPECT_NE(testing::refusal([&] { integrated(AnyContactLaw(), options); }).find(name), std::string::npos);
  };
  expect("output_points is 1;", [](auto& o) { o.output_points = 1; });
  expect("period_tolerance", [](auto& o) { o.period_tolerance = 0.0; });
  expect("max_periods", [](auto& o) { o.max_periods = 0; });
  expect("longest", [](auto& o) { o.longest = 0; });
}

}  // namespace
}  // namespace wavebalance::solvers
