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

/// From the sizes of a scene alone: C contacts, M functions, N quadrature points, P output points, n degrees
/// of freedom after reduction, a = min(C N / 10, 1000) samples in contact that a dense matrix is factorized
/// for, s = min(12 (C^2 N)^(1/3), C N) unknowns of the preconditioner of GMRES,
///
///   bytes = 20e6 + 130 C N + (150 + 32 C^2) M + 8 C^2 N r + 16 a^2 + 16 s^2 + 100 C s
///           + (500 + 400 C [C > 1]) P + structure,
///   seconds = (8e-8 C N log2 N + 2e-8 C^2 M n + 5e-10 b^3) per response + 3e-6 C P + structure,
///
/// b = min(a, 144), or min(a, 256) for several contacts, the samples up to which LU takes the place of GMRES,
/// and r the period after which products with the compliance repeat (1 for an odd number of Fourier
/// functions, otherwise N / gcd(N, M)), with 2 |to - from| / largest_step responses along a sweep. The
/// structure takes 1500 n bytes, and where all its modes are taken 64 n^2 bytes and 2e-8 n^3 s; a reduction
/// 4e-4 s per degree of freedom before it. In six scenes from 1 to 24 contacts, up to 2^16 functions and 2^20
/// points, memory was within a factor of 1.5 above 50 MB and time within a factor of 3 above 0.1 s. Stability
/// with the structure's own curve took 0.1 to 9 times the time of the curve in ten sweeps of one contact. Of
/// three contacts it had taken 170 times when it was stopped, as that curve may have many phases; it is
/// bounded by the operations that it may take, here estimated at 300 s. The exact motion beside a response
/// takes steps of n^2 (n / 1.5 + 4 poles) operations at 5e9 per second: ten with n = 14 C unknowns at least,
/// at most sixty with 24 nodes on each panel, or all that the searches by phases and by the flow may take; it
/// is said where it may exceed a second. Of 24 contacts it took 0.5 to 10 s where 0.04 to 24 s are said.
/// Responses that Newton's method does not find take more time. Sizes that a tolerance chooses, periods of
/// time stepping and points of a mode are not known, and with friction curves take more time by factors that
/// differ widely: the time is NaN, and memory that of the structure and the output. With laws of the velocity
/// at 10 to 200 contacts memory was within a factor of 1.5, too. O(1), but matrices that have not been read
/// are read.
CostEstimate estimate_cost(const Scene& scene);

/// One sentence for a scene of time stepping that follows more modes than a user waits for, and what takes
/// fewer; empty for others. O(1), but matrices that have not been read are read.
std::string slow_stepping_advice(const Scene& scene);

/// Bytes of memory that this process may have: those of the machine, or the limit of the process (setrlimit)
/// or of its control group where that is less.
double available_memory();

/// "3.2 GB", "15 MB"
std::string memory_text(double bytes);

/// "about 0.2 s for the curve, 0.02 s to 2 s for its stability, and 21 MB of memory"; of a response "for its
/// exact motion".
std::string cost_text(const CostEstimate& cost);

/// Throws std::invalid_argument if a scene is expected to take more memory than the machine has, or more than
/// `max_gigabytes` where that is positive, before any is allocated.
void check_memory(const Scene& scene, double max_gigabytes = 0.0);

}  // namespace wavebalance::app
