// Tests compute with one thread of OpenBLAS, as the programs do, so that their figures are those of the
// programs.
extern "C" void openblas_set_num_threads(int threads) __attribute__((weak));

namespace {

[[maybe_unused]] const bool one_blas_thread = [] {
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  return true;
}();

}  // namespace
