// Laws whose force depends on the velocity: R, J and its solves, and responses against independent solutions.

#include <functional>

#include "linalg/dense.hpp"
#include "support/newton_checks.hpp"
#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/contact/hunt_crossley_law.hpp"
#include "wavebalance/contact/kelvin_voigt_law.hpp"
#include "wavebalance/solvers/continuation/arc_length.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::solvers {
namespace {

// A viscous damper of a user's own, which acts everywhere.
struct Damper {
  double force(double, double v) const { return c * v; }
  double tangent(double, double) const { return 0.0; }
  double damping(double, double) const { return c; }
  double potential(double) const { return 0.0; }
  double gap() const { return 0.0; }
  double c = 0.3;
};
static_assert(ContactLaw<Damper> && DependsOnVelocity<Damper>);

// A force that is smooth in displacement and velocity, with slopes of either sign.
struct Curved {
  double force(double u, double v) const { return 0.4 * u * u * u + 0.2 * v * (1.0 + u) + 0.1 * v * v * v; }
  double tangent(double u, double v) const { return 1.2 * u * u + 0.2 * v; }
  double damping(double u, double v) const { return 0.2 * (1.0 + u) + 0.3 * v * v; }
  double potential(double u) const { return 0.1 * u * u * u * u; }
  double gap() const { return 0.0; }
};

// The same beyond a displacement.
struct CurvedBeyond {
  double from = 0.0;
  bool acts(double u) const { return u > from; }
  double force(double u, double v) const { return acts(u) ? Curved{}.force(u, v) : 0.0; }
  double tangent(double u, double v) const { return acts(u) ? Curved{}.tangent(u, v) : 0.0; }
  double damping(double u, double v) const { return acts(u) ? Curved{}.damping(u, v) : 0.0; }
  double potential(double u) const {
    return acts(u) ? Curved{}.potential(u) - Curved{}.potential(from) : 0.0;
  }
  double gap() const { return from; }
};

// One that acts at all samples, more than the motions have coefficients, and one that acts at a quarter of
// them.
std::vector<AnyContactLaw> everywhere_and_at_few_samples(Eigen::VectorXd motion) {
  const Eigen::Index quarter = motion.size() / 4;
  std::sort(motion.begin(), motion.end(), std::greater<>());
  return {Curved{}, CurvedBeyond{0.5 * (motion[quarter] + motion[quarter + 1])}};
}

std::vector<TimePair> smooth_pairs() {
  std::vector<TimePair> pairs;
  for (TimePair& pair : testing::pair_kinds())
    if (pair.trial().pointwise_derivatives() >= 1) pairs.push_back(std::move(pair));
  return pairs;
}

// With the strong form damping term and contact force have the same sums over points.
TEST(VelocityLaw, ADamperIsTheDampingOfTheStructure) {
  std::mt19937 generator(3);
  const LinearStructure plain = testing::random_chain(4, generator);
  LinearStructure damped = plain;
  damped.damping +=
      0.3 * Eigen::SparseMatrix<double>(plain.contact_directions.transpose() * plain.contact_directions);
  const spectral::FourierBasis fourier(7);
  const testing::CubicBasis cubic{8};
  for (const TimePair& pair : {testing::fourier_pair(7, 28), testing::fourier_pair(7, 30),
                               testing::make_pair(cubic, cubic, 32, Formulation::strong),
                               testing::fourier_pair(8, 32, NyquistCoefficient::drop, 0.5)}) {
    CondensedProblem with_law(pair, plain, testing::cosine_load()),
        with_damping(pair, damped, testing::cosine_load());
    with_law.set_frequency(0.13);
    with_damping.set_frequency(0.13);
    const PeriodicResponse response = testing::solved_response(with_law, Damper{});
    EXPECT_LE(response.iterations, 2);
    EXPECT_LE((response.displacement - with_damping.linear_response()).norm(),
              1e-10 * response.displacement.norm());
  }
}

class VelocitySystem : public ::testing::Test {
 protected:
  explicit VelocitySystem() : generator_(7) {
    LinearStructure chain = testing::random_chain(5, generator_);
    chain.contact_directions = contact_rows({1, 3}, 5);
    structure_ = chain;
  }

  CondensedProblem problem(const TimePair& pair) {
    CondensedProblem problem(pair, structure_, testing::cosine_load());
    problem.set_frequency(0.17);
    return problem;
  }
  // A motion of the trial functions, as all u_0 - K f are.
  Eigen::VectorXd motion(CondensedProblem& problem) {
    Eigen::VectorXd moved;
    problem.apply(testing::random_vector(problem.samples(), generator_), moved);
    return problem.linear_response() - moved;
  }

  std::mt19937 generator_;
  LinearStructure structure_;
};

TEST_F(VelocitySystem, TheSolveInvertsTheDerivativeOfTheResidual) {
  for (const TimePair& pair : smooth_pairs()) {
    CondensedProblem problem = this->problem(pair);
    const Eigen::VectorXd u = motion(problem);
    for (const AnyContactLaw& law : everywhere_and_at_few_samples(u)) {
      ContactSystem system(problem, law);
      testing::expect_solve_inverts_derivative(system, u, generator_, 1e-6);
    }
  }
}

TEST_F(VelocitySystem, TheBorderedSolveHasTheResidualAndTheSignOfTheWholeMatrix) {
  CondensedProblem problem = this->problem(testing::fourier_pair(7, 12));
  const Eigen::VectorXd u = motion(problem);
  const std::vector<AnyContactLaw> laws = everywhere_and_at_few_samples(u);
  const int size = problem.samples();
  for (int trial = 0; trial < 12; ++trial) {
    ContactSystem system(problem, laws[std::size_t(trial % 2)]);
    system.evaluate(u);
    Eigen::MatrixXd whole(size + 1, size + 1);
    for (int l = 0; l < size; ++l) {  // J, column by column by central differences
      const double step = 1e-6;
      system.evaluate(u + step * Eigen::VectorXd::Unit(size, l));
      const Eigen::VectorXd ahead = system.residual();
      system.evaluate(u - step * Eigen::VectorXd::Unit(size, l));
      whole.col(l).head(size) = (ahead - system.residual()) / (2.0 * step);
    }
    const Eigen::VectorXd b = testing::random_vector(size, generator_),
                          c = testing::random_vector(size, generator_);
    const Eigen::VectorXd r = testing::random_vector(size, generator_);
    whole.col(size).head(size) = b;
    whole.row(size).head(size) = c.transpose();
    whole(size, size) = 0.3;
    system.evaluate(u);
    ASSERT_TRUE(system.factorize_bordered(b, c, 0.3));
    EXPECT_EQ(system.determinant_sign(), detail::Lu<double>(whole).determinant_sign());
    Eigen::VectorXd x, all(size + 1);
    double y = 0.0;
    ASSERT_TRUE(system.solve_bordered(r, 0.7, x, y));
    all << x, y;
    Eigen::VectorXd right(size + 1);
    right << r, 0.7;
    EXPECT_LE((whole * all - right).norm(), 1e-5 * (right.norm() + all.norm()));
  }
}

TEST_F(VelocitySystem, SolutionsByGmresAndByLuAreEqual) {
  for (const TimePair& pair : {testing::fourier_pair(31, 128), testing::pair_kinds(32, 128)[5]}) {
    CondensedProblem problem = this->problem(pair);
    const Eigen::VectorXd u = motion(problem);
    for (const AnyContactLaw& law : everywhere_and_at_few_samples(u)) {
      ContactSystem system(problem, law);
      system.evaluate(u);
      testing::expect_gmres_equals_lu(system, problem.samples(), generator_);
    }
  }
}

TEST_F(VelocitySystem, TheSlopeByFrequencyIsTheDerivative) {
  for (const TimePair& pair : smooth_pairs()) {
    CondensedProblem problem = this->problem(pair);
    ContactSystem system(problem, Curved{});
    const Eigen::VectorXd u = motion(problem);
    const FrequencyParameter frequency;
    const double f = 0.17, step = 1e-6;
    frequency.set(system, f);
    system.evaluate(u);
    Eigen::VectorXd slope;
    frequency.slope(system, slope);
    frequency.set(system, f + step);
    system.evaluate(u);
    const Eigen::VectorXd ahead = system.residual();
    frequency.set(system, f - step);
    system.evaluate(u);
    EXPECT_LE(((ahead - system.residual()) / (2.0 * step) - slope).norm(), 1e-5 * slope.norm());
  }
}

TEST(VelocityLaw, IsRefusedWhereTheVelocityHasNoValuesAtPoints) {
  const spectral::FourierBasis fourier(8);
  CondensedProblem problem(testing::make_pair(testing::HaarBasis{8}, fourier, 32),
                           testing::unit_oscillator(0.1, 1.0), testing::cosine_load());
  problem.set_frequency(0.2);
  EXPECT_THROW(forced_response(problem, Damper{}, {}), std::invalid_argument);
  CondensedProblem smooth = testing::fourier_problem(testing::unit_oscillator(0.1, 1.0), 7, 32, 0.2);
  ForcedResponseOptions force;
  force.form = ContactForm::force;
  EXPECT_THROW(forced_response(smooth, Damper{}, force), std::invalid_argument);
}

// The velocity is one of the weighting functions of harmonic balance: the work of the load is the loss in the
// damper of the structure and in contact, to rounding.
TEST(VelocityLaw, TheWorkOfTheLoadIsWhatStructureAndContactDissipate) {
  const double damping = 0.1, load = 0.8, frequency = 0.2;
  const LinearStructure oscillator = testing::unit_oscillator(damping, load);
  const contact::HuntCrossleyLaw law(10.0, 1.5, 2.0, 0.3);
  CondensedProblem problem = testing::fourier_problem(oscillator, 63, 256, frequency);
  const PeriodicResponse response = testing::solved_response(problem, law);
  const Motion motion = contact_motion(problem, response, law, 256);
  const Eigen::ArrayXd v = motion.velocity.row(0).transpose().array();
  const Eigen::ArrayXd phase = Eigen::ArrayXd::LinSpaced(256, 0.0, 255.0) * (two_pi / 256.0);
  const double period = 1.0 / frequency;
  const double work = period * (load * phase.cos() * v).mean();
  const double lost = period * (damping * v.square()).mean();
  const double in_contact = period * (motion.force.row(0).transpose().array() * v).mean();
  EXPECT_GT(in_contact, 0.05 * work);
  EXPECT_NEAR(work, lost + in_contact, 1e-9 * work);
}

}  // namespace
}  // namespace wavebalance::solvers
