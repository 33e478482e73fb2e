// Special points of the structure in the records of ordinary sweeps: those of sweeps with analysis.exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/curve_record.hpp"
#include "support/summary_value.hpp"
#include "support/zigzag.hpp"

namespace wavebalance::app {
namespace {

using Overrides = std::vector<std::string>;

std::vector<std::string> with(Overrides overrides, const std::string& one) {
  overrides.push_back(one);
  return overrides;
}

/// Every special point of the exact curve is among those of the structure that the ordinary sweep tells,
/// once. Those have motions by phases with an estimated error of at most 1e-6.
void expect_points_of(const Table& structure, const Table& exact, const std::string& axis) {
  EXPECT_EQ(structure.rows(), exact.rows());
  for (std::size_t i = 0; i < exact.rows(); ++i) {
    const double value = exact.numbers(axis)[i];
    int same = 0;
    for (std::size_t k = 0; k < structure.rows(); ++k) {
      if (structure.texts("type")[k] != exact.texts("type")[i]) continue;
      if (std::abs(structure.numbers(axis)[k] - value) > 1e-9 * value) continue;
      ++same;
      if (std::isnan(exact.numbers("multiplier_real")[i])) continue;
      EXPECT_NEAR(structure.numbers("multiplier_real")[k], exact.numbers("multiplier_real")[i], 1e-6);
      EXPECT_NEAR(std::abs(structure.numbers("multiplier_imag")[k]), exact.numbers("multiplier_imag")[i],
                  1e-6);
      EXPECT_NEAR(structure.numbers("max_displacement_m")[k], exact.numbers("max_displacement_m")[i],
                  1e-5 * std::abs(exact.numbers("max_displacement_m")[i]));
    }
    EXPECT_EQ(same, 1) << exact.texts("type")[i] << " " << value;
  }
}

TEST(StructureSpecialPoints, AreThoseOfAnExactSweepToNineDigits) {
  for (const char* functions : {"15", "63"}) {
    const Overrides overrides{"time.functions=" + std::string(functions)};
    const Record ordinary = analyse(stop_with(overrides), Observer()),
                 exact = analyse(stop_with(with(overrides, "analysis.exact=true")), Observer());
    ASSERT_TRUE(ordinary.converged && exact.converged);
    expect_points_of(value_of<Table>(ordinary.summary, "structure_special_points"),
                     value_of<Table>(exact.summary, "special_points"), "frequency_Hz");
    const Table balance = value_of<Table>(ordinary.summary, "special_points");
    for (std::size_t i = 0; i < balance.rows(); ++i) {
      if (balance.texts("type")[i] != "fold") continue;
      EXPECT_EQ(balance.texts("structure_status")[i], "found");
      EXPECT_NEAR(balance.numbers("structure_frequency_Hz")[i], balance.numbers("frequency_Hz")[i], 1e-3);
    }
  }
}

TEST(StructureSpecialPoints, AreThoseOfAnExactSweepOverTheAmplitudeToo) {
  const Record ordinary = analyse(load_with({}), Observer()),
               exact = analyse(load_with({"analysis.exact=true"}), Observer());
  ASSERT_TRUE(ordinary.converged && exact.converged);
  expect_points_of(value_of<Table>(ordinary.summary, "structure_special_points"),
                   value_of<Table>(exact.summary, "special_points"), "amplitude_N");
}

TEST(StructureSpecialPoints, AreThoseOfAnExactSweepOfTheBar) {
  const auto scene = [](Overrides overrides) {
    overrides.insert(overrides.end(), {"analysis.frequency_from=1250", "analysis.frequency_to=1400",
                                       "time.functions=63", "time.nyquist=drop"});
    return load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/case2_sweep.toml", overrides);
  };
  const Record ordinary = analyse(scene({}), Observer()),
               exact = analyse(scene({"analysis.exact=true"}), Observer());
  ASSERT_TRUE(ordinary.converged && exact.converged);
  expect_points_of(value_of<Table>(ordinary.summary, "structure_special_points"),
                   value_of<Table>(exact.summary, "special_points"), "frequency_Hz");
}

TEST(StructureSpecialPoints, StandOnceWhereTheSamplesMakeManyOfThem) {
  const TemporaryFolder folder;
  const auto place = zigzag_in(folder);
  const Record ordinary = analyse(load_scene(place, Overrides{}), Observer()),
               exact = analyse(load_scene(place, Overrides{"analysis.exact=true"}), Observer());
  ASSERT_TRUE(exact.converged);
  const Table balance = value_of<Table>(ordinary.summary, "special_points"),
              structure = value_of<Table>(ordinary.summary, "structure_special_points");
  EXPECT_GT(balance.rows(), 20u);
  const auto statuses = balance.texts("structure_status");
  EXPECT_GT(std::count(statuses.begin(), statuses.end(), "repeated"), 10);
  expect_points_of(structure, value_of<Table>(exact.summary, "special_points"), "frequency_Hz");
}

TEST(StructureSpecialPoints, AreNotSoughtWithoutStability) {
  const Record record = analyse(stop_with({"analysis.stability=false"}), Observer());
  EXPECT_EQ(find_entry(record.summary, "structure_special_points"), nullptr);
}

}  // namespace
}  // namespace wavebalance::app
