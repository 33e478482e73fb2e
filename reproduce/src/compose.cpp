#include "wavebalance/reproduce/compose.hpp"

#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "wavebalance/contact/exponential_law.hpp"
#include "wavebalance/contact/linear_law.hpp"
#include "wavebalance/contact/no_contact.hpp"
#include "wavebalance/fem/bar.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/spectral/fourier_basis.hpp"
#include "wavebalance/wavelets/connection.hpp"
#include "wavebalance/wavelets/periodic_basis.hpp"

namespace wavebalance::reproduce {
namespace {

wavelets::PeriodicBasis wavelet_basis(const std::string& name, int functions) {
  if (functions < 1 || !std::has_single_bit(static_cast<unsigned>(functions)))
    throw std::invalid_argument("functions is " + std::to_string(functions) + "; with the basis \"" + name +
                                "\" it must be a power of two");
  const int level = std::countr_zero(static_cast<unsigned>(functions));
  if (name == "haar") return {wavelets::ScalingFunction::haar(), level};
  if (name == "bspline") return {wavelets::ScalingFunction::orthonormal_bspline(), level};
  return {wavelets::ScalingFunction::daubechies(daubechies_coefficients(name)), level};
}

solvers::Formulation solver_value(Formulation formulation) {
  switch (formulation) {
    case Formulation::strong:
      return solvers::Formulation::strong;
    case Formulation::weak:
      return solvers::Formulation::weak;
    case Formulation::distributional:
      break;
  }
  return solvers::Formulation::distributional;
}

solvers::InnerProducts solver_value(InnerProducts products) {
  return products == InnerProducts::exact ? solvers::InnerProducts::exact
                                          : solvers::InnerProducts::quadrature;
}

/// The tip's row of the consistent or lumped mass goes to its neighbour, where it acts as one rigid piece.
void move_tip_mass(Eigen::SparseMatrix<double>& mass) {
  const Eigen::Index tip = mass.rows() - 1;
  const double moved = mass.coeff(tip, tip) + 2.0 * mass.coeff(tip, tip - 1);
  mass.coeffRef(tip - 1, tip - 1) += moved;
  for (const auto& [row, column] : {std::pair{tip, tip}, {tip, tip - 1}, {tip - 1, tip}})
    mass.coeffRef(row, column) = 0.0;
  mass.prune(0.0);
}

bool is_haar(const std::string& basis) { return basis == "haar" || basis == "daubechies2"; }

/// Opposite a Haar function, whose Fourier coefficient at the Nyquist harmonic is imaginary, only the sine
/// remains.
solvers::AnyTimeBasis basis_opposite(const std::string& name, const std::string& other, const Time& time) {
  const bool blind = is_haar(other) && effective_inner_products(time) == InnerProducts::exact;
  if (name == "fourier" && blind) return spectral::FourierBasis(time.functions, spectral::Nyquist::sine);
  return make_basis(name, time.functions);
}

}  // namespace

solvers::LinearStructure make_structure(const Scene& scene) {
  const Structure& bar = scene.structure;
  fem::Matrices matrices = fem::bar({.youngs_modulus = bar.youngs_modulus,
                                     .density = bar.density,
                                     .area = bar.area,
                                     .length = bar.length,
                                     .elements = bar.elements,
                                     .stiffness_damping = bar.stiffness_damping,
                                     .lumped_fraction = bar.lumped_mass_fraction});
  if (bar.massless_tip) move_tip_mass(matrices.mass);
  solvers::LinearStructure structure;
  structure.mass = std::move(matrices.mass);
  structure.damping = std::move(matrices.damping);
  structure.stiffness = std::move(matrices.stiffness);
  structure.contact_dof = bar.elements - 1;
  structure.load = Eigen::VectorXd::Zero(bar.elements);
  structure.load[structure.contact_dof] = scene.forcing.amplitude;
  return structure;
}

solvers::AnyContactLaw make_law(const Contact& contact) {
  switch (contact.law) {
    case ContactLawType::exponential:
      return contact::ExponentialLaw(contact.constant, contact.exponent, contact.gap);
    case ContactLawType::linear:
      return contact::LinearLaw(contact.stiffness, contact.gap);
    case ContactLawType::rigid:
      throw std::invalid_argument("make_law: rigid contact has no force as a function of the displacement");
    case ContactLawType::none:
      break;
  }
  return contact::NoContact();
}

solvers::AnyTimeBasis make_basis(const std::string& name, int functions) {
  if (!is_wavelet(name)) return spectral::FourierBasis(functions);
  return wavelet_basis(name, functions);
}

InnerProducts effective_inner_products(const Time& time) {
  const bool daubechies_galerkin = time.trial == time.weight && daubechies_coefficients(time.trial) > 0;
  return daubechies_galerkin ? InnerProducts::exact : time.inner_products;
}

solvers::Admissibility pair_admissibility(const Time& time) {
  return solvers::admissibility(basis_opposite(time.trial, time.weight, time),
                                basis_opposite(time.weight, time.trial, time), solver_value(time.formulation),
                                solver_value(effective_inner_products(time)));
}

solvers::TimePair make_pair(const Time& time) {
  solvers::TimePairOptions options;
  options.formulation = solver_value(time.formulation);
  options.inner_products = solver_value(effective_inner_products(time));
  options.quadrature_points = time.quadrature_points;
  if (is_wavelet(time.trial) && is_wavelet(time.weight))
    options.exact_column = [time](int derivative) {
      return wavelets::periodic_inner_products(wavelet_basis(time.trial, time.functions),
                                               wavelet_basis(time.weight, time.functions), derivative);
    };
  return {basis_opposite(time.trial, time.weight, time), basis_opposite(time.weight, time.trial, time),
          std::move(options)};
}

StructureModes make_modes(const Scene& scene) {
  const solvers::LinearStructure structure = make_structure(scene);
  auto modes = fem::eigenmodes(structure.stiffness, structure.mass, structure.size());
  if (modes.status != fem::EigenmodesStatus::converged)
    throw std::runtime_error("make_modes: the eigenvalue solver did not find all linear modes");
  return {{modes.omega.cwiseAbs2(), modes.shapes.row(structure.contact_dof),
           Eigen::VectorXd::Constant(1, scene.contact.gap)},
          modes.shapes};
}

solvers::NonlinearMode make_nonlinear_mode(const Scene& scene, const solvers::ModalModel& model) {
  solvers::NonlinearModeOptions options;
  options.mode = scene.analysis.mode;
  options.harmonics = scene.analysis.harmonics;
  options.samples = scene.analysis.samples;
  options.cosine_only = scene.analysis.cosine_only;
  return {model, options};
}

solvers::CondensedProblem make_problem(const Scene& scene) {
  Eigen::VectorXcd cosine(2);
  cosine << 0.0, 1.0;
  solvers::CondensedProblem problem(make_pair(scene.time), make_structure(scene), std::move(cosine));
  if (scene.forcing.frequency > 0.0) problem.set_frequency(scene.forcing.frequency);
  return problem;
}

}  // namespace wavebalance::reproduce
