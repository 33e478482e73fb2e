// Responses with elastic Coulomb friction against event-driven exact motions: first harmonic and friction
// work of oscillators, two masses, a chain with two contacts, a beam, contact with lift-off, slip in a plane.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "support/friction_scenes.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionScene;

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

struct Row {
  std::string name;
  FrictionScene scene;
  int compared;  // row of the amplitude
  double amplitude, degrees, work;
};

// Of event-driven integrations with residuals of their period map below 1e-11.
std::vector<Row> rows() {
  using namespace testing;
  return {{"Jenkins 1", slider_on_oscillator(2.0, 1.0, 1.0), 0, 15.24880669, 78.03919810, 57.20200604},
          {"Jenkins 2", slider_on_oscillator(2.0, 1.0, 1.2), 0, 5.002826509, 138.47166233, 16.12103657},
          {"Jenkins 3", slider_on_oscillator(1.5, 1.0, 1.3), 0, 2.877360723, 137.01667201, 7.553103559},
          {"Jenkins 4", slider_on_oscillator(0.5, 1.0, 1.41), 0, 1.356058056, 121.76679083, 1.403619588},
          {"Jenkins 5", slider_on_oscillator(2.0, 1.0, 0.45), 0, 1.097855263, 4.95798686, 0.4751676217},
          {"Jenkins 6", slider_on_oscillator(1.5, 10.0, 1.1), 0, 3.283576885, 107.75333803, 12.87055849},
          {"Jenkins 7", slider_on_oscillator(2.0, 10.0, 0.35), 0, 1.922715379, 34.20697379, 6.517261824},
          {"masses 1", rubbing_masses(1.0, 20.0, 1.0, 1.1), 0, 0.3190945734, 88.87064027, 1.243657049},
          {"masses 2", rubbing_masses(1.0, 2.0, 0.3, 1.0), 0, 15.49106365, 88.03905311, 18.42165955},
          {"masses 3", rubbing_masses(1.0, 2.0, 0.3, 1.7), 0, 2.410075263, -131.91800580, 2.71834876},
          {"masses 4", rubbing_masses(1.0, 2.0, 0.3, 0.6), 0, 0.3837520286, 30.77841669, 0.3501968699},
          {"masses 5", rubbing_masses(0.3, 20.0, 1.0, 1.4), 0, 0.2490895418, 166.60129865, 0.9009964397},
          {"lift-off 1", lift_off(2.0, 2.0, 0.6, 0.5, 3.0), 1, 0.8394928991, 36.26958233, 0.08956782539},
          {"lift-off 2", lift_off(2.0, 0.3, 0.8, 0.5, 3.6), 1, 0.8480504295, 137.81003911, 0.0867303503},
          {"lift-off 3", lift_off(1.0, 1.0, 0.6, 0.5, 2.4), 1, 0.16760139, 16.55471259, 0.009501358651},
          {"lift-off 4", lift_off(3.0, 3.0, 0.6, 0.3, 4.5), 1, 0.1494001728, 87.36462453, 0.16813445},
          {"lift-off 5", lift_off(2.0, 2.0, 0.6, 0.5, 5.2), 1, 0.09885903968, 148.48560834, 0.07204846169},
          {"beam 1", cantilever(200.0, 1e7, 500.0, 21.0), 0, 0.0002213141966, 103.11964394, 0.3432899534},
          {"beam 2", cantilever(200.0, 1e7, 500.0, 23.0), 0, 0.0001398661067, 130.18112343, 0.1810996299},
          {"beam 3", cantilever(1000.0, 1e7, 500.0, 30.0), 0, 0.0001678063563, 171.65973218, 0.23311738},
          {"beam 4", cantilever(200.0, 1e8, 300.0, 25.0), 0, 5.617511121e-05, 142.61810670, 0.06321740761},
          {"chain 1", chain_of_three(6.0, 1.0), 0, 5.457548875, 169.30886378, 23.90822297},
          {"chain 2", chain_of_three(3.0, 0.85), 0, 6.92202665, 151.41079665, 36.60300851},
          {"plane 1", slip_in_a_plane(0.4, 1.1), 0, 3.062298476, 119.045638, 5.86809935},
          {"plane 2", slip_in_a_plane(0.5, 1.6), 0, 0.702498735, 158.844637, 2.31546099},
          {"plane 3", slip_in_a_plane(0.6, 0.6), 0, 0.823732656, 41.523253, 1.98552060}};
}

std::complex<double> exact_of(const Row& row) {
  return std::polar(row.amplitude, row.degrees * std::numbers::pi / 180.0);
}

// The error of the balance is that of its functions: at 63 the worst row, a stiff slider, has 1.6e-4.
TEST(Friction, HasTheHarmonicAndTheWorkOfItsExactMotions) {
  for (const Row& row : rows()) {
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
  for (const Row& row : rows()) {
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
