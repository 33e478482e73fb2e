#pragma once
#include <Eigen/Core>
#include <vector>

#include "multiscale_basis.hpp"
#include "wavebalance/solvers/balance/contact_law.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers {

/// The balance u = u0 - K f_c(u) of a CondensedProblem on selected functions, a = free - effect^T f and
/// u = values a: what is solved for the |S| coefficients a.
struct SelectedBalance {
  Selection selection;
  Eigen::VectorXd free;    ///< |S|, m, of the contact-free response
  Eigen::MatrixXd effect;  ///< N x |S|, m/N: what a unit force at a sample takes from each coefficient
  Eigen::MatrixXd values;  ///< N x |S|, the functions at the samples
};

/// P W (u0 - K f): the structure answers in all M functions, where it is diagonal, and only the contact
/// displacement is confined to the selection. K smooths, so that this Galerkin method for an equation of the
/// second kind errs by a factor of the best approximation in the selected functions once they resolve the
/// contact; with too few it may err more than a whole coarse level. (To select before inverting, P W Z W^T
/// P^T for each mode, has resonances of its own: a single real wavelet sees no damping.) With all functions
/// it is the balance of the pair itself. `basis` spans the trial functions of the problem's pair, its
/// frequency set and its one contact. O(N |S| + (N/M) blocks M log M), independent of the structure. Throws
/// std::invalid_argument when basis and problem differ in functions or points.
SelectedBalance selected_balance(CondensedProblem& problem, const MultiscaleBasis& basis,
                                 const Selection& selection);

/// A periodic response on selected functions.
struct SelectedResponse {
  SolveStatus status = SolveStatus::iteration_limit;
  int iterations = 0;
  double residual = 0.0;  ///< ||R|| / (||free|| + ||effect^T f||)
  Selection selection;
  Eigen::VectorXd coefficients;   ///< |S|, m
  Eigen::VectorXd displacement;   ///< m, N samples at the contact degree of freedom
  Eigen::VectorXd contact_force;  ///< N, N samples

  bool converged() const { return status == SolveStatus::converged; }
};

/// Semismooth Newton with line search on the coefficients; where it stalls, the law is stiffened from next to
/// nothing. `start` is a displacement at the N points; empty: the contact-free response. Only samples in
/// contact cost: O(active |S|^2 + |S|^3) an iteration. Never throws for want of convergence.
SelectedResponse selected_response(const SelectedBalance& balance, const AnyContactLaw& law,
                                   const NewtonOptions& options = {}, const Eigen::VectorXd& start = {});

/// The first `complete` blocks whole and, of the blocks up to `blocks`, the functions whose centres lie
/// within `reach` of their block's spacing of the instants (fractions of the period): a marking by geometry.
Selection near_instants(const MultiscaleBasis& basis, const std::vector<double>& instants, int complete,
                        int blocks, double reach);

/// Instants at which contact opens or closes: where uniform samples of a displacement cross the gap,
/// linearly interpolated, as fractions of the period.
std::vector<double> contact_instants(const Eigen::VectorXd& displacement, double gap);

/// What decides where functions are added.
enum class Marking {
  residual,  ///< where the balance on all M functions is missed most: one product with K
  details    ///< around the largest selected details: their neighbours, and those of the next block there
};

/// Which functions a refinement starts from, how many a round adds, and when it ends.
struct AdaptiveOptions {
  Marking marking = Marking::residual;
  int complete_blocks = 2;  ///< blocks that are selected whole from the start
  double tolerance = 1e-4;  ///< on the relative rms change of the displacement from one round to the next
  int max_functions = 256;
  int max_rounds = 40;
  double fraction = 0.8;  ///< share of the squared indicator that the functions added hold, 0..1
  double growth = 0.4;    ///< at most this many times the functions there are is added in a round
  NewtonOptions newton;
};

/// One round of the refinement.
struct AdaptiveRound {
  SelectedResponse response;
  double estimate = 1.0;  ///< relative rms change against the round before
};

/// Every round is kept; the last one is the answer.
struct AdaptiveResponse {
  std::vector<AdaptiveRound> rounds;
  bool met_tolerance = false;  ///< of the estimate; never when a round did not converge
};

/// Solve, estimate, mark, refine: from the complete blocks until a round changes the response by less than
/// the tolerance, the functions or rounds run out, nothing is left to mark or a solve fails.
AdaptiveResponse adaptive_response(CondensedProblem& problem, const MultiscaleBasis& basis,
                                   const AnyContactLaw& law, const AdaptiveOptions& options = {});

}  // namespace wavebalance::solvers
