#pragma once
#include <functional>

namespace wavebalance::bench {

/// Bytes by which `work` raises the largest resident memory of a separate process (fork) in which
/// `warm_up`, the same on a small scale, has brought in the code. NaN when either throws or the process
/// cannot be made. Pages of 4096 bytes are counted.
double peak_bytes(const std::function<void()>& warm_up, const std::function<void()>& work);

}  // namespace wavebalance::bench
