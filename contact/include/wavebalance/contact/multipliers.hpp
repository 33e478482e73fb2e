#pragma once
#include <span>
#include <vector>

namespace wavebalance::contact {

/// Powell's measure of the inequality constraints g <= 0 [LL10, eq. (25a)]: max |max(g, -theta)|, zero where
/// a constraint is met with its multiplier kappa theta >= 0 complementary to it. Not a number if an entry is.
/// theta: as many entries as g, std::invalid_argument otherwise. O(n).
double powell_measure(std::span<const double> g, std::span<const double> theta);
/// The same of the equality constraints h = 0 [LL10, eq. (25b)]: max |h|. O(n).
double powell_measure(std::span<const double> h);

/// When multipliers and penalties change, and when the outer iteration has converged.
struct MultiplierOptions {
  /// alpha > 1: an outer iteration must reduce Powell's measure by this factor, or penalties grow [LL10,
  /// eq. (26)].
  double improvement = 4.0;
  /// beta > 1: the factor by which a penalty parameter grows.
  double growth = 10.0;
  /// epsilon > 0 of the inequality constraints, in the unit of g.
  double inequality_tolerance = 1e-10;
  /// epsilon > 0 of the equality constraints, in the unit of h.
  double equality_tolerance = 1e-10;
  /// >= 1: no penalty parameter grows beyond this multiple of its first value.
  double largest_growth = 1e12;

  /// Throws std::invalid_argument naming the member, its value and what is allowed.
  void validate() const;
};

/// The action of one outer iteration on the inequality constraints or on the equality constraints.
enum class MultiplierAction {
  satisfied,                          ///< within the tolerance (or no constraints): unchanged
  multipliers_updated,                ///< improved enough
  multipliers_and_penalties_updated,  ///< improved, but not by alpha: both
  penalties_increased,                ///< did not improve: penalties of the worst constraints only
  stalled                             ///< did not improve, and the penalties in question are at their largest
};

/// Changes of one outer iteration, and the measures that decided them.
struct MultiplierStep {
  MultiplierAction inequality = MultiplierAction::satisfied;
  MultiplierAction equality = MultiplierAction::satisfied;
  double inequality_measure = 0.0;  ///< G_i, before the update
  double equality_measure = 0.0;    ///< G_e

  bool converged() const;
  /// Not converged and nothing was changed: the same inner problem would follow.
  bool stalled() const;
};

/// The contact side of the augmented Lagrangian of M. J. D. Powell as [LL10] uses it, for any number of
/// inequality constraints g <= 0 (one per contact degree of freedom and time sample) and of equality
/// constraints h = 0 (a normalisation): the terms [LL10, eq. (18)]
///
///     1/2 sum kappa (g + theta)_+^2  +  1/2 sum kappa_e (h + theta_e)^2
///
/// that the caller adds to the functional that it makes stationary, and the outer iteration on theta and
/// kappa [LL10, Algorithm 3]. Its fixed point has the Lagrange multipliers kappa theta >= 0 and kappa_e
/// theta_e:
///
///     MultiplierUpdate outer(std::vector<double>(n, 100.0), {100.0});
///     for (int j = 0; j < j_max; ++j) {
///       solve_inner(x, outer);                          // stationary in x, theta and kappa fixed
///       const MultiplierStep step = outer.update(g(x), h(x));
///       if (step.converged() || step.stalled()) break;
///     }
///
/// Sums carry no weight: for the integral over a period multiply the terms, forces and tangents by 1/m (m
/// samples), and the multipliers then belong to the integral.
///
/// Differences from the printed algorithm: G^(j) is the measure of the last outer iteration that improved;
/// it is set before the comparison and is infinite at first. Violations are |max(g, -theta)|, where (26a)
/// lacks the sign and the modulus. Line 18 has S_i instead of L_i. theta is divided by beta wherever kappa
/// is multiplied, so that a larger penalty does not change the multiplier. The condition of line 25 reads
/// |h| >= G_e/alpha.
///
/// Not to be updated from several threads. All calls are O(n).
class MultiplierUpdate {
 public:
  /// First penalty parameters, > 0 and finite, one per inequality and one per equality constraint. The first
  /// multipliers are zero. Throws std::invalid_argument naming the entry.
  explicit MultiplierUpdate(std::vector<double> inequality_penalties,
                            std::vector<double> equality_penalties = {}, MultiplierOptions options = {});

  int inequalities() const { return static_cast<int>(inequality_.penalty.size()); }
  int equalities() const { return static_cast<int>(equality_.penalty.size()); }
  const MultiplierOptions& options() const { return options_; }
  /// kappa and theta.
  std::span<const double> inequality_penalties() const { return inequality_.penalty; }
  std::span<const double> inequality_shifts() const { return inequality_.shift; }
  std::span<const double> equality_penalties() const { return equality_.penalty; }
  std::span<const double> equality_shifts() const { return equality_.shift; }
  /// The Lagrange multipliers kappa theta.
  std::vector<double> inequality_multipliers() const;
  std::vector<double> equality_multipliers() const;

  /// 1/2 sum kappa (g + theta)_+^2.
  double inequality_term(std::span<const double> g) const;
  /// Its gradient by g, kappa (g + theta)_+ >= 0, and the diagonal of its second derivative: kappa where
  /// g + theta >= 0, else 0. Arrays of inequalities() entries, std::invalid_argument otherwise.
  void inequality_force(std::span<const double> g, std::span<double> force, std::span<double> tangent) const;
  /// 1/2 sum kappa_e (h + theta_e)^2; its second derivative by h is kappa_e.
  double equality_term(std::span<const double> h) const;
  /// Its gradient by h, kappa_e (h + theta_e).
  void equality_force(std::span<const double> h, std::span<double> force) const;

  /// One outer iteration, with the constraints at the solution of the inner problem. Throws
  /// std::invalid_argument if an entry is not finite or a length is wrong; nothing has changed then.
  MultiplierStep update(std::span<const double> g, std::span<const double> h = {});

  /// Starts a new problem: multipliers as given (of inequalities >= 0, std::invalid_argument otherwise),
  /// penalties as they are, no measure to improve on. Both empty: multipliers as they are.
  void restart(std::span<const double> inequality_multipliers = {},
               std::span<const double> equality_multipliers = {});

 private:
  struct Family {
    std::vector<double> penalty, shift, largest_penalty;
    double reference = 0.0;  // G^(j), of the last outer iteration that improved
  };
  Family make_family(const char* name, std::vector<double> penalties) const;
  MultiplierAction advance(Family& family, std::span<const double> violation, double measure,
                           double tolerance) const;
  bool increase_penalties(Family& family, std::span<const double> violation, double threshold) const;

  MultiplierOptions options_;
  Family inequality_, equality_;
};

}  // namespace wavebalance::contact
