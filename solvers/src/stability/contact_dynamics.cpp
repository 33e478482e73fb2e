#include "wavebalance/solvers/stability/contact_dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"
#include "stability/contact_dynamics_reduced.hpp"
#include "structure/held_structure.hpp"
#include "structure/modal_form.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
constexpr double eps = std::numeric_limits<double>::epsilon();

// Entries that are rounding of the largest, as zeros.
Eigen::VectorXd without_rounding(const Eigen::VectorXd& values) {
  const double least = 4.0 * eps * double(values.size()) * values.cwiseAbs().maxCoeff();
  return (values.array().abs() > least).select(values, 0.0);
}

// Contribution of the modes to the compliance of the contacts.
struct Parts {
  Eigen::MatrixXd constant;
  std::vector<ContactPole> poles;
  std::vector<ContactDynamics::Section> sections;
};

// Modes of the quadratic eigenvalue problem with Im exponent >= 0: exponents lambda, x in the columns of
// `shapes` and, without symmetry, y in the columns of `left`, such that (s^2 M + s C + K)^-1 is the sum of
// x y^T / (s
// - lambda) and of its conjugate where Im lambda > 0.
struct ComplexModes {
  Eigen::VectorXcd exponents;
  Eigen::MatrixXcd shapes, left;  // n x modes
};

struct FirstOrderForm {
  Eigen::MatrixXd matrix;  // 2n x 2n
  bool inverse;            // its eigenvalues are the reciprocals of the exponents
  detail::Lu<double> metric;
};

// By the inverse where K is definite, so that the lowest modes are the accurate ones, and without symmetry
// where it is regular.
FirstOrderForm first_order_form(const LinearStructure& structure) {
  const Eigen::MatrixXd mass(structure.mass), damping(structure.damping), stiffness(structure.stiffness);
  const Index n = mass.rows();
  const double least = structure.symmetric() ? 1e-14 : 1e-12;
  const bool inverse = !detail::Lu<double>(stiffness).is_singular(least) &&
                       (!structure.symmetric() || detail::cholesky(stiffness).has_value());
  FirstOrderForm form{Eigen::MatrixXd::Zero(2 * n, 2 * n), inverse,
                      detail::Lu<double>(inverse ? stiffness : mass)};
  if (form.metric.is_singular(1e-14))
    throw std::invalid_argument(
        "ContactDynamics: neither mass nor stiffness is positive definite; one of them must be");
  if (inverse) {
    form.matrix.topLeftCorner(n, n) = -form.metric.solve(damping);
    form.matrix.topRightCorner(n, n) = -form.metric.solve(mass);
    form.matrix.bottomLeftCorner(n, n).setIdentity();
  } else {
    form.matrix.topRightCorner(n, n).setIdentity();
    form.matrix.bottomLeftCorner(n, n) = -form.metric.solve(stiffness);
    form.matrix.bottomRightCorner(n, n) = -form.metric.solve(damping);
  }
  return form;
}

// The columns y, by the rows w of the inverse of all eigenvectors: y^T is the part of w^T that belongs to
// the accelerations times M^-1 or, for the inverse form, the part of the first rows times -K^-1.
Eigen::MatrixXcd left_modes(const FirstOrderForm& form, const Eigen::MatrixXcd& vectors) {
  const Index n = vectors.rows() / 2;
  const Eigen::MatrixXcd identity = Eigen::MatrixXcd::Identity(2 * n, 2 * n);
  const Eigen::MatrixXcd rows = detail::Lu<Complex>(vectors).solve(identity).transpose();
  const Eigen::MatrixXcd part = form.inverse ? rows.topRows(n) : rows.bottomRows(n);
  const Eigen::MatrixXd real = form.metric.solve_transposed(part.real()),
                        imaginary = form.metric.solve_transposed(part.imag());
  return (form.inverse ? -1.0 : 1.0) * (real + Complex(0.0, 1.0) * imaginary);
}

// Whether two exponents are so near to each other that rounding chooses their modes among all combinations.
bool has_equal(const Eigen::VectorXcd& exponents) {
  constexpr double near = 1e-5;
  for (Index i = 0; i < exponents.size(); ++i)
    for (Index j = 0; j < i; ++j)
      if (std::abs(exponents[i] - exponents[j]) <= near * std::abs(exponents[i])) return true;
  return false;
}

// Modes of one exponent, as an isotropic rotor has, are no left modes of each other.
ComplexModes complex_modes(const LinearStructure& structure) {
  const Index n = structure.size();
  const FirstOrderForm form = first_order_form(structure);
  const auto eigen = detail::general_eigen(form.matrix);
  if (!eigen) throw std::invalid_argument("ContactDynamics: no modes found; matrices must be finite");
  // The exponent of each pair in the upper half plane. Zeros of the inverse form are infinite exponents.
  std::vector<Index> kept;
  const double least = form.inverse ? 1e-13 * eigen->values.cwiseAbs().maxCoeff() : -1.0;
  for (Index i = 0; i < 2 * n; ++i) {
    const double upwards = (form.inverse ? -1.0 : 1.0) * eigen->values[i].imag();
    if (upwards >= 0.0 && std::abs(eigen->values[i]) > least) kept.push_back(i);
  }
  const bool unsymmetric = !structure.symmetric() || has_equal(eigen->values);
  ComplexModes modes{eigen->values(kept), {}, {}};
  if (form.inverse) modes.exponents = modes.exponents.cwiseInverse().eval();
  // The lower half of an eigenvector of the inverse form is a displacement, as the upper one of the other.
  const bool lower = unsymmetric && form.inverse;
  modes.shapes = eigen->vectors.middleRows(lower ? n : 0, n)(Eigen::all, kept);
  if (unsymmetric) modes.left = left_modes(form, eigen->vectors)(Eigen::all, kept);
  return modes;
}

// The poles of 1 / (m s^2 + c s + k), m and c not both zero.
void add_poles(double m, double c, double k, const Eigen::VectorXd& shape, std::vector<ContactPole>& poles) {
  if (m == 0.0) {
    poles.push_back({-k / c, 1.0 / c, shape, shape});
    return;
  }
  // A motion that nothing resists has a double exponent 0, which has no residues either.
  if (c == 0.0 && k == 0.0) k = m * 1e-18;
  double discriminant = 0.25 * c * c - m * k;
  // Equal exponents have no residues; a change by 5e-7 of them does not matter.
  const double least = 2.5e-13 * c * c;
  if (std::abs(discriminant) < least) discriminant = -least;
  if (discriminant < 0.0) {
    const Complex exponent(-0.5 * c / m, std::sqrt(-discriminant) / m);
    poles.push_back({exponent, 1.0 / (2.0 * m * Complex(0.0, exponent.imag())), shape, shape});
    return;
  }
  const double sum = 0.5 * std::abs(c) + std::sqrt(discriminant), sign = c < 0.0 ? 1.0 : -1.0;
  const double fast = sign * sum / m, slow = sign * k / sum;
  poles.push_back({fast, 1.0 / (m * (fast - slow)), shape, shape});
  poles.push_back({slow, 1.0 / (m * (slow - fast)), shape, shape});
}

Parts decoupled_parts(const LinearStructure& structure, const ModalForm& modes) {
  const Eigen::MatrixXd contacts = structure.contact_directions * modes.shapes;
  const Eigen::VectorXd mass = without_rounding(modes.mass), damping = without_rounding(modes.damping),
                        stiffness = without_rounding(modes.stiffness);
  Parts parts{Eigen::MatrixXd::Zero(contacts.rows(), contacts.rows()), {}, {}};
  for (Index j = 0; j < mass.size(); ++j) {
    const Eigen::VectorXd shape = contacts.col(j);
    if (mass[j] == 0.0 && damping[j] == 0.0) {
      parts.constant += shape * shape.transpose() / stiffness[j];
      continue;
    }
    parts.sections.push_back({{mass[j], damping[j], stiffness[j]}, shape * shape.transpose(), {}});
    add_poles(mass[j], damping[j], stiffness[j], shape, parts.poles);
  }
  return parts;
}

ContactDynamics::Section section_of(const ContactPole& pole) {
  const Eigen::MatrixXcd matrix = pole.residue * pole.shape * pole.left.transpose();
  const Complex exponent = pole.exponent;
  if (exponent.imag() == 0.0) return {{0.0, 1.0, -exponent.real()}, matrix.real(), {}};
  return {{1.0, -2.0 * exponent.real(), std::norm(exponent)},
          -2.0 * (matrix * std::conj(exponent)).real(),
          2.0 * matrix.real()};
}

// An exponent lambda of the shape x has the residue 1 / x^T (2 lambda M + C) x; left modes include it.
Parts complex_parts(const LinearStructure& structure) {
  StaticCondensation condensed = without_massless(structure);
  const LinearStructure& own = condensed.structure;
  const ComplexModes modes = complex_modes(own);
  Parts parts{std::move(condensed.compliance), {}, {}};
  for (Index j = 0; j < modes.exponents.size(); ++j) {
    const Complex exponent = modes.exponents[j];
    const Eigen::VectorXcd mode = modes.shapes.col(j), shape = own.contact_directions * mode;
    Eigen::VectorXcd left = shape;
    Complex residue = 1.0;
    if (modes.left.size() > 0) {
      left = condensed.left_directions * modes.left.col(j);
    } else {
      const Eigen::VectorXcd momentum = own.mass * (2.0 * exponent * mode) + own.damping * mode;
      residue = 1.0 / (mode.transpose() * momentum).value();
    }
    parts.poles.push_back({exponent, residue, shape, left});
    parts.sections.push_back(section_of(parts.poles.back()));
  }
  return parts;
}

}  // namespace

namespace {

// The squared frequency that the springs give to a rigid body: a hundredth of the first elastic mode's, or
// where nothing is elastic the squared rate of the dampers.
double square_of_springs(const LinearStructure& whole, bool small) {
  const LinearStructure structure = without_massless(whole).structure;
  const double largest =
      (structure.stiffness.diagonal().array() / structure.mass.diagonal().array()).abs().maxCoeff();
  if (!(largest > 0.0)) {
    const double rate = (structure.damping.diagonal().array() / structure.mass.diagonal().array()).maxCoeff();
    return rate > 0.0 ? rate * rate : 1.0;
  }
  if (!small) return 1e-8 * largest;
  const auto modes =
      detail::symmetric_eigen(Eigen::MatrixXd(structure.stiffness), Eigen::MatrixXd(structure.mass));
  const Index rigid = structure.rigid_modes.cols();
  return modes && rigid < modes->values.size() ? 1e-2 * modes->values[rigid] : 1e-8 * largest;
}

// Adds kappa S^T S to the stiffness of a structure that is free to move.
double hold_by_springs(LinearStructure& structure, bool small) {
  const Eigen::MatrixXd moved = structure.contact_directions * structure.rigid_modes;  // S R
  const double size = moved.squaredNorm();
  const double kappa = size > 0.0 ? square_of_springs(structure, small) / size : 0.0;
  const Eigen::SparseMatrix<double> directions = structure.contact_directions;
  structure.stiffness += kappa * Eigen::SparseMatrix<double>(directions.transpose() * directions);
  structure.rigid_modes.resize(structure.size(), 0);
  return kappa;
}

}  // namespace

void ContactDynamicsOptions::validate() const {
  detail::require_at_least("ContactDynamicsOptions", "max_size", max_size, 1);
  detail::require_at_least("ContactDynamicsOptions", "reduced_size", reduced_size, 0);
}

ContactDynamics::ContactDynamics(const LinearStructure& structure, const ContactDynamicsOptions& options) {
  options.validate();
  structure.validate();
  const int contacts = structure.contacts();
  reduced_ = structure.size() > options.max_size;
  structurally_damped_ = structure.loss_factor > 0.0;
  const int vectors = options.reduced_size > 0 ? options.reduced_size : std::max(80, 12 * contacts);
  LinearStructure held = structure.is_free() && !reduced_ ? without_drift(structure) : structure;
  if (held.is_free()) holding_ = hold_by_springs(held, !reduced_);
  const LinearStructure own = reduced_ ? krylov_reduction(held, vectors) : std::move(held);
  const auto modes = modal_form(own);
  Parts parts = modes ? decoupled_parts(own, *modes) : complex_parts(own);
  constant_ = std::move(parts.constant);
  poles_ = std::move(parts.poles);
  set_sections(parts.sections);
}

ContactDynamics ContactDynamics::undamped(const Eigen::VectorXd& omega_squared, const Eigen::MatrixXd& shapes,
                                          Index dynamic) {
  const Index modes = omega_squared.size();
  if (shapes.cols() != modes || dynamic < 0 || dynamic > modes || !(omega_squared.array() > 0.0).all())
    throw std::invalid_argument(
        "ContactDynamics::undamped: there are " + std::to_string(modes) + " omega_squared, " +
        std::to_string(shapes.cols()) + " shapes and " + std::to_string(dynamic) +
        " dynamic modes; omega_squared must be positive, with one shape each and no more dynamic modes");
  ContactDynamics result;
  const Index springs = modes - dynamic;
  const Eigen::MatrixXd held =
      shapes.rightCols(springs) * omega_squared.tail(springs).cwiseSqrt().cwiseInverse().asDiagonal();
  result.constant_ = detail::product_transposed(held, held);
  std::vector<Section> sections;
  for (Index j = 0; j < dynamic; ++j) {
    const Eigen::VectorXd shape = shapes.col(j);
    sections.push_back({{1.0, 0.0, omega_squared[j]}, shape * shape.transpose(), {}});
    add_poles(1.0, 0.0, omega_squared[j], shape, result.poles_);
  }
  result.set_sections(sections);
  return result;
}

ContactDynamics ContactDynamics::with_springs_beyond(double modulus) const {
  ContactDynamics result = *this;
  result.poles_.clear();
  std::vector<Section> sections;
  std::vector<const ContactPole*> springs;
  for (const ContactPole& pole : poles_) {
    if (std::abs(pole.exponent) > modulus) {
      springs.push_back(&pole);
      continue;
    }
    result.poles_.push_back(pole);
    sections.push_back(section_of(pole));
  }
  result.set_sections(sections);
  const auto count = Index(springs.size());
  Eigen::MatrixXd scaled(contacts(), 2 * count),
      left(contacts(), 2 * count);  // real parts, then imaginary ones
  for (Index l = 0; l < count; ++l) {
    const ContactPole& pole = *springs[std::size_t(l)];
    const Complex weight = (pole.exponent.imag() == 0.0 ? -1.0 : -2.0) * pole.residue / pole.exponent;
    const Eigen::VectorXcd shape = weight * pole.shape;
    scaled.col(l) = shape.real();
    scaled.col(count + l) = -shape.imag();
    left.col(l) = pole.left.real();
    left.col(count + l) = pole.left.imag();
  }
  result.constant_ += detail::product_transposed(scaled, left);
  return result;
}

// Those that no contact excites are left out.
void ContactDynamics::set_sections(const std::vector<Section>& sections) {
  const auto count = Index(sections.size());
  denominator_.resize(count, 3);
  constant_numerator_.resize(count, constant_.size());
  linear_numerator_.setZero(count, constant_.size());
  Index used = 0;
  for (const Section& section : sections) {
    if (section.constant.isZero(0.0) && section.linear.isZero(0.0)) continue;
    denominator_.row(used) = section.denominator.transpose();
    constant_numerator_.row(used) = section.constant.reshaped().transpose();
    if (section.linear.size() > 0) linear_numerator_.row(used) = section.linear.reshaped().transpose();
    ++used;
  }
  denominator_.conservativeResize(used, Eigen::NoChange);
  constant_numerator_.conservativeResize(used, Eigen::NoChange);
  linear_numerator_.conservativeResize(used, Eigen::NoChange);
  if (linear_numerator_.isZero(0.0)) linear_numerator_.resize(0, constant_.size());
}

ContactDynamics::Values ContactDynamics::compliance(double real, const Eigen::VectorXd& imaginary,
                                                    bool with_slope) const {
  const Index points = imaginary.size(), sections = denominator_.rows();
  const Eigen::ArrayXd y = imaginary.array();
  // Real and imaginary parts of 1 / d(s) below each other, and of its derivative by s.
  Eigen::MatrixXd weight(2 * points, sections), slope(2 * points, sections);
  for (Index j = 0; j < sections; ++j) {
    const double a2 = denominator_(j, 0), a1 = denominator_(j, 1), a0 = denominator_(j, 2);
    const double rise = 2.0 * a2 * real + a1, static_part = (a2 * real + a1) * real + a0;
    const double* at = y.data();
    double *wr = &weight(0, j), *wi = wr + points, *sr = &slope(0, j), *si = sr + points;
    for (Index k = 0; k < points; ++k) {
      const double re = static_part - a2 * at[k] * at[k], im = rise * at[k];
      const double scale = 1.0 / (re * re + im * im), vr = re * scale, vi = -im * scale;
      const double square_re = vr * vr - vi * vi, square_im = 2.0 * vr * vi;
      const double turn = 2.0 * a2 * at[k];
      wr[k] = vr;
      wi[k] = vi;
      sr[k] = turn * square_im - rise * square_re;
      si[k] = -turn * square_re - rise * square_im;
    }
  }
  const auto joined = [&](const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) -> Eigen::MatrixXcd {
    const Eigen::MatrixXd parts = detail::product(left, right);
    return parts.topRows(points) + Complex(0.0, 1.0) * parts.bottomRows(points);
  };
  Values values{joined(weight, constant_numerator_), {}};
  if (with_slope) values.slope = joined(slope, constant_numerator_);
  if (linear_numerator_.rows() == 0) return values;
  const Eigen::VectorXcd exponents = real + Complex(0.0, 1.0) * y;
  const Eigen::MatrixXcd ramp = joined(weight, linear_numerator_);
  values.compliance += exponents.asDiagonal() * ramp;
  if (with_slope) values.slope += ramp + exponents.asDiagonal() * joined(slope, linear_numerator_);
  return values;
}

std::shared_ptr<const ContactDynamics> DynamicsAlong::at(const LinearStructure& structure) {
  if (!structure.turns()) return given_;
  constexpr std::size_t most = 4;  // an iterate, two neighbours, and the first point
  const double speed = structure.turning.speed;
  for (const AtSpeed& one : last_)
    if (one.speed == speed) return one.dynamics;
  last_.insert(last_.begin(), {speed, std::make_shared<const ContactDynamics>(structure)});
  if (last_.size() > most) last_.pop_back();
  return last_.front().dynamics;
}

}  // namespace wavebalance::solvers
