// Elastic Coulomb friction over a period: exact hysteresis, the derivative by differences, order in the
// points with lift-off and with two tangents, a period that closes, bad input.

#include "wavebalance/contact/coulomb_law.hpp"
#include "testing.hpp"

namespace wavebalance::contact {
namespace {

constexpr double pi = std::numbers::pi;

// Random periodic displacements of a few harmonics, row after row.
std::vector<double> random_motion(int rows, int points, std::mt19937& generator, double size = 1.0) {
  std::normal_distribution<double> normal(0.0, size);
  std::vector<double> motion;
  for (int row = 0; row < rows; ++row) {
    std::array<double, 7> a{};
    for (double& one : a) one = normal(generator);
    for (int j = 0; j < points; ++j) {
      double u = a[0];
      for (int n = 1; n <= 3; ++n)
        u += a[std::size_t(2 * n - 1)] * std::cos(2 * pi * n * j / points) +
             a[std::size_t(2 * n)] * std::sin(2 * pi * n * j / points);
      motion.push_back(u);
    }
  }
  return motion;
}

CoulombLaw random_law(int tangents, bool with_normal, std::mt19937& generator) {
  std::uniform_real_distribution<double> any(0.2, 2.0);
  FrictionParameters p{0.5 * any(generator), any(generator), any(generator), tangents};
  if (!with_normal) return CoulombLaw(p);
  return CoulombLaw(p, LinearLaw(any(generator), 0.3 * any(generator)));
}

TEST(CoulombLaw, DissipatesTheAreaOfItsHysteresis) {
  constexpr double stiffness = 3.0, load = 2.0, mu = 0.4, amplitude = 1.1;
  const CoulombLaw law({mu, stiffness, load});
  constexpr int points = 4096;
  std::vector<double> u;
  for (int j = 0; j < points; ++j) u.push_back(amplitude * std::cos(2 * pi * j / points));
  const FrictionPeriod period = law.over_period(points, u, false);
  const double limit = mu * load, exact = 4.0 * limit * (amplitude - limit / stiffness);
  EXPECT_NEAR(period.work, exact, 4.0 / points * exact / points * 10);
  EXPECT_NEAR(period.normal_work, exact / mu, 1e-5 * exact);
  EXPECT_DOUBLE_EQ(period.force.front(), limit);
  EXPECT_FALSE(period.history_dependent);
  double area = 0.0;
  for (int j = 0; j < points; ++j) {
    const auto now = std::size_t(j), before = std::size_t((j + points - 1) % points);
    area += 0.5 * (period.force[now] + period.force[before]) * (u[now] - u[before]);
  }
  EXPECT_NEAR(area, exact, 1e-6 * exact);
}

TEST(CoulombLaw, OfAVanishingForceSticksAtItsSliderAndSaysThatHistoryDecides) {
  const CoulombLaw law({0.5, 4.0, 2.0, 1, {0.1}});
  const std::vector<double> u{0.1, 0.2, 0.0, -0.1};
  const FrictionPeriod period = law.over_period(4, u, true);
  for (std::size_t j = 0; j < u.size(); ++j) EXPECT_NEAR(period.force[j], 4.0 * (u[j] - 0.1), 1e-15);
  EXPECT_TRUE(period.history_dependent);
  EXPECT_EQ(period.work, 0.0);
  ASSERT_EQ(period.slopes.size(), 4U);
  for (const auto& slope : period.slopes) {
    EXPECT_EQ(slope.force, slope.displacement);
    EXPECT_DOUBLE_EQ(slope.slope, 4.0);
  }
}

TEST(CoulombLaw, OfOneTangentIsPeriodicAfterOnePeriodForAnyMotion) {
  std::mt19937 generator(7);
  constexpr int points = 64;
  for (int run = 0; run < 2000; ++run) {
    const CoulombLaw law = random_law(1, run % 2 == 0, generator);
    const std::vector<double> u = random_motion(law.rows(), points, generator);
    const FrictionPeriod period = law.over_period(points, u, false);
    // One more period from its end by single steps.
    std::vector<double> force(std::size_t(law.rows())), before(force.size()), now(force.size()),
        none(force.size(), 0.0);
    const auto at = [&](int j, std::vector<double>& values) {
      for (int row = 0; row < law.rows(); ++row) values[std::size_t(row)] = u[std::size_t(row * points + j)];
    };
    at(points - 1, before);
    for (int row = 0; row < law.rows(); ++row)
      force[std::size_t(row)] = period.force[std::size_t(row * points + points - 1)];
    for (int j = 0; j < points; ++j) {
      at(j, now);
      law.advance(before, now, none, force);
      for (int row = 0; row < law.rows(); ++row)
        ASSERT_NEAR(force[std::size_t(row)], period.force[std::size_t(row * points + j)], 1e-13);
      before = now;
    }
    EXPECT_GE(period.work, 0.0);
  }
}

TEST(CoulombLaw, OfTwoTangentsClosesItsPeriodAndStaysInItsDisc) {
  std::mt19937 generator(8);
  constexpr int points = 64;
  for (int run = 0; run < 300; ++run) {
    const CoulombLaw law = random_law(2, run % 2 == 0, generator);
    const std::vector<double> u = random_motion(law.rows(), points, generator, run % 3 == 0 ? 0.3 : 1.0);
    const FrictionPeriod period = law.over_period(points, u, false);
    const auto row = [&](int r, int j) { return std::size_t(r * points + j); };
    const int first = law.normal_rows();
    std::vector<double> force(std::size_t(law.rows())), before(force.size()), now(force.size()),
        none(force.size(), 0.0);
    for (int r = 0; r < law.rows(); ++r) {
      before[std::size_t(r)] = u[row(r, points - 1)];
      now[std::size_t(r)] = u[row(r, 0)];
      force[std::size_t(r)] = period.force[row(r, points - 1)];
    }
    law.advance(before, now, none, force);
    double most = 0.0;
    for (int j = 0; j < points; ++j) {
      const double limit =
          law.friction() * std::max(0.0, law.raw_normal_force(first > 0 ? u[row(0, j)] : 0.0));
      const double size = std::hypot(period.force[row(first, j)], period.force[row(first + 1, j)]);
      EXPECT_LE(size, limit * (1.0 + 1e-12));
      most = std::max(most, size);
    }
    for (int r = first; r < law.rows(); ++r)
      EXPECT_NEAR(force[std::size_t(r)], period.force[row(r, 0)], 1e-11 * (most + 1e-3)) << run;
  }
}

// A directional derivative by differences, at motions whose samples keep their states.
TEST(CoulombLaw, HasTheDerivativeOfItsForces) {
  std::mt19937 generator(9);
  std::normal_distribution<double> normal;
  constexpr int points = 48;
  constexpr double step = 1e-7;
  int compared = 0;
  for (int run = 0; run < 200; ++run) {
    const CoulombLaw law = random_law(1 + run % 2, run % 4 < 2, generator);
    const std::vector<double> u = random_motion(law.rows(), points, generator, run % 5 == 0 ? 0.1 : 1.0);
    std::vector<double> change(u.size()), ahead = u, behind = u;
    for (std::size_t i = 0; i < u.size(); ++i) {
      change[i] = normal(generator);
      ahead[i] += step * change[i];
      behind[i] -= step * change[i];
    }
    const FrictionPeriod at = law.over_period(points, u, true), plus = law.over_period(points, ahead, false),
                         minus = law.over_period(points, behind, false);
    if (plus.state != at.state || minus.state != at.state) continue;
    std::vector<double> slope(u.size(), 0.0);
    for (const auto& one : at.slopes)
      slope[std::size_t(one.force)] += one.slope * change[std::size_t(one.displacement)];
    double size = 0.0;
    for (const double one : slope) size = std::max(size, std::abs(one));
    for (std::size_t i = 0; i < u.size(); ++i)
      EXPECT_NEAR((plus.force[i] - minus.force[i]) / (2 * step), slope[i], 1e-6 * (size + 1.0))
          << run << ' ' << i;
    ++compared;
  }
  EXPECT_GT(compared, 120);
}

TEST(CoulombLaw, OfOneTangentHasAtMostFiveSlopesPerForce) {
  std::mt19937 generator(10);
  constexpr int points = 256;
  for (int run = 0; run < 50; ++run) {
    const CoulombLaw law = random_law(1, run % 2 == 0, generator);
    const FrictionPeriod period = law.over_period(points, random_motion(law.rows(), points, generator), true);
    std::vector<int> count(period.force.size(), 0);
    for (const auto& one : period.slopes) ++count[std::size_t(one.force)];
    EXPECT_LE(*std::max_element(count.begin(), count.end()), 5);
  }
}

// The largest difference of the tangential forces from a solution with 64 times as many points, at the
// coarse ones.
double error_of(const CoulombLaw& law, int points, double phase) {
  const auto forces = [&](int count) {
    std::vector<double> u;
    for (int row = 0; row < law.rows(); ++row)
      for (int j = 0; j < count; ++j) {
        const double t = 2 * pi * j / count;
        u.push_back(row == 0 ? 1.3 * std::cos(t + phase) + 0.2 * std::sin(2 * t)
                             : 0.9 * std::sin(t + 0.4 * row + phase) + 0.3 * std::cos(2 * t - row));
      }
    return law.over_period(count, u, false).force;
  };
  constexpr int finer = 64;
  const std::vector<double> coarse = forces(points), fine = forces(points * finer);
  double error = 0.0;
  for (int i = law.normal_rows() * points; i < law.rows() * points; ++i) {
    const double apart = coarse[std::size_t(i)] - fine[std::size_t(i) * finer];
    error += apart * apart;
  }
  return std::sqrt(error / points);
}

// Asked: 1.8. A slider that starts at the sample before closing, and a radial return, are of first order.
TEST(CoulombLaw, IsOfSecondOrderInThePointsWithLiftOffAndWithTwoTangents) {
  const CoulombLaw lifts({0.5, 2.0, 0.2}, LinearLaw(1.5, 0.3)), turns({0.4, 3.0, 1.0, 2}),
      both({0.5, 2.0, 0.2, 2}, LinearLaw(1.5, 0.3));
  for (const CoulombLaw& law : {lifts, turns, both}) {
    double coarse = 0.0, fine = 0.0;
    for (int shift = 0; shift < 12; ++shift) {
      coarse += error_of(law, 64, 0.5 * shift);
      fine += error_of(law, 512, 0.5 * shift);
    }
    EXPECT_GE(std::log2(coarse / fine) / 3.0, 1.8) << law.rows() << ' ' << coarse << ' ' << fine;
  }
}

TEST(CoulombLaw, InSeriesWithAFlexibilityIsItsStepAtTheDisplacementThatFollows) {
  std::mt19937 generator(12);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 500; ++run) {
    const CoulombLaw law = random_law(1 + run % 2, run % 4 < 2, generator);
    const auto rows = std::size_t(law.rows());
    std::vector<double> before(rows), v(rows), h(rows), force(rows), direct, u(rows), none(rows, 0.0);
    for (std::size_t r = 0; r < rows; ++r) {
      before[r] = normal(generator);
      v[r] = before[r] + 0.5 * normal(generator);
      h[r] = 0.3 * std::abs(normal(generator));
    }
    law.start(before, none, force);
    direct = force;
    law.advance(before, v, h, force);
    for (std::size_t r = 0; r < rows; ++r) u[r] = v[r] - h[r] * force[r];
    law.advance(before, u, none, direct);
    for (std::size_t r = 0; r < rows; ++r) EXPECT_NEAR(direct[r], force[r], 1e-12) << run;
  }
}

TEST(CoulombLaw, RefusesWhatMakesNoLaw) {
  const auto message = [](const FrictionParameters& parameters) -> std::string {
    try {
      CoulombLaw law(parameters);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({-0.1, 1.0, 1.0}).find("friction is -0.1"), std::string::npos);
  EXPECT_NE(message({0.1, 0.0, 1.0}).find("tangential_stiffness is 0"), std::string::npos);
  EXPECT_NE(message({0.1, 1.0, -1.0}).find("normal_load is -1"), std::string::npos);
  EXPECT_NE(message({0.1, 1.0, 0.0}).find("normal_load is 0"), std::string::npos);
  EXPECT_NE(message({0.1, 1.0, 1.0, 3}).find("tangents is 3"), std::string::npos);
  EXPECT_NE(message({0.1, 1.0, 1.0, 2, {0.0}}).find("slider has 1 entries"), std::string::npos);
}

// v = u + h f: the forces of the law at u equal its resolvent's at v, along straight steps of either.
TEST(CoulombLaw, ResolventHasTheForcesOfTheLawAtTheEndOfSprings) {
  std::mt19937 generator(7);
  constexpr int points = 4096;
  for (int tangents = 1; tangents <= 2; ++tangents) {
    const CoulombLaw law = random_law(tangents, true, generator);
    const std::vector<double> u = random_motion(law.rows(), points, generator);
    const std::vector<double> flexibility(std::size_t(law.rows()), 0.4);
    const FrictionPeriod own = law.over_period(points, u, false);
    std::vector<double> v = u;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += 0.4 * own.force[i];
    const FrictionPeriod series = law.resolvent(flexibility).over_period(points, v, false);
    double greatest = 0.0, error = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      greatest = std::max(largest, std::abs(own.force[i]));
      error = std::max(error, std::abs(series.force[i] - own.force[i]));
    }
    EXPECT_LT(error, 2e-3 * greatest) << tangents;
  }
}

TEST(CoulombLaw, RigidFrictionIsElasticInSeriesWithASpring) {
  const CoulombLaw rigid({0.5, std::numeric_limits<double>::infinity(), 2.0});
  EXPECT_TRUE(rigid.rigid());
  const std::vector<double> flexibility{0.25};
  const CoulombLaw series = rigid.resolvent(flexibility);
  EXPECT_FALSE(series.rigid());
  EXPECT_EQ(series.tangential_stiffness(), 4.0);
  EXPECT_THROW(rigid.over_period(2, std::vector<double>{0.0, 1.0}, false), std::invalid_argument);
  EXPECT_THROW(rigid.resolvent(std::vector<double>{0.0}), std::invalid_argument);
  EXPECT_THROW(rigid.resolvent(std::vector<double>{1.0, 1.0}), std::invalid_argument);
  // A step of rigid friction in series with a spring equals the step of the elastic law along v.
  for (const double travel : {0.1, 0.3, 2.0}) {
    std::vector<double> force{0.4}, other{0.4};
    const std::vector<double> before{0.2}, v{0.2 + 0.25 * 0.4 + travel}, start{0.2 + 0.25 * 0.4}, none{0.0};
    rigid.advance(before, v, flexibility, force);
    series.advance(start, v, none, other);
    EXPECT_NEAR(force[0], other[0], 1e-14);
  }
}

}  // namespace
}  // namespace wavebalance::contact
