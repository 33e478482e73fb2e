#include "wavebalance/app/files/table.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <stdexcept>

namespace {

using namespace wavebalance::app;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Table mixed_table() {
  Table table({"case", "trial", "error", "converged"});
  table.append_row({std::int64_t{1}, std::string("haar"), 0.1, true});
  table.append_row({std::int64_t{2}, std::string("a,\"b\""), nan, false});
  return table;
}

TEST(Table, RefusesWhatDoesNotFit) {
  Table table;
  table.add_column("a", std::vector<double>{1, 2});
  EXPECT_THROW(table.add_column("a", std::vector<double>{1, 2}), std::invalid_argument);
  EXPECT_THROW(table.add_column("b", std::vector<double>{1}), std::invalid_argument);
  EXPECT_THROW(table.append_row({1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(table.numbers("c"), std::out_of_range);
  EXPECT_THROW(mixed_table().numbers("trial"), std::invalid_argument);
}

TEST(Table, TakesVectorsOfEigenAndSelectsRows) {
  Table table;
  table.add_column("a", Eigen::VectorXd::LinSpaced(3, 0.0, 1.0).eval());
  EXPECT_EQ(table.numbers("a"), (std::vector<double>{0.0, 0.5, 1.0}));
  EXPECT_EQ(mixed_table().where("trial", "haar").rows(), 1u);
  EXPECT_EQ(mixed_table().where("converged", "false").numbers("case"), std::vector<double>{2.0});
}

}  // namespace
