#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "collocation/cell_waves.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"

namespace wavebalance::solvers::detail {

/// An interval on which the force of a contact is one polynomial: a part of a contact interval that covers
/// consecutive cells of the period, of which only the first may be cell 0. Times in periods as in its
/// contact interval: begin < end.
struct Panel {
  int contact = 0, interval = 0, cell = 0;
  double begin = 0.0, end = 0.0;
  int cells = 1;

  double length() const { return end - begin; }
  /// The time of a point x in [-1, 1].
  double time(double x) const { return 0.5 * (begin + end) + 0.5 * length() * x; }
};

/// The cells of a period, within each of which all forces are polynomials, and what happens where they meet.
struct CellGrid {
  /// A passage of a contact, which lies at a boundary.
  struct Mark {
    int contact = 0, boundary = 0;
    bool acts_before = false, acts_after = false;
  };

  /// An impulse on a contact, N periods, where two cells meet.
  struct Impulse {
    int contact = 0, boundary = 0;
    double size = 0.0;
  };

  /// Ascending within one period. Cell j begins at boundary j; the last one ends at the first.
  std::vector<double> boundaries;
  std::vector<Panel> panels;
  std::vector<Mark> marks;
  std::vector<Impulse> impulses = {};

  /// The states at a boundary, where they are known better than from the forces, whose errors those that
  /// almost nothing holds have many times: PoleResponse::states().
  struct Begin {
    int boundary = 0;
    Eigen::VectorXcd states;
  };
  std::optional<Begin> begin = {};

  int cells() const { return static_cast<int>(boundaries.size()); }
  double length(int cell) const;
  /// The boundary nearest to a time in periods.
  int boundary_near(double time) const;
  int next(int cell) const { return cell + 1 == cells() ? 0 : cell + 1; }
  int before(int cell) const { return cell == 0 ? cells() - 1 : cell - 1; }
};

/// Responses of the poles within each cell of a grid, for forces at so many nodes; in
/// pole_response_parts.hpp.
struct PeriodCells;

/// How the contacts move where contact forces act periodically: displacements (m) and velocities (m per
/// period) at the n nodes of all panels and at the m marks, by forces of 1 N at the nodes and by impulses of
/// 1 N times a period at the marks.
struct Influence {
  Eigen::MatrixXd displacement;   ///< (n + m) x (n + m)
  Eigen::MatrixXd node_velocity;  ///< n x (n + m); empty if not requested
  Eigen::MatrixXd mark_velocity;  ///< m x n
};

/// The same for given forces.
struct ForcedMotion {
  Eigen::VectorXd displacement;   ///< n + m, m
  Eigen::VectorXd node_velocity;  ///< n, m per period; empty if not requested
  Eigen::VectorXd mark_velocity;  ///< m, m per period
};

/// Cells that follow each other and begin with any states of the poles, n nodes and m marks in them.
struct FreeCells {
  Influence influence;                            ///< only within these cells
  Eigen::MatrixXcd displacement_by, velocity_by;  ///< (n + m) x poles and n x poles: by states of 1
  Eigen::MatrixXcd states_by;  ///< poles x (n + m): the last states, by forces and impulses
  Eigen::VectorXcd decay;      ///< poles: the last states, by the first
};

/// Displacements (m) and velocities (m per period) of all contacts at K times, C x K each.
struct ContactMotion {
  Eigen::MatrixXd displacement, velocity;
};

/// The compliance of the contacts by its poles r and residues R: the periodic solutions of y' = r y + f for
/// each pole, and u = -sum R y - constant f. The integrals are exact for forces that are polynomials in
/// time. Positive forces move the contact towards its obstacle.
///
/// Immutable; may be shared between threads.
class PoleResponse {
 public:
  /// Keeps no reference. The period in s.
  PoleResponse(const ContactDynamics& dynamics, double period);

  int contacts() const { return static_cast<int>(constant_.rows()); }
  Eigen::Index poles() const { return exponents_.size(); }
  /// Immediate response of contact c to a force of 1 N: the displacement, m, and without mass the velocity,
  /// m per period.
  double displacement_at_once(int c) const { return constant_(c, c); }
  double velocity_at_once(int c) const { return jump_(c, c); }
  /// With mass the acceleration, m per period squared, its size.
  double acceleration_at_once(int c) const;

  /// Keeps a reference to the nodes. O(cells poles q).
  std::shared_ptr<const PeriodCells> cells(const CellGrid& grid, const LegendreNodes& nodes) const;
  /// Node j of panel p has number p q + j. O((n + m)^2 poles).
  Influence influence(const PeriodCells& period, bool velocity) const;
  /// By forces with these Legendre coefficients, q x panels, N. O(n poles (q + C)).
  ForcedMotion forced_motion(const PeriodCells& period, const Eigen::MatrixXd& coefficients,
                             bool velocity) const;
  /// The same of all cells but the last, which has neither panels nor marks, for any states at the begin of
  /// the first. O((n + m)^2 poles).
  FreeCells free_cells(const PeriodCells& period, bool velocity) const;
  const Eigen::VectorXcd& exponents() const { return exponents_; }
  /// Whether a force on one contact moves another, or changes its velocity, at once.
  bool acts_at_once(int displaced, int forced) const {
    return constant_(displaced, forced) != 0.0 || jump_(displaced, forced) != 0.0;
  }
  /// The multipliers of all states without forces, exp(exponent), both of each pair.
  Eigen::VectorXcd free_multipliers() const;
  /// CellGrid::Begin::states by states y of ContactDynamics::poles(), N s, with y' = exponent y - left f
  /// for a force f on contacts.
  Eigen::VectorXcd states(const Eigen::VectorXcd& by_pole) const;
  /// By forces with these Legendre coefficients, q x panels, N, at times in periods. O(K poles C + panels q
  /// (poles + C q)).
  ContactMotion motion(const PeriodCells& period, const Eigen::MatrixXd& coefficients,
                       const Eigen::VectorXd& times) const;

 private:
  friend struct PeriodCells;
  struct Part;
  struct Cell;
  struct Rows;
  struct Sources;

  static Part part_of(const CellGrid& grid, std::size_t panel, double begin, double length, bool last,
                      const LegendreNodes& nodes);
  void add_between(const PeriodCells& period, const Cell& cell, const WavesAtNodes& waves, const Part& from,
                   const Part& to, bool velocity, Eigen::MatrixXd& all) const;
  static Eigen::MatrixXd at_once(const Part& from, const Part& to, Index count);
  void add_by_poles(const PeriodCells& period, const Cell& cell, const WavesAtNodes& waves, bool velocity,
                    Eigen::MatrixXd& all) const;
  std::vector<Rows> rows_of(const PeriodCells& period, bool velocity) const;
  std::vector<Sources> sources_of(const PeriodCells& period) const;
  static Influence split(const Eigen::MatrixXd& all, Index nodes, Index marks, bool velocity);
  void add_within_cells(const PeriodCells& period, bool velocity, Eigen::MatrixXd& all) const;
  Eigen::MatrixXcd states_at_boundaries(const PeriodCells& period, const Eigen::MatrixXd& coefficients) const;
  void set_at_marks(const PeriodCells& period, const Eigen::MatrixXd& coefficients,
                    const Eigen::MatrixXcd& states, ForcedMotion& result) const;
  ContactMotion free_flight(const Eigen::VectorXcd& state, const Eigen::VectorXd& since) const;
  FarPoles::Series far_motion(const CellGrid& grid, const Cell& cell, const Eigen::MatrixXd& forces) const;
  // `known`: the waves of the cell with this number at these points.
  ContactMotion forced_flight(const PeriodCells& period, std::size_t number, const Eigen::VectorXcd& state,
                              const Eigen::MatrixXd& coefficients, const Eigen::VectorXd& points,
                              bool velocity, const WavesAtNodes* known = nullptr) const;
  ContactMotion by_poles(const CellGrid& grid, const Cell& cell, const Eigen::VectorXcd& state,
                         const Eigen::MatrixXd& forces, const Eigen::VectorXd& points, bool velocity) const;
  template <class States>
  void add_poles(const CellGrid& grid, const Cell& cell, const std::vector<Eigen::Index>& poles,
                 const Eigen::MatrixXd& forces, const States& states, ContactMotion& result) const;
  Eigen::VectorXcd weights(int displaced, int forced) const;

  Eigen::VectorXcd exponents_;       // per period, one for each pair, by rising decay
  std::vector<Eigen::Index> order_;  // of the poles in ContactDynamics::poles()
  double period_;                    // s
  Eigen::VectorXcd periodic_;        // 1 / (1 - exp(exponent))
  Eigen::MatrixXcd shapes_, left_;   // C x poles; weight, residue and period are in shapes_
  Eigen::MatrixXd constant_;         // C x C, m/N
  Eigen::MatrixXd jump_;  // C x C: of the velocity, m per period, by a force of 1 N; zero with masses
};

}  // namespace wavebalance::solvers::detail
