#include "wavebalance/spectral/aft.hpp"

#include "testing.hpp"

namespace wavebalance::spectral {
namespace {

using std::numbers::pi;

template <class Function>
PointwiseLaw pointwise(Function function) {
  return [function](std::span<const double> u, std::span<double> result) {
    for (std::size_t i = 0; i < u.size(); ++i) result[i] = function(u[i]);
  };
}

const PointwiseLaw square = pointwise([](double u) { return u * u; });
const PointwiseLaw cube = pointwise([](double u) { return u * u * u; });
const PointwiseLaw cube_slope = pointwise([](double u) { return 3 * u * u; });
const PointwiseLaw spring = pointwise([](double u) { return u > 0.1 ? std::expm1(2 * (u - 0.1)) : 0.0; });
Eigen::VectorXd random_coefficients(int harmonics, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  Eigen::VectorXd coefficients(2 * harmonics + 1);
  for (double& value : coefficients) value = uniform(generator);
  return coefficients;
}

// Coefficients of the cube by convolution of the two-sided spectrum, without any sampling.
Eigen::VectorXd convolved_cube(const Eigen::VectorXd& coefficients) {
  using Complex = std::complex<double>;
  const int harmonics = static_cast<int>(coefficients.size()) / 2;
  const auto c = [&](int n) {
    const int m = std::abs(n);
    if (m > harmonics) return Complex(0.0);
    if (m == 0) return Complex(coefficients[0]);
    return Complex(coefficients[2 * m - 1], n > 0 ? -coefficients[2 * m] : coefficients[2 * m]) / 2.0;
  };
  Eigen::VectorXd result(coefficients.size());
  for (int n = 0; n <= harmonics; ++n) {
    Complex sum = 0.0;
    for (int a = -harmonics; a <= harmonics; ++a)
      for (int b = -harmonics; b <= harmonics; ++b) sum += c(a) * c(b) * c(n - a - b);
    if (n == 0)
      result[0] = sum.real();
    else
      result.segment<2>(2 * n - 1) << 2.0 * sum.real(), -2.0 * sum.imag();
  }
  return result;
}

// The defining sums, for any scalar.
template <class Scalar, class Law>
std::vector<Scalar> defining_sums(const std::vector<Scalar>& coefficients, int points, Law law) {
  std::vector<Scalar> sums(coefficients.size(), Scalar(0.0));
  const auto basis = [&](std::size_t i, int l) {
    const double angle = 2 * pi * static_cast<double>((i + 1) / 2) * l / points;
    return i == 0 ? 1.0 : i % 2 == 1 ? std::cos(angle) : std::sin(angle);
  };
  for (int l = 0; l < points; ++l) {
    Scalar u(0.0);
    for (std::size_t i = 0; i < coefficients.size(); ++i) u += coefficients[i] * basis(i, l);
    const Scalar f = law(u);
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] += f * (basis(i, l) * (i == 0 ? 1.0 : 2.0) / points);
  }
  return sums;
}

TEST(Aft, SquareOfACosineIsExact) {
  Aft aft(2, 5);
  const AftForce force = aft.force(Eigen::Matrix<double, 5, 1>(0, 3, 0, 0, 0), square);
  Eigen::Matrix<double, 5, 1> expected(4.5, 0, 0, 4.5, 0);
  EXPECT_LE((force.coefficients - expected).cwiseAbs().maxCoeff(), 16 * eps);
  EXPECT_NEAR(force.samples[1], std::pow(3 * std::cos(2 * pi / 5), 2), 16 * eps);
}

TEST(Aft, CubicForceIsExactFromFourTimesTheHarmonicsOn) {
  for (int harmonics : {0, 1, 2, 3, 7}) {
    const Eigen::VectorXd coefficients = random_coefficients(harmonics, 5);
    const Eigen::VectorXd expected = convolved_cube(coefficients);
    const double tolerance = 64 * eps * std::max(1.0, expected.cwiseAbs().maxCoeff());
    for (int points : {4 * harmonics + 1, 4 * harmonics + 2, 8 * harmonics + 3}) {
      Aft aft(harmonics, points);
      EXPECT_LE((aft.force(coefficients, cube).coefficients - expected).cwiseAbs().maxCoeff(), tolerance);
      EXPECT_LE(aft.aliasing(coefficients, cube), 64 * eps);
    }
  }
}

TEST(Aft, CubicForceAliasesBelowAndTheEstimateSaysHowMuch) {
  for (int harmonics : {1, 3, 7}) {
    const Eigen::VectorXd coefficients = random_coefficients(harmonics, 5);
    const Eigen::VectorXd exact = convolved_cube(coefficients);
    Aft aft(harmonics, 4 * harmonics);
    const Eigen::VectorXd error = aft.force(coefficients, cube).coefficients - exact;
    const auto norm = [](const Eigen::VectorXd& v) { return std::sqrt(v.squaredNorm() + v[0] * v[0]); };
    EXPECT_GT(norm(error), 1e-6 * norm(exact));
    EXPECT_NEAR(aft.aliasing(coefficients, cube), norm(error) / norm(exact), 1e-12);  // 2N points are enough
  }
}

TEST(Aft, AliasingOfAContactForceFallsAsPointsAreAdded) {
  const Eigen::VectorXd coefficients = random_coefficients(4, 9);
  double last = 1.0;
  for (int points : {16, 64, 256, 1024}) {
    const double found = Aft(4, points).aliasing(coefficients, spring);
    EXPECT_LT(found, 0.5 * last) << points << " points";
    EXPECT_GT(found, 0.0);
    last = found;
  }
}

TEST(Aft, NoForceHasNoAliasing) {
  EXPECT_EQ(Aft(3, 16).aliasing(random_coefficients(3, 1), pointwise([](double) { return 0.0; })), 0.0);
}

TEST(Aft, ForceIsTheDefiningSum) {
  for (int points : {11, 12, 37, 64}) {
    const Eigen::VectorXd coefficients = random_coefficients(5, 3);
    const auto expected = defining_sums(std::vector<double>(coefficients.begin(), coefficients.end()), points,
                                        [](double u) { return u > 0.1 ? std::expm1(2 * (u - 0.1)) : 0.0; });
    const Eigen::VectorXd found = Aft(5, points).force(coefficients, spring).coefficients;
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(found[static_cast<Eigen::Index>(i)], expected[i], 64 * eps);
  }
}

TEST(Aft, JacobianIsThatOfCentralDifferences) {
  for (const auto& [harmonics, points] : {std::pair{5, 11}, {5, 12}, {5, 19}, {5, 64}, {6, 33}}) {
    const Eigen::VectorXd at = random_coefficients(harmonics, 4);
    Aft aft(harmonics, points);
    const Eigen::MatrixXd found = aft.jacobian(at, cube_slope);
    const double step = 1e-4;  // the error of a cubic's central difference is step^2 times one
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      const Eigen::VectorXd shift = step * Eigen::VectorXd::Unit(at.size(), i);
      const Eigen::VectorXd slope =
          (aft.force(at + shift, cube).coefficients - aft.force(at - shift, cube).coefficients) / (2 * step);
      EXPECT_LE((slope - found.col(i)).cwiseAbs().maxCoeff(), 2 * step * step) << points << ' ' << i;
    }
  }
}

TEST(Aft, RejectsTooFewPointsAndWrongLengths) {
  EXPECT_THROW(Aft(-1, 4), std::invalid_argument);
  try {
    Aft aft(3, 6);
    FAIL() << "six points cannot tell seven coefficients apart";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "Aft: points is 6; it must be at least 7");
  }
  EXPECT_THROW(Aft(3, 7).force(Eigen::VectorXd::Zero(6), square), std::invalid_argument);
  EXPECT_THROW(Aft(3, 7).jacobian(Eigen::VectorXd::Zero(8), square), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::spectral
