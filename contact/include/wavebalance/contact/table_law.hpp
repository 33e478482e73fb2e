#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "wavebalance/contact/force_and_tangent.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// A spring by its measured characteristic: the monotone cubic interpolant of the points (u_i, f_i),
/// continued beyond both ends with the slopes there.
///
/// The interpolant is once continuously differentiable, so that Newton's method meets no kink, and rises or
/// falls between two points as they do. A table that is constant over an interval is constant there: a gap
/// stays a gap. Slopes as F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5, 1984,
/// doi:10.1137/0905021; condition for monotony: F. N. Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17,
/// 1980, doi:10.1137/0717021. Two points are a straight line. The potential is measured from gap(). O(log
/// k) for k points in one of n equal cells. Immutable, may be shared between threads.
class TableLaw {
 public:
  /// Displacements in m, strictly ascending, and as many forces in N, two at least. Throws
  /// std::invalid_argument otherwise.
  TableLaw(std::vector<double> displacements, std::vector<double> forces);

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static TableLaw of(const LawValues& values);

  std::span<const double> displacements() const { return displacements_; }
  std::span<const double> forces() const { return forces_; }
  /// m: where the force begins in a unilateral table, else 0.
  double gap() const { return gap_; }
  static std::vector<double> kinks() { return {}; }
  /// m: the points, at which the slope's slope jumps.
  const std::vector<double>& breakpoints() const { return displacements_; }
  /// Whether the table begins with two zeros at least, and has no negative force and none falling beyond its
  /// end.
  bool unilateral() const { return unilateral_; }

  /// Whether no force of the table is below the one before.
  bool monotone() const { return monotone_; }

  double force(double displacement) const { return evaluate(displacement).force; }      ///< N
  double tangent(double displacement) const { return evaluate(displacement).tangent; }  ///< N/m
  double potential(double displacement) const;                                          ///< J
  ForceAndTangent evaluate(double displacement) const;

 private:
  double energy_from_begin(double displacement) const;  // of the first point
  // For a displacement within the table: one of n - 1 equal cells, with one more for the last point, and
  // the interval between two points.
  std::size_t cell_of(double displacement) const;
  std::size_t interval_of(double displacement) const;
  void set_cells();

  std::vector<double> displacements_, forces_, slopes_, energies_;
  std::vector<std::size_t> cells_;  // the first point at or beyond the begin of each, and n
  double gap_ = 0.0, energy_at_gap_ = 0.0;
  bool unilateral_ = false, monotone_ = false;
};

/// Reads a table from a CSV file: two columns, displacement in m and force in N, behind a header row or none;
/// blank lines and those that begin with # are skipped. Throws std::runtime_error "<file>:<line>: ..." for
/// what is not two finite numbers or does not ascend, and "<file>: ..." for a file that cannot be read, is no
/// regular file, is larger than 16 MiB, or has fewer than two rows or more than 100000.
TableLaw read_table_law(const std::filesystem::path& file);

}  // namespace wavebalance::contact
