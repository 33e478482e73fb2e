#include "modes/mode_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "modes/elastic_point.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

bool contains(const std::vector<int>& sorted, int value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

}  // namespace

ModeSolver::ModeSolver(const NonlinearMode& mode, double omega)
    : mode_(mode),
      omega_(omega),
      samples_(mode.options().samples),
      unknowns_(mode.model().contacts() * mode.options().samples) {}

std::vector<int> ModeSolver::time_mirror(int index) const {
  const int time = index % samples_;
  const int mirrored = time == 0 ? 0 : samples_ - time;
  if (!mode_.options().cosine_only || mirrored == time) return {index};
  return {index, index - time + mirrored};
}

// lags_[d] = (1/m) sum_{n=-N..N} H_n cos(2 pi n d / m), H_n = S (K - n^2 omega^2 M)^-1 S^T in modal form.
void ModeSolver::assemble_lags(int harmonics) {
  const ModalModel& model = mode_.model();
  lags_.assign(static_cast<std::size_t>(samples_), Eigen::MatrixXd::Zero(model.contacts(), model.contacts()));
  for (int n = 0; n <= harmonics; ++n) {
    const double squared = n * omega_ * (n * omega_);
    const Eigen::VectorXd gain = (model.omega_squared.array() - squared).inverse();
    const Eigen::MatrixXd compliance =
        detail::product_transposed(model.contact_shapes * gain.asDiagonal(), model.contact_shapes);
    const double weight = (n == 0 ? 1.0 : 2.0) / samples_;
    for (int d = 0; d < samples_; ++d)
      lags_[static_cast<std::size_t>(d)] +=
          weight * std::cos(two_pi * ((n * d) % samples_) / samples_) * compliance;
  }
}

double ModeSolver::compliance(int a, int b) const {
  const int lag = (a % samples_ - b % samples_ + samples_) % samples_;
  return lags_[static_cast<std::size_t>(lag)](a / samples_, b / samples_);
}

// Solves G_AA force_A = -gap, with one unknown per sample and its time mirror; false when singular.
bool ModeSolver::solve_forces(const std::vector<int>& active, Eigen::VectorXd& force) {
  std::vector<int> representatives;
  for (const int index : active)
    if (time_mirror(index).size() == 1 || index % samples_ <= samples_ / 2) representatives.push_back(index);
  const auto count = Index(representatives.size());
  Eigen::MatrixXd matrix(count, count);
  Eigen::VectorXd right(count);
  for (Index i = 0; i < count; ++i) {
    const int row = representatives[static_cast<std::size_t>(i)];
    right[i] = -mode_.model().gaps[row / samples_];
    for (Index j = 0; j < count; ++j) {
      matrix(i, j) = 0.0;
      for (const int column : time_mirror(representatives[static_cast<std::size_t>(j)]))
        matrix(i, j) += compliance(row, column);
    }
  }
  const detail::Lu<double> lu(matrix);
  const Eigen::VectorXd values = lu.solve(right);
  force.setZero(unknowns_);
  for (Index i = 0; i < count; ++i)
    for (const int index : time_mirror(representatives[static_cast<std::size_t>(i)]))
      force[index] = values[i];
  constexpr double tiny = 1e-13;
  return values.allFinite() && !lu.is_singular(tiny);
}

// Violation of a sample's condition, relative to its gap or to the largest force; not positive if it holds.
double ModeSolver::violation(int index, const Eigen::VectorXd& force, const std::vector<int>& active) const {
  if (contains(active, index)) return -force[index] / force.cwiseAbs().maxCoeff();
  const double gap = mode_.model().gaps[index / samples_];
  double displacement = 0.0;
  for (const int other : active) displacement -= compliance(index, other) * force[other];
  return displacement / gap - 1.0 - mode_.options().tolerance;
}

std::vector<int> ModeSolver::exchanges(const std::vector<int>& active, const Eigen::VectorXd& force,
                                       bool worst_only) const {
  std::vector<int> all;
  double worst = 0.0;
  std::vector<int> worst_mirror;
  for (int index = 0; index < unknowns_; ++index) {
    const double value = violation(index, force, active);
    if (!(value > 0.0)) continue;
    all.push_back(index);
    if (value > worst) {
      worst = value;
      worst_mirror = time_mirror(index);
    }
  }
  return worst_only ? worst_mirror : all;
}

ModePoint ModeSolver::solve(int harmonics, const std::vector<int>& start) {
  assemble_lags(harmonics);
  ModePoint point;
  point.omega = omega_;
  point.active = start;
  std::sort(point.active.begin(), point.active.end());
  std::set<std::vector<int>> seen;
  bool worst_only = false;
  Eigen::VectorXd force;
  for (; point.iterations < mode_.options().max_iterations; ++point.iterations) {
    if (point.active.empty()) return point;  // no_contact
    if (!solve_forces(point.active, force)) {
      point.status = ModeStatus::singular;
      return point;
    }
    const std::vector<int> exchanged = exchanges(point.active, force, worst_only);
    if (exchanged.empty()) {
      finish(point, harmonics, force);
      return point;
    }
    if (!seen.insert(point.active).second) {
      if (worst_only) break;
      worst_only = true;
      seen.clear();
    }
    std::vector<int> next;
    std::set_symmetric_difference(point.active.begin(), point.active.end(), exchanged.begin(),
                                  exchanged.end(), std::back_inserter(next));
    point.active = std::move(next);
  }
  point.status = ModeStatus::cycling;
  return point;
}

void ModeSolver::finish(ModePoint& point, int harmonics, const Eigen::VectorXd& force) const {
  const ModalModel& model = mode_.model();
  point.force = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      force.data(), model.contacts(), samples_);
  point.amplitudes = Eigen::MatrixXcd::Zero(model.modes(), harmonics + 1);
  for (int n = 0; n <= harmonics; ++n) {
    Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(model.contacts());
    for (int k = 0; k < samples_; ++k)
      spectrum += point.force.col(k) * std::polar(1.0 / samples_, -two_pi * ((n * k) % samples_) / samples_);
    const double squared = n * omega_ * (n * omega_);
    point.amplitudes.col(n) =
        -(model.contact_shapes.transpose() * spectrum)
             .cwiseQuotient((model.omega_squared.array() - squared).matrix().cast<std::complex<double>>());
  }
  point.status = ModeStatus::converged;
  measure_energy(point);
  measure_complementarity(point);
  classify_resonance(point);
}

// m = sum n^2 |q_n|^2 over n = -N..N, k likewise with omega_j^2; <force> gap / m closes the balance.
void ModeSolver::measure_energy(ModePoint& point) const {
  const ModalModel& model = mode_.model();
  double mass = 0.0, stiffness = 0.0;
  for (Index n = 0; n < point.amplitudes.cols(); ++n) {
    const Eigen::VectorXd squares = point.amplitudes.col(n).cwiseAbs2();
    const double both = n == 0 ? 1.0 : 2.0;
    mass += both * double(n * n) * squares.sum();
    stiffness += both * model.omega_squared.dot(squares);
  }
  point.energy_ratio = 0.5 * mass / mode_.grazing_energy();
  point.rayleigh = stiffness / mass;
  const double virial = model.gaps.dot(point.force.rowwise().mean());
  point.virial_residual = std::abs(omega_ * omega_ - point.rayleigh - virial / mass) / (omega_ * omega_);
}

void ModeSolver::measure_complementarity(ModePoint& point) const {
  constexpr int fine = 16;
  Eigen::MatrixXcd contact(mode_.model().contacts(), point.amplitudes.cols());
  contact.real() = detail::product(mode_.model().contact_shapes, point.amplitudes.real());
  contact.imag() = detail::product(mode_.model().contact_shapes, point.amplitudes.imag());
  point.max_penetration = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < fine * samples_; ++k) {
    Eigen::VectorXd displacement = contact.col(0).real();
    for (Index n = 1; n < contact.cols(); ++n)
      displacement +=
          2.0 * (contact.col(n) * std::polar(1.0, two_pi * double(n) * k / (fine * samples_))).real();
    const double excess = (displacement.cwiseQuotient(mode_.model().gaps).array() - 1.0).maxCoeff();
    point.max_penetration = std::max(point.max_penetration, excess);
  }
  point.min_force = point.force.minCoeff();
  const Eigen::VectorXd largest = point.force.colwise().maxCoeff();
  point.contact_fraction = (largest.array() > 0.0).cast<double>().mean();
}

void ModeSolver::classify_resonance(ModePoint& point) const {
  Eigen::MatrixXd kinetic = point.amplitudes.cwiseAbs2();
  for (Index n = 0; n < kinetic.cols(); ++n) kinetic.col(n) *= double(n * n);
  point.resonance = strongest_resonance(kinetic);
  if (is_resonant(point.resonance, mode_.model(), point.resonance.harmonic * omega_))
    point.status = ModeStatus::internal_resonance;
}

}  // namespace wavebalance::solvers
