#include "dense_algebra.hpp"
#include "support/oscillator.hpp"
#include "support/rigid_law.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
#include "wavebalance/solvers/time/motion_evaluator.hpp"

// Properties of several contacts from their coupling and its symmetries; tests/pairs compares them with the
// assembled system.
namespace wavebalance::solvers {
namespace {

using testing::LinearContact;

constexpr double chain_frequency = 0.05;  // Hz, above the first resonance of the chain
const Eigen::Vector3d gaps(1.1, 0.2, 0.5);

LinearStructure chain(int contacts) {
  std::mt19937 generator(11);
  LinearStructure result = testing::random_chain(9, generator);
  std::vector<int> dofs{8, 2, 5};
  dofs.resize(static_cast<std::size_t>(contacts));
  result.contact_directions = contact_rows(dofs, result.size());
  return result;
}

std::vector<AnyContactLaw> springs(const std::vector<int>& order) {
  std::vector<AnyContactLaw> laws;
  for (const int c : order) laws.emplace_back(LinearContact{2.0 + c, gaps[c]});
  return laws;
}

CondensedProblem make_problem(TimePair pair, const LinearStructure& structure, double at = chain_frequency,
                              CondensationMethod method = CondensationMethod::automatic) {
  CondensedProblem problem(std::move(pair), structure, testing::cosine_load(), method);
  problem.set_frequency(at);
  return problem;
}

bool every_contact_presses(const CondensedProblem& problem, const Eigen::VectorXd& force) {
  return (force.reshaped(problem.points(), problem.contacts()).colwise().maxCoeff().array() > 0.0).all();
}

class ManyContacts : public ::testing::TestWithParam<int> {
 protected:
  TimePair pair() const { return testing::pair_kinds()[static_cast<std::size_t>(GetParam())]; }
};

void expect_exact_solves(CondensedProblem problem, const ContactLaws& laws) {
  std::mt19937 generator(3);
  ContactSystem system(problem, laws);
  const Eigen::MatrixXd compliance = testing::compliance_matrix(problem);
  for (const double scale : {0.0, 1.0, 2.0}) {
    const Eigen::Index size = problem.samples();
    system.evaluate(scale * testing::random_vector(size, generator));
    const Eigen::MatrixXd jacobian =
        Eigen::MatrixXd::Identity(size, size) + compliance * system.tangent().asDiagonal();
    const Eigen::VectorXd r = testing::random_vector(size, generator),
                          b = testing::random_vector(size, generator),
                          c = testing::random_vector(size, generator);
    Eigen::VectorXd x;
    ASSERT_TRUE(system.factorize());
    system.solve(r, x);
    EXPECT_LE((jacobian * x - r).norm(), 1e-12 * (jacobian.norm() * x.norm() + r.norm()));
    double y = 0.0;
    ASSERT_TRUE(system.factorize_bordered(b, c, 0.7));
    system.solve_bordered(r, -0.4, x, y);
    const double size_of_terms = jacobian.norm() * x.norm() + b.norm() * std::abs(y) + r.norm();
    EXPECT_LE((jacobian * x + b * y - r).norm(), 1e-12 * size_of_terms);
    EXPECT_NEAR(c.dot(x) + 0.7 * y, -0.4, 1e-12 * size_of_terms * c.norm());
    Eigen::MatrixXd bordered(size + 1, size + 1);
    bordered << jacobian, b, c.transpose(), 0.7;
    EXPECT_EQ(system.determinant_sign(), oracle::determinant(bordered) > 0.0 ? 1 : -1);
  }
}

TEST_P(ManyContacts, SolvesInvertTheExplicitMatrix) {
  expect_exact_solves(make_problem(pair(), chain(1)), springs({0}));
  expect_exact_solves(make_problem(pair(), chain(3)), springs({0, 1, 2}));
}

// GMRES keeps a preconditioner of many contacts from one frequency and state to the next.
TEST(ManyContactsSolver, SolvesWithThePreconditionerOfAStateBeforeAsLuDoes) {
  constexpr int contacts = 60;
  std::mt19937 generator(17);
  LinearStructure structure = testing::random_chain(70, generator);
  std::vector<int> dofs(contacts);
  std::iota(dofs.begin(), dofs.end(), 3);
  structure.contact_directions = contact_rows(dofs, structure.size());
  CondensedProblem problem = make_problem(testing::fourier_pair(15, 32), structure);
  ContactSystem by_gmres(problem, LinearContact{2.0, 0.5}), by_lu(problem, LinearContact{2.0, 0.5});
  by_gmres.set_linear_solver(LinearSolver::krylov);
  by_lu.set_linear_solver(LinearSolver::dense);
  const Eigen::VectorXd state = testing::random_vector(problem.samples(), generator),
                        change = testing::random_vector(problem.samples(), generator),
                        b = testing::random_vector(problem.samples(), generator),
                        r = testing::random_vector(problem.samples(), generator);
  int step = 0;
  for (const double frequency : {0.05, 0.0501, 0.0502, 0.0502, 0.06}) {
    problem.set_frequency(frequency);
    const Eigen::VectorXd u = state + 0.02 * step++ * change, c = (b + 0.1 * step * r) / double(u.size());
    Eigen::VectorXd x, exact;
    double y = 0.0, exact_y = 0.0;
    for (ContactSystem* system : {&by_gmres, &by_lu}) system->evaluate(u);
    ASSERT_TRUE(by_gmres.factorize_bordered(b, c, 0.3) && by_lu.factorize_bordered(b, c, 0.3));
    ASSERT_TRUE(by_gmres.solve_bordered(r, 0.7, x, y, 1e-10));
    by_lu.solve_bordered(r, 0.7, exact, exact_y);
    const double error = 1e-10 * by_lu.condition() * exact.norm();
    EXPECT_LE((x - exact).norm(), error) << frequency;
    EXPECT_NEAR(y, exact_y, error);
    if (step > 2) {
      EXPECT_EQ(by_gmres.determinant_sign(), by_lu.determinant_sign()) << frequency;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PairKinds, ManyContacts, ::testing::Range(0, testing::pair_kind_count));

// Two uncoupled oscillators, in one structure and separately; the contact of `first` comes first.
struct Uncoupled {
  testing::Oscillator first, second;
  LinearStructure both;

  Uncoupled() {
    first.mass = 3.0;
    first.load = -70.0;
    first.stiffness = 1.1e5;
    const auto diagonal = [](double a, double b) -> Eigen::SparseMatrix<double> {
      const Eigen::Matrix2d matrix = Eigen::Vector2d(a, b).asDiagonal();
      return matrix.sparseView();
    };
    both.mass = diagonal(second.mass, first.mass);
    both.damping = diagonal(second.damping, first.damping);
    both.stiffness = diagonal(second.stiffness, first.stiffness);
    both.load = Eigen::Vector2d(second.load, first.load);
    both.contact_directions = contact_rows({1, 0}, both.size());
  }
};

TEST(ManyContactsResponse, OfUncoupledOscillatorsIsThatOfEach) {
  const Uncoupled structures;
  const TimePair pair = testing::fourier_pair(31, 64);
  auto together = make_problem(pair, structures.both, 27.0),
       first = make_problem(pair, structures.first.structure(), 27.0),
       second = make_problem(pair, structures.second.structure(), 27.0);
  const LinearContact law_first{4e4, 0.3e-3}, law_second{9e4, 0.4e-3};
  const PeriodicResponse a =
      testing::solved_response(together, std::vector<AnyContactLaw>{law_first, law_second});
  const PeriodicResponse b = testing::solved_response(first, law_first),
                         c = testing::solved_response(second, law_second);
  EXPECT_TRUE(every_contact_presses(together, a.contact_force));
  EXPECT_LE((a.displacement.head(64) - b.displacement).norm(), 1e-9 * b.displacement.norm());
  EXPECT_LE((a.displacement.tail(64) - c.displacement).norm(), 1e-9 * c.displacement.norm());
  EXPECT_LE((a.coefficients.col(1) - c.coefficients).norm(), 1e-9 * c.coefficients.norm());
}

TEST(ManyContactsResponse, DoesNotDependOnTheOrderOfContacts) {
  const TimePair pair = testing::fourier_pair(31, 64);
  LinearStructure reordered = chain(3);
  reordered.contact_directions = contact_rows({5, 8, 2}, reordered.size());
  auto a = make_problem(pair, chain(3)), b = make_problem(pair, reordered);
  const PeriodicResponse first = testing::solved_response(a, springs({0, 1, 2}));
  const PeriodicResponse second = testing::solved_response(b, springs({2, 0, 1}));
  EXPECT_TRUE(every_contact_presses(a, first.contact_force));
  const Eigen::MatrixXd u = first.displacement.reshaped(64, 3), v = second.displacement.reshaped(64, 3);
  EXPECT_LE((u.col(2) - v.col(0)).norm() + (u.col(0) - v.col(1)).norm() + (u.col(1) - v.col(2)).norm(),
            1e-9 * u.norm());
}

// Over a period the load's work equals the dissipation of dampers and contacts; the products are exact with
// these points.
TEST(ManyContactsResponse, BalancesTheWorkOfLoadDampersAndContacts) {
  const LinearStructure structure = chain(3);
  auto problem = make_problem(testing::fourier_pair(31, 64), structure);
  const PeriodicResponse response = testing::solved_response(problem, springs({0, 1, 2}));
  const Motion field = structure_motion(problem, response, 64);
  double load = 0.0, dampers = 0.0, contacts = 0.0, size = 0.0;
  for (int l = 0; l < 64; ++l) {
    const Eigen::VectorXd v = field.velocity.col(l);
    load += std::cos(2.0 * std::numbers::pi * l / 64) * structure.load.dot(v);
    dampers += v.dot(structure.damping * v);
    for (int c = 0; c < 3; ++c) {
      const double power = response.contact_force[c * 64 + l] * v[structure.selected_dof(c)];
      contacts += power;
      size += std::abs(power);
    }
  }
  EXPECT_GT(size, 0.1 * load) << "the contacts do not matter";
  EXPECT_NEAR(load, dampers + contacts, 1e-9 * (load + size));
  const Eigen::MatrixXd at_contacts = structure.contact_directions * field.displacement;
  EXPECT_LE((at_contacts - by_contact(response.displacement, 3)).norm(), 1e-9 * at_contacts.norm());
  const Motion motion = contact_motion(problem, response, springs({0, 1, 2}), 64);
  EXPECT_LE((motion.displacement - at_contacts).norm(), 1e-9 * at_contacts.norm());
  EXPECT_LE((motion.velocity - structure.contact_directions * field.velocity).norm(),
            1e-9 * field.velocity.norm());
  EXPECT_LE((motion.force - by_contact(response.contact_force, 3)).norm(), 1e-9 * motion.force.norm());
}

TEST(ManyContactsResponse, EnergyHoldsThePotentialOfEveryContact) {
  const LinearStructure structure = chain(3);
  auto problem = make_problem(testing::fourier_pair(31, 64), structure);
  const PeriodicResponse response = forced_response(problem, springs({0, 1, 2}), {});
  const Motion field = structure_motion(problem, response, 64);
  const Eigen::VectorXd stored =
      system_energy(structure, springs({0, 1, 2}), field) - system_energy(structure, AnyContactLaw(), field);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(64);
  for (int c = 0; c < 3; ++c)
    expected += (0.5 / (2.0 + c)) * response.contact_force.segment(c * 64, 64).cwiseAbs2();
  EXPECT_LE((stored - expected).norm(), 1e-9 * stored.norm());
}

TEST(ManyContactsErrors, NameTheNumberFoundAndWanted) {
  auto problem = make_problem(testing::fourier_pair(7, 32), chain(3));
  EXPECT_THROW(forced_response(problem, springs({0, 1}), {}), std::invalid_argument);
  EXPECT_THROW(forced_response(problem, springs({0, 1, 2}), {}, Eigen::VectorXd::Zero(32)),
               std::invalid_argument);
  EXPECT_THROW(ContactLaws(std::vector<AnyContactLaw>{}), std::invalid_argument);
  try {
    ContactSystem(problem, springs({0, 1}));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("2 laws for 3 contacts"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace wavebalance::solvers
