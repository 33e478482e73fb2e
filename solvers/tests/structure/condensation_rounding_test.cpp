#include <gtest/gtest.h>

#include "dense_algebra.hpp"
#include "support/condensation_cases.hpp"
#include "support/small_problems.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
using testing::all_methods;
using testing::shuffled;
using LongComplex = std::complex<long double>;
using LongMatrix = oracle::LongComplexMatrix;

// Z^-1 S^T and Z^-1 load at the contacts by an elimination in long double.
LongMatrix by_long_double(const LinearStructure& s, const ImpedanceCoefficients& factors) {
  const auto precise = [](const auto& matrix) {
    return LongMatrix(Eigen::MatrixXd(matrix).cast<LongComplex>());
  };
  const LongMatrix stiffness = LongComplex(factors[0]) * precise(s.mass) +
                               LongComplex(factors[1]) * precise(s.damping) +
                               LongComplex(factors[2]) * precise(s.stiffness);
  LongMatrix right = LongMatrix::Zero(s.size(), s.contacts() + 1);
  const LongMatrix directions = precise(s.contact_directions);
  right.leftCols(s.contacts()) = directions.transpose();
  right.col(s.contacts()) = s.load.cast<LongComplex>();
  return directions * oracle::solve(stiffness, right);
}

// Equal oscillators of 10 kN/m and 1 kg; each is coupled to the next by a spring of that share. The load
// acts on `loaded`, an obstacle on the first and the fourth. The frequency is near all natural frequencies.
LinearStructure weakly_coupled(int size, double share, int loaded, bool ring) {
  LinearStructure s;
  Eigen::MatrixXd stiffness = 1e4 * Eigen::MatrixXd::Identity(size, size);
  for (int i = 0; i + (ring ? 0 : 1) < size; ++i) {
    const int next = (i + 1) % size;
    const double spring = 1e4 * share * (1.0 + 0.3 * std::sin(double(i)));
    stiffness(i, i) += spring;
    stiffness(next, next) += spring;
    stiffness(i, next) -= spring;
    stiffness(next, i) -= spring;
  }
  s.stiffness = stiffness.sparseView();
  s.mass = Eigen::MatrixXd::Identity(size, size).sparseView();
  s.damping = 0.02 * s.mass + 1e-4 * s.stiffness;
  s.load = Eigen::VectorXd::Unit(size, loaded);
  s.contact_directions = contact_rows({0}, s.size());
  return s;
}

ImpedanceCoefficients at_harmonic(int k, double omega = 80.0) {
  return {-(k * omega) * (k * omega), Complex(0.0, k * omega), 1.0};
}

StiffnessSpectrum spectrum_of(int size, double omega = 80.0) {
  StiffnessSpectrum factors;
  for (std::size_t d = 0; d < 3; ++d)
    factors[d] =
        Eigen::VectorXcd::NullaryExpr(size, [&](Eigen::Index k) { return at_harmonic(int(k), omega)[d]; });
  return factors;
}

// The errors of one harmonic, and whether they are within those that the method states.
struct TrueErrors {
  double response = 0.0, stated = 0.0;

  TrueErrors(const LinearStructure& structure, Condensation& condensation,
             const ImpedanceCoefficients& factors) {
    const CondensedPoint point = condensation.dynamic_compliance(factors, {0.0, 0.0, 0.0});
    const LongMatrix exact = by_long_double(structure, factors);
    const int count = structure.contacts();
    for (int c = 0; c < count; ++c) {
      const double size = double(std::abs(exact(c, count)));
      const double error = double(std::abs(exact(c, count) - LongComplex(point.load_response[c])));
      EXPECT_LE(error, point.load_response_error[c]) << "load, contact " << c;
      response = std::max(response, error / size);
      stated = std::max(stated, point.load_response_error[c] / size);
      for (int d = 0; d < count; ++d)
        EXPECT_LE(double(std::abs(exact(c, d) - LongComplex(point.compliance(c, d)))),
                  std::sqrt(point.compliance_error[c] * point.compliance_error[d]))
            << c << ", " << d;
    }
  }
};

// The response decays by 1e-4 from one oscillator to the next: the modal terms are as large as at the load.
TEST(CondensationRounding, ModalSumLosesTheDigitsOfAResponseFarFromTheLoadAndEliminationsKeepThem) {
  for (const bool ring : {false, true}) {
    const LinearStructure chain = weakly_coupled(10, 1e-4, 5, ring);
    for (const CondensationMethod method : all_methods) {
      if (ring && method == CondensationMethod::tridiagonal) continue;
      Condensation condensation(chain, method);
      const TrueErrors errors(chain, condensation, at_harmonic(1));
      if (method == CondensationMethod::modal) {
        EXPECT_GT(errors.response, 1e-2);
      } else {
        EXPECT_LT(errors.response, 1e-13);
        EXPECT_LT(errors.stated, 1e-11);
      }
    }
  }
}

TEST(CondensationRounding, StatesAtLeastTheErrorThatItMakes) {
  std::mt19937 generator(11);
  for (const double share : {1e-1, 1e-2, 1e-3, 1e-4})
    for (const int loaded : {0, 2, 5, 9}) {
      LinearStructure chain = weakly_coupled(10, share, loaded, false);
      chain.contact_directions = contact_rows({0, 3}, chain.size());
      const LinearStructure other = shuffled(chain, generator);
      for (const CondensationMethod method : all_methods)
        for (const int k : {0, 1, 2, 30}) {
          const LinearStructure& taken = method == CondensationMethod::tridiagonal ? chain : other;
          Condensation condensation(taken, method);
          TrueErrors(taken, condensation, at_harmonic(k));
        }
    }
}

// Neighbours that a stiff spring makes move alike: of their relative motion the digits are lost in the sums.
TEST(CondensationRounding, HoldsForRelativeMotionsOfBodiesThatMoveAlike) {
  std::mt19937 generator(12);
  for (const double share : {1e-2, 1e2, 1e6}) {
    LinearStructure chain = weakly_coupled(10, share, 0, false);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, 10);
    for (int c = 0; c < 3; ++c) {
      rows(c, 3 * c) = 1.0;
      rows(c, 3 * c + 1) = -1.0;
    }
    rows.row(1) *= -0.3;
    chain.contact_directions = rows.sparseView();
    const LinearStructure other = shuffled(chain, generator);
    for (const CondensationMethod method : all_methods)
      for (const int k : {0, 1, 2, 30}) {
        SCOPED_TRACE(::testing::Message() << "share " << share << ", method " << int(method) << ", k " << k);
        const LinearStructure& taken = method == CondensationMethod::tridiagonal ? chain : other;
        Condensation condensation(taken, method);
        TrueErrors(taken, condensation, at_harmonic(k));
      }
  }
}

// Rows before the contact at a natural frequency: pivots of the recursion lose up to eight digits.
TEST(CondensationRounding, RecursionOfABarStatesAtLeastTheErrorThatItMakes) {
  LinearStructure bar = testing::jl14_bar(25, 1e-7);
  for (const double omega : {2.0, 5.0, 1e3, 8e3, 1e4, 3e4}) {
    Condensation condensation(bar);
    const StiffnessSpectrum factors = spectrum_of(40, omega);
    CondensedSpectrum result;
    condensation.condense(factors, factors, result);
    for (int k = 0; k < 40; ++k) {
      const LongMatrix exact = by_long_double(bar, at_harmonic(k, omega));
      EXPECT_LE(double(std::abs(exact(0, 0) - LongComplex(result.compliance(k, 0)))),
                result.compliance_error(k, 0));
      EXPECT_LE(double(std::abs(exact(0, 1) - LongComplex(result.load_response(k, 0)))),
                result.load_response_error(k, 0));
    }
    EXPECT_LT(condensation.rounding().compliance, 1e-8);
  }
}

TEST(CondensationRounding, ReplacesTheModalSumWhereItLosesTheContactFreeResponse) {
  const LinearStructure near = weakly_coupled(10, 1e-4, 1, true), far = weakly_coupled(10, 1e-4, 5, true);
  const StiffnessSpectrum factors = spectrum_of(8);
  const Eigen::VectorXcd cosine = Eigen::VectorXcd::Unit(8, 1);
  CondensedSpectrum result;
  Condensation kept(near), replaced(far), forced(far, CondensationMethod::modal);
  kept.condense(factors, factors, result, cosine);
  EXPECT_EQ(kept.method(), CondensationMethod::modal);
  EXPECT_LE(kept.rounding().load_response, 1e-8);
  forced.condense(factors, factors, result, cosine);
  EXPECT_EQ(forced.method(), CondensationMethod::modal);
  EXPECT_GT(forced.rounding().load_response, 1e-3);
  EXPECT_LT(forced.rounding().compliance, 1e-10);
  EXPECT_EQ(replaced.method(), CondensationMethod::modal);
  replaced.condense(factors, factors, result, cosine);
  EXPECT_EQ(replaced.method(), CondensationMethod::dense);
  EXPECT_LE(replaced.rounding().load_response, 1e-11);
  const LongMatrix exact = by_long_double(far, at_harmonic(1));
  EXPECT_LE(double(std::abs(exact(0, 1) - LongComplex(result.load_response(1, 0)))),
            1e-13 * double(std::abs(exact(0, 1))));
}

// A clamped beam of short elements: the rounding of its stiffness grows, relative to its first mode, with
// the fourth power of their number, to which an elimination adds its own.
LinearStructure finely_divided_beam(int elements) {
  const double length = 1.0 / elements;
  Eigen::Matrix4d bending, inertia;
  bending << 12, 6, -12, 6, 6, 4, -6, 2, -12, -6, 12, -6, 6, 2, -6, 4;
  inertia << 156, 22, 54, -13, 22, 4, 13, -3, 54, 13, 156, -22, -13, -3, -22, 4;
  const int size = 2 * elements;  // displacement and rotation times the length of an element
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size + 2, size + 2), mass = stiffness;
  for (int e = 0; e < elements; ++e) {
    stiffness.block<4, 4>(2 * e, 2 * e) += bending / std::pow(length, 3);
    mass.block<4, 4>(2 * e, 2 * e) += inertia * length / 420.0;
  }
  LinearStructure s;
  s.stiffness = stiffness.bottomRightCorner(size, size).sparseView();
  s.mass = mass.bottomRightCorner(size, size).sparseView();
  s.damping = 1e-3 * s.stiffness;
  s.load = Eigen::VectorXd::Unit(size, size - 2);
  s.contact_directions = contact_rows({elements}, size);
  return s;
}

TEST(CondensationRounding, KeepsTheModalSumWhereAnEliminationLosesMore) {
  const LinearStructure beam = finely_divided_beam(160);
  const StiffnessSpectrum factors = spectrum_of(4, 3.5);
  const Eigen::VectorXcd cosine = Eigen::VectorXcd::Unit(4, 1);
  CondensedSpectrum result, expected;
  Condensation chosen(beam), modal(beam, CondensationMethod::modal), sparse(beam, CondensationMethod::sparse);
  chosen.condense(factors, factors, result, cosine);
  sparse.condense(factors, factors, expected, cosine);
  modal.condense(factors, factors, expected, cosine);
  EXPECT_GT(modal.rounding().load_response, 1e-8);
  EXPECT_GT(sparse.rounding().load_response, modal.rounding().load_response);
  EXPECT_EQ(chosen.method(), CondensationMethod::modal);
  EXPECT_EQ(chosen.rounding().load_response, modal.rounding().load_response);
  EXPECT_EQ(result.load_response, expected.load_response);
}

// The modal sum also neglects off-diagonal damping, up to 1e-8.
TEST(CondensationRounding, ErrorsOfTheModalSumHoldTheDampingThatItLeavesOut) {
  LinearStructure chain = weakly_coupled(6, 1e-3, 0, true);
  chain.contact_directions = contact_rows({2}, chain.size());
  chain.damping.coeffRef(0, 0) *= 1.0 + 1e-9;
  Condensation modal(chain, CondensationMethod::modal);
  const TrueErrors errors(chain, modal, at_harmonic(1, 100.0));
  EXPECT_GT(errors.stated, 1e-10);
}

}  // namespace
}  // namespace wavebalance::solvers
