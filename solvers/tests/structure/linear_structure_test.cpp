#include "wavebalance/solvers/structure/linear_structure.hpp"

#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/structure/condensation.hpp"

namespace wavebalance::solvers {
namespace {

TEST(ContactRows, SelectDegreesOfFreedomInTheirOrder) {
  const ContactDirections rows = contact_rows({4, 0, 2}, 5);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(3, 5);
  expected(0, 4) = expected(1, 0) = expected(2, 2) = 1.0;
  EXPECT_EQ(Eigen::MatrixXd(rows), expected);
  LinearStructure structure;
  structure.contact_directions = rows;
  EXPECT_EQ(structure.contacts(), 3);
  EXPECT_EQ(structure.selected_dof(0), 4);
  EXPECT_EQ(structure.selected_dof(2), 2);
}

TEST(ContactRows, RefuseOnesThatAreNotThereOrTwice) {
  for (const std::vector<int>& dofs : {std::vector<int>{3}, {-1}, {1, 0, 1}})
    EXPECT_THROW(contact_rows(dofs, 3), std::invalid_argument) << dofs.size();
}

TEST(LinearStructure, SelectsADegreeOfFreedomByACoefficientOfOneAlone) {
  LinearStructure structure;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(4, 3);
  rows(0, 1) = 1.0;
  rows(1, 1) = -1.0;
  rows(2, 0) = 1.0;
  rows(2, 2) = -1.0;
  rows(3, 2) = 2.0;
  structure.contact_directions = rows.sparseView();
  structure.contact_directions.coeffRef(0, 2) = 0.0;  // an entry without effect
  EXPECT_EQ(structure.selected_dof(0), 1);
  for (const int other : {1, 2, 3}) EXPECT_EQ(structure.selected_dof(other), -1) << other;
}

std::string refusal_of(const ContactDirections& directions) {
  LinearStructure bar = testing::jl14_bar(3, 1e-4);
  bar.contact_directions = directions;
  try {
    Condensation{bar};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(LinearStructure, RefusesDirectionsThatDoNotFit) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Ones(2, 3);
  EXPECT_EQ(refusal_of(rows.sparseView()), "");
  EXPECT_NE(refusal_of({}).find("contact_directions is 0 x 0"), std::string::npos);
  EXPECT_NE(refusal_of(contact_rows({}, 3)).find("is 0 x 3; it must have at least one row"),
            std::string::npos);
  EXPECT_NE(refusal_of(contact_rows({0}, 4)).find("is 1 x 4"), std::string::npos);
  rows.row(1).setZero();
  EXPECT_NE(refusal_of(rows.sparseView()).find("a zero row 1"), std::string::npos);
  rows(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal_of(rows.sparseView()).find("row 1 that is not finite"), std::string::npos);
}

}  // namespace
}  // namespace wavebalance::solvers
