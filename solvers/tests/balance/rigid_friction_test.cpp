// Balances with rigid Coulomb friction at contacts without mass, which no structure of scenes has: at the end
// of a spring against event-driven exact motions of the elastic slider.

#include <utility>

#include "support/friction_scenes.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionScene;

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
    CondensedProblem problem = testing::fourier_problem(rigid.structure, 63, 1024, rigid.frequency());
    const PeriodicResponse response = testing::solved_response(problem, rigid.contact_laws());
    const Eigen::VectorXd mass =
        response.displacement.tail(1024) + response.contact_force.tail(1024) / one.kt;
    EXPECT_NEAR(std::abs(first_harmonic(mass)), one.amplitude, 3e-4 * one.amplitude);
  }
}

TEST(RigidFriction, AtAContactWithMassIsRefused) {
  FrictionScene scene = testing::slider_on_oscillator(2.0, 1.0, 1.2);
  scene.laws = {contact::CoulombLaw({1.0, std::numeric_limits<double>::infinity(), 1.0})};
  CondensedProblem problem = testing::fourier_problem(scene.structure, 15, 64, scene.frequency());
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
