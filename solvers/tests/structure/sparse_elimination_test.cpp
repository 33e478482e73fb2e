#include <atomic>
#include <chrono>
#include <thread>

#include "structure/condensation_method.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/linalg/parallel_for.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

/// Masses on a lattice of n x n x n points, held at one face, with springs and dampers of random strength
/// between neighbours; two contacts on the opposite face, a load inside.
LinearStructure lattice(int n, std::mt19937& generator) {
  const int size = n * n * n;
  const auto place = [n](int x, int y, int z) { return x + n * (y + n * z); };
  std::vector<Eigen::Triplet<double>> springs, dampers;
  const auto join = [&](int a, int b) {
    const double stiffness = testing::random_vector(1, generator)[0] + 2.0;
    const double damping = 0.01 * (testing::random_vector(1, generator)[0] + 2.0);
    for (const auto& [row, column, sign] : {std::tuple{a, a, 1.0}, {b, b, 1.0}, {a, b, -1.0}, {b, a, -1.0}}) {
      springs.emplace_back(row, column, sign * stiffness);
      dampers.emplace_back(row, column, sign * damping);
    }
  };
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const int here = place(x, y, z);
        if (x + 1 < n) join(here, place(x + 1, y, z));
        if (y + 1 < n) join(here, place(x, y + 1, z));
        if (z + 1 < n) join(here, place(x, y, z + 1));
        if (z == 0) springs.emplace_back(here, here, 3.0);
      }
  LinearStructure structure;
  structure.stiffness.resize(size, size);
  structure.stiffness.setFromTriplets(springs.begin(), springs.end());
  structure.damping.resize(size, size);
  structure.damping.setFromTriplets(dampers.begin(), dampers.end());
  structure.mass.resize(size, size);
  structure.mass.setIdentity();
  structure.load = Eigen::VectorXd::Unit(size, size / 2);
  structure.contact_directions = contact_rows({place(0, 0, n - 1), size - 1}, size);
  return structure;
}

ImpedanceCoefficients at(double rate) { return {Complex(-rate * rate), Complex(0.0, rate), 1.0}; }
ImpedanceCoefficients slope_at(double rate) { return {Complex(-2.0 * rate), Complex(0.0, 1.0), 0.0}; }

double relative_distance(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return (a - b).norm() / b.norm();
}

void expect_same_by_both(const LinearStructure& structure, std::mt19937& generator) {
  const auto fast = make_sparse_method(structure), plain = make_plain_sparse_method(structure);
  const Eigen::VectorXcd forces = testing::random_vector(2, generator) * Complex(0.3, -0.4);
  const Eigen::VectorXcd load = Eigen::VectorXcd::Constant(1, Complex(1.0, 2.0));
  for (const double rate : {0.0, 0.3, 1.1, 2.5, 40.0}) {
    const auto found = fast->dynamic_compliance(at(rate), slope_at(rate));
    const auto expected = plain->dynamic_compliance(at(rate), slope_at(rate));
    EXPECT_LE(relative_distance(found.compliance, expected.compliance), 1e-10) << rate;
    EXPECT_LE(relative_distance(found.load_response, expected.load_response), 1e-10) << rate;
    EXPECT_LE(relative_distance(found.compliance_slope, expected.compliance_slope), 1e-10) << rate;
    EXPECT_LE(relative_distance(found.load_response_slope, expected.load_response_slope), 1e-10) << rate;
    EXPECT_LE(relative_distance(found.load_response_error, expected.load_response_error), 1e-6) << rate;
    EXPECT_NEAR(fast->condition() / plain->condition(), 1.0, 1e-9) << rate;
    EXPECT_LE(
        relative_distance(fast->recover(at(rate), load, forces), plain->recover(at(rate), load, forces)),
        1e-10)
        << rate;
  }
}

TEST(SparseElimination, FastAndPlainFactorsGiveTheSame) {
  std::mt19937 generator(5);
  LinearStructure structure = lattice(8, generator);
  expect_same_by_both(structure, generator);
  for (int i = 0; i + 1 < structure.size(); i += 3) {  // gyroscopic
    structure.damping.coeffRef(i, i + 1) += 0.2;
    structure.damping.coeffRef(i + 1, i) -= 0.2;
  }
  expect_same_by_both(structure, generator);
}

TEST(SparseElimination, BothFindASingularDynamicStiffness) {
  std::mt19937 generator(6);
  LinearStructure structure = lattice(5, generator);
  structure.damping.setZero();
  LinearStructure empty = structure;
  empty.stiffness *= 0.0;
  empty.mass *= 0.0;
  structure.stiffness = structure.mass;  // all natural frequencies are 1 rad/s
  for (const auto make : {make_sparse_method, make_plain_sparse_method}) {
    EXPECT_THROW(make(structure)->dynamic_compliance(at(1.0), slope_at(1.0)), SingularSystem);
    EXPECT_THROW(make(empty)->recover(at(2.0), Eigen::VectorXcd::Ones(1), Eigen::VectorXcd::Zero(2)),
                 SingularSystem);
    EXPECT_NO_THROW(make(structure)->dynamic_compliance(at(1.0001), slope_at(1.0001)));
  }
}

StiffnessSpectrum spectrum(int points, bool slope) {
  StiffnessSpectrum factors{Eigen::VectorXcd(points), Eigen::VectorXcd(points), Eigen::VectorXcd(points)};
  for (int k = 0; k < points; ++k) {
    const ImpedanceCoefficients point = slope ? slope_at(0.17 * k) : at(0.17 * k);
    for (std::size_t d = 0; d < 3; ++d) factors[d][k] = point[d];
  }
  return factors;
}

TEST(ParallelCondensation, HasTheDigitsOfOneThread) {
  std::mt19937 generator(7);
  const LinearStructure structure = lattice(6, generator);
  for (const auto method : {CondensationMethod::sparse, CondensationMethod::dense})
    for (const int threads : {2, 5, 0}) {
      Condensation one(structure, method), several(structure, method);
      several.set_threads(threads);
      CondensedSpectrum expected, found;
      one.condense(spectrum(17, false), spectrum(17, true), expected);
      for (int repetition = 0; repetition < 2; ++repetition) {
        several.condense(spectrum(17, false), spectrum(17, true), found);
        EXPECT_EQ(found.compliance, expected.compliance) << threads;
        EXPECT_EQ(found.load_response, expected.load_response) << threads;
        EXPECT_EQ(found.compliance_slope, expected.compliance_slope) << threads;
        EXPECT_EQ(found.load_response_slope, expected.load_response_slope) << threads;
        EXPECT_EQ(found.compliance_error, expected.compliance_error) << threads;
        EXPECT_EQ(found.load_response_error, expected.load_response_error) << threads;
        EXPECT_EQ(several.condition(), one.condition()) << threads;
        EXPECT_EQ(several.rounding().load_response, one.rounding().load_response) << threads;
      }
    }
  EXPECT_THROW(Condensation(structure, CondensationMethod::sparse).set_threads(-1), std::invalid_argument);
}

TEST(ParallelCondensation, CarriesASingularSystemToTheCaller) {
  std::mt19937 generator(8);
  LinearStructure structure = lattice(5, generator);
  structure.damping *= 0.0;
  structure.stiffness = structure.mass;
  Condensation condensation(structure, CondensationMethod::sparse);
  condensation.set_threads(2);
  StiffnessSpectrum factors = spectrum(12, false);
  CondensedSpectrum result;
  EXPECT_NO_THROW(condensation.condense(factors, spectrum(12, true), result));
  factors[0][9] = -1.0;  // its natural frequency
  EXPECT_THROW(condensation.condense(factors, spectrum(12, true), result), SingularSystem);
}

TEST(ParallelFor, ThrowsTheExceptionOfTheLeastIndexAfterAllIndicesBeforeIt) {
  for (int repetition = 0; repetition < 50; ++repetition) {
    std::vector<int> done(100, 0);
    const auto work = [&](int, Eigen::Index index) {
      if (index == 40 || index == 41 || index == 70) throw std::runtime_error(std::to_string(index));
      done[static_cast<std::size_t>(index)] = 1;
    };
    try {
      parallel_for(3, 100, work);
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), "40");
    }
    EXPECT_EQ(std::count(done.begin(), done.begin() + 40, 1), 40);
  }
}

TEST(ParallelFor, CallsWatchInTheCallersThreadWhileOthersStillWork) {
  const auto caller = std::this_thread::get_id();
  std::atomic<bool> begun{false}, released{false};
  int watched = 0;
  const auto work = [&](int worker, Eigen::Index) {
    const std::atomic<bool>& awaited = worker == 0 ? begun : released;
    if (worker != 0) begun = true;
    while (!awaited) std::this_thread::yield();
  };
  const auto watch = [&] {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    released = ++watched == 3;
  };
  parallel_for(2, 2, work, watch);
  EXPECT_EQ(watched, 3);
}

TEST(ParallelFor, WaitsForItsThreadsWhenWatchThrows) {
  std::atomic<int> begun{0}, ended{0};
  const auto work = [&](int worker, Eigen::Index) {
    if (worker == 0) {
      while (begun == 0) std::this_thread::yield();
      return;
    }
    ++begun;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    ++ended;
  };
  EXPECT_THROW(parallel_for(2, 2, work, [] { throw std::runtime_error("watched"); }), std::runtime_error);
  EXPECT_EQ(ended, begun);
}

TEST(ThreadCount, IsTheNumberGivenOrOneForEachCoreAndRefusesNegativeOnes) {
  EXPECT_EQ(thread_count(3), 3);
  EXPECT_GE(thread_count(0), 1);
  EXPECT_THROW(thread_count(-1), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
