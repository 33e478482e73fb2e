#include "wavebalance/fem/assembly.hpp"

#include "testing.hpp"

namespace wavebalance::fem {
namespace {

Connectivity random_connectivity(int unknowns, int rows, int elements, std::mt19937& generator) {
  std::uniform_int_distribution<int> any(-1, unknowns - 1);
  return Connectivity::NullaryExpr(rows, elements, [&] { return any(generator); });
}

// The oracle adds into a dense matrix. An unknown may occur twice in one element.
TEST(Assembly, AgreesWithDenseSummation) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 20; ++trial) {
    const int unknowns = 2 + trial, rows = 1 + trial % 5, elements = 3 * trial;
    const Connectivity connectivity = random_connectivity(unknowns, rows, elements, generator);
    std::vector<Eigen::MatrixXd> parts;
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd expected_vector = Eigen::VectorXd::Zero(unknowns);
    for (int element = 0; element < elements; ++element) {
      parts.push_back(Eigen::MatrixXd::Random(rows, rows));
      for (int j = 0; j < rows; ++j) {
        if (connectivity(j, element) < 0) continue;
        expected_vector[connectivity(j, element)] += parts.back()(j, 0);
        for (int i = 0; i < rows; ++i)
          if (connectivity(i, element) >= 0)
            expected(connectivity(i, element), connectivity(j, element)) += parts.back()(i, j);
      }
    }
    const Assembly assembly(unknowns, connectivity);
    const auto part = [&](int element) { return parts[static_cast<std::size_t>(element)]; };
    const Eigen::SparseMatrix<double> found = assembly.matrix(part);
    EXPECT_TRUE(found.isCompressed());
    EXPECT_EQ(Eigen::MatrixXd(found), expected);
    EXPECT_EQ(assembly.vector([&](int element) -> Eigen::VectorXd { return part(element).col(0); }),
              expected_vector);
  }
}

TEST(Assembly, StoresEachEntryOnceAndInOrder) {
  Connectivity chain(2, 4);
  chain << -1, 0, 1, 2, 0, 1, 2, 3;
  const Eigen::SparseMatrix<double> found =
      Assembly(4, chain).matrix([](int) { return Eigen::MatrixXd::Ones(2, 2); });
  EXPECT_EQ(found.nonZeros(), 10);
  for (int column = 0; column < 4; ++column)
    for (int entry = found.outerIndexPtr()[column] + 1; entry < found.outerIndexPtr()[column + 1]; ++entry)
      EXPECT_LT(found.innerIndexPtr()[entry - 1], found.innerIndexPtr()[entry]);
}

TEST(Assembly, RejectsNumbersAndSizesThatDoNotFit) {
  Connectivity connectivity(2, 1);
  connectivity << 0, 3;
  EXPECT_THROW(Assembly(3, connectivity), std::invalid_argument);
  connectivity << 0, -2;
  EXPECT_THROW(Assembly(3, connectivity), std::invalid_argument);
  connectivity << 0, 2;
  const Assembly assembly(3, connectivity);
  EXPECT_THROW(assembly.matrix([](int) { return Eigen::MatrixXd::Ones(2, 3); }), std::invalid_argument);
  EXPECT_THROW(assembly.vector([](int) { return Eigen::VectorXd::Ones(3); }), std::invalid_argument);
}

TEST(FreeDofs, NumberWhatIsNotHeldInOrder) {
  const std::vector<int> held = {4, 0, 4};
  const FreeDofs dofs(6, held);
  EXPECT_EQ(dofs.count(), 4);
  EXPECT_EQ(dofs.free(), (std::vector<int>{1, 2, 3, 5}));
  EXPECT_EQ(dofs.unknown(4), -1);
  EXPECT_EQ(dofs.unknown(5), 3);
  const Eigen::Vector4d values(1, 2, 3, 4);
  EXPECT_EQ(dofs.expand(values)(dofs.free()), values);
  EXPECT_EQ(dofs.expand(values)[0], 0.0);
  EXPECT_EQ(dofs.unknowns(Connectivity::Constant(1, 1, 5))(0, 0), 3);
}

TEST(FreeDofs, RejectNumbersAndSizesThatDoNotFit) {
  const std::vector<int> held = {6};
  EXPECT_THROW(FreeDofs(6, held), std::invalid_argument);
  EXPECT_THROW(FreeDofs(-1, {}), std::invalid_argument);
  const FreeDofs dofs(7, held);
  EXPECT_THROW(dofs.expand(Eigen::VectorXd(7)), std::invalid_argument);
  EXPECT_THROW(dofs.unknown(7), std::out_of_range);
}

}  // namespace
}  // namespace wavebalance::fem
