#pragma once

namespace wavebalance::solvers {

/// Lets this process keep up to 512 MB that it has freed, where the C library is glibc. Matrices of a few
/// hundred rows are made and freed at every step; memory that goes back to the system in between is cleared
/// anew each time, which took two thirds of an exact curve with 46 states. The programs of this project call
/// it as they start; the libraries leave the setting to the program that uses them.
void keep_freed_memory();

}  // namespace wavebalance::solvers
