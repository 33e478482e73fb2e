#include "linalg/gsl_errors.hpp"

#include <atomic>
#include <latch>
#include <optional>
#include <thread>

#include "testing.hpp"

namespace wavebalance::solvers::detail {
namespace {

std::atomic<int> handled{0};  // errors that reached the handler of the program

void count_errors(const char*, const char*, int, int) { ++handled; }

/// The handler of this test, which counts instead of ending the program, for as long as a test runs.
class SilencedGsl : public ::testing::Test {
 protected:
  SilencedGsl() : previous_(gsl_set_error_handler(count_errors)) { handled = 0; }
  ~SilencedGsl() override { gsl_set_error_handler(previous_); }

  static void make_error() { gsl_error("made by a test", __FILE__, __LINE__, GSL_EFAILED); }

 private:
  gsl_error_handler_t* previous_;
};

TEST_F(SilencedGsl, ErrorsStaySilentUntilTheLastOfOverlappingUsersEndsAndAreHandledAfterIt) {
  std::optional<SilencedGslErrors> first, second;
  first.emplace();
  second.emplace();
  first.reset();
  make_error();
  EXPECT_EQ(handled, 0);
  second.reset();
  make_error();
  EXPECT_EQ(handled, 1);
}

TEST_F(SilencedGsl, ErrorsStaySilentInThreadsThatEndBesideEachOther) {
  {
    constexpr int count = 4;
    std::latch begin(count);
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < count; ++thread)
      threads.emplace_back([&begin] {
        begin.arrive_and_wait();
        for (int repetition = 0; repetition < 50000; ++repetition) {
          const SilencedGslErrors silence;
          make_error();
        }
      });
  }
  EXPECT_EQ(handled, 0);
  make_error();
  EXPECT_EQ(handled, 1);
}

}  // namespace
}  // namespace wavebalance::solvers::detail
