#include <rapidcheck/gtest.h>

#include "support/condensation_cases.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {
namespace {

using testing::CubicBasis;
using testing::HaarBasis;
using testing::random_vector;
using Complex = std::complex<double>;

std::mt19937 random_generator() { return std::mt19937(*rc::gen::arbitrary<unsigned>()); }

// One of the kinds of pair_kinds() with random sizes.
TimePair random_pair() {
  const int functions = *rc::gen::inRange(3, 13);
  const int points = functions * *rc::gen::inRange(1, 6);
  const int kind = *rc::gen::inRange(0, testing::pair_kind_count);
  if (kind == 0)
    return testing::fourier_pair(2 * functions + 1, 2 * functions + 1 + *rc::gen::inRange(0, 40));
  if (kind == 1) return testing::fourier_pair(2 * functions, 2 * functions + *rc::gen::inRange(0, 40));
  return testing::pair_kinds(functions, points)[static_cast<std::size_t>(kind)];
}

Eigen::VectorXcd real_spectrum(int points, std::mt19937& generator) {
  return translate_spectrum(random_vector(points, generator));
}

// <x, y> over all harmonics of real data of which 0..size/2 are stored.
double inner(const Eigen::VectorXcd& x, const Eigen::VectorXcd& y, int size) {
  double sum = 0.0;
  for (int n = 0; n <= size / 2; ++n)
    sum += (n == 0 || 2 * n == size ? 1.0 : 2.0) * (std::conj(x[n]) * y[n]).real();
  return sum;
}

// A_d[i, j] = <p_i, q_j^(d)> in the strong form, from samples shifted by whole points.
RC_GTEST_PROP(TimePairProperty, InnerProductsAreCirculantWithTheSymbolAsSpectrum, ()) {
  const int functions = *rc::gen::inRange(3, 13), stride = *rc::gen::inRange(1, 6),
            points = functions * stride;
  const int derivative = *rc::gen::inRange(0, 3);
  const bool fourier = *rc::gen::arbitrary<bool>();
  const AnyTimeBasis trial = CubicBasis{functions};
  const AnyTimeBasis weight =
      fourier ? AnyTimeBasis(spectral::FourierBasis(functions)) : AnyTimeBasis(HaarBasis{functions});
  const TimePair pair = testing::make_pair(trial, weight, points, Formulation::strong);
  const Eigen::VectorXd q = trial.samples(points, derivative), p = weight.samples(points, 0);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(functions, functions);
  for (int i = 0; i < functions; ++i)
    for (int j = 0; j < functions; ++j)
      for (int l = 0; l < points; ++l)
        matrix(i, j) +=
            p[(l - i * stride + points) % points] * q[(l - j * stride + points) % points] / points;
  const double scale = matrix.cwiseAbs().maxCoeff() + 1e-300;
  for (int i = 0; i < functions; ++i)
    for (int j = 0; j < functions; ++j)
      RC_ASSERT(std::abs(matrix((i + 1) % functions, (j + 1) % functions) - matrix(i, j)) <= 1e-13 * scale);
  const Eigen::VectorXcd spectrum = translate_spectrum(matrix.col(0));
  RC_ASSERT((spectrum - pair.symbol(derivative)).norm() <= 1e-12 * scale * functions);
}

RC_GTEST_PROP(TranslateIndexProperty, FoldIsTheAdjointOfReplicate, ()) {
  std::mt19937 generator = random_generator();
  const int functions = *rc::gen::inRange(1, 20), points = functions * *rc::gen::inRange(1, 6);
  const AliasMap index{functions, points};
  const Eigen::VectorXcd factor = real_spectrum(points, generator),
                         samples = real_spectrum(points, generator),
                         translates = real_spectrum(functions, generator);
  Eigen::VectorXcd replicated, folded;
  index.replicate(factor, translates, replicated);
  index.fold(factor, samples, folded);
  const double left = inner(replicated, samples, points), right = inner(translates, folded, functions);
  const double scale = replicated.norm() * samples.norm() + translates.norm() * folded.norm();
  RC_ASSERT(std::abs(left - right) <= 1e-12 * scale);
}

// Away from the resonances and at a random frequency; sizes 1..6, contacts 1..3.
CondensedProblem random_problem(TimePair pair, std::mt19937& generator) {
  LinearStructure chain = testing::random_chain(1 + int(generator() % 6), generator);
  chain.contact_directions = testing::random_directions(1 + int(generator() % 3), chain.size(), generator);
  CondensedProblem problem(std::move(pair), chain, testing::cosine_load());
  problem.set_frequency(std::uniform_real_distribution<double>(0.02, 1.0)(generator));
  return problem;
}

RC_GTEST_PROP(CondensedProblemProperty, TransposedProductIsTheAdjoint, ()) {
  std::mt19937 generator = random_generator();
  CondensedProblem problem = random_problem(random_pair(), generator);
  const Eigen::VectorXd f = random_vector(problem.samples(), generator),
                        v = random_vector(problem.samples(), generator);
  Eigen::VectorXd kf, ktv;
  problem.apply(f, kf);
  ContactOperator contact(problem);
  contact.apply_transposed(v, ktv);
  RC_ASSERT(std::abs(kf.dot(v) - f.dot(ktv)) <= 1e-12 * (kf.norm() * v.norm() + f.norm() * ktv.norm()));
}

RC_GTEST_PROP(CondensedProblemProperty, ColumnsAreTheProductsWithUnitVectors, ()) {
  std::mt19937 generator = random_generator();
  CondensedProblem problem = random_problem(random_pair(), generator);
  const int points = problem.points(), period = problem.pair().shift_period();
  ContactOperator contact(problem);
  const Eigen::MatrixXd& columns = contact.columns();
  const int column = *rc::gen::inRange(0, problem.samples()), m = column % points, shift = m - m % period;
  Eigen::VectorXd product;
  problem.apply(Eigen::VectorXd::Unit(problem.samples(), column), product);
  for (int row = 0; row < problem.samples(); ++row) {
    const int moved = row / points * points + (row % points - shift + points) % points;
    RC_ASSERT(std::abs(columns(moved, column / points * period + m % period) - product[row]) <=
              1e-13 * columns.cwiseAbs().maxCoeff());
  }
}

Eigen::VectorXd rolled(const Eigen::VectorXd& v, int shift) {
  Eigen::VectorXd out(v.size());
  for (Eigen::Index l = 0; l < v.size(); ++l) out[(l + shift) % v.size()] = v[l];
  return out;
}

// h_n exp(-2 pi i n j / M): the same load j translates later.
RC_GTEST_PROP(ForcedResponseProperty, ShiftedLoadShiftsTheResponse, ()) {
  std::mt19937 generator = random_generator();
  const TimePair pair = random_pair();
  const int functions = pair.functions();
  RC_PRE(pair.points() % functions == 0);
  const int shift = *rc::gen::inRange(1, functions);
  const LinearStructure chain = testing::random_chain(4, generator);
  Eigen::VectorXcd harmonics(3), later(3);
  harmonics << 0.1, Complex(1.0, 0.3), Complex(-0.2, 0.5);
  for (int n = 0; n < 3; ++n)
    later[n] = harmonics[n] * std::polar(1.0, -2 * std::numbers::pi * n * shift / functions);
  CondensedProblem first(pair, chain, harmonics), second(pair, chain, later);
  first.set_frequency(0.04);
  second.set_frequency(0.04);
  const testing::ExponentialLaw law{0.5, 0.3, 0.5 * first.linear_response().maxCoeff()};
  ForcedResponseOptions options;
  options.form = ContactForm::displacement;  // of the system below
  const PeriodicResponse response = forced_response(first, law, options);
  RC_PRE(response.converged());
  RC_ASSERT(response.contact_force.maxCoeff() > 0.0);
  ContactSystem system(second, law);
  RC_ASSERT(system.evaluate(rolled(response.displacement, shift * (pair.points() / functions))) <= 1e-10);
}

RC_GTEST_PROP(ForcedResponseProperty, OutOfReachOfTheObstacleItIsTheLinearResponseExactly, ()) {
  std::mt19937 generator = random_generator();
  CondensedProblem problem = random_problem(random_pair(), generator);
  testing::ExponentialLaw far{1e8, 50.0, std::numeric_limits<double>::infinity()};
  const PeriodicResponse without = forced_response(problem, AnyContactLaw(), {});
  const PeriodicResponse with = forced_response(problem, far, {});
  RC_ASSERT(without.converged() && with.converged());
  RC_ASSERT(with.displacement == problem.linear_response());
  RC_ASSERT(with.coefficients == without.coefficients);
  RC_ASSERT(with.contact_force.isZero(0.0));
}

// kg, m, s -> kg mass, m length, s time: forces scale with mass length / time^2.
LinearStructure in_units(const LinearStructure& s, double mass, double length, double time) {
  LinearStructure out = s;
  out.mass = s.mass * mass;
  out.damping = s.damping * (mass / time);
  out.stiffness = s.stiffness * (mass / (time * time));
  out.load = s.load * (mass * length / (time * time));
  return out;
}

RC_GTEST_PROP(ForcedResponseProperty, UnitsDoNotMatter, ()) {
  // mm-N-t (mass in t, length in mm), the bar's own scales, and random ones.
  const int system = *rc::gen::inRange(0, 3);
  const auto power = [](int range) {
    return std::pow(10.0, *rc::gen::inRange(-10 * range, 10 * range + 1) / 10.0);
  };
  const double mass = system == 0 ? 1e-3 : system == 1 ? 1.0 / 6.75 : power(4);
  const double length = system == 0 ? 1e3 : system == 1 ? 1.0 / 14.5e-3 : power(4);
  const double time = system == 0 ? 1.0 : system == 1 ? 2 * std::numbers::pi * 1273.147 : power(4);
  const bool second_case = *rc::gen::arbitrary<bool>();
  const testing::Jl14Case& reference = second_case ? testing::jl14_case_2 : testing::jl14_case_1;
  const double force = mass * length / (time * time);
  const TimePair pair = testing::pair_kinds(32, 128)[static_cast<std::size_t>(*rc::gen::element(0, 2, 5))];
  CondensedProblem si(pair, reference.structure(), testing::cosine_load());
  CondensedProblem other(pair, in_units(reference.structure(), mass, length, time), testing::cosine_load());
  si.set_frequency(reference.frequency_hz);
  other.set_frequency(reference.frequency_hz / time);
  const testing::ExponentialLaw law{reference.law.constant * force, reference.law.exponent / length,
                                    reference.law.start * length};
  const PeriodicResponse a = forced_response(si, reference.law, {}), b = forced_response(other, law, {});
  RC_ASSERT(a.converged() && b.converged());
  RC_ASSERT((a.displacement * length - b.displacement).norm() <= 1e-9 * b.displacement.norm());
  RC_ASSERT((a.contact_force * force - b.contact_force).norm() <= 1e-9 * b.contact_force.norm());
}

// The tip's node in the middle of the numbering makes the matrices sparse, not tridiagonal.
RC_GTEST_PROP(CondensationProperty, TridiagonalAndSparseAgree, ()) {
  std::mt19937 generator = random_generator();
  const LinearStructure chain = testing::random_chain(*rc::gen::inRange(4, 15), generator);
  Eigen::PermutationMatrix<Eigen::Dynamic> order(chain.size());
  order.setIdentity();
  std::swap(order.indices()[0], order.indices()[chain.size() - 1]);
  LinearStructure swapped = chain;
  swapped.mass = chain.mass.twistedBy(order);
  swapped.damping = chain.damping.twistedBy(order);
  swapped.stiffness = chain.stiffness.twistedBy(order);
  swapped.load = order * chain.load;
  swapped.contact_directions = contact_rows({order.indices()[chain.selected_dof(0)]}, swapped.size());
  const TimePair pair = random_pair();
  CondensedProblem a(pair, chain, testing::cosine_load()), b(pair, swapped, testing::cosine_load());
  a.set_frequency(0.3);
  b.set_frequency(0.3);
  const Eigen::VectorXd f = random_vector(a.points(), generator);
  Eigen::VectorXd ka, kb;
  a.apply(f, ka);
  b.apply(f, kb);
  RC_ASSERT((ka - kb).norm() <= 1e-10 * ka.norm());
  RC_ASSERT((a.linear_response() - b.linear_response()).norm() <= 1e-10 * a.linear_response().norm());
  RC_ASSERT((a.linear_response_slope() - b.linear_response_slope()).norm() <=
            1e-10 * a.linear_response_slope().norm());
}

}  // namespace
}  // namespace wavebalance::solvers
