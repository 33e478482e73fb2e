#include "wavebalance/app/compose/compose.hpp"

#include <Eigen/Cholesky>
#include <bit>

#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/contact/catalogue.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/spectral/fourier_basis.hpp"
#include "wavebalance/wavelets/connection.hpp"
#include "wavebalance/wavelets/periodic_basis.hpp"

namespace wavebalance::app {
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

bool is_haar(const std::string& basis) { return basis == "haar" || basis == "daubechies2"; }

/// Opposite a Haar function, whose Fourier coefficient at the Nyquist harmonic is imaginary, only the sine
/// remains, and so it does at the middles of the intervals, about which the function is even. Without effect
/// where the Nyquist coefficient is dropped.
solvers::AnyTimeBasis basis_opposite(const std::string& name, const std::string& other, const Time& time) {
  const bool blind =
      is_haar(other) && (effective_inner_products(time) == InnerProducts::exact || time.sample_offset != 0.0);
  if (name == "fourier" && blind) return spectral::FourierBasis(time.functions, spectral::Nyquist::sine);
  return make_basis(name, time.functions);
}

/// At the middles the alternating B-spline has no product with the alternating Haar function, nor with any
/// force that is constant in each cell, as for Haar motions: the coefficient is zero.
bool has_no_nyquist_force(const Time& time) {
  return is_haar(time.trial) && time.weight == "bspline" && time.sample_offset != 0.0 &&
         effective_inner_products(time) == InnerProducts::quadrature;
}

/// Bases of a scene's pair, for both the verdict on the pair and the pair.
struct PairParts {
  solvers::AnyTimeBasis trial, weight;
  solvers::TimePairOptions options;
};

PairParts pair_parts(const Time& time) {
  solvers::TimePairOptions options;
  options.formulation = time.formulation;
  options.inner_products = effective_inner_products(time);
  options.quadrature_points = time.quadrature_points;
  options.sample_offset = time.sample_offset;
  options.nyquist = effective_nyquist(time);
  if (!is_wavelet(time.trial) || !is_wavelet(time.weight))
    return {basis_opposite(time.trial, time.weight, time), basis_opposite(time.weight, time.trial, time),
            std::move(options)};
  // A filter needs longer to compute than a pair of small bases: one for all.
  const wavelets::PeriodicBasis trial = wavelet_basis(time.trial, time.functions);
  const wavelets::PeriodicBasis weight =
      time.weight == time.trial ? trial : wavelet_basis(time.weight, time.functions);
  options.exact_column = [trial, weight](int derivative) {
    return wavelets::periodic_inner_products(trial, weight, derivative);
  };
  return {trial, weight, std::move(options)};
}

solvers::AnyContactLaw law_of(const std::string& law, const contact::LawValues& values) {
  return std::visit([](const auto& made) -> solvers::AnyContactLaw { return made; },
                    contact::law_entry(law).make(values));
}

solvers::ContactLaws laws_at(const Scene& scene, double frequency) {
  const std::vector<SceneContact> contacts = contacts_of(scene, frequency);
  const bool one = std::ranges::all_of(
      contacts, [&](const SceneContact& other) { return other.same_law(contacts.front()); });
  if (one && !has_friction(scene) && !names_coupled_rows(scene.contact))
    return contacts.empty() ? make_law(scene.contact) : law_of(contacts[0].law, contacts[0].values);
  std::vector<solvers::AnyContactLaw> laws;
  for (const SceneContact& contact : contacts)
    if (contact.place == 0) laws.push_back(law_of(contact.law, contact.values));
  return laws;
}

fem::EigenmodesResult all_modes(const Eigen::SparseMatrix<double>& stiffness,
                                const Eigen::SparseMatrix<double>& mass) {
  auto modes = fem::eigenmodes(stiffness, mass, static_cast<int>(mass.rows()));
  if (modes.status != fem::EigenmodesStatus::converged)
    throw std::runtime_error("make_modes: the eigenvalue solver did not find all linear modes");
  return modes;
}

/// Modes of a structure with massless degrees of freedom: modes of the others, with the former condensed,
/// and the deflections of the massless ones as springs.
StructureModes modes_beside_springs(const solvers::LinearStructure& structure, const std::vector<int>& moving,
                                    const std::vector<int>& massless) {
  constexpr double beyond = 1e10;  // omega^2 of springs over the largest of the others
  const Eigen::MatrixXd stiffness(structure.stiffness), mass(structure.mass);
  const Eigen::LLT<Eigen::MatrixXd> held(Eigen::MatrixXd(stiffness(massless, massless)));
  if (held.info() != Eigen::Success)
    throw std::runtime_error("make_modes: degrees of freedom without mass are not held by a stiffness");
  const Eigen::MatrixXd coupling = held.solve(Eigen::MatrixXd(stiffness(massless, moving)));
  const Eigen::MatrixXd condensed = stiffness(moving, moving) - stiffness(moving, massless) * coupling;
  const auto modes = all_modes(Eigen::MatrixXd(0.5 * (condensed + condensed.transpose())).sparseView(),
                               Eigen::MatrixXd(mass(moving, moving)).sparseView());
  const auto count = static_cast<Eigen::Index>(moving.size()),
             springs = static_cast<Eigen::Index>(massless.size());
  const double far = beyond * modes.omega.cwiseAbs2().maxCoeff();
  StructureModes result{{Eigen::VectorXd(count + springs), {}, {}, static_cast<int>(springs)},
                        Eigen::MatrixXd::Zero(count + springs, count + springs)};
  result.model.omega_squared << modes.omega.cwiseAbs2(), Eigen::VectorXd::Constant(springs, far);
  Eigen::MatrixXd at_massless(springs, count + springs);
  at_massless << -coupling * modes.shapes,
      std::sqrt(far) * Eigen::MatrixXd(held.matrixU().solve(Eigen::MatrixXd::Identity(springs, springs)));
  result.shapes(moving, Eigen::seqN(0, count)) = modes.shapes;
  result.shapes(massless, Eigen::all) = at_massless;
  return result;
}

/// Turns the modes from `begin` to `end` by the eigenvectors of G = (S Phi)^T S Phi, the largest first: the
/// modes of v = omega^2 (G + d) v in ascending order, for any d that makes G + d definite.
void turn(StructureModes& modes, Eigen::Index begin, Eigen::Index end) {
  const Eigen::Index count = end - begin;
  const Eigen::MatrixXd contacts = modes.model.contact_shapes.middleCols(begin, count);
  Eigen::MatrixXd squares = contacts.transpose() * contacts;
  const double largest = squares.trace();
  if (!(largest > 0.0)) return;
  squares.diagonal().array() += largest;
  Eigen::SparseMatrix<double> identity(count, count);
  identity.setIdentity();
  const auto found = fem::eigenmodes(identity, squares.sparseView(), static_cast<int>(count));
  if (found.status != fem::EigenmodesStatus::converged) return;
  const Eigen::MatrixXd turned = found.shapes * found.omega.cwiseInverse().asDiagonal();
  const Eigen::VectorXd frequencies = modes.model.omega_squared.segment(begin, count);
  modes.shapes.middleCols(begin, count) *= turned;
  modes.model.contact_shapes.middleCols(begin, count) = contacts * turned;
  modes.model.omega_squared.segment(begin, count) = turned.cwiseAbs2().transpose() * frequencies;
}

/// Turns modes of equal frequency into those combinations that move the contacts most, in descending order.
/// Their frequencies become the frequencies of the combinations, which differ by less than
/// equal_frequencies.
void separate_equal_modes(StructureModes& modes) {
  const Eigen::VectorXd omega = modes.model.omega_squared.cwiseSqrt();
  const Eigen::Index last = omega.size() - modes.model.springs;
  for (Eigen::Index begin = 0; begin < last;) {
    Eigen::Index end = begin + 1;
    while (end < last && omega[end] - omega[begin] <= equal_frequencies * omega[end]) ++end;
    if (end > begin + 1) turn(modes, begin, end);
    begin = end;
  }
}

}  // namespace

solvers::LinearStructure make_structure(const Scene& scene) { return make_model(scene).structure; }

solvers::AnyContactLaw make_law(const Contact& contact) {
  return law_of(contact.law, law_values(contact.law, contact.values, contact.gap));
}

solvers::ContactLaws make_laws(const Scene& scene) {
  if (!has_growing_normal_load(scene.contact)) return laws_at(scene, load_frequency(scene));
  Scene read = scene;
  read.contact = with_tables_read(scene.contact);
  return solvers::ContactLaws::over_frequency([read](double frequency) { return laws_at(read, frequency); },
                                              load_frequency(scene));
}

solvers::AnyTimeBasis make_basis(const std::string& name, int functions) {
  if (!is_wavelet(name)) return spectral::FourierBasis(functions);
  return wavelet_basis(name, functions);
}

InnerProducts effective_inner_products(const Time& time) {
  const bool daubechies_galerkin = time.trial == time.weight && daubechies_coefficients(time.trial) > 0;
  return daubechies_galerkin ? InnerProducts::exact : time.inner_products;
}

NyquistCoefficient effective_nyquist(const Time& time) {
  return has_no_nyquist_force(time) ? NyquistCoefficient::drop : time.nyquist;
}

solvers::Admissibility pair_admissibility(const Time& time) {
  const PairParts parts = pair_parts(time);
  return solvers::admissibility(parts.trial, parts.weight, parts.options.formulation,
                                parts.options.inner_products);
}

solvers::TimePair make_pair(const Time& time) {
  PairParts parts = pair_parts(time);
  return {std::move(parts.trial), std::move(parts.weight), std::move(parts.options)};
}

StructureModes make_modes(const StructureModel& model) {
  const solvers::LinearStructure& structure = model.structure;
  std::vector<int> moving, massless;
  for (int i = 0; i < structure.size(); ++i)
    (structure.mass.col(i).cwiseAbs().sum() > 0.0 ? moving : massless).push_back(i);
  StructureModes modes;
  if (massless.empty()) {
    auto found = all_modes(structure.stiffness, structure.mass);
    modes = {{found.omega.cwiseAbs2(), {}, {}}, std::move(found.shapes)};
  } else {
    modes = modes_beside_springs(structure, moving, massless);
  }
  modes.model.contact_shapes = structure.contact_directions * modes.shapes;
  modes.model.gaps = model.gaps;
  separate_equal_modes(modes);
  return modes;
}

solvers::NonlinearMode make_nonlinear_mode(const Scene& scene, const solvers::ModalModel& model) {
  solvers::NonlinearModeOptions options;
  options.mode = scene.analysis.mode;
  options.harmonics = scene.analysis.harmonics;
  options.samples = scene.analysis.samples;
  options.cosine_only = scene.analysis.cosine_only;
  return {model, options};
}

solvers::ContactProblem compose_problem(const Scene& scene, const StructureModel& model) {
  return {make_problem(scene, model), make_laws(scene), model.dynamics};
}

solvers::CondensedProblem make_problem(const Scene& scene) { return make_problem(scene, make_model(scene)); }

solvers::CondensedProblem make_problem(const Scene& scene, const StructureModel& model) {
  const int periods = scene.analysis.subharmonic;
  Eigen::VectorXcd cosine = Eigen::VectorXcd::Zero(periods + 1);
  cosine[periods] = 1.0;
  solvers::CondensedProblem problem(make_pair(scene.time), model.structure, std::move(cosine));
  problem.set_threads(model.threads);
  problem.set_periods(periods);
  if (is_over_amplitude(scene.analysis))
    if (const auto load = reference_load(scene.forcing))
      problem.set_load_unit(std::abs(load->amplitude), std::string(load->unit));
  if (scene.forcing.frequency > 0.0) problem.set_load_frequency(scene.forcing.frequency);
  return problem;
}

}  // namespace wavebalance::app
