#pragma once
#include <cmath>
#include <cstdint>
#include <random>

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

 private:
  std::mt19937_64 generator_;
};
