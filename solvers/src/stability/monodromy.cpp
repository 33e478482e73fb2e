#include "wavebalance/solvers/stability/monodromy.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "linalg/dense.hpp"
#include "linalg/gauss_rule.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "linalg/option_checks.hpp"
#include "stability/monodromy_map.hpp"
#include "stability/monodromy_segments.hpp"
#include "stability/pole_states.hpp"
#include "stability/stability_checks.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// Row i: the values at points[i] of the polynomials that are 1 at one of the nodes and 0 at the others.
Eigen::MatrixXd lagrange(const Eigen::VectorXd& nodes, const Eigen::VectorXd& points) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Ones(points.size(), nodes.size());
  for (Index i = 0; i < points.size(); ++i)
    for (Index k = 0; k < nodes.size(); ++k)
      for (Index j = 0; j < nodes.size(); ++j)
        if (j != k) values(i, k) *= (points[i] - nodes[j]) / (nodes[k] - nodes[j]);
  return values;
}

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
    for (Index i = 0; i < rule_.points.size(); ++i)
      below_.push_back(lagrange(rule_.points, rule_.points[i] * rule_.points));
  }

  const PoleStates& states() const { return states_; }

  // The states of all columns after the pieces.
  Eigen::MatrixXd passed(const std::vector<Piece>& pieces, Eigen::MatrixXd states) const {
    for (const Piece& piece : pieces) pass(piece, states);
    return states;
  }

 private:
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

  // Common data of all parts of one length. Rows and columns belong to the closed contacts at the nodes,
  // node after node.
  struct PartMaps {
    Eigen::MatrixXd memory;                  // displacements from the forces in the part, m/N
    Eigen::MatrixXd free;                    // displacements from the states at its begin
    Eigen::MatrixXd impulses;                // states at its end from the forces
    Eigen::MatrixXd memory_rate, free_rate;  // the same of velocities; no rows where no law depends on them
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

  // The displacements after an impulse rise from h(0), so that the velocities under a force f have h(0) f.
  PartMaps maps_of(const std::vector<int>& contacts, double length) const {
    const auto closed = Index(contacts.size());
    const Index nodes = rule_.points.size(), size = nodes * closed;
    const bool rates = bool(stiffness_.damping);
    PartMaps maps{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd(size, states_.size()),
                  Eigen::MatrixXd(states_.size(), size), Eigen::MatrixXd(rates ? size : 0, size),
                  Eigen::MatrixXd(rates ? size : 0, states_.size())};
    const Eigen::MatrixXd displaced = states_.free_motion(0.0)(contacts, Eigen::all),
                          moved = states_.free_velocity(0.0)(contacts, Eigen::all),
                          struck = states_.after_impulse(0.0)(Eigen::all, contacts);
    for (Index i = 0; i < nodes; ++i) {
      const double point = rule_.points[i];
      const Index row = i * closed;
      maps.free.middleRows(row, closed) = states_.free_motion(length * point)(contacts, Eigen::all);
      maps.impulses.middleCols(row, closed) =
          length * period_ * rule_.weights[i] *
          states_.after_impulses(states_.growth(length * (1.0 - point)), contacts);
      const Eigen::MatrixXd up_to_node = states_up_to_node(contacts, length, i);
      maps.memory.middleRows(row, closed) = detail::product(displaced, up_to_node);
      maps.memory.block(row, row, closed, closed) += dynamics_.constant()(contacts, contacts);
      if (!rates) continue;
      maps.free_rate.middleRows(row, closed) = states_.free_velocity(length * point)(contacts, Eigen::all);
      maps.memory_rate.middleRows(row, closed) = detail::product(moved, up_to_node);
      maps.memory_rate.block(row, row, closed, closed) += detail::product(displaced, struck);
    }
    return maps;
  }

  // A slope of the closed contacts at the nodes of a part.
  Eigen::VectorXd at_nodes(const std::function<double(int, double)>& slope, const Piece& piece, double begin,
                           double length) const {
    Eigen::VectorXd values(rule_.points.size() * Index(piece.closed.size()));
    Index row = 0;
    for (const double point : rule_.points)
      for (const int contact : piece.closed) values[row++] = slope(contact, begin + length * point);
    return values;
  }

  // Forces f of the closed contacts at the nodes, one column per state: f + D_u h * f + D_v h' * f = D_u u +
  // D_v u' of the free motion. A rigid contact, whose tangent is infinite, holds the displacement: h * f = u.
  Eigen::MatrixXd contact_forces(const Piece& piece, double begin, double length, const PartMaps& maps,
                                 const Eigen::MatrixXd& states) const {
    const Eigen::VectorXd tangent = at_nodes(stiffness_.tangent, piece, begin, length);
    const auto rigid = tangent.array().isInf();
    const Eigen::VectorXd slope = rigid.select(1.0, tangent);
    Eigen::MatrixXd matrix = slope.asDiagonal() * maps.memory;
    matrix.diagonal() += rigid.select(0.0, Eigen::VectorXd::Ones(tangent.size()));
    const Eigen::MatrixXd free = detail::product(maps.free, states);
    Eigen::MatrixXd right = slope.asDiagonal() * free;
    if (stiffness_.coupling) {
      const Eigen::MatrixXd coupling = coupling_at_nodes(stiffness_.coupling, piece, begin, length);
      matrix += detail::product(coupling, maps.memory);
      right += detail::product(coupling, free);
    }
    if (stiffness_.damping) {
      const Eigen::VectorXd damping = at_nodes(stiffness_.damping, piece, begin, length);
      matrix += damping.asDiagonal() * maps.memory_rate;
      right += damping.asDiagonal() * detail::product(maps.free_rate, states);
    }
    if (stiffness_.damping_coupling) {
      const Eigen::MatrixXd coupling = coupling_at_nodes(stiffness_.damping_coupling, piece, begin, length);
      matrix += detail::product(coupling, maps.memory_rate);
      right += detail::product(coupling, detail::product(maps.free_rate, states));
    }
    return detail::Lu<double>(matrix).solve(right);
  }

  // The slopes of forces by other rows of their laws.
  Eigen::MatrixXd coupling_at_nodes(const std::function<double(int, int, double)>& slope, const Piece& piece,
                                    double begin, double length) const {
    const auto closed = Index(piece.closed.size()), size = rule_.points.size() * closed;
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(size, size);
    for (Index i = 0; i < rule_.points.size(); ++i)
      for (Index a = 0; a < closed; ++a)
        for (Index b = 0; b < closed; ++b)
          if (a != b)
            slopes(i * closed + a, i * closed + b) = slope(
                piece.closed[std::size_t(a)], piece.closed[std::size_t(b)], begin + length * rule_.points[i]);
    return slopes;
  }

  // The states at node i by forces from the begin of a part on that are the polynomials of the nodes, n x
  // (contacts at node after node): each pole's integral of exp(lambda (t_i - s)) times the polynomials.
  Eigen::MatrixXd states_up_to_node(const std::vector<int>& contacts, double length, Index i) const {
    const auto closed = Index(contacts.size());
    const Index nodes = rule_.points.size();
    const double reach = length * rule_.points[i];
    const Eigen::MatrixXd& polynomials = below_[static_cast<std::size_t>(i)];
    Eigen::MatrixXcd growths(Index(dynamics_.poles().size()), nodes);
    for (Index q = 0; q < nodes; ++q)
      growths.col(q) = reach * period_ * rule_.weights[q] * states_.growth(reach * (1.0 - rule_.points[q]));
    Eigen::MatrixXd states(states_.size(), nodes * closed);
    for (Index k = 0; k < nodes; ++k)
      states.middleCols(k * closed, closed) = states_.after_impulses(growths * polynomials.col(k), contacts);
    return states;
  }

  const ContactDynamics& dynamics_;
  const PeriodicStiffness& stiffness_;
  PoleStates states_;
  double period_;
  QuadratureRule rule_;
  std::vector<Eigen::MatrixXd> below_;
};

// Holds contacts at zero from a state in which they need not be there: the impulse that closes them, and the
// map over `length` (s) under the forces that keep them. h0 is the jump of the displacements after a unit
// impulse.
bool hold(const PoleStates& states, const std::vector<int>& closed, double length, Eigen::MatrixXd& map) {
  const Eigen::MatrixXd displaced = states.free_motion(0.0)(closed, Eigen::all);
  const Eigen::MatrixXd struck = states.after_impulse(0.0)(Eigen::all, closed);
  const Eigen::MatrixXd jump = detail::product(displaced, struck);
  const detail::Lu<double> h0(jump);
  // With a mass at the contact h0 is the rounding of a sum of its terms.
  const Eigen::MatrixXd terms = detail::product(displaced.cwiseAbs(), struck.cwiseAbs());
  if (!(jump.diagonal().array() > 1e-9 * terms.diagonal().array()).all() || h0.is_singular(1e-9))
    return false;
  map -= detail::product(struck, h0.solve(detail::product(displaced, map)));
  const Eigen::MatrixXd free = states.generator();
  const Eigen::MatrixXd held = free - detail::product(struck, h0.solve(detail::product(displaced, free)));
  map = detail::product(detail::exponential(length * held), map);
  return true;
}

// Pieces in the order in which the longest free flight comes first, and its length in periods.
double begin_with_free_flight(std::vector<Piece>& pieces) {
  double longest = 0.0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    double length = 0.0;
    for (std::size_t k = i; k < i + pieces.size() && pieces[k % pieces.size()].closed.empty(); ++k)
      length += pieces[k % pieces.size()].end - pieces[k % pieces.size()].begin;
    if (!(length > longest)) continue;
    first = i;
    longest = length;
  }
  std::rotate(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(first), pieces.end());
  return longest;
}

void require_causal(const char* who, const ContactDynamics& dynamics) {
  if (dynamics.structurally_damped())
    throw std::invalid_argument(
        std::string(who) +
        ": the structure has a loss_factor, and structural damping has no equation in time");
}

}  // namespace

void MonodromyOptions::validate() const {
  detail::require_at_least("MonodromyOptions", "nodes", nodes, 2);
  detail::require_at_least("MonodromyOptions", "max_segments", max_segments, 1);
  detail::require_positive("MonodromyOptions", "max_phase", max_phase);
}

namespace {

// The stiffness of a structure that is held, once all arguments are checked.
PeriodicStiffness checked_stiffness(const ContactDynamics& dynamics, const PeriodicStiffness& of_contacts,
                                    double frequency, const MonodromyOptions& options) {
  options.validate();
  PeriodicStiffness stiffness = held_stiffness(of_contacts, dynamics.contacts(), dynamics.holding());
  require_stability_arguments("monodromy", dynamics, stiffness, frequency, 1);
  require_causal("monodromy", dynamics);
  if (stiffness.status != StabilityStatus::converged)
    throw std::invalid_argument("monodromy: the status of the stiffness is " +
                                std::string(to_string(stiffness.status)) + "; it must be converged");
  return stiffness;
}

}  // namespace

Eigen::MatrixXd monodromy_map(const ContactDynamics& dynamics, const PeriodicStiffness& of_contacts,
                              double frequency, const MonodromyOptions& options) {
  const PeriodicStiffness stiffness = checked_stiffness(dynamics, of_contacts, frequency, options);
  const Propagator propagator(dynamics, stiffness, 1.0 / frequency, options.nodes);
  const Index size = propagator.states().size();
  const auto resolving = resolving_pieces(dynamics, stiffness, frequency, options);
  if (!resolving) return Eigen::MatrixXd::Constant(size, size, missing);
  return propagator.passed(*resolving, Eigen::MatrixXd::Identity(size, size));
}

double monodromy_operations(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                            double frequency, bool eigenvalues, const MonodromyOptions& options) {
  auto resolving = resolving_pieces(dynamics, stiffness, frequency, options);
  if (!resolving) return std::numeric_limits<double>::infinity();
  const PoleStates all(dynamics, 1.0 / frequency);
  const auto states = double(all.size()),
             left = double(all.left_after(begin_with_free_flight(*resolving)).size());
  // Eigenvalues need 25 n^3 [Golub & Van Loan]; about eight powers are computed, by products, which are
  // faster.
  double operations = (eigenvalues ? 25.0 : 8.0) * left * left * left;
  for (const Piece& piece : *resolving) {
    const double rows = options.nodes * double(piece.closed.size());
    operations += piece.parts * rows * (2.0 / 3.0 * rows * rows + 2.0 * rows * left + 4.0 * states * left);
  }
  return operations;
}

// States that decay in a free flight have columns of zeros.
std::optional<Eigen::MatrixXd> lasting_map(const ContactDynamics& dynamics,
                                           const PeriodicStiffness& of_contacts, double frequency,
                                           const MonodromyOptions& options) {
  const PeriodicStiffness stiffness = checked_stiffness(dynamics, of_contacts, frequency, options);
  const Propagator propagator(dynamics, stiffness, 1.0 / frequency, options.nodes);
  auto resolving = resolving_pieces(dynamics, stiffness, frequency, options);
  if (!resolving) return std::nullopt;
  const Index size = propagator.states().size();
  const auto left = propagator.states().left_after(begin_with_free_flight(*resolving));
  const Eigen::MatrixXd states =
      propagator.passed(*resolving, Eigen::MatrixXd::Identity(size, size)(Eigen::all, left));
  return states.allFinite() ? std::optional<Eigen::MatrixXd>(states(left, Eigen::all)) : std::nullopt;
}

Eigen::VectorXcd monodromy(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                           double frequency, const MonodromyOptions& options) {
  const auto map = lasting_map(dynamics, stiffness, frequency, options);
  const Index states = PoleStates(dynamics, 1.0 / frequency).size();
  if (!map) return Eigen::VectorXcd::Constant(states, missing);
  Eigen::VectorXcd multipliers = Eigen::VectorXcd::Zero(states);
  multipliers.head(map->rows()) = detail::map_multipliers(*map);
  return multipliers;
}

Eigen::VectorXcd rigid_monodromy(const ContactDynamics& dynamics, const PeriodicStiffness& contact,
                                 double frequency) {
  require_stability_arguments("rigid_monodromy", dynamics, contact, frequency, 1);
  require_causal("rigid_monodromy", dynamics);
  const PoleStates states(dynamics, 1.0 / frequency);
  Eigen::MatrixXd map = Eigen::MatrixXd::Identity(states.size(), states.size());
  for (const Piece& piece : pieces(contact, 1.0)) {
    const double length = piece.end - piece.begin;
    if (piece.closed.empty())
      states.advance(length, map);
    else if (!hold(states, piece.closed, length / frequency, map))
      return Eigen::VectorXcd::Constant(states.size(), missing);
  }
  return detail::map_multipliers(map);
}

}  // namespace wavebalance::solvers
