#include "wavebalance/solvers/collocation/exact_structure_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "balance/free_contacts.hpp"
#include "collocation/exact_solution_parts.hpp"
#include "linalg/option_checks.hpp"
#include "wavebalance/solvers/structure/condensation.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers {
namespace {

constexpr std::complex<double> imaginary_unit(0.0, 1.0);

// Sums of harmonics, Re(a_n exp(2 pi i n t)), at uniform times, of which those that agree there are one.
class FoldedSpectrum {
 public:
  FoldedSpectrum(Eigen::Index rows, int points)
      : points_(points), values_(Eigen::MatrixXcd::Zero(rows, points / 2 + 1)) {}

  void add(int harmonic, const Eigen::VectorXcd& amplitudes) {
    const int k = harmonic % points_;
    if (k == 0 || 2 * k == points_)
      values_.col(k).real() += amplitudes.real();
    else if (2 * k < points_)
      values_.col(k) += 0.5 * amplitudes;
    else
      values_.col(points_ - k) += 0.5 * amplitudes.conjugate();
  }

  // rows x points.
  Eigen::MatrixXd samples() const {
    spectral::RealFft fft(points_);
    Eigen::MatrixXd result(values_.rows(), points_);
    Eigen::VectorXcd spectrum;
    Eigen::VectorXd row(points_);
    for (Eigen::Index r = 0; r < values_.rows(); ++r) {
      spectrum = values_.row(r).transpose();
      fft.inverse(std::span<const std::complex<double>>(spectrum.data(), std::size_t(spectrum.size())),
                  std::span<double>(row.data(), std::size_t(row.size())));
      result.row(r) = row.transpose();
    }
    return result;
  }

 private:
  int points_;
  Eigen::MatrixXcd values_;
};

double distance_to_contacts(const Eigen::MatrixXd& values, const Eigen::MatrixXd& exact) {
  const double size = exact.norm(), distance = (values - exact).norm();
  return size > 0.0 ? distance / size : distance;
}

// The amplitudes of all degrees of freedom at one harmonic after the other.
class Harmonics {
 public:
  Harmonics(const CondensedProblem& problem, const ExactSolution& motion)
      : motion_(motion),
        rate_(2.0 * std::numbers::pi * problem.frequency() * imaginary_unit),
        repeats_(load_periods(problem)),
        loads_(problem.structure().load_series(problem.load_harmonics(), repeats_, problem.frequency(),
                                               problem.load_factor())),
        structure_(detail::held_by_springs(problem.structure(), motion.parts->model.holding)),
        condensation_(structure_) {
    if (const auto held = detail::held_at_rest(problem.structure(), motion.parts->model.holding))
      at_rest_.emplace(*held);
  }

  const LinearStructure& structure() const { return structure_; }
  std::complex<double> rate(int harmonic) const { return rate_ * double(harmonic); }

  // Those from the number taken before up to `count` - 1.
  template <class Take>
  void take_up_to(int count, const Take& take) {
    const Eigen::MatrixXcd forces = motion_.force_harmonics(count);
    for (; taken_ < count; ++taken_) {
      const std::complex<double> s = rate(taken_);
      Condensation& used = taken_ == 0 && at_rest_ ? *at_rest_ : condensation_;
      take(taken_, used.recover({s * s, s, 1.0}, loads_at(taken_), forces.col(taken_)));
    }
  }

 private:
  Eigen::VectorXcd loads_at(int harmonic) const {
    const bool loaded = harmonic % repeats_ == 0 && harmonic / repeats_ < loads_.cols();
    if (!loaded) return Eigen::VectorXcd::Zero(loads_.rows());
    return loads_.col(harmonic / repeats_);
  }

  const ExactSolution& motion_;
  std::complex<double> rate_;
  int repeats_, taken_ = 0;
  Eigen::MatrixXcd loads_;
  LinearStructure structure_;
  Condensation condensation_;
  std::optional<Condensation> at_rest_;
};

}  // namespace

// Panel by panel, since exp(-2 pi i n t) with t = begin + (x + 1) length / 2 has the integrals over
// Legendre polynomials of ExponentialIntegrals at x = 1, with the other sign of the exponent and x from the
// end on.
Eigen::MatrixXcd ExactSolution::force_harmonics(int count) const {
  if (parts == nullptr) throw std::invalid_argument("ExactSolution::force_harmonics: there is no motion");
  detail::require_at_least("ExactSolution::force_harmonics", "count", count, 1);
  const detail::PanelForces& forces = parts->iterate.forces;
  const Eigen::MatrixXd& coefficients = forces.coefficients();
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(parts->model.response.contacts(), count);
  detail::ExponentialIntegrals<std::complex<double>> integrals(Eigen::VectorXd::Ones(1), coefficients.rows());
  const auto& panels = forces.panels();
  for (std::size_t p = 0, next = 0; p < panels.size(); p = next) {
    const detail::Panel& panel = panels[p];  // and panels of other contacts over the same time
    while (next < panels.size() && panels[next].begin == panel.begin && panels[next].end == panel.end) ++next;
    const Eigen::MatrixXd force = coefficients.middleCols(Eigen::Index(p), Eigen::Index(next - p));
    for (int n = 0; n < count; ++n) {
      const double turns = 2.0 * std::numbers::pi * double(n);
      integrals.compute(std::complex<double>(0.0, 0.5 * turns * panel.length()));
      const Eigen::RowVectorXcd at_end = integrals.values().row(0) * force;
      // Integrals of exp(z (1 - s)) P_k(s): the phase counts from the end of the panel back.
      const double weight = n == 0 ? 0.5 : 1.0;
      const std::complex<double> factor =
          weight * panel.length() * std::exp(-imaginary_unit * turns * panel.end);
      for (std::size_t k = p; k < next; ++k)
        result(panels[k].contact, n) += factor * at_end[Eigen::Index(k - p)];
    }
  }
  for (const Impact& one : impacts)
    for (int n = 0; n < count; ++n)
      result(one.contact, n) += (n == 0 ? 1.0 : 2.0) * one.impulse * parts->model.frequency *
                                std::polar(1.0, -2.0 * std::numbers::pi * double(n) * one.time);
  return result;
}

void ExactStructureOptions::validate() const {
  detail::require_positive("exact_structure_motion", "tolerance", tolerance);
  detail::require_at_least("exact_structure_motion", "first_harmonics", first_harmonics, 1);
  detail::require_at_least("exact_structure_motion", "max_harmonics", max_harmonics, first_harmonics);
}

ExactStructureMotion exact_structure_motion(const CondensedProblem& problem, const ExactSolution& motion,
                                            int points, const ExactStructureOptions& options) {
  constexpr int least_points = 256;  // at which contacts are compared
  if (motion.parts == nullptr) throw std::invalid_argument("exact_structure_motion: there is no motion");
  options.validate();
  detail::require_at_least("exact_structure_motion", "points", points, 1);
  Harmonics harmonics(problem, motion);
  const ContactDirections& directions = problem.structure().contact_directions;
  FoldedSpectrum displacement(problem.structure().size(), points),
      velocity(problem.structure().size(), points), contacts(directions.rows(), least_points);
  const Eigen::MatrixXd exact =
      motion.displacement(Eigen::VectorXd::LinSpaced(least_points, 0.0, 1.0 - 1.0 / least_points));
  ExactStructureMotion result;
  for (int count = options.first_harmonics;; count = std::min(2 * count, options.max_harmonics)) {
    harmonics.take_up_to(count, [&](int n, const Eigen::VectorXcd& amplitudes) {
      displacement.add(n, amplitudes);
      velocity.add(n, harmonics.rate(n) * amplitudes);
      contacts.add(n, directions * amplitudes);
    });
    result.harmonics = count;
    result.left_out = distance_to_contacts(contacts.samples(), exact);
    if (result.left_out <= options.tolerance || count == options.max_harmonics) break;
  }
  result.motion.displacement = displacement.samples();
  result.motion.velocity = velocity.samples();
  return result;
}

}  // namespace wavebalance::solvers
