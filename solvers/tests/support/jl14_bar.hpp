#pragma once
#include <cmath>
#include <utility>
#include <vector>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers::testing {

/// The clamped bar of [JL14, section 4]: E = 70 GPa, rho = 2700 kg/m^3, S = 25 cm^2, length 1 m, equal
/// two-node elements with consistent mass, C = beta K (beta in s), a load of 250 kN and the contact at the
/// free end.
inline LinearStructure jl14_bar(int elements, double beta) {
  const double length = 1.0 / elements;
  const double stiffness = 70e9 * 25e-4 / length;
  const double mass = 2700.0 * 25e-4 * length / 6.0;
  std::vector<Eigen::Triplet<double>> k, m;
  for (int i = 0; i < elements; ++i) {
    const int shared = i + 1 < elements ? 2 : 1;  // the number of elements that meet at node i
    k.emplace_back(i, i, shared * stiffness);
    m.emplace_back(i, i, 2.0 * shared * mass);
    if (i + 1 == elements) continue;
    for (const auto& [row, col] : {std::pair{i, i + 1}, std::pair{i + 1, i}}) {
      k.emplace_back(row, col, -stiffness);
      m.emplace_back(row, col, mass);
    }
  }
  LinearStructure bar;
  bar.mass.resize(elements, elements);
  bar.stiffness.resize(elements, elements);
  bar.mass.setFromTriplets(m.begin(), m.end());
  bar.stiffness.setFromTriplets(k.begin(), k.end());
  bar.damping = beta * bar.stiffness;
  bar.load = Eigen::VectorXd::Zero(elements);
  bar.load[elements - 1] = 250e3;
  bar.contact_directions = contact_rows({elements - 1}, bar.size());
  return bar;
}

/// The same bar with a massless tip; its neighbour has the mass.
inline LinearStructure massless_tip(LinearStructure bar) {
  const int tip = bar.size() - 1;
  bar.mass.coeffRef(tip - 1, tip - 1) += bar.mass.coeff(tip, tip) + 2.0 * bar.mass.coeff(tip, tip - 1);
  for (const auto& [row, column] : {std::pair{tip, tip}, {tip, tip - 1}, {tip - 1, tip}})
    bar.mass.coeffRef(row, column) = 0.0;
  return bar;
}

/// f_c = max(a_c (exp(alpha (u - g_0)) - 1), 0) [JL14, eq. (5)].
struct ExponentialLaw {
  double constant = 1e8;   ///< a_c, N
  double exponent = 50.0;  ///< alpha, 1/m
  double start = 1e-3;     ///< g_0, m

  double force(double u) const { return u > start ? constant * std::expm1(exponent * (u - start)) : 0.0; }
  double tangent(double u) const {
    return u >= start ? constant * exponent * std::exp(exponent * (u - start)) : 0.0;
  }
  double potential(double u) const {
    return u > start ? constant * (std::expm1(exponent * (u - start)) / exponent - (u - start)) : 0.0;
  }
  double gap() const { return start; }
};

/// One column of [JL14, Table 1] with figures of its periodic response at the tip, from a shooting
/// computation made independently of this code (self-error 2e-9 in case 1, 2e-8 in case 2).
struct Jl14Case {
  double frequency_hz;          ///< Hz
  double beta;                  ///< s
  ExponentialLaw law;           ///< m, N
  double max_displacement;      ///< m
  double max_abs_displacement;  ///< m
  double rms_displacement;      ///< m
  double max_force_ratio;       ///< contact force over the load's amplitude
  double contact_fraction;      ///< of the period

  LinearStructure structure(int elements = 25) const { return jl14_bar(elements, beta); }
};

inline const Jl14Case jl14_case_1{150.0,  1e-4,  {1e8, 50.0, 1e-3}, 1.014506e-3, 1.438608e-3, 9.316321e-4,
                                  0.2902, 0.2396};
inline const Jl14Case jl14_case_2{1275.0, 5e-6,  {1e8, 20.0, 14.5e-3}, 15.20671e-3, 16.26369e-3, 11.47116e-3,
                                  5.694,  0.1069};

}  // namespace wavebalance::solvers::testing
