#pragma once
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

/// Random numbers of one seed.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : generator_(seed) {}

  int between(int least, int most) { return std::uniform_int_distribution<int>(least, most)(generator_); }
  double uniform(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(generator_);
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  double magnitude(double least_power, double most_power) {
    return std::pow(10.0, uniform(least_power, most_power));
  }
  template <class Values>
  auto one_of(const Values& values) {
    return values[static_cast<std::size_t>(between(0, static_cast<int>(values.size()) - 1))];
  }

  /// Names of a trial and a weighting basis that are admissible.
  std::pair<const char*, const char*> pair_of_bases() {
    using Names = std::pair<const char*, const char*>;
    return one_of(std::vector<Names>{{"fourier", "fourier"},
                                     {"fourier", "fourier"},
                                     {"bspline", "bspline"},
                                     {"daubechies6", "daubechies6"},
                                     {"daubechies12", "fourier"},
                                     {"haar", "fourier"},
                                     {"haar", "bspline"}});
  }

 private:
  std::mt19937_64 generator_;
};
