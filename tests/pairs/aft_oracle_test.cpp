#include "pairs.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/spectral/aft.hpp"

// Harmonic balance in its classical form, with AFT for the contact force, against the condensed balance.
namespace wavebalance::pairs {
namespace {

// Real coefficients {mean, cos 1, sin 1, ..} of a motion with the complex coefficients c_n, n >= 0.
Eigen::VectorXd real_coefficients(const Eigen::VectorXcd& c) {
  Eigen::VectorXd real(2 * c.size() - 1);
  real[0] = c[0].real();
  for (Eigen::Index n = 1; n < c.size(); ++n)
    real.segment<2>(2 * n - 1) = 2.0 * Eigen::Vector2d(c[n].real(), -c[n].imag());
  return real;
}

class Balance {
 public:
  Balance(const Case& scene, int harmonics, int points)
      : structure_(scene.structure(5)),
        law_(scene.law()),
        omega_(2 * std::numbers::pi * scene.frequency_hz),
        aft_(harmonics, points) {
    const int functions = 2 * harmonics + 1;
    solvers::CondensedProblem problem(
        time_pair(table_2[0], functions,
                  options(table_2[0], functions, points, solvers::InnerProducts::quadrature)),
        structure_, cosine_load());
    problem.set_frequency(scene.frequency_hz);
    const solvers::PeriodicResponse response = solvers::forced_response(problem, law_, {});
    EXPECT_TRUE(response.converged());
    EXPECT_GT(response.contact_force.maxCoeff(), 0.0);
    // The translates of the Fourier basis have the Fourier coefficients 1/M.
    motion_ = problem.full_coefficients(response.contact_force) / functions;
    samples_ = response.displacement;
    force_ = response.contact_force;
  }

  void expect_equal_samples() {
    const Eigen::VectorXd tip = real_coefficients(motion_.row(motion_.rows() - 1));
    const spectral::AftForce force = aft_.force(tip, pointwise());
    EXPECT_LE((aft_.displacement(tip) - samples_).norm(), 1e-10 * samples_.norm());
    EXPECT_LE((force.samples - force_).norm(), 1e-7 * force_.norm());  // the law magnifies the displacement
  }

  // (-(n omega)^2 M + i n omega C + K) u_n + f_n e_tip = load_n, with f_n from AFT.
  void expect_equation_of_motion() {
    const Eigen::Index last = motion_.rows() - 1;
    const Eigen::VectorXd force = aft_.force(real_coefficients(motion_.row(last)), pointwise()).coefficients;
    Eigen::MatrixXd residual(motion_.rows(), 2 * motion_.cols() - 1);
    for (Eigen::Index i = 0; i <= last; ++i) {
      Eigen::VectorXcd balance(motion_.cols());
      for (Eigen::Index n = 0; n < motion_.cols(); ++n) {
        const std::complex<double> rate(0.0, static_cast<double>(n) * omega_);
        const Eigen::VectorXcd u = motion_.col(n);
        balance[n] = (structure_.stiffness * u + rate * (structure_.damping * u) +
                      rate * rate * (structure_.mass * u))[i];
      }
      residual.row(i) = real_coefficients(balance);
    }
    residual.row(last) += force;
    residual.col(1) -= structure_.load;
    EXPECT_LE(residual.norm(), 1e-7 * force.norm());
  }

 private:
  spectral::PointwiseLaw pointwise() const {
    return [this](std::span<const double> u, std::span<double> f) { law_.evaluate(u, f); };
  }

  solvers::LinearStructure structure_;
  solvers::AnyContactLaw law_;
  double omega_;
  spectral::Aft aft_;
  Eigen::MatrixXcd motion_;  // c_n of all degrees of freedom, n x (H + 1)
  Eigen::VectorXd samples_, force_;
};

struct Resolution {
  int harmonics, points;
};
constexpr Resolution resolutions[] = {{4, 64}, {7, 81}, {15, 256}, {31, 256}};

TEST(AftOracle, GivesTheForcesOfTheBalanceWhichFulfilTheEquationOfMotionOfEachHarmonic) {
  for (const Case& scene : cases)
    for (const auto& [harmonics, points] : resolutions) {
      SCOPED_TRACE(std::string(scene.name) + ", H " + std::to_string(harmonics));
      Balance balance(scene, harmonics, points);
      balance.expect_equal_samples();
      balance.expect_equation_of_motion();
    }
}

}  // namespace
}  // namespace wavebalance::pairs
