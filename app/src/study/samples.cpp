#include "study/samples.hpp"

#include <gsl/gsl_qrng.h>

#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace wavebalance::app {
namespace {

/// In [0, 1), with all 53 bits. The distributions of the standard library differ between its implementations.
double uniform(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

/// 0..size-1 in random order [D. E. Knuth, The Art of Computer Programming 2, algorithm 3.4.2 P].
std::vector<int> random_order(int size, std::mt19937_64& generator) {
  std::vector<int> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t last = order.size(); last > 1; --last) {
    const auto other = static_cast<std::size_t>(uniform(generator) * static_cast<double>(last));
    std::swap(order[last - 1], order[other]);
  }
  return order;
}

}  // namespace

std::vector<double> sobol_points(int runs, int dimension) {
  if (dimension < 1 || dimension > max_sobol_dimension)
    throw std::invalid_argument("sobol_points: dimension is " + std::to_string(dimension) +
                                "; it must be in 1.." + std::to_string(max_sobol_dimension));
  const std::unique_ptr<gsl_qrng, void (*)(gsl_qrng*)> sequence(
      gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(dimension)), gsl_qrng_free);
  const auto width = static_cast<std::size_t>(dimension);
  std::vector<double> points(static_cast<std::size_t>(runs) * width);
  for (std::size_t begin = 0; begin < points.size(); begin += width)
    gsl_qrng_get(sequence.get(), points.data() + begin);
  return points;
}

std::vector<double> latin_hypercube_points(int runs, int dimension, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  const auto width = static_cast<std::size_t>(dimension), size = static_cast<std::size_t>(runs);
  std::vector<double> points(size * width);
  for (std::size_t j = 0; j < width; ++j) {
    const std::vector<int> strata = random_order(runs, generator);
    for (std::size_t i = 0; i < size; ++i) points[i * width + j] = (strata[i] + uniform(generator)) / runs;
  }
  return points;
}

}  // namespace wavebalance::app
