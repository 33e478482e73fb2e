// The verdicts on the statements of the paper, and how many readings of its words they hold under.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "convergence.hpp"
#include "jl14_results.hpp"
#include "readings.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::jl14 {
namespace {

TEST(Jl14Paper, StatementsOnTheCasesHaveTheirVerdicts) {
  using report::Verdict;
  results().need({"reference_case1", "reference_case2", "haar_readings", "fig04", "fig06", "fig07", "fig08",
                  "fig09", "tab01", "rigid_plateau"});
  const std::vector<std::tuple<std::string, std::string, Verdict>> expected{
      {"reference_case2", "transient response to decay", Verdict::agrees},
      {"fig04_daubechies6_levels", "wrapped around the", Verdict::agrees},
      {"fig04_daubechies6_levels", "the shape does not converge", Verdict::differs},
      {"fig04_daubechies6_levels", "prone to error", Verdict::agrees},
      {"tab01_cases", "fundamental frequency", Verdict::agrees},
      {"tab01_cases", "maximum tip displacements", Verdict::agrees},
      {"fig06_tip_displacement_case1", "HBM (Fourier:Fourier) approximates", Verdict::agrees},
      {"fig06_tip_displacement_case1", "oscillations due to Gibbs", Verdict::agrees},
      {"fig06_tip_displacement_case1", "contact plateau is well represented", Verdict::differs},
      {"fig06_tip_displacement_case1", "localized error", Verdict::depends},
      {"fig07_tip_displacement_case2", "less suited", Verdict::partly},
      {"fig07_tip_displacement_case2", "tip penetration", Verdict::agrees},
      {"fig07_tip_displacement_case2", "no distinct contact plateau", Verdict::agrees},
      {"fig08_tip_velocity_case1", "more pronounced", Verdict::differs},
      {"fig08_tip_velocity_case1", "best job", Verdict::differs},
      {"fig08_tip_velocity_case1", "velocity function envelope", Verdict::differs},
      {"fig08_tip_velocity_case1", "sparse representation", Verdict::agrees},
      {"fig09_contact_force_case1", "Gibbs phenomenon can be seen", Verdict::agrees},
      {"fig09_contact_force_case1", "relatively well", Verdict::differs},
      {"fig09_contact_force_case1", "most accurately approximate", Verdict::agrees},
      {"fig09_contact_force_case1", "more accurate contact force", Verdict::differs},
      {"fig09_contact_force_case1", "comparable prediction accuracy", Verdict::partly},
      {"rigid_plateau", "perform even better", Verdict::agrees}};
  for (const auto& [stem, words, verdict] : expected)
    EXPECT_EQ(report::to_string(results().verdict(stem, words)), report::to_string(verdict)) << stem << words;
}

TEST(Jl14Paper, ReadingsOfTheTextDecideAndTheOthersAreCountedApart) {
  results().need({"reference_case1", "reference_case2", "haar_readings", "fig06", "fig08", "fig09"});
  struct Counts {
    const char *stem, *words;
    int text, instead;
    std::size_t all;
  };
  for (const Counts& one : {Counts{"fig06_tip_displacement_case1", "well represented", 0, 7, 18},
                            Counts{"fig06_tip_displacement_case1", "localized error", 1, 14, 18},
                            Counts{"fig08_tip_velocity_case1", "velocity function envelope", 0, 1, 18},
                            Counts{"fig08_tip_velocity_case1", "best job", 0, 14, 36},
                            Counts{"fig09_contact_force_case1", "relatively well", 0, 2, 18},
                            Counts{"fig09_contact_force_case1", "Gibbs phenomenon can be seen", 2, 16, 18}}) {
    const auto readings = results().statement(one.stem, one.words).readings;
    EXPECT_EQ(report::agreeing(readings), one.text) << one.words;
    EXPECT_EQ(report::agreeing(readings, false), one.instead) << one.words;
    EXPECT_EQ(report::of_text(readings).size(), 2u) << one.words;
    EXPECT_EQ(readings.size(), one.all) << one.words;
  }
}

TEST(Jl14Paper, ErrorsThatAreToldAreThoseOfTheReadingsOfTheText) {
  results().need({"reference_case1", "reference_case2", "haar_readings", "fig06", "fig09"});
  const auto force = results().statement("fig09_contact_force_case1", "relatively well");
  EXPECT_NE(force.headline.find("by 36 % to 90 %"), std::string::npos) << force.headline;
  const auto plateau =
      results().statement("fig06_tip_displacement_case1", "well represented by the constant");
  for (const auto& reading : report::of_text(plateau.readings)) {
    const std::string share = reading.measured.substr(0, reading.measured.find(" of the range"));
    EXPECT_NE(plateau.because.find(share), std::string::npos) << plateau.because << " / " << share;
  }
}

TEST(Jl14Paper, StatementsOnConvergenceAndResonanceHaveTheirVerdicts) {
  using report::Verdict;
  results().need({"reference_case1", "reference_case2", "fig10", "fig11", "fig12"});
  const std::vector<std::tuple<std::string, std::string, Verdict>> expected{
      {"fig10_energy_norm", "approximately unity", Verdict::agrees},
      {"fig10_energy_norm", "relatively few basis functions", Verdict::agrees},
      {"fig10_energy_norm", "again converge quickly", Verdict::agrees},
      {"fig10_energy_norm", "over-predict the system energy", Verdict::agrees},
      {"fig10_energy_norm", "better approximated", Verdict::depends},
      {"fig10_energy_norm", "less obvious", Verdict::differs},
      {"fig10_energy_norm", "more slowly", Verdict::agrees},
      {"fig10_energy_norm", "larger difference", Verdict::agrees},
      {"fig11_tip_error", "only 8 basis functions", Verdict::agrees},
      {"fig11_tip_error", "does not perform as well", Verdict::agrees},
      {"fig11_tip_error", "performs poorly using 16", Verdict::agrees},
      {"fig11_tip_error", "reasonably constant", Verdict::differs},
      {"fig11_tip_error", "smooth portions", Verdict::agrees},
      {"fig11_tip_error", "mid-points of the Haar", Verdict::partly},
      {"fig11_tip_error", "low resolution", Verdict::differs},
      {"fig11_tip_error", "similar trends", Verdict::partly},
      {"fig11_tip_error", "consistent or better", Verdict::partly},
      {"fig11_tip_error", "rapidly converge", Verdict::agrees},
      {"fig12_frequency_response", "increase in frequency", Verdict::agrees},
      {"fig12_frequency_response", "captured by both", Verdict::agrees},
      {"fig12_frequency_response", "other combinations", Verdict::agrees},
      {"fig12_frequency_response", "all the basis combinations", Verdict::agrees},
      {"fig12_frequency_response", "second fundamental frequency", Verdict::misprint}};
  for (const auto& [stem, words, verdict] : expected)
    EXPECT_EQ(report::to_string(results().verdict(stem, words)), report::to_string(verdict)) << stem << words;
}

TEST(Jl14Paper, CurvesWithoutTheNyquistCoefficientPassWithEveryStep) {
  results().need({"fig12"});
  for (const char* words : {"captured by both", "other combinations", "all the basis combinations"}) {
    const auto statement = results().statement("fig12_frequency_response", words);
    int dropped = 0, kept = 0;
    for (const auto& reading : statement.readings) {
      const bool without = reading.name.find("dropped") != std::string::npos;
      (without ? dropped : kept) += 1;
      const bool shortest = reading.name.find("up to 1 Hz") != std::string::npos;
      if (without || shortest) {
        EXPECT_EQ(reading.verdict, report::plain(without)) << reading.name << ": " << reading.measured;
      }
    }
    EXPECT_EQ(dropped, 2);
    EXPECT_EQ(kept, 6);
  }
}

// What cannot fail but by a fault of the code, and what no criterion could decide.
TEST(Jl14Paper, SomeSentencesAreChecksAndSomeAreNotJudged) {
  results().need({"reference_case1", "reference_case2", "haar_readings", "fig04", "fig06", "fig08", "fig11",
                  "tab01", "rigid_plateau"});
  EXPECT_TRUE(results().passes("fig04_daubechies6_levels", "no longer scale-invariant"));
  EXPECT_TRUE(results().passes("fig06_tip_displacement_case1", "blocky nature"));
  EXPECT_TRUE(results().passes("fig08_tip_velocity_case1", "sharp jump in velocity"));
  EXPECT_TRUE(results().passes("fig08_tip_velocity_case1", "ringing due to Gibbs"));
  EXPECT_TRUE(results().passes("fig11_tip_error", "is highest out of"));
  EXPECT_EQ(results().record("tab01_cases").unjudged.size(), 2u);
  EXPECT_EQ(results().record("tab01_cases").slips.size(), 2u);
  const auto flat = results().record("rigid_plateau").unjudged;
  ASSERT_EQ(flat.size(), 1u);
  EXPECT_NE(flat[0].found.find("512 points: flat none"), std::string::npos) << flat[0].found;
}

// The energies and errors of [JL14, Figs. 10 and 11] under the sums that are read from the paper's words.
TEST(Jl14Paper, ConvergenceIsJudgedUnderReadingsOfAllSums) {
  std::vector<std::string> names;
  for (const Sums& one : all_sums()) names.push_back(one.name());
  int of_text = 0;
  for (const Sums& one : convergence_sums()) {
    EXPECT_EQ(std::count(names.begin(), names.end(), one.name()), 1) << one.name();
    of_text += one.of_text() ? 1 : 0;
  }
  EXPECT_EQ(of_text, 2);
  EXPECT_EQ(convergence_sums().front().name(), all_sums().front().name());
}

}  // namespace
}  // namespace wavebalance::jl14
