#include "linalg/active_inverse.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>

namespace wavebalance::solvers {
namespace {

constexpr int total = 60;

class ActiveInverseTest : public ::testing::Test {
 protected:
  ActiveInverseTest() {
    std::normal_distribution<double> normal;
    matrix_ = Eigen::MatrixXd::NullaryExpr(total, total, [&] { return normal(generator_); });
    matrix_.diagonal().array() += 4.0 * std::sqrt(double(total));
  }

  void turn(int member) {
    inverse_.apply_pending_updates();
    if (inverse_.contains(member)) {
      inverse_.leave(member);
      return;
    }
    const Eigen::VectorXd right = inverse_.times(inverse_.gather(matrix_.col(member)));
    const Eigen::VectorXd row = inverse_.gather(matrix_.row(member).transpose());
    inverse_.enter(member, right, inverse_.transposed_times(row), matrix_(member, member) - row.dot(right));
  }

  // The solution over all, zero where there is no member.
  Eigen::VectorXd solve(const Eigen::VectorXd& right, bool transposed) {
    const Eigen::VectorXd slots = transposed ? inverse_.transposed_times(inverse_.gather(right))
                                             : inverse_.times(inverse_.gather(right));
    Eigen::VectorXd all = Eigen::VectorXd::Zero(total);
    for (Eigen::Index slot = 0; slot < slots.size(); ++slot)
      if (const int member = inverse_.members()[std::size_t(slot)]; member >= 0) all[member] = slots[slot];
    return all;
  }

  Eigen::VectorXd solve_densely(const Eigen::VectorXd& right, bool transposed) const {
    const std::vector<int> members = inverse_.ascending();
    Eigen::MatrixXd block(matrix_(members, members));
    const Eigen::VectorXd chosen = right(members);
    if (transposed) block.transposeInPlace();
    Eigen::VectorXd all = Eigen::VectorXd::Zero(total);
    all(members) = block.partialPivLu().solve(chosen).eval();
    return all;
  }

  std::mt19937 generator_{11};
  Eigen::MatrixXd matrix_;
  ActiveInverse inverse_{total};
};

// Through several times as many changes as are gathered, with members that go and come back.
TEST_F(ActiveInverseTest, SolvesWithTheBlockOfItsMembersAfterEveryChange) {
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(total, -1.0, 2.0);
  std::uniform_int_distribution<int> any(0, total - 1);
  inverse_.assign({}, Eigen::MatrixXd());
  for (int change = 0; change < 400; ++change) {
    turn(any(generator_));
    EXPECT_EQ(inverse_.updates(), change + 1);
    for (const bool transposed : {false, true}) {
      const Eigen::VectorXd expected = solve_densely(right, transposed);
      ASSERT_LE((solve(right, transposed) - expected).norm(), 1e-12 * (1.0 + expected.norm())) << change;
    }
  }
}

TEST_F(ActiveInverseTest, IsTheInverseOfABlockWithoutGaps) {
  const std::vector<int> first{3, 20, 41};
  inverse_.assign(first, Eigen::MatrixXd(matrix_(first, first)).inverse());
  for (const int member : {7, 20, 50, 3, 8}) turn(member);
  EXPECT_EQ(inverse_.ascending(), (std::vector<int>{7, 8, 41, 50}));
  const Eigen::MatrixXd inverse = inverse_.matrix();
  const std::vector<int> members = inverse_.members();
  ASSERT_EQ(inverse.rows(), 4);
  EXPECT_LE((inverse * matrix_(members, members) - Eigen::MatrixXd::Identity(4, 4)).norm(), 1e-14 * 60);
}

TEST_F(ActiveInverseTest, ReturnsTheColumnOfAMemberThatLeaves) {
  const std::vector<int> members{5, 9, 30, 44};
  const Eigen::MatrixXd inverse = Eigen::MatrixXd(matrix_(members, members)).inverse();
  inverse_.assign(members, inverse);
  const Eigen::VectorXd column = inverse_.leave(30);
  EXPECT_LE((column - inverse.col(2) / inverse(2, 2)).norm(), 1e-14);
  EXPECT_FALSE(inverse_.contains(30));
}

}  // namespace
}  // namespace wavebalance::solvers
