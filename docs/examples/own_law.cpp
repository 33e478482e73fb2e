// A frequency sweep with stability of two masses, of which the second meets a rubber stop with a custom
// law.
#include <wavebalance/solvers/response/frequency_sweep.hpp>
#include <wavebalance/solvers/stability/curve_stability.hpp>
#include <wavebalance/spectral/fourier_basis.hpp>

#include <cstdio>
#include <string>

using namespace wavebalance;

struct RubberStop {  // f = k d^2 for the penetration d = u - gap
  double force(double u) const { return u > gap() ? k * (u - gap()) * (u - gap()) : 0.0; }     // N
  double tangent(double u) const { return u > gap() ? 2.0 * k * (u - gap()) : 0.0; }           // N/m
  double potential(double u) const { return u > gap() ? force(u) * (u - gap()) / 3.0 : 0.0; }  // J
  double gap() const { return 1e-3; }                                                          // m
  double k = 3e8;                                                                              // N/m^2
};

int main() {
  const Eigen::Matrix2d mass{{1.0, 0.0}, {0.0, 0.5}}, stiffness{{5e5, -2e5}, {-2e5, 2e5}};  // kg, N/m
  const solvers::LinearStructure masses{mass.sparseView(), 1e-5 * stiffness.sparseView(),
                                        stiffness.sparseView(),
                                        Eigen::Vector2d(0.0, 40.0),      // 40 N at the second mass,
                                        solvers::contact_rows({1}, 2)};  // which touches
  const spectral::FourierBasis harmonics(63);                            // mean and 31 harmonics
  solvers::CondensedProblem problem({harmonics, harmonics, {}}, masses, Eigen::Vector2cd(0.0, 1.0));

  solvers::FrequencySweepOptions options{.from = 60.0, .to = 110.0};  // Hz
  options.keep_unknowns = true;
  const auto curve = solvers::frequency_sweep(problem, RubberStop{}, options);
  const solvers::ContactDynamics dynamics(masses);
  const auto stability = solvers::curve_stability(problem, RubberStop{}, curve, dynamics);
  std::printf("%s, %zu points\n", std::string(to_string(curve.status)).c_str(), curve.points.size());
  for (const auto& point : stability.special_points)
    std::printf("%-16s at %8.3f Hz, largest displacement %.3f mm\n",
                std::string(to_string(point.type)).c_str(), point.frequency, 1e3 * point.max_displacement);
  return curve.status == solvers::SweepStatus::reached_end ? 0 : 1;
}
