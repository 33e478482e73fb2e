#include "dense_algebra.hpp"
#include "oracle.hpp"
#include "testing.hpp"
#include "wavebalance/contact/linear_law.hpp"
#include "wavebalance/contact/rigid_law.hpp"
#include "wavebalance/solvers/response/complementarity.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

// The solvers' symbols against the system of all n M unknowns that the papers assemble.
namespace wavebalance::pairs {
namespace {

struct Sizes {
  int elements, functions, points;
};

TEST(DenseOracle, CoversEveryPairAndFormulationThatIsAdmissible) {
  // Exact products: all three for each of six pairs. Sums: three each for Fourier and B-spline, the
  // distributional form for Haar trial functions, weak forms for Daubechies with one pointwise derivative.
  EXPECT_EQ(admissible_settings().size(), 6u * 3u + 3u + 3u + 1u + 1u + 2u + 1u);
}

TEST(DenseOracle, EqualsTheSymbolsForEveryPairAndFormulationAtLeftEndsAndMiddles) {
  int all = 0, with_contact = 0;
  for (const Setting& setting : admissible_settings())
    for (const Case& scene : cases)
      for (const auto& [size, offset] : {std::pair{Sizes{5, 8, 64}, 0.0},
                                         {Sizes{7, 16, 256}, 0.0},
                                         {Sizes{4, 8, 64}, 0.5},
                                         {Sizes{5, 16, 256}, 0.5}}) {
        SCOPED_TRACE(describe(setting) + ", " + scene.name + ", M " + std::to_string(size.functions));
        with_contact +=
            Oracle(setting, scene, size.elements, size.functions, size.points, offset).expect_equal();
        ++all;
      }
  // Sums over 64 points for 8 functions leave Daubechies:Daubechies in the weak form short of the obstacle.
  EXPECT_GE(with_contact, all - 2);
}

TEST(DenseOracle, EqualsTheSymbolsForTheWholeBar) {
  for (const Pair& pair : table_2)
    for (const Case& scene : cases) {
      const auto products = paper_options(pair, 16).inner_products;
      SCOPED_TRACE(std::string(pair.name) + ", " + scene.name);
      EXPECT_TRUE(Oracle({pair, Formulation::distributional, products}, scene, 25, 16, 256).expect_equal());
    }
}

// Without mass along its contact directions, as rigid obstacles need it.
solvers::LinearStructure massless_at_contacts(solvers::LinearStructure structure) {
  const Eigen::MatrixXd rows(structure.contact_directions);
  // Directions along which no contact acts, also if one repeats another.
  const auto along =
      oracle::generalized_eigen(rows.transpose() * rows, Eigen::MatrixXd::Identity(rows.cols(), rows.cols()));
  Eigen::Index free = 0;
  while (free < along.values.size() && along.values[free] < 1e-9 * along.values.tail(1)[0]) ++free;
  const Eigen::MatrixXd basis = along.vectors.leftCols(free), across = basis * basis.transpose();
  const Eigen::MatrixXd mass = across.transpose() * (structure.mass * across);
  structure.mass = Eigen::MatrixXd(0.5 * (mass + mass.transpose())).sparseView();
  return structure;
}

// Several random directions of a bar, one of which repeats another with its obstacle on the other side, at
// 0.6 of their linear response.
Contacts random_directions(int count, unsigned seed) {
  using Complex = std::complex<double>;
  const Case& scene = cases[0];
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  Contacts all{scene.structure(7), Eigen::VectorXd(count), {}};
  Eigen::MatrixXd rows = Eigen::MatrixXd::NullaryExpr(count, 7, [&] { return normal(generator); });
  rows.row(count - 1) = -rows.row(0);
  all.structure.contact_directions = rows.sparseView();
  const Complex rate(0.0, 2.0 * std::numbers::pi * scene.frequency_hz);
  const Eigen::MatrixXcd impedance = Eigen::MatrixXcd(all.structure.stiffness.cast<Complex>()) +
                                     rate * Eigen::MatrixXcd(all.structure.damping.cast<Complex>()) +
                                     rate * rate * Eigen::MatrixXcd(all.structure.mass.cast<Complex>());
  const Eigen::VectorXcd free =
      oracle::solve(impedance, Eigen::VectorXcd(all.structure.load.cast<Complex>()));
  all.gaps = 0.6 * (rows * free).cwiseAbs();
  for (int c = 0; c < count; ++c) all.laws.emplace_back(contact::LinearLaw(1e8 * (c + 1), all.gaps[c]));
  return all;
}

TEST(DenseOracle, EqualsTheSymbolsForRandomDirectionsAndBothSidesOfOne) {
  int all = 0, every_one_presses = 0;
  for (const int count : {2, 4})
    for (const Setting& setting : admissible_settings()) {
      const unsigned seed = 1 + static_cast<unsigned>(all++ % 5);
      const Contacts contacts = random_directions(count, seed);
      SCOPED_TRACE(describe(setting) + ", contacts " + std::to_string(count) + ", seed " +
                   std::to_string(seed));
      Oracle oracle(setting, contacts.structure, contacts.laws, cases[0].frequency_hz, 16, 64);
      every_one_presses += oracle.expect_equal();
    }
  EXPECT_GE(every_one_presses, all / 2);
}

TEST(DenseOracle, EqualsTheSymbolsForRigidObstaclesOnBothSidesOfRandomDirections) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    Contacts contacts = random_directions(2, seed);
    contacts.structure = massless_at_contacts(contacts.structure);
    for (const Pair& pair : {table_2[0], table_2[1], table_2[2]})
      for (const double offset : {0.0, 0.5}) {
        SCOPED_TRACE(std::string(pair.name) + ", seed " + std::to_string(seed));
        const Setting setting{pair, Formulation::distributional, InnerProducts::exact};
        Oracle(setting, contacts.structure, {}, cases[0].frequency_hz, 16, 32, offset)
            .expect_equal_rigid_solution(contacts.gaps);
      }
  }
}

// The points need not be a multiple of the functions, odd or even, when both bases are Fourier.
TEST(DenseOracle, EqualsTheSymbolsForAnyNumberOfFourierFunctionsAndPoints) {
  for (const auto formulation : {Formulation::strong, Formulation::weak, Formulation::distributional})
    for (const Case& scene : cases)
      for (const Sizes& size : {Sizes{5, 9, 64}, Sizes{9, 15, 256}, Sizes{3, 9, 81}, Sizes{5, 8, 30}}) {
        SCOPED_TRACE(std::string(scene.name) + ", M " + std::to_string(size.functions));
        EXPECT_TRUE(Oracle({table_2[0], formulation, InnerProducts::quadrature}, scene, size.elements,
                           size.functions, size.points)
                        .expect_equal());
      }
}

// Integration by parts moves derivatives, it does not change exact products.
TEST(DenseOracle, ExactInnerProductsAreThoseOfFineSums) {
  const Pair pairs[] = {table_2[1], table_2[4]};
  for (const Pair& pair : pairs) {
    const auto how = options(pair, 8, 64, InnerProducts::exact);
    const auto exact = dense::discretise(basis(pair.trial, 8), basis(pair.weight, 8), how, cosine_load());
    const auto fine = dense::sampled_inner_products(basis(pair.trial, 8), basis(pair.weight, 8),
                                                    Formulation::distributional, 1 << 14);
    for (std::size_t d = 0; d <= 2; ++d)
      EXPECT_LE((exact.products[d] - fine[d]).norm(), 1e-5 * exact.products[d].norm())
          << pair.name << " " << d;
  }
}

TEST(Admissibility, IsThatOfTheSobolevExponents) {
  const auto verdict = [](const wavelets::ScalingFunction& trial, const wavelets::ScalingFunction& weight) {
    return solvers::admissibility(wavelets::PeriodicBasis(trial, 5), wavelets::PeriodicBasis(weight, 5),
                                  Formulation::distributional, InnerProducts::exact);
  };
  const auto haar = wavelets::ScalingFunction::haar();
  const auto bspline = wavelets::ScalingFunction::orthonormal_bspline();
  const auto db4 = wavelets::ScalingFunction::daubechies(4), db6 = wavelets::ScalingFunction::daubechies(6);
  EXPECT_TRUE(verdict(haar, bspline).admissible);
  EXPECT_TRUE(verdict(db6, db6).admissible);
  for (const auto& [trial, weight] : {std::pair{haar, haar}, {haar, db6}, {db4, db4}}) {
    const auto refused = verdict(trial, weight);
    EXPECT_FALSE(refused.admissible) << trial.name() << ":" << weight.name();
    EXPECT_NE(refused.reason.find(std::to_string(trial.sobolev_exponent())), std::string::npos)
        << refused.reason;
    EXPECT_NE(refused.reason.find("sum above 2"), std::string::npos) << refused.reason;
    EXPECT_THROW(solvers::TimePair(wavelets::PeriodicBasis(trial, 5), wavelets::PeriodicBasis(weight, 5),
                                   {.quadrature_points = 64}),
                 solvers::InadmissiblePair);
  }
}

}  // namespace
}  // namespace wavebalance::pairs
