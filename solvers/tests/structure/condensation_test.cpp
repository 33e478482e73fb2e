#include "wavebalance/solvers/structure/condensation.hpp"

#include <gtest/gtest.h>

#include "dense_algebra.hpp"
#include "support/condensation_cases.hpp"
#include "support/small_problems.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
using testing::all_methods;
using testing::shuffled;

Eigen::MatrixXcd dense(const LinearStructure& s, const ImpedanceCoefficients& factors) {
  return factors[0] * Eigen::MatrixXcd(s.mass.cast<Complex>()) +
         factors[1] * Eigen::MatrixXcd(s.damping.cast<Complex>()) +
         factors[2] * Eigen::MatrixXcd(s.stiffness.cast<Complex>());
}

struct Dense {
  CondensedPoint point;
  Eigen::VectorXcd recovered;
};

Dense by_dense_lu(const LinearStructure& s, const ImpedanceCoefficients& factors,
                  const ImpedanceCoefficients& rates, Complex load, const Eigen::VectorXcd& contact) {
  const Eigen::MatrixXcd inverse = oracle::inverse(dense(s, factors));
  const Eigen::MatrixXcd slope = -inverse * dense(s, rates) * inverse;
  const Eigen::VectorXcd forces = s.load.cast<Complex>();
  const Eigen::MatrixXcd rows = Eigen::MatrixXd(s.contact_directions).cast<Complex>();
  const Eigen::VectorXcd all = forces * load - rows.transpose() * contact;
  return {{rows * inverse * rows.transpose(), rows * inverse * forces, rows * slope * rows.transpose(),
           rows * slope * forces},
          inverse * all};
}

void expect_equal(const CondensedPoint& a, const CondensedPoint& b, double tolerance) {
  EXPECT_LE((a.compliance - b.compliance).norm(), tolerance * b.compliance.norm());
  EXPECT_LE((a.load_response - b.load_response).norm(), tolerance * b.load_response.norm());
  EXPECT_LE((a.compliance_slope - b.compliance_slope).norm(), tolerance * b.compliance_slope.norm());
  EXPECT_LE((a.load_response_slope - b.load_response_slope).norm(), tolerance * b.load_response_slope.norm());
}

// M, C, K times 2^entries and the factors times 2^(total - entries), seen in the old units.
struct Rescaled {
  Condensation condensation;
  double factor, unit;

  Rescaled(LinearStructure structure, CondensationMethod method, int entries, int total)
      : condensation(times(std::move(structure), std::ldexp(1.0, entries)), method),
        factor(std::ldexp(1.0, total - entries)),
        unit(std::ldexp(1.0, total)) {}

  static LinearStructure times(LinearStructure structure, double factor) {
    for (auto* matrix : {&structure.mass, &structure.damping, &structure.stiffness}) *matrix *= factor;
    return structure;
  }
  ImpedanceCoefficients in_units(const ImpedanceCoefficients& s) const {
    return {s[0] * factor, s[1] * factor, s[2] * factor};
  }
  CondensedPoint dynamic_compliance(const ImpedanceCoefficients& factors,
                                    const ImpedanceCoefficients& rates) {
    const CondensedPoint point = condensation.dynamic_compliance(in_units(factors), in_units(rates));
    return {point.compliance * unit, point.load_response * unit, point.compliance_slope * unit,
            point.load_response_slope * unit};
  }
  Complex spectrum_at(const ImpedanceCoefficients& factors, const ImpedanceCoefficients& rates) {
    const Eigen::VectorXcd one = Eigen::VectorXcd::Constant(1, factor);
    CondensedSpectrum result;
    condensation.condense({one * factors[0], one * factors[1], one * factors[2]},
                          {one * rates[0], one * rates[1], one * rates[2]}, result);
    return result.compliance_slope(0, 0) * unit;
  }
};

// Numbers whose squares overflow or vanish, as entries of the matrices and as factors.
TEST(Condensation, StiffnessesBeyondTheRangeOfSquaresAreOnlyAnotherUnit) {
  std::mt19937 generator(7);
  LinearStructure chain = testing::random_chain(12, generator);
  chain.load = Eigen::VectorXd::Unit(12, 11) * 2.0;
  chain.contact_directions = contact_rows({11}, chain.size());
  const ImpedanceCoefficients factors{Complex(-3.0, 0.2), Complex(0.1, 2.0), Complex(1.0, 0.05)};
  const ImpedanceCoefficients rates{Complex(-1.0, 0.1), Complex(0.0, 1.0), Complex(0.3, -0.2)};
  const Eigen::VectorXcd force = Eigen::VectorXcd::Constant(1, Complex(0.3, -0.4));
  for (const CondensationMethod method : all_methods) {
    Rescaled ordinary(chain, method, 0, 0);
    const CondensedPoint expected = ordinary.dynamic_compliance(factors, rates);
    const Eigen::VectorXcd full = ordinary.condensation.recover(factors, Complex(1.0, 2.0), force);
    for (const int entries : {-900, -520, 0, 520, 900})
      for (const int total : {-520, 0, 520, 900}) {
        if (std::abs(total - entries) > 1000) continue;  // factors out of range
        Rescaled rescaled(chain, method, entries, total);
        expect_equal(rescaled.dynamic_compliance(factors, rates), expected, 1e-13);
        EXPECT_LE(std::abs(rescaled.spectrum_at(factors, rates) - expected.compliance_slope(0, 0)),
                  1e-13 * std::abs(expected.compliance_slope(0, 0)));
        const Eigen::VectorXcd recovered =
            rescaled.condensation.recover(rescaled.in_units(factors), Complex(1.0, 2.0), force);
        EXPECT_LE((recovered * rescaled.unit - full).norm(), 1e-13 * full.norm());
      }
  }
}

// The chain with one to three contacts by every method; its modes decouple the damping.
TEST(Condensation, EveryMethodEqualsTheDenseInverse) {
  std::mt19937 generator(1);
  const ImpedanceCoefficients factors{Complex(-3.0, 0.2), Complex(0.1, 2.0), Complex(1.0, 0.05)};
  const ImpedanceCoefficients rates{Complex(-1.0, 0.1), Complex(0.0, 1.0), Complex(0.3, -0.2)};
  for (const int size : {1, 2, 9, 25})
    for (const int contacts : {1, 2, 3}) {
      if (contacts > size) continue;
      LinearStructure chain = testing::random_chain(size, generator);
      std::vector<int> dofs{size / 2, 0, size - 1};
      dofs.resize(static_cast<std::size_t>(contacts));
      chain.contact_directions = contact_rows(dofs, size);
      const Eigen::VectorXcd force = testing::random_vector(contacts, generator) * Complex(0.3, -0.4);
      const Dense expected = by_dense_lu(chain, factors, rates, Complex(1.0, 2.0), force);
      for (const CondensationMethod method : all_methods) {
        Condensation condensation(chain, method);
        EXPECT_EQ(condensation.method(), method);
        EXPECT_EQ(condensation.contacts(), contacts);
        expect_equal(condensation.dynamic_compliance(factors, rates), expected.point, 1e-11);
        const auto recovered = condensation.recover(factors, Complex(1.0, 2.0), force);
        EXPECT_LE((recovered - expected.recovered).norm(), 1e-11 * expected.recovered.norm());
      }
    }
}

// Relative motion, a weighted direction, both sides of one direction, the tip with another factor than 1.
TEST(Condensation, EveryMethodTakesAnyDirections) {
  std::mt19937 generator(3);
  const ImpedanceCoefficients factors{Complex(-3.0, 0.2), Complex(0.1, 2.0), Complex(1.0, 0.05)};
  const ImpedanceCoefficients rates{Complex(-1.0, 0.1), Complex(0.0, 1.0), Complex(0.3, -0.2)};
  LinearStructure chain = testing::random_chain(9, generator);
  Eigen::MatrixXd pair = Eigen::MatrixXd::Zero(1, 9), tip = pair, sides(4, 9);
  pair(0, 2) = 1.0;
  pair(0, 7) = -1.0;
  tip(0, 8) = -2.5;
  const Eigen::MatrixXd random = testing::random_directions(2, 9, generator);
  sides << pair, -pair, random;
  for (const Eigen::MatrixXd& rows : {pair, tip, random, sides}) {
    chain.contact_directions = rows.sparseView();
    const auto contacts = static_cast<int>(rows.rows());
    const Eigen::VectorXcd force = testing::random_vector(contacts, generator) * Complex(0.3, -0.4);
    const Dense expected = by_dense_lu(chain, factors, rates, Complex(1.0, 2.0), force);
    for (const CondensationMethod method : all_methods) {
      Condensation condensation(chain, method);
      ASSERT_EQ(condensation.contacts(), contacts);
      expect_equal(condensation.dynamic_compliance(factors, rates), expected.point, 1e-11);
      const auto recovered = condensation.recover(factors, Complex(1.0, 2.0), force);
      EXPECT_LE((recovered - expected.recovered).norm(), 1e-11 * expected.recovered.norm());
    }
  }
}

TEST(Condensation, TakesTheFastestMethodThatTheMatricesAdmit) {
  std::mt19937 generator(7);
  const LinearStructure chain = testing::random_chain(120, generator);
  EXPECT_EQ(Condensation(chain).method(), CondensationMethod::tridiagonal);
  LinearStructure other = shuffled(chain, generator);
  EXPECT_EQ(Condensation(other).method(), CondensationMethod::modal);
  EXPECT_THROW(Condensation(other, CondensationMethod::tridiagonal), std::invalid_argument);
  other.damping.coeffRef(3, 3) += 0.1;  // couples the modes
  EXPECT_EQ(Condensation(other).method(), CondensationMethod::sparse);
  EXPECT_THROW(Condensation(other, CondensationMethod::modal), std::invalid_argument);
  other.stiffness =
      oracle::solve_positive_definite(Eigen::MatrixXd(chain.stiffness), Eigen::MatrixXd::Identity(120, 120))
          .sparseView();
  other.stiffness = 0.5 * (other.stiffness + Eigen::SparseMatrix<double>(other.stiffness.transpose()));
  EXPECT_EQ(Condensation(other).method(), CondensationMethod::dense);
}

// A contact without mass, and a body that nothing holds: modes of whichever matrix is definite.
TEST(Condensation, ModesNeedOnlyOneDefiniteMatrix) {
  std::mt19937 generator(8);
  const ImpedanceCoefficients factors{Complex(-1.7, 0.0), Complex(0.0, 1.3), 1.0},
      rates{Complex(-2.6), 1.0, 0.0};
  LinearStructure massless = testing::random_chain(9, generator);
  massless.contact_directions = contact_rows({8, 2}, massless.size());
  massless.mass.row(8) *= 0.0;
  massless.mass.col(8) *= 0.0;
  massless.damping = 0.01 * massless.stiffness;
  LinearStructure loose = testing::random_chain(9, generator);
  loose.contact_directions = contact_rows({8, 2}, loose.size());
  loose.stiffness.coeffRef(0, 0) = -loose.stiffness.coeff(1, 0);
  loose.damping = 0.02 * loose.mass;
  for (const LinearStructure& structure : {massless, loose}) {
    const Eigen::VectorXcd force = testing::random_vector(2, generator) * Complex(0.3, -0.4);
    const Dense expected = by_dense_lu(structure, factors, rates, 1.0, force);
    Condensation modal(structure, CondensationMethod::modal);
    expect_equal(modal.dynamic_compliance(factors, rates), expected.point, 1e-11);
    EXPECT_LE((modal.recover(factors, 1.0, force) - expected.recovered).norm(),
              1e-11 * expected.recovered.norm());
  }
}

// A load only at the contact uses a shortcut of the tridiagonal method.
TEST(Condensation, LoadAtTheContactAloneGivesTheSame) {
  const LinearStructure bar = testing::jl14_bar(25, 1e-4);
  const Complex rate(0.0, 2.0 * std::numbers::pi * 1275.0);
  const ImpedanceCoefficients factors{rate * rate, rate, 1.0};
  const ImpedanceCoefficients rates{2.0 * rate, 1.0, 0.0};
  expect_equal(Condensation(bar).dynamic_compliance(factors, rates),
               by_dense_lu(bar, factors, rates, 1.0, Eigen::VectorXcd::Zero(1)).point, 1e-9);
}

// A bar that is loaded and touches at its tip uses the recursion over all k, any other structure goes point
// by point.
TEST(Condensation, SpectrumAtOnceEqualsPointByPoint) {
  std::mt19937 generator(4);
  const LinearStructure chain = testing::random_chain(7, generator);
  LinearStructure other_side = testing::jl14_bar(25, 1e-4);
  other_side.contact_directions *= -1.0;
  for (const LinearStructure& structure :
       {chain, shuffled(chain, generator), testing::jl14_bar(25, 1e-4), other_side}) {
    const double unit = structure.stiffness.coeff(0, 0) / structure.mass.coeff(0, 0);
    StiffnessSpectrum factors, rates;
    for (std::size_t d = 0; d < 3; ++d) {
      const double scale = std::pow(unit, 0.5 * (2.0 - double(d)));
      factors[d] =
          (testing::random_vector(9, generator) + Complex(0, 1) * testing::random_vector(9, generator)) *
          scale;
      rates[d] =
          (testing::random_vector(9, generator) + Complex(0, 1) * testing::random_vector(9, generator)) *
          scale;
    }
    Condensation condensation(structure);
    CondensedSpectrum result;
    condensation.condense(factors, rates, result);
    ASSERT_EQ(result.compliance.rows(), 9);
    for (int k = 0; k < 9; ++k) {
      const CondensedPoint point = condensation.dynamic_compliance(
          {factors[0][k], factors[1][k], factors[2][k]}, {rates[0][k], rates[1][k], rates[2][k]});
      const int contacts = structure.contacts();
      expect_equal(
          {result.compliance.row(k).reshaped(contacts, contacts), result.load_response.row(k).transpose(),
           result.compliance_slope.row(k).reshaped(contacts, contacts),
           result.load_response_slope.row(k).transpose()},
          point, 1e-11);
    }
  }
}

// Central differences of step h: the error of the slope is h^2 / 6 of the third derivative and eps / h.
TEST(Condensation, SlopesAreTheDerivativesAlongTheRates) {
  std::mt19937 generator(2);
  const LinearStructure chain = testing::random_chain(6, generator);
  for (const LinearStructure& structure : {chain, shuffled(chain, generator)}) {
    Condensation condensation(structure);
    const ImpedanceCoefficients factors{Complex(-2.0, 0.1), Complex(0.0, 1.5), 1.0};
    const ImpedanceCoefficients rates{Complex(-2.7, 0.3), Complex(0.1, 1.0), Complex(0.2, 0.1)};
    const auto moved = [&](double h) {
      ImpedanceCoefficients at = factors;
      for (std::size_t i = 0; i < 3; ++i) at[i] += h * rates[i];
      return condensation.dynamic_compliance(at, rates);
    };
    const double h = 1e-5;
    const CondensedPoint point = condensation.dynamic_compliance(factors, rates), ahead = moved(h),
                         behind = moved(-h);
    EXPECT_LE(((ahead.compliance - behind.compliance) / (2 * h) - point.compliance_slope).norm(),
              1e-7 * point.compliance_slope.norm());
    EXPECT_LE(((ahead.load_response - behind.load_response) / (2 * h) - point.load_response_slope).norm(),
              1e-7 * point.load_response_slope.norm());
  }
}

// Z = [0 1; 1 0] for both orders: regular, but the first pivot of an elimination without exchange vanishes.
TEST(Condensation, VanishingLeadingPivotIsNotSingular) {
  LinearStructure s;
  Eigen::Matrix2d stiffness, mass;
  stiffness << 4.0, 1.0, 1.0, 5.0;
  mass << 4.0, 0.0, 0.0, 5.0;
  s.stiffness = stiffness.sparseView();
  s.mass = mass.sparseView();
  s.damping = Eigen::SparseMatrix<double>(2, 2);
  s.load = Eigen::Vector2d(3.0, 0.0);
  s.contact_directions = contact_rows({1}, s.size());
  Condensation condensation(s);
  const CondensedPoint point = condensation.dynamic_compliance({-1.0, 0.0, 1.0}, {0.0, 0.0, 1.0});
  EXPECT_NEAR(point.compliance.norm(), 0.0, 1e-14);
  EXPECT_NEAR(std::abs(point.load_response[0] - 3.0), 0.0, 1e-14);
  s.load = Eigen::Vector2d(0.0, 3.0);  // now at the contact: the recursion over k
  const Eigen::VectorXcd one = Eigen::VectorXcd::Ones(1), none = Eigen::VectorXcd::Zero(1);
  CondensedSpectrum result;
  Condensation(s).condense({-one, none, one}, {none, none, one}, result);
  EXPECT_NEAR(result.load_response.norm(), 0.0, 1e-14);
}

TEST(Condensation, UndampedStructureAtItsNaturalFrequencyIsSingular) {
  std::mt19937 generator(3);
  for (const int size : {1, 2, 25}) {
    LinearStructure bar = testing::jl14_bar(size, 0.0);
    const auto modes = oracle::generalized_eigen(Eigen::MatrixXd(bar.stiffness), Eigen::MatrixXd(bar.mass));
    for (const LinearStructure& structure : {bar, shuffled(bar, generator)}) {
      Condensation condensation(structure);
      const Complex at = -modes.values[0];
      EXPECT_THROW(condensation.dynamic_compliance({at, 0.0, 1.0}, {1.0, 0.0, 0.0}), SingularSystem) << size;
      EXPECT_THROW(condensation.recover({at, 0.0, 1.0}, 1.0, Eigen::VectorXcd::Zero(1)), SingularSystem)
          << size;
      const Eigen::VectorXcd one = Eigen::VectorXcd::Ones(1);
      CondensedSpectrum result;
      EXPECT_THROW(condensation.condense({at * one, 0.0 * one, one}, {one, one, one}, result),
                   SingularSystem);
      EXPECT_NO_THROW(condensation.dynamic_compliance({at * 1.0001, 0.0, 1.0}, {1.0, 0.0, 0.0})) << size;
    }
  }
}

TEST(Condensation, RefusesMatricesThatDoNotFit) {
  LinearStructure bar = testing::jl14_bar(3, 1e-4);
  bar.mass.coeffRef(0, 1) *= 2.0;
  EXPECT_THROW(Condensation{bar}, std::invalid_argument);
  bar = testing::jl14_bar(3, 1e-4);
  bar.damping.resize(2, 2);
  try {
    Condensation{bar};
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("damping is 2 x 2; the load has 3"), std::string::npos);
  }
  bar = testing::jl14_bar(3, 1e-4);
  bar.contact_directions = contact_rows({3}, 4);
  EXPECT_THROW(Condensation{bar}, std::invalid_argument);
  EXPECT_THROW(Condensation{LinearStructure{}}, std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
