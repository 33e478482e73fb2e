#pragma once

namespace wavebalance::solvers {

/// Lets OpenBLAS compute every product and factorization of this process on the thread that calls it.
/// Matrices here are small, so that its threads would wait for each other more than they compute. The
/// programs of this project call it as they start; the libraries leave the setting to the program that uses
/// them. Without effect where another BLAS is linked, or an OpenBLAS without threads.
void use_one_blas_thread();

}  // namespace wavebalance::solvers
