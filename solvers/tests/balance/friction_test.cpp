// Responses with elastic Coulomb friction against event-driven exact motions: first harmonic and friction
// work of oscillators, two masses, a chain with two contacts, a beam, contact with lift-off, slip in a plane.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "support/friction_scenes.hpp"
#include "support/friction_table.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers {
namespace {

using testing::exact_of, testing::FrictionScene;
using Row = testing::FrictionRow;

struct Solved {
  PeriodicResponse response;
  double work = 0.0;
  std::vector<contact::FrictionPeriod> contacts;
  Eigen::VectorXd row(int index, int points) const {
    return response.displacement.segment(Eigen::Index(index) * points, points);
  }
};

Solved solve(const FrictionScene& scene, const TimePair& pair) {
  CondensedProblem problem(pair, scene.structure, testing::cosine_load());
  problem.set_frequency(scene.frequency());
  Solved solved;
  solved.response = forced_response(problem, scene.contact_laws(), {});
  Eigen::Index row = 0;
  for (const contact::CoulombLaw& law : scene.laws) {
    const Eigen::Index first = row * problem.points();
    solved.contacts.push_back(law.over_period(
        problem.points(),
        {solved.response.displacement.data() + first, std::size_t(law.rows() * problem.points())}, false));
    solved.work += solved.contacts.back().work;
    row += law.rows();
  }
  return solved;
}

// The error of the balance is that of its functions: at 63 the worst row, a stiff slider, has 1.6e-4.
TEST(Friction, HasTheHarmonicAndTheWorkOfItsExactMotions) {
  for (const Row& row : testing::friction_rows()) {
    // Slip in a plane remembers many samples, all of which are then unknowns of Newton's system.
    const int points = row.scene.laws.front().tangents() == 1 ? 1024 : 256;
    const TimePair fourier = testing::fourier_pair(63, points),
                   spline = testing::make_pair(testing::CubicBasis{64}, testing::CubicBasis{64}, points);
    const double of_points = points == 256 ? 5e-4 : 2e-4;  // of second order in their number
    for (const auto& [pair, allowed] : {std::pair(fourier, of_points), std::pair(spline, 1e-3)}) {
      const Solved solved = solve(row.scene, pair);
      ASSERT_TRUE(solved.response.converged()) << row.name << ' ' << to_string(solved.response.status);
      EXPECT_LE(solved.response.iterations, 20) << row.name;
      EXPECT_LE(std::abs(testing::first_harmonic(solved.row(row.compared, points)) - exact_of(row)),
                allowed * row.amplitude)
          << row.name;
      EXPECT_NEAR(solved.work, row.work, allowed * row.work) << row.name;
    }
  }
}

TEST(Friction, HasThemToFiveDigitsWithEnoughFunctions) {
  constexpr int points = 4096;
  const TimePair pair = testing::fourier_pair(255, points);
  for (const Row& row : testing::friction_rows()) {
    if (row.scene.laws.front().tangents() > 1) continue;
    const Solved solved = solve(row.scene, pair);
    ASSERT_TRUE(solved.response.converged()) << row.name << ' ' << to_string(solved.response.status);
    EXPECT_LE(std::abs(testing::first_harmonic(solved.row(row.compared, points)) - exact_of(row)),
              1e-5 * row.amplitude)
        << row.name;
    EXPECT_NEAR(solved.work, row.work, 1e-4 * row.work) << row.name;
  }
}

// The slider of an oscillator with its spring k_t as a part of the structure: the contact, at its end, has no
// mass, and friction there is rigid. The motion of the mass is u + f / k_t.
FrictionScene with_spring_in_structure(const FrictionScene& elastic, double kt) {
  const Eigen::Index n = elastic.structure.size();
  const auto grown = [&](const Eigen::SparseMatrix<double>& of) {
    Eigen::MatrixXd larger = Eigen::MatrixXd::Zero(n + 1, n + 1);
    larger.topLeftCorner(n, n) = Eigen::MatrixXd(of);
    return larger;
  };
  Eigen::MatrixXd stiffness = grown(elastic.structure.stiffness);
  stiffness(0, 0) += kt;
  stiffness(n, n) += kt;
  stiffness(0, n) -= kt;
  stiffness(n, 0) -= kt;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(elastic.structure.contacts(), n + 1);
  rows.leftCols(n) = Eigen::MatrixXd(elastic.structure.contact_directions);
  rows.row(rows.rows() - 1).setZero();
  rows(rows.rows() - 1, n) = 1.0;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(n + 1);
  load.head(n) = elastic.structure.load;
  const contact::CoulombLaw& law = elastic.laws.front();
  const contact::FrictionParameters rigid{law.friction(), std::numeric_limits<double>::infinity(),
                                          law.raw_normal_force(0.0)};
  FrictionScene scene = testing::friction_scene(
      grown(elastic.structure.mass), grown(elastic.structure.damping), stiffness, rows, load, elastic.omega,
      {law.normal_rows() > 0 ? contact::CoulombLaw(rigid, contact::LinearLaw(law.normal_stiffness(), 0.0))
                             : contact::CoulombLaw(rigid)});
  for (PeriodicForce force : elastic.structure.forces) {
    force.shape.conservativeResize(n + 1);
    force.shape[n] = 0.0;
    scene.structure.forces.push_back(std::move(force));
  }
  return scene;
}

TEST(RigidFriction, AtTheEndOfASpringHasTheMotionsOfTheElasticSlider) {
  using namespace testing;
  struct Case {
    FrictionScene scene;
    double kt, amplitude;
  };
  for (const Case& one : {Case{slider_on_oscillator(2.0, 1.0, 1.0), 1.0, 15.24880669},
                          {slider_on_oscillator(2.0, 1.0, 1.2), 1.0, 5.002826509},
                          {slider_on_oscillator(1.5, 1.0, 1.3), 1.0, 2.877360723},
                          {slider_on_oscillator(0.5, 1.0, 1.41), 1.0, 1.356058056},
                          {slider_on_oscillator(1.5, 10.0, 1.1), 10.0, 3.283576885},
                          {rubbing_masses(1.0, 20.0, 1.0, 1.1), 20.0, 0.3190945734},
                          {rubbing_masses(1.0, 2.0, 0.3, 1.7), 2.0, 2.410075263},
                          {lift_off(2.0, 2.0, 0.6, 0.5, 3.0), 5.0, 0.8394928991}}) {
    const FrictionScene rigid = with_spring_in_structure(one.scene, one.kt);
    CondensedProblem problem(testing::fourier_pair(63, 1024), rigid.structure, testing::cosine_load());
    problem.set_frequency(rigid.frequency());
    const PeriodicResponse response = forced_response(problem, rigid.contact_laws(), {});
    ASSERT_TRUE(response.converged()) << one.amplitude << " " << to_string(response.status);
    const Eigen::VectorXd mass =
        response.displacement.tail(1024) + response.contact_force.tail(1024) / one.kt;
    EXPECT_NEAR(std::abs(first_harmonic(mass)), one.amplitude, 3e-4 * one.amplitude);
  }
}

TEST(RigidFriction, AtAContactWithMassIsRefused) {
  FrictionScene scene = testing::slider_on_oscillator(2.0, 1.0, 1.2);
  scene.laws = {contact::CoulombLaw({1.0, std::numeric_limits<double>::infinity(), 1.0})};
  CondensedProblem problem(testing::fourier_pair(15, 64), scene.structure, testing::cosine_load());
  problem.set_frequency(scene.frequency());
  const auto solve = [&](ContactForm form) {
    ForcedResponseOptions options;
    options.form = form;
    return testing::refusal([&] { forced_response(problem, scene.contact_laws(), options); });
  };
  EXPECT_NE(solve(ContactForm::automatic).find("contacts without mass"), std::string::npos);
  EXPECT_NE(solve(ContactForm::displacement).find("force form"), std::string::npos);
}

}  // namespace
}  // namespace wavebalance::solvers
