#include "mode_augmented_lagrangian_functional.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

#include "constants.hpp"
#include "wavebalance/contact/multipliers.hpp"

namespace wavebalance::ll10 {
namespace {

constexpr int modes = 3, contacts = 2, highest_harmonic = 2, sample_count = 7;

using First = Eigen::AutoDiffScalar<Eigen::VectorXd>;
using Second = Eigen::AutoDiffScalar<Eigen::Matrix<First, Eigen::Dynamic, 1>>;

Second constant(double value, Eigen::Index size) {
  Second result(First(value, Eigen::VectorXd::Zero(size)));
  result.derivatives().setConstant(size, First(0.0, Eigen::VectorXd::Zero(size)));
  return result;
}

struct State {
  ModeFormulation formulation;
  bool cosine_only;
  unsigned seed;

  friend void PrintTo(const State& state, std::ostream* out) {
    *out << (state.formulation == ModeFormulation::published ? "published" : "consistent")
         << (state.cosine_only ? ", cosine, " : ", full, ") << "seed " << state.seed;
  }
};

// Two contacts, unequal penalties and multipliers, a random motion large enough to touch at some samples.
struct Problem {
  ModalModel model;
  ModeLagrangian lagrangian;
  contact::MultiplierUpdate outer;
  Eigen::VectorXd x;
  double gamma = 0.4;

  explicit Problem(const State& state)
      : model(random_model(state.seed)),
        lagrangian(model, {highest_harmonic, state.cosine_only}, sample_count, state.formulation),
        outer(random(contacts * sample_count, 50.0, 500.0), {80.0}),
        x(Eigen::VectorXd::Random(lagrangian.unknowns())) {
    outer.restart(random(contacts * sample_count, 0.0, 20.0), std::vector<double>{-3.0});
  }

  static ModalModel random_model(unsigned seed) {
    std::srand(seed);
    return {Eigen::Vector3d(1.0, 8.7, 26.0), Eigen::MatrixXd::Random(contacts, modes),
            Eigen::Vector2d(1.0, 0.6)};
  }
  static std::vector<double> random(int count, double low, double high) {
    const Eigen::VectorXd unit = 0.5 * (Eigen::VectorXd::Random(count).array() + 1.0);
    std::vector<double> values;
    for (const double u : unit) values.push_back(low + (high - low) * u);
    return values;
  }

  double wave(int block, int k) const {
    const FourierLayout& layout = lagrangian.layout();
    const double phase = 2.0 * std::numbers::pi * layout.harmonic(block) * k / sample_count;
    return layout.is_sine(block) ? std::sin(phase) : std::cos(phase);
  }

  // L as printed, sum by sum.
  Second value(const std::vector<Second>& a, ModeFormulation formulation) const {
    const Eigen::Index size = x.size();
    const FourierLayout& layout = lagrangian.layout();
    Second k = constant(0.0, size), m = k, norm = k;
    for (int block = 0; block < layout.blocks(); ++block)
      for (int mode = 0; mode < modes; ++mode) {
        const Second& entry = a[static_cast<std::size_t>(modes * block + mode)];
        const Second square = layout.weight(block) * Second(entry * entry);
        const double n = layout.harmonic(block);
        k += model.omega_squared[mode] * square;
        m += n * n * square;
        norm += (formulation == ModeFormulation::published ? 1.0 : n * n) * square;
      }
    Second total = k / m;
    for (int c = 0; c < contacts; ++c)
      for (int time = 0; time < sample_count; ++time) {
        const auto i = static_cast<std::size_t>(c * sample_count + time);
        Second shifted = constant(outer.inequality_shifts()[i] - model.gaps[c], size);
        for (int block = 0; block < layout.blocks(); ++block)
          for (int mode = 0; mode < modes; ++mode)
            shifted += (model.contact_shapes(c, mode) * wave(block, time)) *
                       a[static_cast<std::size_t>(modes * block + mode)];
        if (shifted.value().value() > 0.0)
          total += (0.5 / sample_count * outer.inequality_penalties()[i]) * Second(shifted * shifted);
      }
    const Second pull = Second(0.5 * norm) + constant(outer.equality_shifts()[0] - gamma, size);
    return Second(total + (0.5 * outer.equality_penalties()[0]) * Second(pull * pull));
  }
};

class RandomState : public ::testing::TestWithParam<State> {};

TEST_P(RandomState, GradientAndHessianAgreeWithAutomaticDifferentiation) {
  const Problem p(GetParam());
  const Eigen::Index size = p.x.size();
  std::vector<Second> a;
  for (Eigen::Index i = 0; i < size; ++i) {
    a.push_back(constant(p.x[i], size));
    a.back().value().derivatives()[i] = 1.0;
    a.back().derivatives()[i].value() = 1.0;
  }
  const Second expected = p.value(a, GetParam().formulation);
  contact::MultiplierUpdate outer = p.outer;
  const AugmentedMultipliers multipliers(outer);
  const Eigen::VectorXd gradient = p.lagrangian.gradient(p.x, p.gamma, multipliers);
  const Eigen::MatrixXd hessian = p.lagrangian.hessian(p.x, p.gamma, multipliers);
  const double tolerance = 1e3 * eps * hessian.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < size; ++i) {
    EXPECT_NEAR(gradient[i], expected.value().derivatives()[i], tolerance);
    for (Eigen::Index j = 0; j < size; ++j)
      EXPECT_NEAR(hessian(i, j), expected.derivatives()[i].derivatives()[j], tolerance);
  }
  const Eigen::VectorXd g = p.lagrangian.gap_function(p.x);
  const auto theta = p.outer.inequality_shifts();
  const Eigen::VectorXd shifted = g + Eigen::Map<const Eigen::VectorXd>(theta.data(), g.size());
  EXPECT_LT(shifted.minCoeff(), 0.0);  // both sides of the kink were met
  EXPECT_GT(shifted.maxCoeff(), 0.0);
}

TEST_P(RandomState, FrozenEigenvalueChangesGradientAndItsDerivativeConsistently) {
  const Problem p(GetParam());
  contact::MultiplierUpdate outer = p.outer;
  const AugmentedMultipliers multipliers(outer);
  const auto gradient = [&](const Eigen::VectorXd& x, std::optional<double> frozen) {
    return p.lagrangian.gradient(x, p.gamma, multipliers, frozen);
  };
  const double r = p.lagrangian.quotient().value(p.x), rho = 1.7;
  EXPECT_LE((gradient(p.x, r) - gradient(p.x, {})).norm(), 100 * eps * gradient(p.x, {}).norm());
  const Eigen::VectorXd inertia = p.lagrangian.quotient().mass().apply(p.x);
  const Eigen::VectorXd difference = 2.0 * (r - rho) / p.x.dot(inertia) * inertia;
  EXPECT_LE((gradient(p.x, rho) - gradient(p.x, {}) - difference).norm(),
            100 * eps * gradient(p.x, {}).norm());
  const Eigen::MatrixXd matrix = p.lagrangian.hessian(p.x, p.gamma, multipliers, rho);
  constexpr double step = 1e-5;
  for (Eigen::Index j = 0; j < p.x.size(); ++j) {
    const Eigen::VectorXd e = step * Eigen::VectorXd::Unit(p.x.size(), j);
    const Eigen::VectorXd column = (gradient(p.x + e, rho) - gradient(p.x - e, rho)) / (2.0 * step);
    EXPECT_LE((matrix.col(j) - column).norm(), 1e-7 * matrix.norm());
  }
}

std::vector<State> states() {
  std::vector<State> all;
  for (const auto formulation : {ModeFormulation::consistent, ModeFormulation::published})
    for (const bool cosine_only : {false, true})
      for (unsigned seed = 1; seed <= 3; ++seed) all.push_back({formulation, cosine_only, seed});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Lagrangian, RandomState, ::testing::ValuesIn(states()));

TEST(ModeLagrangian, OnTheKinkTheHessianIsThatOfContact) {
  const ModalModel model{Eigen::VectorXd::Ones(1), Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Ones(1)};
  const ModeLagrangian lagrangian(model, {1, true}, 2, ModeFormulation::consistent);
  contact::MultiplierUpdate outer({100.0, 100.0}, {100.0});
  const AugmentedMultipliers multipliers(outer);
  const auto hessian = [&](double tip) {
    return lagrangian.hessian(Eigen::Vector2d(0.0, tip), 0.25, multipliers);
  };
  const double nudge = 1e-9, half = 50.0;  // kappa / m
  EXPECT_NEAR(hessian(1.0)(0, 0) - hessian(1.0 - nudge)(0, 0), half, 1e-6);
  EXPECT_NEAR(hessian(1.0)(0, 0), hessian(1.0 + nudge)(0, 0), 1e-6);
}

TEST(ModeLagrangian, TooFewSamplesAreAnError) {
  const ModalModel model{Eigen::VectorXd::Ones(1), Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Ones(1)};
  EXPECT_THROW(ModeLagrangian(model, {3}, 5, ModeFormulation::consistent), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::ll10
