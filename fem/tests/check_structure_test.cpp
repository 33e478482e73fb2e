#include "wavebalance/fem/check_structure.hpp"

#include "expect_error.hpp"
#include "testing.hpp"
#include "wavebalance/fem/bar.hpp"
#include "wavebalance/fem/blade.hpp"

namespace wavebalance::fem {
namespace {

TEST(StructureCheck, AcceptsABarWithOrWithoutDamping) {
  Matrices matrices = bar({});
  EXPECT_NO_THROW(check_structure(matrices));
  matrices.damping.resize(0, 0);
  EXPECT_NO_THROW(check_structure(matrices));
}

TEST(StructureCheck, TellsAFreeSolidFromAClampedOne) {
  const Blade clamped = blade();
  EXPECT_NO_THROW(check_structure(solid_matrices(clamped.model)));
  BladeOptions options;
  options.chord_elements = 4;
  options.span_elements = 5;
  const Matrices free = solid_matrices(hold_nodes(blade(options).model.mesh, options.material, {}));
  expect_error([&] { check_structure(free); }, "stiffness is not positive definite");
  EXPECT_NO_THROW(check_structure(free, {.allow_free = true}));
}

TEST(StructureCheck, NamesTheMatrixThatIsWrong) {
  const Matrices right = bar({});
  const auto expect_rejected = [&](auto change, const std::string& part) {
    Matrices wrong = right;
    change(wrong);
    expect_error([&] { check_structure(wrong); }, part);
  };
  expect_rejected([](Matrices& m) { m.mass.conservativeResize(24, 24); }, "mass is 24 x 24");
  expect_rejected([](Matrices& m) { m.damping.conservativeResize(25, 26); }, "damping is 25 x 26");
  expect_rejected([](Matrices& m) { m = {}; }, "stiffness is 0 x 0");
  expect_rejected([](Matrices& m) { m.stiffness.coeffRef(2, 1) *= 1.1; }, "stiffness is not symmetric");
  expect_rejected([](Matrices& m) { m.damping.coeffRef(2, 1) += 1.0; }, "damping is not symmetric");
  expect_rejected([](Matrices& m) { m.mass.coeffRef(3, 3) = std::nan(""); }, "row 3, column 3");
  expect_rejected([](Matrices& m) { m.mass.coeffRef(3, 3) = -1; }, "mass is not positive definite");
  expect_rejected([](Matrices& m) { m.mass.coeffRef(3, 3) /= 20; }, "mass is not positive definite");
  const auto set_free = [](Matrices& m) { m.stiffness.coeffRef(0, 0) /= 2; };
  expect_rejected(set_free, "stiffness is not positive definite");
  Matrices floating = right;
  set_free(floating);
  EXPECT_NO_THROW(check_structure(floating, {.allow_free = true}));
}

// The mass of a bar with one integration point per element: an alternating motion has none.
TEST(StructureCheck, AcceptsMotionsWithoutMassWhereTheyAreAllowed) {
  Matrices matrices = bar({.elements = 4});
  std::vector<Eigen::Triplet<double>> entries;
  for (int element = 0; element < 4; ++element)
    for (int i = element - 1; i <= element; ++i)
      for (int j = element - 1; j <= element; ++j)
        if (i >= 0 && j >= 0) entries.emplace_back(i, j, 1.0);
  matrices.mass.setFromTriplets(entries.begin(), entries.end());
  EXPECT_NO_THROW(check_structure(matrices, {.semidefinite_mass = true}));
  matrices.mass.coeffRef(0, 0) = 0.0;  // the alternating motion of the rest has none, and this one less
  matrices.mass.coeffRef(1, 1) = 1.9;
  expect_error([&] { check_structure(matrices, {.semidefinite_mass = true}); },
               "mass is not positive semidefinite");
}

TEST(StructureCheck, ThrowsTheMatrixAtFaultAndTheReason) {
  for (auto [name, member] : {std::pair{StructureMatrix::mass, &Matrices::mass},
                              std::pair{StructureMatrix::damping, &Matrices::damping},
                              std::pair{StructureMatrix::stiffness, &Matrices::stiffness}}) {
    Matrices wrong = bar({.stiffness_damping = 1e-4});
    (wrong.*member).coeffRef(2, 1) += 1e9;
    try {
      check_structure(wrong, {.first_index = 1});
      ADD_FAILURE() << to_string(name) << " was accepted";
    } catch (const StructureFault& fault) {
      EXPECT_EQ(fault.matrix(), name);
      EXPECT_EQ(fault.reason().find("is not symmetric: row "), 0u) << fault.reason();
      EXPECT_EQ(fault.what(), "check_structure: " + std::string(to_string(name)) + " " + fault.reason());
    }
  }
}

Eigen::SparseMatrix<double> sparse(const Eigen::MatrixXd& matrix) { return matrix.sparseView(); }

TEST(PositiveSemidefinite, HoldsForDampingThatTakesEnergyOrNone) {
  const Matrices clamped = bar({.stiffness_damping = 1e-4});
  EXPECT_TRUE(positive_semidefinite(clamped.damping));
  Eigen::SparseMatrix<double> free = clamped.stiffness;
  free.coeffRef(0, 0) /= 2;  // singular: the bar may move as a rigid body
  EXPECT_TRUE(positive_semidefinite(free));
  EXPECT_TRUE(positive_semidefinite(Eigen::SparseMatrix<double>(4, 4)));
  EXPECT_TRUE(positive_semidefinite({}));
  EXPECT_TRUE(positive_semidefinite(sparse(Eigen::Vector4d(1e9, 0, 1e-9, 3).asDiagonal())));
}

TEST(PositiveSemidefinite, FailsForDampingThatAddsEnergyToSomeMotion) {
  EXPECT_FALSE(positive_semidefinite(sparse(Eigen::Vector3d(1, -1e-3, 1).asDiagonal())));
  EXPECT_FALSE(positive_semidefinite(sparse((Eigen::Matrix2d() << 0, 1, 1, 0).finished())));
  EXPECT_FALSE(positive_semidefinite(sparse((Eigen::Matrix2d() << 1, 1e-3, 1e-3, 0).finished())));
  EXPECT_FALSE(positive_semidefinite(-bar({}).stiffness));
  Matrices matrices = bar({});
  matrices.stiffness.coeffRef(3, 3) *= 0.8;  // a spring below minus the stiffness of the bar there
  EXPECT_FALSE(positive_semidefinite(matrices.stiffness));
}

// The eigenvalues of [1 c; c 1] are 1 - c and 1 + c, in any units of the two unknowns.
TEST(PositiveSemidefinite, JudgesTheSmallestEigenvalueOfTheScaledMatrix) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const auto with_smallest = [&](double eigenvalue) {
      const double c = unit * (1 - eigenvalue);
      return sparse((Eigen::Matrix2d() << unit * unit, c, c, 1).finished());
    };
    EXPECT_TRUE(positive_semidefinite(with_smallest(-0.9e-8)));
    EXPECT_FALSE(positive_semidefinite(with_smallest(-1.1e-8)));
    EXPECT_FALSE(positive_semidefinite(with_smallest(-1e-11), 1e-12));
  }
  EXPECT_THROW(positive_semidefinite(sparse(Eigen::MatrixXd::Ones(2, 3))), std::invalid_argument);
  EXPECT_THROW(positive_semidefinite({}, 0.0), std::invalid_argument);
}

TEST(StructureCheck, NamesUnknownsThatAreOutOfRangeOrRepeated) {
  const std::vector<int> list = {4, 2, 7};
  EXPECT_NO_THROW(check_unknowns(list, 8, "contact.dofs"));
  expect_error([&] { check_unknowns(list, 7, "contact.dofs"); }, "contact.dofs has 7; it must be in 0..6");
  const std::vector<int> twice = {4, 2, 4};
  expect_error([&] { check_unknowns(twice, 8, "contact.dofs"); }, "contact.dofs has 4 twice");
}

}  // namespace
}  // namespace wavebalance::fem
