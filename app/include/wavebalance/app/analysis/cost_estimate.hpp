#pragma once
#include <string>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Expected time and memory of `analyse` on one core of 2 to 3 GHz.
struct CostEstimate {
  double seconds = 0.0;  ///< processor time of a response or a curve; NaN where only the solution shows it
  /// Bounds of the time for stability and the exact curve; zero without them.
  double least_stability_seconds = 0.0, most_stability_seconds = 0.0;
  /// Time of the exact motion near a response, with its stability, at least and at most; zero without, or
  /// below a second.
  double least_exact_seconds = 0.0, most_exact_seconds = 0.0;
  double bytes = 0.0;       ///< resident memory at its peak
  bool unforeseen = false;  ///< the time is NaN since it depends on how often contacts slip, stick and open
};

/// Estimated from the sizes of a scene only: C contacts, M functions, N quadrature points, P output points,
/// n degrees of freedom after reduction, a = min(C N / 10, 1000) samples in contact that a dense matrix is
/// factorized for, s = min(12 (C^2 N)^(1/3), C N) unknowns of the preconditioner of GMRES,
///
///   bytes = 20e6 + 130 C N + (150 + 32 C^2) M + 8 C^2 N r + 16 a^2 + 16 s^2 + 100 C s
///           + (500 + 400 C [C > 1]) P + structure,
///   seconds = (8e-8 C N log2 N + 2e-8 C^2 M n + 5e-10 b^3) per response + 3e-6 C P + structure,
///
/// b = min(a, 144), or min(a, 256) for several contacts, the samples up to which LU replaces GMRES, and r
/// the period after which products with the compliance repeat (1 for an odd number of Fourier functions,
/// otherwise N / gcd(N, M)), with 2 |to - from| / largest_step responses along a sweep. The structure needs
/// 1500 n bytes, with all its modes 64 n^2 bytes and 2e-8 n^3 s. A reduction needs 4e-4 s per degree of
/// freedom before it. Stability along the exact curve is bounded by its operations, estimated at 300 s,
/// because that curve may have many contact intervals. The exact motion near a response takes steps of n^2
/// (n / 1.5 + 4 poles) operations at 5e9 per second: ten with n = 14 C unknowns at least, at most sixty
/// with 24 nodes on each panel, or all operations allowed for the searches. It is reported if it may exceed
/// a second. Responses that Newton's method does not find need more time. Sizes that a tolerance chooses,
/// periods of time stepping and points of a mode are not known, and curves with friction need widely
/// different times: the time is NaN, and the memory is only for structure and output. O(1), but matrices
/// that have not been read are read.
CostEstimate estimate_cost(const Scene& scene);

/// One sentence for a scene of time stepping that follows more modes than a user waits for, and how to
/// reduce them; empty for others. O(1), but matrices that have not been read are read.
std::string slow_stepping_advice(const Scene& scene);

/// Bytes of memory available to this process: the least of the machine's memory, the process limit
/// (setrlimit) and the limit of its control group.
double available_memory();

/// "3.2 GB", "15 MB"
std::string memory_text(double bytes);

/// "about 0.2 s for the curve, 0.02 s to 2 s for its stability, and 21 MB of memory"; of a response "for its
/// exact motion".
std::string cost_text(const CostEstimate& cost);

/// Throws std::invalid_argument if a scene is expected to need more memory than the machine has, or more
/// than `max_gigabytes` where that is positive, before any is allocated.
void check_memory(const Scene& scene, double max_gigabytes = 0.0);

}  // namespace wavebalance::app
