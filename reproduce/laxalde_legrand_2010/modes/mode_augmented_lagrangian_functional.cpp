#include "mode_augmented_lagrangian_functional.hpp"

#include <cmath>
#include <numbers>

#include "linalg/dense.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::ll10 {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::MatrixXd sampled_waves(const FourierLayout& layout, int samples) {
  solvers::detail::require_at_least("ModeLagrangian", "samples", samples, 2 * layout.harmonics);
  Eigen::MatrixXd waves(samples, layout.blocks());
  for (int block = 0; block < layout.blocks(); ++block)
    for (int k = 0; k < samples; ++k) {
      const double phase = 2.0 * std::numbers::pi * ((layout.harmonic(block) * k) % samples) / samples;
      waves(k, block) = layout.is_sine(block) ? std::sin(phase) : std::cos(phase);
    }
  return waves;
}

const ModalModel& validated(const ModalModel& model) {
  model.validate();
  return model;
}

Eigen::MatrixXd identity(const ModalModel& model) {
  return Eigen::MatrixXd::Identity(model.modes(), model.modes());
}

}  // namespace

ModeLagrangian::ModeLagrangian(const ModalModel& model, FourierLayout layout, int samples,
                               ModeFormulation formulation)
    : quotient_(validated(model).omega_squared.asDiagonal(), identity(model), layout),
      norm_(identity(model), layout.factors(formulation == ModeFormulation::published ? 0 : 2)),
      shapes_(model.contact_shapes),
      gaps_(model.gaps),
      waves_(sampled_waves(layout, samples)) {}

Eigen::VectorXd ModeLagrangian::gap_function(const Eigen::VectorXd& x) const {
  const Eigen::Map<const Eigen::MatrixXd> blocks(x.data(), shapes_.cols(), waves_.cols());
  Eigen::VectorXd g(constraints());
  Eigen::Map<RowMajor>(g.data(), gaps_.size(), samples()) =
      solvers::detail::product_transposed(solvers::detail::product(shapes_, blocks), waves_).colwise() -
      gaps_;
  return g;
}

Eigen::VectorXd ModeLagrangian::generalised_force(const Eigen::VectorXd& force) const {
  const Eigen::Map<const RowMajor> samples_of(force.data(), gaps_.size(), samples());
  Eigen::VectorXd result(unknowns());
  Eigen::Map<Eigen::MatrixXd>(result.data(), shapes_.cols(), waves_.cols()) =
      solvers::detail::transposed_product(shapes_, solvers::detail::product(samples_of, waves_)) /
      double(samples());
  return result;
}

Eigen::VectorXd ModeLagrangian::gradient(const Eigen::VectorXd& x, double gamma,
                                         const Multipliers& multipliers, std::optional<double> frozen) const {
  const Eigen::VectorXd elastic = quotient_.stiffness().apply(x), inertia = quotient_.mass().apply(x);
  const double m = x.dot(inertia), rho = frozen.value_or(x.dot(elastic) / m);
  const Eigen::VectorXd g = gap_function(x);
  Eigen::VectorXd force(g.size()), tangent(g.size());
  const auto count = static_cast<std::size_t>(g.size());
  multipliers.inequality_force({g.data(), count}, {force.data(), count}, {tangent.data(), count});
  const double pull = multipliers.equality_force(normalisation(x) - gamma);
  return 2.0 / m * (elastic - rho * inertia) + generalised_force(force) + pull * norm_.apply(x);
}

Eigen::MatrixXd ModeLagrangian::hessian(const Eigen::VectorXd& x, double gamma,
                                        const Multipliers& multipliers, std::optional<double> frozen) const {
  const Eigen::VectorXd inertia = quotient_.mass().apply(x), normal = norm_.apply(x);
  Eigen::MatrixXd result;
  if (frozen) {
    const double factor = 2.0 / x.dot(inertia);
    const Eigen::VectorXd slope = factor * (quotient_.stiffness().apply(x) - *frozen * inertia);
    result = -factor * slope * inertia.transpose();
    quotient_.stiffness().add_to(result, factor);
    quotient_.mass().add_to(result, -factor * *frozen);
  } else {
    result = quotient_.hessian(x);
  }
  const Eigen::VectorXd g = gap_function(x);
  Eigen::VectorXd force(g.size()), tangent(g.size());
  const auto count = static_cast<std::size_t>(g.size());
  multipliers.inequality_force({g.data(), count}, {force.data(), count}, {tangent.data(), count});
  add_contact(result, tangent);
  norm_.add_to(result, multipliers.equality_force(normalisation(x) - gamma));
  result.noalias() += multipliers.equality_penalty() * normal * normal.transpose();
  return result;
}

// (1/m) B_A^T kappa_A B_A over the active constraints A; a row of B is a wave times a shape, block by block.
void ModeLagrangian::add_contact(Eigen::MatrixXd& hessian, const Eigen::VectorXd& tangent) const {
  const Eigen::Index active = (tangent.array() > 0.0).count();
  Eigen::MatrixXd columns(unknowns(), active);
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < tangent.size(); ++i) {
    if (!(tangent[i] > 0.0)) continue;
    const double root = std::sqrt(tangent[i] / samples());
    Eigen::Map<Eigen::MatrixXd>(columns.col(column).data(), shapes_.cols(), waves_.cols()).noalias() =
        root * shapes_.row(i / samples()).transpose() * waves_.row(i % samples());
    ++column;
  }
  hessian += solvers::detail::product_transposed(columns, columns);
}

}  // namespace wavebalance::ll10
