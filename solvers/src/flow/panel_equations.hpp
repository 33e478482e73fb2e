#pragma once
#include <Eigen/Core>
#include <vector>

#include "flow/panel.hpp"
#include "wavebalance/solvers/flow/law_machine.hpp"

namespace wavebalance::solvers::detail {

/// The state of each contact and all memories, in the order of the contacts.
struct ContactStates {
  std::vector<int> state;
  std::vector<double> memory;
};

/// The machines of all contacts of a structure, and where each has its memories.
class Contacts {
 public:
  explicit Contacts(std::vector<ContactMachine> machines);

  Index count() const { return Index(machines_.size()); }
  Index memories() const { return memory_begins_.back(); }
  const LawMachine& law(Index c) const { return *machines_[std::size_t(c)].law; }
  Index row(Index c) const { return machines_[std::size_t(c)].row; }
  Index memory_begin(Index c) const { return memory_begins_[std::size_t(c)]; }

 private:
  std::vector<ContactMachine> machines_;
  std::vector<Index> memory_begins_;
};

/// Signals of one contact at one point, with numbers of the gradient.
class LocalValues {
 public:
  LocalValues(const Contacts& contacts, Index c, const Signals& signals, Index point);
  /// To another point of signals of the same contact: gradients stay.
  void move_to(const Signals& signals, Index point);
  LocalSignals signals() const;

 private:
  std::array<std::array<Dual, 3>, 4> values_;
  std::array<Dual, 2> memory_;
  std::size_t rows_, memories_;
  Index row_, memory_begin_;
};

/// Which forces, and which rates of memories, are unknown in the states of all contacts: all forces are
/// combine x free + constant.
struct FreeForces {
  FreeForces(const Contacts& contacts, const std::vector<int>& states, bool all);

  Index count() const { return Index(rows.size() + moving.size()); }
  /// The contact of equation e; equations of the free forces come first.
  Index contact(std::size_t e) const {
    return e < rows.size() ? rows[e].first : moving[e - rows.size()].first;
  }

  std::vector<std::pair<Index, Index>> rows;    ///< contact and row of the structure of each free force
  std::vector<std::pair<Index, Index>> moving;  ///< contact and number of each memory that moves
  Eigen::MatrixXd combine;                      ///< R x free
  Eigen::VectorXd constant;                     ///< R, N
};

/// The laws' equations at the nodes of a panel: values and gradients, one per free force and memory that
/// moves, and node. The gradients of the latter are without that by their own rate, 1.
std::vector<std::vector<Dual>> law_equations(const Contacts& contacts, const ContactStates& now,
                                             const FreeForces& free, bool all_free, const Signals& signals,
                                             Index nodes);

/// The change of a local value, with gradient `slope`, of contact c by linear changes of the signals of its
/// rows. Row i of contact c is structure row contacts.row(c) + i.
struct SlopeOfSignals {
  const Contacts& contacts;
  Index contact;
  const Dual& value;
  double holding;

  double by(int kind, Index row) const;  ///< kinds 0 to 2 and the force
  double by_memory(Index j) const;
  /// By time, along signals at a point.
  double rate(const Signals& signals, Index point) const;
};

/// Values on a panel that satisfy the laws at its nodes, and whether they were found.
struct SolvedPanel {
  NodeValues values;
  bool converged = false;
  double rate = 0.0;      ///< rad/s, at which perturbations turn or decay by the slopes of the laws
  double rounding = 0.0;  ///< N, of forces that follow from displacements
};
/// The largest modulus; 0 of none.
double largest(const Eigen::MatrixXd& values);
SolvedPanel solve_panel(const Contacts& contacts, const ContactStates& now, const PanelMotion& motion,
                        double force_size);

/// (count q) x (count q): the derivative of the equations by the unknowns at the nodes, free forces and then
/// rates of memories.
Eigen::MatrixXd equations_by_unknowns(const Contacts& contacts, const FreeForces& free,
                                      const PanelShape& shape,
                                      const std::vector<std::vector<Dual>>& equations, double holding);

}  // namespace wavebalance::solvers::detail
