#pragma once
#include <functional>

namespace wavebalance::bench {

/// Bytes by which `work` raises the largest resident memory of a process of its own (fork), whatever was
/// freed before. NaN when `work` throws or the process cannot be made. Pages of 4096 bytes are counted.
double peak_bytes(const std::function<void()>& work);

}  // namespace wavebalance::bench
