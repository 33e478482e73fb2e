#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

#include "collocation/law_segments.hpp"
#include "collocation/pole_response.hpp"

namespace wavebalance::solvers::detail {

/// The breakpoint of an instant at which a force vanishes within a segment.
inline constexpr double no_breakpoint = std::numeric_limits<double>::infinity();

/// An instant at which a contact passes a breakpoint of its law, or at which its force vanishes.
struct Passage {
  int contact = 0;
  double time = 0.0;        ///< periods
  double breakpoint = 0.0;  ///< m
  bool released = false;    ///< the force vanishes instead
};

/// An interval between two passages, or one that lasts the whole period, with passages -1.
struct LayoutInterval {
  int contact = 0, piece = 0;
  int begin = -1, end = -1;       ///< numbers of passages
  double turns = 0.0;             ///< added to the time of `end`, so that it comes after `begin`
  std::vector<double> cuts = {};  ///< shares in (0, 1) of the interval at which panels meet, ascending
};

/// All intervals with a force, and their passages, which are unknowns.
struct Layout {
  std::vector<Passage> passages;
  std::vector<LayoutInterval> intervals;
  /// Whether passages and cuts of other intervals cut the panels of an interval: its force has kinks in
  /// high derivatives there. With many active contacts, panels without these cuts are far fewer.
  bool cut_by_others = true;

  double begin(const LayoutInterval& interval) const;
  double end(const LayoutInterval& interval) const;
  /// Between two passages of one contact, in periods; 1 where no contact has two. O(passages^2).
  double shortest_interval() const;
  /// The cells of the period, between all passages and cuts of all contacts, and the panels of the intervals,
  /// by interval.
  CellGrid grid() const;
};

/// The contact intervals of a motion sampled at times l / N: displacements, m, and velocities, m per
/// period, C x N each. Between two samples the motion is the cubic through both, so grazing between samples
/// is found. An interval shorter than `least` periods between two intervals on the same segment of a law is
/// ignored. The frequency in Hz.
Layout layout_of(const std::vector<LawSegments>& laws, double frequency, const Eigen::MatrixXd& displacement,
                 const Eigen::MatrixXd& velocity, double least = 0.0);

/// Slopes at times l / N of the cubic spline through periodic samples, C x N, that central differences of
/// fourth order give, per period.
Eigen::MatrixXd periodic_slopes(const Eigen::MatrixXd& samples);

/// Whether a contact has the same intervals at about the same instants in both, in any order.
bool same_intervals(const Layout& a, const Layout& b, int contact);

/// Contact forces that are polynomials on panels.
class PanelForces {
 public:
  PanelForces() = default;
  /// `values`: of q nodes each, by panel.
  PanelForces(CellGrid grid, const LegendreNodes& nodes, const Eigen::VectorXd& values);

  const CellGrid& grid() const { return grid_; }
  const std::vector<Panel>& panels() const { return grid_.panels; }
  /// The force of an interval at a time in its own periods, continued beyond the ends of the interval.
  double in_interval(int interval, double time) const;
  /// The force of a contact at any time; zero outside its panels.
  double at(int contact, double time) const;
  /// q x panels, N.
  const Eigen::MatrixXd& coefficients() const { return coefficients_; }

 private:
  std::size_t panel_of(int interval, double time) const;
  double value(std::size_t panel, double time) const;

  CellGrid grid_;
  Eigen::MatrixXd coefficients_;
};

}  // namespace wavebalance::solvers::detail
