#include "dense_algebra.hpp"
#include "support/refusal.hpp"
#include "support/unsymmetric_cases.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
using LongComplex = std::complex<long double>;
using LongMatrix = oracle::LongComplexMatrix;

const ImpedanceCoefficients given_factors{Complex(-3.0, 0.2), Complex(0.1, 2.0), Complex(1.0, 0.05)};
const ImpedanceCoefficients given_rates{Complex(-1.0, 0.1), Complex(0.0, 1.0), Complex(0.3, -0.2)};

LongMatrix combined(const LinearStructure& s, const ImpedanceCoefficients& at) {
  const auto precise = [](const auto& matrix) {
    return LongMatrix(Eigen::MatrixXd(matrix).cast<LongComplex>());
  };
  return LongComplex(at[0]) * precise(s.mass) + LongComplex(at[1]) * precise(s.damping) +
         LongComplex(at[2]) * precise(s.stiffness);
}

// S Z^-1 (S^T, load), and its derivative.
struct Exact {
  LongMatrix response, slope, full;

  explicit Exact(const LinearStructure& s) {
    const LongMatrix directions = Eigen::MatrixXd(s.contact_directions).cast<LongComplex>();
    LongMatrix right(s.size(), s.contacts() + 1);
    right << directions.transpose(), Eigen::MatrixXd(s.load).cast<LongComplex>();
    const LongMatrix inverse = oracle::inverse(combined(s, given_factors));
    response = directions * inverse * right;
    slope = -directions * inverse * combined(s, given_rates) * inverse * right;
    full = inverse * right;
  }
};

void expect_refusal(const std::function<void()>& action, const std::string& words) {
  EXPECT_NE(testing::refusal(action).find(words), std::string::npos) << testing::refusal(action);
}

double distance(const Eigen::MatrixXcd& found, const LongMatrix& exact) {
  return double((found.cast<LongComplex>() - exact).norm() / exact.norm());
}

TEST(UnsymmetricCondensation, ComplianceLoadResponseAndSlopesAreThoseOfTheInverse) {
  std::mt19937 generator(31);
  for (const int size : {2, 9, 25})
    for (const int contacts : {1, 2, 3}) {
      if (contacts > size) continue;
      LinearStructure chain = testing::unsymmetric_chain(size, 0.3, 0.2, generator);
      chain.contact_directions = testing::random_directions(contacts, size, generator);
      const Exact exact(chain);
      for (const auto method : {CondensationMethod::dense, CondensationMethod::sparse}) {
        Condensation condensation(chain, method);
        EXPECT_FALSE(condensation.symmetric());
        const CondensedPoint point = condensation.dynamic_compliance(given_factors, given_rates);
        EXPECT_LE(distance(point.compliance, exact.response.leftCols(contacts)), 1e-12);
        EXPECT_LE(distance(point.load_response, exact.response.rightCols(1)), 1e-12);
        EXPECT_LE(distance(point.compliance_slope, exact.slope.leftCols(contacts)), 1e-12);
        EXPECT_LE(distance(point.load_response_slope, exact.slope.rightCols(1)), 1e-12);
        const Eigen::VectorXcd force = testing::random_vector(contacts, generator) * Complex(0.3, -0.4);
        LongMatrix weights(contacts + 1, 1);
        weights << -force.cast<LongComplex>(), LongComplex(1.0L, 2.0L);
        EXPECT_LE(
            distance(condensation.recover(given_factors, Complex(1.0, 2.0), force), exact.full * weights),
            1e-12);
      }
    }
}

TEST(UnsymmetricCondensation, RoundingErrorsAreWithinThoseStated) {
  std::mt19937 generator(32);
  for (int trial = 0; trial < 20; ++trial) {
    LinearStructure chain = testing::unsymmetric_chain(12, 1.0, 0.5, generator);
    chain.contact_directions = testing::random_directions(3, 12, generator);
    const Exact exact(chain);
    for (const auto method : {CondensationMethod::dense, CondensationMethod::sparse}) {
      Condensation condensation(chain, method);
      const CondensedPoint point = condensation.dynamic_compliance(given_factors, given_rates);
      for (int c = 0; c < 3; ++c) {
        const auto error = [&](int column, Complex found) {
          return double(std::abs(exact.response(c, column) - LongComplex(found)));
        };
        EXPECT_LE(error(3, point.load_response[c]), point.load_response_error[c]);
        EXPECT_LE(point.load_response_error[c], 1e-10 * std::abs(point.load_response[c]) + 1e-11);
        for (int d = 0; d < 3; ++d)
          EXPECT_LE(error(d, point.compliance(c, d)),
                    std::sqrt(point.compliance_error[c] * point.compliance_error[d]));
      }
    }
  }
}

TEST(UnsymmetricCondensation, TheMethodIsAnLuAndOthersAreRefusedWithTheMatrix) {
  std::mt19937 generator(33);
  const LinearStructure gyroscopic = testing::unsymmetric_chain(4, 0.3, 0.0, generator);
  LinearStructure circulatory = testing::random_chain(5, generator);  // tridiagonal
  circulatory.stiffness.coeffRef(1, 0) *= 1.5;
  EXPECT_EQ(Condensation(gyroscopic).method(), CondensationMethod::dense);
  EXPECT_EQ(Condensation(circulatory).method(), CondensationMethod::dense);
  for (const auto method : {CondensationMethod::modal, CondensationMethod::tridiagonal}) {
    expect_refusal([&] { Condensation(gyroscopic, method); }, "damping is not symmetric");
    expect_refusal([&] { Condensation(circulatory, method); }, "stiffness is not symmetric");
  }
  LinearStructure heavy = gyroscopic;
  heavy.mass.coeffRef(1, 0) *= 1.5;
  expect_refusal([&] { Condensation{heavy}; }, "mass is not symmetric");
}

TEST(UnsymmetricCondensation, TheTransposedProductIsTheAdjointOfTheProduct) {
  std::mt19937 generator(34);
  LinearStructure chain = testing::unsymmetric_chain(5, 0.3, 0.2, generator);
  chain.contact_directions = testing::random_directions(3, 5, generator);
  for (TimePair& pair : testing::pair_kinds()) {
    CondensedProblem problem(std::move(pair), chain, testing::cosine_load());
    problem.set_frequency(0.11);
    const Eigen::VectorXd force = testing::random_vector(problem.samples(), generator),
                          values = testing::random_vector(problem.samples(), generator);
    Eigen::VectorXd product, transposed;
    problem.apply(force, product);
    problem.apply_transposed(problem.compliance(), values, transposed);
    EXPECT_NEAR(values.dot(product), transposed.dot(force), 1e-12 * values.norm() * product.norm());
  }
}

TEST(UnsymmetricCondensation, AGyroscopicRotorRespondsByForwardAndBackwardWhirl) {
  const testing::Rotor rotor{.gyroscopic = 0.4, .circulatory = 0.02};
  CondensedProblem problem = testing::fourier_problem(rotor.structure(), 15, 32);
  for (const double omega : {0.5, 0.82, 1.22, 2.0}) {
    problem.set_frequency(omega / two_pi);
    for (int l = 0; l < 32; ++l) {
      const double expected = rotor.response(omega, two_pi / omega * l / 32.0);
      EXPECT_NEAR(problem.linear_response()[l], expected, 1e-12 * rotor.response(omega, 0.0) + 1e-12);
    }
  }
}

}  // namespace
}  // namespace wavebalance::solvers
