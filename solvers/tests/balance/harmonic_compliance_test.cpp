// A balance uses only the compliance of its structure at each harmonic, which may be given instead of
// matrices.

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

// The receptance of m = k = 1, c = 0.1 in closed form, in a pair of Fourier functions.
class Receptance final : public HarmonicCompliance {
 public:
  explicit Receptance(TimePair pair) : pair_(std::move(pair)) {}

  void condense(double frequency, const Eigen::MatrixXcd&, CondensedSpectrum& result) override {
    const Eigen::Index rows = pair_.spectrum_size();
    for (auto* matrix :
         {&result.compliance, &result.load_response, &result.compliance_slope, &result.load_response_slope})
      matrix->setZero(rows, 1);
    result.compliance_error.setZero(rows, 1);
    result.load_response_error.setZero(rows, 1);
    for (int k = 0; k < rows; ++k) {
      const std::complex<double> s(0.0, two_pi * k * frequency), ds(0.0, two_pi * k);
      const std::complex<double> receptance = 1.0 / (1.0 + 0.1 * s + s * s) / pair_.symbol(0)[k];
      result.compliance(k, 0) = receptance;
      result.load_response(k, 0) = load * receptance;
      result.compliance_slope(k, 0) =
          -(0.1 * ds + 2.0 * s * ds) * receptance * receptance * pair_.symbol(0)[k];
      result.load_response_slope(k, 0) = load * result.compliance_slope(k, 0);
    }
    frequency_ = frequency;
  }
  Eigen::VectorXcd recover(int k, const Eigen::VectorXcd& loads, const Eigen::VectorXcd& forces) override {
    const std::complex<double> s(0.0, two_pi * k * frequency_);
    return Eigen::VectorXcd::Constant(
        1, (load * loads[0] - forces[0]) / (1.0 + 0.1 * s + s * s) / pair_.symbol(0)[k]);
  }
  bool symmetric() const override { return true; }
  double condition() const override { return 1.0; }

  static constexpr double load = 0.8;

 private:
  TimePair pair_;
  double frequency_ = 0.0;
};

TEST(HarmonicCompliance, InClosedFormGivesTheResponsesOfTheMatrices) {
  const LinearStructure oscillator = testing::unit_oscillator(0.1, Receptance::load);
  const TimePair pair = testing::fourier_pair(63, 256);
  CondensedProblem of_matrices(pair, oscillator, testing::cosine_load());
  CondensedProblem of_receptance(pair, oscillator, testing::cosine_load(),
                                 std::make_unique<Receptance>(pair));
  const testing::LinearContact stop{10.0, 0.1};
  for (const double frequency : {0.12, 0.2, 0.3}) {
    of_matrices.set_frequency(frequency);
    of_receptance.set_frequency(frequency);
    const PeriodicResponse expected = testing::solved_response(of_matrices, stop);
    const PeriodicResponse response = testing::solved_response(of_receptance, stop);
    EXPECT_LE((response.displacement - expected.displacement).norm(), 1e-10 * expected.displacement.norm());
    EXPECT_LE((of_receptance.full_coefficients(response.contact_force) -
               of_matrices.full_coefficients(expected.contact_force))
                  .norm(),
              1e-10 * expected.coefficients.norm());
    Eigen::VectorXd slope, expected_slope;
    of_matrices.apply_slope(expected.contact_force, expected_slope);
    of_receptance.apply_slope(expected.contact_force, slope);
    EXPECT_LE((slope - expected_slope).norm(), 1e-10 * expected_slope.norm());
  }
}

TEST(HarmonicCompliance, ThatIsNoObjectIsRefused) {
  EXPECT_THROW(CondensedProblem(testing::fourier_pair(7, 16), testing::unit_oscillator(0.1, 1.0),
                                testing::cosine_load(), std::unique_ptr<HarmonicCompliance>()),
               std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
