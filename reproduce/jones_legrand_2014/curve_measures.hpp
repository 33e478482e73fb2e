#pragma once
#include <Eigen/Core>

/// Measures that decide the statements of JL14 on curves.
namespace wavebalance::jl14 {

/// Sum of |v[i+1] - v[i]| round the period: twice the range for a curve that rises once and falls once, more
/// for every oscillation. Zero for fewer than two values. O(n).
double total_variation(const Eigen::VectorXd& values);

/// How much more a curve varies than its reference, total_variation(values) / total_variation(reference) - 1:
/// the measure of ringing. The reference must vary.
double excess_variation(const Eigen::VectorXd& values, const Eigen::VectorXd& reference);

/// max |v[i+steps] - v[i]| round the period, 1 <= steps < n.
double largest_change(const Eigen::VectorXd& values, int steps);

using Mask = Eigen::Array<bool, Eigen::Dynamic, 1>;

/// The entries of all cells, `cells` equal parts of the period, whose entries are all in `where`. Throws
/// std::invalid_argument unless cells divides their number.
Mask whole_cells(const Mask& where, int cells);

/// The mean over each of `cells` equal cells of the period: the best constants there.
/// Throws std::invalid_argument unless cells divides the number of values.
Eigen::VectorXd best_constants(const Eigen::VectorXd& values, int cells);

/// (u[k+1] - u[k-1]) / (2 period / points) of every n-th of `values`, `points` of them round the period.
/// Throws std::invalid_argument unless points divides their number.
Eigen::VectorXd central_differences(const Eigen::VectorXd& values, int points, double period);
/// Every n-th of `values`, `points` of them. Throws std::invalid_argument unless points divides their number.
Eigen::VectorXd thinned(const Eigen::VectorXd& values, int points);

/// How many of the largest of `coefficients` of an orthonormal basis leave out at most `share` of the rms of
/// all. O(n log n).
int coefficients_needed(const Eigen::VectorXd& coefficients, double share);

/// The entries of `values` at which `where` is true, in their order.
Eigen::VectorXd select(const Eigen::VectorXd& values, const Mask& where);

/// mean |values - reference| / mean |reference|. Short spikes weigh less than in app::relative_rms_error().
double relative_mean_error(const Eigen::VectorXd& values, const Eigen::VectorXd& reference);

/// The entries in the middle of `cells` equal cells of the period: at (j + 1/2) n / cells. Throws
/// std::invalid_argument unless 2 cells divides n.
Eigen::VectorXd cell_midpoints(const Eigen::VectorXd& values, int cells);

/// Sign changes of consecutive entries, zeros skipped, ends not joined.
int sign_changes(const Eigen::VectorXd& values);

/// max |fine[2i+1] - (coarse[i] + coarse[i+1]) / 2|: what a refinement adds to the polygon through `coarse`,
/// n values, when `fine`, 2n - 1 values, has a further one in the middle of each interval.
double refinement_gain(const Eigen::VectorXd& coarse, const Eigen::VectorXd& fine);

}  // namespace wavebalance::jl14
