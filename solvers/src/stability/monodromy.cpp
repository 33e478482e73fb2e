#include "wavebalance/solvers/stability/monodromy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "linalg/dense.hpp"
#include "linalg/option_checks.hpp"
#include "stability/gauss_rule.hpp"
#include "stability/monodromy_map.hpp"
#include "stability/monodromy_pieces.hpp"
#include "stability/stability_checks.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// Row i: the values at points[i] of the polynomials that are 1 at one of the nodes and 0 at the others.
Eigen::MatrixXd lagrange(const Eigen::VectorXd& nodes, const Eigen::VectorXd& points) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Ones(points.size(), nodes.size());
  for (Eigen::Index i = 0; i < points.size(); ++i)
    for (Eigen::Index k = 0; k < nodes.size(); ++k)
      for (Eigen::Index j = 0; j < nodes.size(); ++j)
        if (j != k) values(i, k) *= (points[i] - nodes[j]) / (nodes[k] - nodes[j]);
  return values;
}

// The states of a structure: of each pole its amplitude a, a' = lambda a - left^T f, as one real number or
// as its real and imaginary part. The contacts are displaced by sum Re(weight residue shape a), weight 2 for
// a pair.
class States {
 public:
  States(const ContactDynamics& dynamics, double period) : dynamics_(dynamics), period_(period) {
    for (const ContactPole& pole : dynamics.poles()) {
      begins_.push_back(size_);
      size_ += pole.exponent.imag() == 0.0 ? 1 : 2;
    }
  }

  Eigen::Index size() const { return size_; }

  // C x size(): displacements of the contacts a time (in periods) after the states.
  Eigen::MatrixXd free_motion(double time) const {
    Eigen::MatrixXd motion(dynamics_.contacts(), size_);
    for (std::size_t l = 0; l < begins_.size(); ++l) {
      const ContactPole& pole = dynamics_.poles()[l];
      const Eigen::VectorXcd shape = pole.residue * std::exp(pole.exponent * time * period_) * pole.shape;
      if (pole.exponent.imag() == 0.0) {
        motion.col(begins_[l]) = shape.real();
      } else {
        motion.col(begins_[l]) = 2.0 * shape.real();
        motion.col(begins_[l] + 1) = -2.0 * shape.imag();
      }
    }
    return motion;
  }

  // C x size(): their velocities, m/s.
  Eigen::MatrixXd free_velocity(double time) const {
    Eigen::MatrixXd motion(dynamics_.contacts(), size_);
    for (std::size_t l = 0; l < begins_.size(); ++l) {
      const ContactPole& pole = dynamics_.poles()[l];
      const Eigen::VectorXcd shape =
          pole.exponent * pole.residue * std::exp(pole.exponent * time * period_) * pole.shape;
      if (pole.exponent.imag() == 0.0) {
        motion.col(begins_[l]) = shape.real();
      } else {
        motion.col(begins_[l]) = 2.0 * shape.real();
        motion.col(begins_[l] + 1) = -2.0 * shape.imag();
      }
    }
    return motion;
  }

  // Takes the states of all columns on by `time`.
  void advance(double time, Eigen::MatrixXd& states) const {
    for (std::size_t l = 0; l < begins_.size(); ++l) {
      const Complex growth = std::exp(dynamics_.poles()[l].exponent * time * period_);
      if (dynamics_.poles()[l].exponent.imag() == 0.0) {
        states.row(begins_[l]) *= growth.real();
        continue;
      }
      const Eigen::RowVectorXd re = states.row(begins_[l]), im = states.row(begins_[l] + 1);
      states.row(begins_[l]) = growth.real() * re - growth.imag() * im;
      states.row(begins_[l] + 1) = growth.imag() * re + growth.real() * im;
    }
  }

  // size() x C: the states a time after unit impulses (N s) at the contacts.
  Eigen::MatrixXd after_impulse(double time) const {
    Eigen::MatrixXd states(size_, dynamics_.contacts());
    for (std::size_t l = 0; l < begins_.size(); ++l) {
      const ContactPole& pole = dynamics_.poles()[l];
      const Eigen::RowVectorXcd row = std::exp(pole.exponent * time * period_) * pole.left.transpose();
      states.row(begins_[l]) = row.real();
      if (pole.exponent.imag() != 0.0) states.row(begins_[l] + 1) = row.imag();
    }
    return states;
  }

 private:
  const ContactDynamics& dynamics_;
  double period_;
  Eigen::Index size_ = 0;
  std::vector<Eigen::Index> begins_;
};

// The map of perturbations over the pieces of a period.
class Propagator {
 public:
  Propagator(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness, double period, int nodes)
      : dynamics_(dynamics),
        stiffness_(stiffness),
        states_(dynamics, period),
        period_(period),
        rule_(gauss_rule(nodes)) {
    // Integrals up to node i of the polynomials of the nodes, by Gauss nodes below it.
    for (Eigen::Index i = 0; i < rule_.points.size(); ++i)
      below_.push_back(lagrange(rule_.points, rule_.points[i] * rule_.points));
  }

  const States& states() const { return states_; }

  void pass(const Piece& piece, Eigen::MatrixXd& states) const {
    if (stiffness_.impulse) strike(piece.begin, states);
    if (piece.closed.empty()) return states_.advance(piece.end - piece.begin, states);
    const double length = (piece.end - piece.begin) / piece.parts;
    const PartMaps maps = maps_of(piece.closed, length);
    for (int part = 0; part < piece.parts; ++part) {
      const Eigen::MatrixXd forces = contact_forces(piece, piece.begin + part * length, length, maps, states);
      states_.advance(length, states);
      states -= detail::product(maps.impulses, forces);
    }
  }

 private:
  // What all parts of one length share. Rows and columns are those of the closed contacts at the nodes, node
  // after node.
  struct PartMaps {
    Eigen::MatrixXd memory;                  // displacements from the forces in the part, m/N
    Eigen::MatrixXd free;                    // displacements from the states at its begin
    Eigen::MatrixXd impulses;                // states at its end from the forces
    Eigen::MatrixXd memory_rate, free_rate;  // the same of velocities; empty where no law depends on them
  };

  // The forces that jump at `time`, where an interval begins or ends.
  void strike(double time, Eigen::MatrixXd& states) const {
    for (const ContactInterval& interval : stiffness_.intervals)
      for (const double end : {interval.begin, interval.end}) {
        if (interval.always() || end - std::floor(end) != time) continue;
        const double impulse = stiffness_.impulse(interval.contact, end);
        if (impulse == 0.0) continue;
        const Eigen::RowVectorXd moved = impulse * states_.free_motion(0.0).row(interval.contact) * states;
        states -= states_.after_impulse(0.0).col(interval.contact) * moved;
      }
  }

  PartMaps maps_of(const std::vector<int>& contacts, double length) const {
    const auto closed = static_cast<Eigen::Index>(contacts.size());
    const Eigen::Index nodes = rule_.points.size(), size = nodes * closed;
    PartMaps maps{Eigen::MatrixXd::Zero(size, size),
                  Eigen::MatrixXd(size, states_.size()),
                  Eigen::MatrixXd(states_.size(), size),
                  {},
                  {}};
    for (Eigen::Index i = 0; i < nodes; ++i) {
      const double point = rule_.points[i];
      maps.free.middleRows(i * closed, closed) = states_.free_motion(length * point)(contacts, Eigen::all);
      maps.impulses.middleCols(i * closed, closed) =
          length * period_ * rule_.weights[i] *
          states_.after_impulse(length * (1.0 - point))(Eigen::all, contacts);
      maps.memory.block(i * closed, i * closed, closed, closed) = dynamics_.constant()(contacts, contacts);
      add_memory(contacts, length, i, states_.free_motion(0.0), maps.memory);
    }
    if (stiffness_.damping) add_rates(contacts, length, maps);
    return maps;
  }

  // The displacements after an impulse rise from h(0), so that the velocities under a force f have h(0) f.
  void add_rates(const std::vector<int>& contacts, double length, PartMaps& maps) const {
    const auto closed = static_cast<Eigen::Index>(contacts.size());
    const Eigen::Index nodes = rule_.points.size(), size = nodes * closed;
    maps.memory_rate.setZero(size, size);
    maps.free_rate.resize(size, states_.size());
    const Eigen::MatrixXd at_once = detail::product(states_.free_motion(0.0)(contacts, Eigen::all),
                                                    states_.after_impulse(0.0)(Eigen::all, contacts));
    for (Eigen::Index i = 0; i < nodes; ++i) {
      maps.free_rate.middleRows(i * closed, closed) =
          states_.free_velocity(length * rule_.points[i])(contacts, Eigen::all);
      maps.memory_rate.block(i * closed, i * closed, closed, closed) = at_once;
      add_memory(contacts, length, i, states_.free_velocity(0.0), maps.memory_rate);
    }
  }

  // The same where laws depend on the velocity: f + D_u h * f + D_v h' * f = D_u u + D_v u' of free motion.
  Eigen::MatrixXd damped_forces(const Piece& piece, double begin, double length, const PartMaps& maps,
                                const Eigen::VectorXd& tangent, const Eigen::MatrixXd& states) const {
    Eigen::VectorXd damping(tangent.size());
    Eigen::Index row = 0;
    for (const double point : rule_.points)
      for (const int contact : piece.closed)
        damping[row++] = stiffness_.damping(contact, begin + length * point);
    Eigen::MatrixXd matrix = tangent.asDiagonal() * maps.memory;
    matrix += damping.asDiagonal() * maps.memory_rate;
    matrix.diagonal().array() += 1.0;
    Eigen::MatrixXd right = tangent.asDiagonal() * detail::product(maps.free, states);
    right += damping.asDiagonal() * detail::product(maps.free_rate, states);
    return detail::Lu<double>(matrix).solve(right);
  }

  // Forces of the closed contacts at the nodes, one column per state: u + h * D u = free motion with f = D u.
  Eigen::MatrixXd contact_forces(const Piece& piece, double begin, double length, const PartMaps& maps,
                                 const Eigen::MatrixXd& states) const {
    Eigen::VectorXd tangent(maps.memory.rows());
    Eigen::Index row = 0;
    for (const double point : rule_.points)
      for (const int contact : piece.closed)
        tangent[row++] = stiffness_.tangent(contact, begin + length * point);
    if (stiffness_.damping) return damped_forces(piece, begin, length, maps, tangent, states);
    const Eigen::MatrixXd free = detail::product(maps.free, states);
    if (!tangent.allFinite()) return forces_of_rigid(tangent, maps.memory, free);
    Eigen::MatrixXd matrix = maps.memory * tangent.asDiagonal();
    matrix.diagonal().array() += 1.0;
    return tangent.asDiagonal() * detail::Lu<double>(matrix).solve(free);
  }

  // The same with rigid contacts, infinite tangents, which hold the displacement: f / D + h * f = free
  // motion.
  static Eigen::MatrixXd forces_of_rigid(const Eigen::VectorXd& tangent, Eigen::MatrixXd matrix,
                                         Eigen::MatrixXd free) {
    for (Eigen::Index row = 0; row < tangent.size(); ++row) {
      if (std::isinf(tangent[row])) continue;
      matrix.row(row) *= tangent[row];
      matrix(row, row) += 1.0;
      free.row(row) *= tangent[row];
    }
    return detail::Lu<double>(matrix).solve(free);
  }

  // integral up to node i of h(t_i - s) times the polynomials of the nodes; `motion` are the displacements of
  // all contacts in the states, or their velocities for h'.
  void add_memory(const std::vector<int>& contacts, double length, Eigen::Index i,
                  const Eigen::MatrixXd& motion, Eigen::MatrixXd& matrix) const {
    const auto closed = static_cast<Eigen::Index>(contacts.size());
    const double reach = length * rule_.points[i];
    const Eigen::MatrixXd& polynomials = below_[static_cast<std::size_t>(i)];
    const Eigen::MatrixXd displaced = motion(contacts, Eigen::all);
    for (Eigen::Index q = 0; q < rule_.points.size(); ++q) {
      const Eigen::MatrixXd impulse =
          states_.after_impulse(reach * (1.0 - rule_.points[q]))(Eigen::all, contacts);
      const Eigen::MatrixXd memory = reach * period_ * rule_.weights[q] * detail::product(displaced, impulse);
      for (Eigen::Index k = 0; k < rule_.points.size(); ++k)
        matrix.block(i * closed, k * closed, closed, closed) += polynomials(q, k) * memory;
    }
  }

  const ContactDynamics& dynamics_;
  const PeriodicStiffness& stiffness_;
  States states_;
  double period_;
  QuadratureRule rule_;
  std::vector<Eigen::MatrixXd> below_;
};

// The generator Lambda of free motion, a' = Lambda a, block diagonal.
Eigen::MatrixXd generator(const ContactDynamics& dynamics, Eigen::Index size) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::Index i = 0;
  for (const ContactPole& pole : dynamics.poles()) {
    const double re = pole.exponent.real(), im = pole.exponent.imag();
    matrix(i, i) = re;
    if (im != 0.0) matrix.block(i, i, 2, 2) << re, -im, im, re;
    i += im != 0.0 ? 2 : 1;
  }
  return matrix;
}

// Holds contacts at zero from a state in which they need not be there: the impulse that closes them, and the
// map over `length` (s) under the forces that keep them. h0 is the jump of the displacements after a unit
// impulse.
bool hold(const States& states, const ContactDynamics& dynamics, const std::vector<int>& closed,
          double length, Eigen::MatrixXd& map) {
  const Eigen::MatrixXd displaced = states.free_motion(0.0)(closed, Eigen::all);
  const Eigen::MatrixXd struck = states.after_impulse(0.0)(Eigen::all, closed);
  const Eigen::MatrixXd jump = detail::product(displaced, struck);
  const detail::Lu<double> h0(jump);
  // A mass beside the contact makes h0 the rounding of a sum of its terms.
  const Eigen::MatrixXd terms = detail::product(displaced.cwiseAbs(), struck.cwiseAbs());
  if (!(jump.diagonal().array() > 1e-9 * terms.diagonal().array()).all() || h0.is_singular(1e-9))
    return false;
  map -= detail::product(struck, h0.solve(detail::product(displaced, map)));
  const Eigen::MatrixXd free = generator(dynamics, states.size());
  const Eigen::MatrixXd held = free - detail::product(struck, h0.solve(detail::product(displaced, free)));
  map = detail::product(detail::exponential(length * held), map);
  return true;
}

void require_causal(const char* who, const ContactDynamics& dynamics) {
  if (dynamics.structurally_damped())
    throw std::invalid_argument(
        std::string(who) +
        ": the structure has a loss_factor, and structural damping has no equation in time");
}

}  // namespace

Eigen::VectorXcd by_falling_modulus(Eigen::MatrixXd map) {
  if (map.size() == 0) return {};
  // States of overdamped modes decay to numbers that keep the QR iteration from converging.
  const double vanishing = 1e-40 * map.cwiseAbs().maxCoeff();
  map = (map.array().abs() > vanishing).select(map, 0.0);
  Eigen::VectorXcd multipliers = detail::eigenvalues(map);
  std::sort(multipliers.begin(), multipliers.end(),
            [](const Complex& a, const Complex& b) { return std::abs(a) > std::abs(b); });
  return multipliers;
}

void MonodromyOptions::validate() const {
  detail::require_at_least("MonodromyOptions", "nodes", nodes, 2);
  detail::require_at_least("MonodromyOptions", "max_pieces", max_pieces, 1);
  detail::require_positive("MonodromyOptions", "max_phase", max_phase);
}

Eigen::MatrixXd monodromy_map(const ContactDynamics& dynamics, const PeriodicStiffness& of_contacts,
                              double frequency, const MonodromyOptions& options) {
  options.validate();
  const PeriodicStiffness stiffness = held_stiffness(of_contacts, dynamics.contacts(), dynamics.holding());
  require_stability_arguments("monodromy", dynamics, stiffness, frequency, 1);
  require_causal("monodromy", dynamics);
  if (stiffness.status != StabilityStatus::converged)
    throw std::invalid_argument("monodromy: the status of the stiffness is " +
                                std::string(to_string(stiffness.status)) + "; it must be converged");
  const Propagator propagator(dynamics, stiffness, 1.0 / frequency, options.nodes);
  const Eigen::Index size = propagator.states().size();
  const auto resolving = resolving_pieces(dynamics, stiffness, frequency, options);
  if (!resolving) return Eigen::MatrixXd::Constant(size, size, std::nan(""));
  Eigen::MatrixXd map = Eigen::MatrixXd::Identity(size, size);
  for (const Piece& piece : *resolving) propagator.pass(piece, map);
  return map;
}

double monodromy_operations(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                            double frequency, const MonodromyOptions& options) {
  const auto resolving = resolving_pieces(dynamics, stiffness, frequency, options);
  if (!resolving) return std::numeric_limits<double>::infinity();
  const double states = double(States(dynamics, 1.0 / frequency).size());
  double operations = 25.0 * states * states * states;  // of the eigenvalues [Golub & Van Loan]
  for (const Piece& piece : *resolving) {
    const double rows = options.nodes * double(piece.closed.size());
    operations +=
        piece.parts * rows * (2.0 / 3.0 * rows * rows + 2.0 * rows * states + 4.0 * states * states);
  }
  return operations;
}

Eigen::VectorXcd monodromy(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                           double frequency, const MonodromyOptions& options) {
  Eigen::MatrixXd map = monodromy_map(dynamics, stiffness, frequency, options);
  if (!map.allFinite()) return Eigen::VectorXcd::Constant(map.rows(), std::nan(""));
  return by_falling_modulus(std::move(map));
}

Eigen::VectorXcd rigid_monodromy(const ContactDynamics& dynamics, const PeriodicStiffness& contact,
                                 double frequency) {
  require_stability_arguments("rigid_monodromy", dynamics, contact, frequency, 1);
  require_causal("rigid_monodromy", dynamics);
  const States states(dynamics, 1.0 / frequency);
  Eigen::MatrixXd map = Eigen::MatrixXd::Identity(states.size(), states.size());
  for (const Piece& piece : pieces(contact, 1.0)) {
    const double length = piece.end - piece.begin;
    if (piece.closed.empty())
      states.advance(length, map);
    else if (!hold(states, dynamics, piece.closed, length / frequency, map))
      return Eigen::VectorXcd::Constant(states.size(), std::nan(""));
  }
  return by_falling_modulus(map);
}

}  // namespace wavebalance::solvers
