#pragma once
#include <span>

namespace wavebalance::contact {

// Rigid (Signorini) contact as complementarity of arrays, one entry a contact degree of freedom and time
// sample, in any order [LL10, eqs. (1), (3c)]: with the gap function g = u - g0, negative where contact is
// open, and the contact force lambda,
//
//     g <= 0,   lambda >= 0,   lambda g = 0.
//
// This is one equation a pair, phi(g, lambda) = lambda - max(0, lambda + c g) = 0, for any c > 0 (N/m): c has
// no effect on the solution, only on the path of an iteration to it. phi is piecewise linear, so Newton's
// method on it is semismooth and coincides with an active-set method (M. Hintermueller, K. Ito, K. Kunisch,
// The primal-dual active set strategy as a semismooth Newton method, SIAM J. Optim. 13, 2002,
// doi:10.1137/S1052623401383558). All functions: O(n); std::invalid_argument if lengths differ. Output may
// be the array of an input of the same length, but not overlap it otherwise.

/// g = u - g0, m. gap: m, one entry for all or as many as displacement.
void gap_function(std::span<const double> displacement, std::span<const double> gap, std::span<double> g);

/// How far a pair of arrays is from rigid contact; all three are zero at a solution.
struct SignoriniMeasures {
  double max_penetration = 0.0;  ///< m, max(0, g)
  double max_adhesion = 0.0;     ///< N, max(0, -lambda)
  /// max |lambda g| over max |lambda| max |g|, without unit, at most 1; 0 if lambda or g is zero throughout.
  double complementarity = 0.0;
};

/// An entry that is not a number makes the measures it enters not a number.
SignoriniMeasures signorini_measures(std::span<const double> g, std::span<const double> force);
/// m, max(0, g).
double max_penetration(std::span<const double> g);
/// N, the least force: >= 0 without adhesion. Infinite if there is none.
double min_force(std::span<const double> force);
/// The same as in SignoriniMeasures.
double complementarity(std::span<const double> g, std::span<const double> force);

/// phi of one pair and an element of its generalised derivative. In contact, lambda + c g >= 0, phi = -c g;
/// otherwise phi = lambda. At the kink it is the derivative in contact, the right-hand slope as that of the
/// penalty laws.
struct SignoriniResidual {
  double value = 0.0;     ///< N
  double by_gap = 0.0;    ///< N/m, -c in contact, else 0
  double by_force = 0.0;  ///< 0 in contact, else 1
};

/// c: N/m, > 0 and finite, std::invalid_argument otherwise. Not a number in, not a number out.
SignoriniResidual signorini_residual(double g, double force, double c);

/// The same for arrays of one length.
void signorini_residual(std::span<const double> g, std::span<const double> force, double c,
                        std::span<double> value, std::span<double> by_gap, std::span<double> by_force);

/// max(0, lambda + c g), N: the force that one step of Uzawa's method with step c goes on with; a fixed point
/// is rigid contact. c as above.
void signorini_projection(std::span<const double> g, std::span<const double> force, double c,
                          std::span<double> projected);

}  // namespace wavebalance::contact
