#pragma once
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "dense_system.hpp"
#include "pairs.hpp"
#include "wavebalance/contact/rigid_law.hpp"
#include "wavebalance/solvers/response/complementarity.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::pairs {

using solvers::Formulation;
using solvers::InnerProducts;

inline constexpr double tolerance = 1e-10;  // relative, for systems of up to 400 unknowns of condition 1e6

struct Setting {
  Pair pair;
  Formulation formulation;
  InnerProducts products;
};

inline std::string describe(const Setting& s) {
  const char* formulations[] = {"strong", "weak", "distributional"};
  return std::string(s.pair.name) + " " + formulations[static_cast<int>(s.formulation)] + " " +
         (s.products == InnerProducts::exact ? "exact" : "quadrature");
}

inline std::vector<Setting> admissible_settings() {
  std::vector<Setting> settings;
  for (const Pair& pair : table_2)
    for (const auto formulation : {Formulation::strong, Formulation::weak, Formulation::distributional})
      for (const auto products : {InnerProducts::quadrature, InnerProducts::exact}) {
        const auto verdict =
            solvers::admissibility(basis(pair.trial, 8), basis(pair.weight, 8), formulation, products);
        if (verdict.admissible) settings.push_back({pair, formulation, products});
      }
  return settings;
}

// Coefficients of one degree of freedom as spectra over translates, n x (M/2 + 1), and back as n M values.
inline Eigen::VectorXd stacked(const Eigen::MatrixXcd& spectra, int functions) {
  Eigen::VectorXd all(spectra.rows() * functions);
  for (Eigen::Index i = 0; i < spectra.rows(); ++i)
    all.segment(i * functions, functions) = solvers::translate_coefficients(spectra.row(i), functions);
  return all;
}

/// The solvers' symbols against the system of all n M unknowns that the papers assemble.
class Oracle {
 public:
  Oracle(const Setting& setting, const Case& scene, int elements, int functions, int points,
         double sample_offset = 0.0)
      : Oracle(setting, scene.structure(elements), scene.law(), scene.frequency_hz, functions, points,
               sample_offset) {}

  Oracle(const Setting& setting, const solvers::LinearStructure& structure, solvers::ContactLaws laws,
         double frequency_hz, int functions, int points, double sample_offset = 0.0)
      : functions_(functions),
        laws_(std::move(laws)),
        how_(at(sample_offset, setting,
                options(setting.pair, functions, points, setting.products, setting.formulation))),
        problem_(time_pair(setting.pair, functions, how_), structure, cosine_load()),
        dense_(structure, laws_,
               dense::discretise(basis(setting.pair.trial, functions),
                                 weight_basis(setting.pair, functions, how_), how_, cosine_load())) {
    problem_.set_frequency(frequency_hz);
    dense_.set_frequency(frequency_hz);
  }

  void expect_equal_linear_response() {
    const Eigen::VectorXd expected = dense_.linear_response();
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem_.samples());
    const Eigen::VectorXd found = stacked(problem_.full_coefficients(zero), functions_);
    EXPECT_LE((found - expected).norm(), tolerance * expected.norm());
    const Eigen::VectorXd samples = dense_.contact_displacement(expected);
    EXPECT_LE((problem_.linear_response() - samples).norm(), tolerance * samples.norm());
  }

  // R(u) = u - u0 + K f(u) is what G^-1 leaves of the assembled residual at the contact.
  void expect_equal_residual() {
    std::mt19937 generator(7);
    std::normal_distribution<double> normal;
    const Eigen::VectorXd response = dense_.linear_response();
    solvers::ContactSystem system(problem_, laws_);
    for (const double noise : {0.0, 0.3}) {
      const Eigen::VectorXd state =
          response + noise * response.cwiseAbs().maxCoeff() *
                         Eigen::VectorXd::NullaryExpr(response.size(), [&] { return normal(generator); });
      const Eigen::VectorXd expected = dense_.contact_displacement(dense_.solve(dense_.residual(state)));
      system.evaluate(dense_.contact_displacement(state));
      EXPECT_LE((system.residual() - expected).norm(),
                tolerance * (expected.norm() + problem_.linear_response().norm()));
    }
  }

  // Returns whether there was contact.
  bool expect_equal_contact_solution() {
    const solvers::PeriodicResponse response = solvers::forced_response(problem_, laws_, {});
    EXPECT_TRUE(response.converged());
    const Eigen::VectorXd found = stacked(problem_.full_coefficients(response.contact_force), functions_);
    EXPECT_LE(dense_.relative_residual(found), 2.0 * tolerance);  // of two factorisations
    dense::Solution own = dense_.newton(dense_.linear_response());
    // Another solution, or none, may be what Newton finds from afar: then it must find this one from nearby.
    if (!own.converged || (own.coefficients - found).norm() > 1e-3 * found.norm())
      own = dense_.newton(found + 1e-6 * (dense_.linear_response() - found));
    EXPECT_TRUE(own.converged);
    EXPECT_LE((found - own.coefficients).norm(), tolerance * own.coefficients.norm());
    return every_contact_presses(response.contact_force);
  }

  // Against rigid obstacles: the motion that the assembled system has under the forces found, and the law at
  // v - f / epsilon.
  void expect_equal_rigid_solution(const Eigen::VectorXd& gaps) {
    std::vector<solvers::AnyContactLaw> laws;
    for (const double gap : gaps) laws.emplace_back(contact::RigidLaw(gap));
    const auto rigid = solvers::forced_response(problem_, laws, {});
    EXPECT_TRUE(rigid.converged());
    const Eigen::VectorXd expected = dense_.forced_response(rigid.contact_force);
    const Eigen::VectorXd found = stacked(problem_.full_coefficients(rigid.contact_force), functions_);
    EXPECT_LE((found - expected).norm(), tolerance * expected.norm());
    const Eigen::VectorXd u = dense_.contact_displacement(expected);
    EXPECT_LE((u - rigid.displacement).norm(), 10.0 * tolerance * u.norm());
    const double size = problem_.linear_response().cwiseAbs().maxCoeff();
    const int points = problem_.points();
    for (int c = 0; c < gaps.size(); ++c) {
      const Eigen::VectorXd force = rigid.contact_force.segment(c * points, points);
      const Eigen::VectorXd held =
          rigid.unknown.segment(c * points, points) - rigid.series_flexibility[c] * force;
      const auto law = solvers::complementarity(held, force, Eigen::VectorXd::Constant(1, gaps[c]));
      EXPECT_LE(law.max_penetration, tolerance * size);
      EXPECT_GE(law.min_force, 0.0);
      EXPECT_LE(law.product, tolerance);
    }
    EXPECT_TRUE(every_contact_presses(rigid.contact_force));
  }

  bool expect_equal() {
    expect_equal_linear_response();
    expect_equal_residual();
    return expect_equal_contact_solution();
  }

 private:
  // At the middles the alternating B-spline has no product with the alternating Haar function, nor with
  // forces that are constant in each cell: the assembled system has the coefficient zero, and TimePair must
  // drop it.
  static solvers::TimePairOptions at(double sample_offset, const Setting& setting,
                                     solvers::TimePairOptions how) {
    how.sample_offset = sample_offset;
    const bool haar_bspline = setting.pair.trial == Family::haar && setting.pair.weight == Family::bspline;
    if (haar_bspline && sample_offset != 0.0 && setting.products == InnerProducts::quadrature)
      how.nyquist = solvers::NyquistCoefficient::drop;
    return how;
  }

  bool every_contact_presses(const Eigen::VectorXd& force) const {
    return (force.reshaped(problem_.points(), problem_.contacts()).colwise().maxCoeff().array() > 0.0).all();
  }

  int functions_;
  solvers::ContactLaws laws_;
  solvers::TimePairOptions how_;
  solvers::CondensedProblem problem_;
  dense::DenseSystem dense_;
};

// Contacts at the tip, the middle and the root of a bar, each with its own law and gap.
struct Contacts {
  solvers::LinearStructure structure;
  Eigen::VectorXd gaps;
  std::vector<solvers::AnyContactLaw> laws;
};

inline Contacts many_contacts(int count) {
  const Case& scene = cases[0];
  Contacts all{scene.structure(7), Eigen::Vector3d(1e-3, 0.4e-3, 0.1e-3).head(count), {}};
  std::vector<int> dofs{6, 3, 0};
  dofs.resize(static_cast<std::size_t>(count));
  all.structure.contact_directions = solvers::contact_rows(dofs, 7);
  for (int c = 0; c < count; ++c)
    all.laws.emplace_back(contact::ExponentialLaw(1e8, 50.0 * (c + 1), all.gaps[c]));
  return all;
}

}  // namespace wavebalance::pairs
