#include "dense_algebra.hpp"
#include "pairs.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

// Orders of convergence on a smooth scene: no contact, three harmonics of load, exact inner products. The
// reference is one complex solution a harmonic.
namespace wavebalance::pairs {
namespace {

using Complex = std::complex<double>;
constexpr int fine_points = 1 << 13;
constexpr double frequency = 210.0;

Eigen::VectorXcd load_harmonics() {
  Eigen::VectorXcd harmonics(4);
  harmonics << 0.3, 1.0, Complex(0.2, -0.5), Complex(-0.4, 0.1);
  return harmonics;
}

Eigen::VectorXcd exact_harmonics(const solvers::LinearStructure& bar) {
  Eigen::VectorXcd tip = load_harmonics();
  for (int n = 0; n < tip.size(); ++n) {
    const Complex rate(0.0, 2.0 * std::numbers::pi * n * frequency);
    const Eigen::MatrixXcd stiffness = rate * rate * Eigen::MatrixXd(bar.mass) +
                                       rate * Eigen::MatrixXd(bar.damping) + Eigen::MatrixXd(bar.stiffness);
    tip[n] *= oracle::solve(stiffness, Eigen::VectorXcd(bar.load.cast<Complex>()))[bar.selected_dof(0)];
  }
  return tip;
}

struct Errors {
  double displacement;  // relative L2 norm over the period
  double harmonics;     // of the Fourier coefficients of the solution, relative, harmonics 1..3
};

Errors errors(const Pair& pair, int functions) {
  const solvers::LinearStructure bar = cases[0].structure(10);
  solvers::CondensedProblem problem(
      time_pair(pair, functions, options(pair, functions, 16 * functions, solvers::InnerProducts::exact)),
      bar, load_harmonics());
  problem.set_frequency(frequency);
  const Eigen::VectorXcd coefficients = problem.coefficients(Eigen::VectorXd::Zero(problem.points()));
  const Eigen::VectorXcd exact = exact_harmonics(bar);
  solvers::TrialEvaluator evaluate(problem.pair().trial(), fine_points, 0);
  const Eigen::VectorXd u = evaluate(coefficients);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(fine_points);
  for (int l = 0; l < fine_points; ++l)
    for (int n = 0; n < exact.size(); ++n)
      expected[l] += (exact[n] * std::polar(1.0, 2.0 * std::numbers::pi * n * l / fine_points)).real();
  // Harmonics past half the functions carry the coefficients of those that they alias with.
  const auto coefficient = [&](int n) -> Complex {
    const int k = n % functions;
    return k < coefficients.size() ? coefficients[k] : std::conj(coefficients[functions - k]);
  };
  double harmonics = 0.0;
  for (int n = 1; n < exact.size(); ++n) {
    const Complex found = 2.0 * coefficient(n) * problem.pair().trial().fourier_coefficient(n);
    harmonics += std::norm(found - exact[n]);
  }
  return {(u - expected).norm() / expected.norm(), std::sqrt(harmonics) / exact.norm()};
}

// log2 of the ratio of successive errors, M = first, 2 first, ... 2^levels first.
struct Orders {
  std::vector<double> displacement, harmonics;
};

Orders orders(const Pair& pair, int first, int levels) {
  Orders result;
  Errors last = errors(pair, first);
  for (int level = 1; level <= levels; ++level) {
    const Errors next = errors(pair, first << level);
    result.displacement.push_back(std::log2(last.displacement / next.displacement));
    result.harmonics.push_back(std::log2(last.harmonics / next.harmonics));
    last = next;
  }
  return result;
}

TEST(Convergence, FourierIsExactOnceTheHarmonicsAreThere) {
  EXPECT_GT(errors(table_2[0], 4).displacement, 1e-2);
  for (const int functions : {7, 8, 16, 33})
    EXPECT_LE(errors(table_2[0], functions).displacement, 1e-12) << functions;
}

void expect_orders(const std::vector<double>& found, double expected, double margin) {
  for (std::size_t level = 0; level < found.size(); ++level)
    EXPECT_NEAR(found[level], expected, margin) << "level " << level;
}

// The Fourier coefficients of the solution converge faster than the solution: the symbol of a Galerkin pair
// is (2 pi i k)^d up to the square of what the trial functions alias, divided by h^2; with Fourier weights it
// is exact.
TEST(Convergence, BsplineIsOfOrderFourAndItsHarmonicsOfOrderSix) {
  const Orders found = orders(table_2[1], 32, 3);
  expect_orders(found.displacement, 4.0, 0.2);
  expect_orders(found.harmonics, 6.0, 0.3);
}

TEST(Convergence, Daubechies6IsOfOrderThreeAndItsHarmonicsOfOrderFour) {
  const Orders found = orders(table_2[2], 64, 3);
  expect_orders(found.displacement, 3.0, 0.1);
  expect_orders(found.harmonics, 4.0, 0.1);
}

TEST(Convergence, Daubechies6WithFourierWeightsIsOfOrderThree) {
  expect_orders(orders(table_2[4], 32, 4).displacement, 3.0, 0.1);
  EXPECT_LE(errors(table_2[4], 32).harmonics, 1e-12);
}

TEST(Convergence, HaarIsOfOrderOne) {
  const Orders fourier = orders(table_2[3], 16, 4), bspline = orders(table_2[5], 16, 4);
  expect_orders(fourier.displacement, 1.0, 0.05);
  expect_orders(bspline.displacement, 1.0, 0.05);
  expect_orders(bspline.harmonics, 4.0, 0.1);
  EXPECT_LE(errors(table_2[3], 16).harmonics, 1e-12);
}

}  // namespace
}  // namespace wavebalance::pairs
