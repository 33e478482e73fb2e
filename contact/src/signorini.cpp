#include "wavebalance/contact/signorini.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#include "checks.hpp"

namespace wavebalance::contact {
namespace {

double largest_magnitude(std::span<const double> values) {
  double largest = 0.0;
  for (double value : values) largest = larger(largest, std::abs(value));
  return largest;
}

SignoriniResidual residual(double g, double force, double c) {
  const double trial = force + c * g;
  if (std::isnan(trial)) return {trial, trial, trial};
  if (trial >= 0.0) return {-c * g, -c, 0.0};
  return {force, 0.0, 1.0};
}

}  // namespace

void gap_function(std::span<const double> displacement, std::span<const double> gap, std::span<double> g) {
  require_length("gap_function", "g", g.size(), displacement.size());
  if (gap.size() != 1) require_length("gap_function", "gap", gap.size(), displacement.size());
  for (std::size_t i = 0; i < g.size(); ++i) g[i] = displacement[i] - gap[gap.size() == 1 ? 0 : i];
}

double max_penetration(std::span<const double> g) {
  double penetration = 0.0;
  for (double value : g) penetration = larger(penetration, value);
  return penetration;
}

double min_force(std::span<const double> force) {
  double negative = -std::numeric_limits<double>::infinity();
  for (double value : force) negative = larger(negative, -value);
  return -negative;
}

double complementarity(std::span<const double> g, std::span<const double> force) {
  require_length("complementarity", "force", force.size(), g.size());
  const double length = largest_magnitude(g), strength = largest_magnitude(force);
  if (length == 0.0 || strength == 0.0) return 0.0;
  double product = 0.0;  // scaled first: neither overflows nor vanishes
  for (std::size_t i = 0; i < g.size(); ++i)
    product = larger(product, std::abs((force[i] / strength) * (g[i] / length)));
  return product;
}

SignoriniMeasures signorini_measures(std::span<const double> g, std::span<const double> force) {
  const double product = complementarity(g, force);
  return {max_penetration(g), larger(0.0, -min_force(force)), product};
}

SignoriniResidual signorini_residual(double g, double force, double c) {
  require_positive("signorini_residual", "c", c);
  return residual(g, force, c);
}

void signorini_residual(std::span<const double> g, std::span<const double> force, double c,
                        std::span<double> value, std::span<double> by_gap, std::span<double> by_force) {
  require_positive("signorini_residual", "c", c);
  require_length("signorini_residual", "force", force.size(), g.size());
  require_length("signorini_residual", "value", value.size(), g.size());
  require_length("signorini_residual", "by_gap", by_gap.size(), g.size());
  require_length("signorini_residual", "by_force", by_force.size(), g.size());
  for (std::size_t i = 0; i < g.size(); ++i) {
    const SignoriniResidual one = residual(g[i], force[i], c);
    value[i] = one.value;
    by_gap[i] = one.by_gap;
    by_force[i] = one.by_force;
  }
}

void signorini_projection(std::span<const double> g, std::span<const double> force, double c,
                          std::span<double> projected) {
  require_positive("signorini_projection", "c", c);
  require_length("signorini_projection", "force", force.size(), g.size());
  require_length("signorini_projection", "projected", projected.size(), g.size());
  for (std::size_t i = 0; i < g.size(); ++i) projected[i] = larger(0.0, force[i] + c * g[i]);
}

}  // namespace wavebalance::contact
