#include <algorithm>
#include <cmath>

#include "limits.hpp"
#include "solver_scenes.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/balance/contact_system.hpp"
#include "wavebalance/spectral/aft.hpp"
#include "wavebalance/spectral/fft.hpp"
#include "wavebalance/wavelets/fast_transform.hpp"
#include "wavebalance/wavelets/filter.hpp"

// The parts of a solve, each with the operations and bytes that it cannot do without.
namespace wavebalance::bench {
namespace {

constexpr double real = sizeof(double);
constexpr double complex = 2 * sizeof(double);

double fft_flops(double points) { return 2.5 * points * std::log2(points); }

// Four samplings and their transforms (trial functions; weights and their first two derivatives) give three
// symbols. Daubechies Galerkin pairs sample only both generators and transform three columns of M values.
void symbol_assembly(benchmark::State& state, const std::string& trial, const std::string& weight) {
  app::Time time;
  time.trial = trial;
  time.weight = weight;
  time.functions = static_cast<int>(state.range(0));
  time.quadrature_points = 4 * time.functions;
  for (auto _ : state) benchmark::DoNotOptimize(app::make_pair(time).symbol(0).data());
  const double points = time.quadrature_points, functions = time.functions;
  const bool connection = effective_inner_products(time) == app::InnerProducts::exact;
  const double flops =
      connection ? 2.0 * fft_flops(points) + 3.0 * fft_flops(functions) : 4.0 * fft_flops(points);
  set_work(state, flops,
           4.0 * points * real + 2.0 * 0.5 * points * complex + 3.0 * 0.5 * functions * complex);
}
void symbol_fourier(benchmark::State& state) { symbol_assembly(state, "fourier", "fourier"); }
void symbol_bspline(benchmark::State& state) { symbol_assembly(state, "bspline", "bspline"); }
void symbol_daubechies6(benchmark::State& state) { symbol_assembly(state, "daubechies6", "daubechies6"); }

// The operations of the pivot recursion and of its derivative by the frequency, a division counted once.
void condensation(benchmark::State& state) {
  constexpr double operations = 94.0;
  constexpr int functions = 255;
  const Case scene = jl14_case(2);
  const auto elements = static_cast<int>(state.range(0));
  const spectral::FourierBasis basis(functions);
  solvers::CondensedProblem problem(solvers::TimePair(basis, basis, {.quadrature_points = 1024}),
                                    scene.structure(elements), cosine_load());
  for (auto _ : state) {
    problem.forget_condensation();
    problem.set_frequency(scene.frequency);
    benchmark::DoNotOptimize(problem.linear_response().data());
  }
  set_work(state, operations * elements * (functions / 2 + 1), 6.0 * real * elements);
}

void fft_pair(benchmark::State& state) {
  const auto points = static_cast<int>(state.range(0));
  spectral::RealFft fft(points);
  const std::vector<double> samples(static_cast<std::size_t>(points), 1.0);
  std::vector<double> again(samples.size());
  std::vector<std::complex<double>> spectrum(static_cast<std::size_t>(fft.harmonics()));
  for (auto _ : state) {
    fft.forward(samples, spectrum);
    fft.inverse(spectrum, again);
    benchmark::DoNotOptimize(again.data());
  }
  set_work(state, 2.0 * fft_flops(points), 4.0 * points * real);
}

// A product of the condensed compliance with a force: two transforms, fold, product and replicate.
void compliance_product(benchmark::State& state) {
  const Case scene = jl14_case(2);
  const auto points = static_cast<int>(state.range(0));
  auto problem = fourier_problem(scene, points / 4 - 1, points);
  problem.set_frequency(scene.frequency);
  const Eigen::VectorXd force = Eigen::VectorXd::Random(points);
  Eigen::VectorXd displacement(points);
  for (auto _ : state) {
    problem.apply(force, displacement);
    benchmark::DoNotOptimize(displacement.data());
  }
  const double half = 0.5 * points;
  set_work(state, 2.0 * fft_flops(points) + (8.0 + 6.0) * half + 6.0 * half / 4.0,
           2.0 * points * real + 2.0 * half * complex + 0.25 * half * complex);
}

// The exponential law and its tangent; an exponential counts as 20 operations.
void force_evaluation(benchmark::State& state) {
  const Case scene = jl14_case(1);
  const auto points = static_cast<int>(state.range(0));
  auto problem = fourier_problem(scene, 63, points);
  problem.set_frequency(scene.frequency);
  const Eigen::VectorXd& displacement = problem.linear_response();
  Eigen::VectorXd force(points), tangent(points);
  const solvers::AnyContactLaw law = scene.law();
  const auto size = static_cast<std::size_t>(points);
  for (auto _ : state) {
    law.evaluate({displacement.data(), size}, {force.data(), size}, {tangent.data(), size});
    benchmark::DoNotOptimize(tangent.data());
  }
  const double active = double((tangent.array() != 0.0).count());
  set_work(state, 20.0 * active, 3.0 * points * real);
}

// Evaluation, factorization and solution of one Newton step at the linear response of case 1, whose
// longest contact is the largest of the solve: an LU of the active samples and four transforms.
void newton_step(benchmark::State& state) {
  const Case scene = jl14_case(1);
  const auto points = static_cast<int>(state.range(0));
  auto problem = fourier_problem(scene, points / 4 - 1, points);
  problem.set_frequency(scene.frequency);
  solvers::ContactSystem system(problem, scene.law());
  system.set_linear_solver(solvers::LinearSolver::dense);
  Eigen::VectorXd direction;
  system.evaluate(problem.linear_response());
  system.factorize();
  for (auto _ : state) {
    system.evaluate(problem.linear_response());
    system.factorize();
    system.solve(system.residual(), direction);
    benchmark::DoNotOptimize(direction.data());
  }
  const double active = double((system.tangent().array() != 0.0).count());
  set_work(state, 2.0 / 3.0 * active * active * active + 2.0 * active * active + 4.0 * fft_flops(points),
           2.0 * real * active * active);
}

// The same by GMRES, to the first residual of Newton's method; the limit is set by the four transforms.
void newton_step_gmres(benchmark::State& state) {
  const Case scene = jl14_case(1);
  const auto points = static_cast<int>(state.range(0));
  auto problem = fourier_problem(scene, points / 4 - 1, points);
  problem.set_frequency(scene.frequency);
  solvers::ContactSystem system(problem, scene.law());
  system.set_linear_solver(solvers::LinearSolver::krylov);
  Eigen::VectorXd direction;
  bool solved = true;
  for (auto _ : state) {
    system.evaluate(problem.linear_response());
    solved = system.factorize() && system.solve(system.residual(), direction, 1e-6) && solved;
    benchmark::DoNotOptimize(direction.data());
  }
  if (!solved) state.SkipWithError("not solved");
  set_work(state, 4.0 * fft_flops(points), 4.0 * 2.0 * real * points);
}

// Coefficients of u = 2 gap cos 2 pi t, which is in contact for a third of the period.
Eigen::VectorXd touching_motion(const Case& scene, const spectral::Aft& aft) {
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(aft.coefficients());
  coefficients[1] = 2.0 * scene.gap;
  return coefficients;
}

// Force coefficients by alternating frequency/time: two transforms and the exponentials of the samples in
// contact.
void aft_force(benchmark::State& state) {
  const Case scene = jl14_case(1);
  const auto points = static_cast<int>(state.range(0));
  spectral::Aft aft(points / 8 - 1, points);
  const Eigen::VectorXd motion = touching_motion(scene, aft);
  const spectral::PointwiseLaw force = [law = scene.law()](std::span<const double> u, std::span<double> f) {
    std::transform(u.begin(), u.end(), f.begin(), [&](double one) { return law.force(one); });
  };
  for (auto _ : state) benchmark::DoNotOptimize(aft.force(motion, force).coefficients.data());
  set_work(state, 2.0 * fft_flops(points) + 20.0 * points / 3.0, 4.0 * points * real);
}

// Its Jacobian: the same with the tangent, and one addition for each of the (2H + 1)^2 entries.
void aft_jacobian(benchmark::State& state) {
  const Case scene = jl14_case(1);
  const auto points = static_cast<int>(state.range(0));
  spectral::Aft aft(points / 8 - 1, points);
  const Eigen::VectorXd motion = touching_motion(scene, aft);
  const spectral::PointwiseLaw tangent = [law = scene.law()](std::span<const double> u, std::span<double> k) {
    std::transform(u.begin(), u.end(), k.begin(), [&](double one) { return law.tangent(one); });
  };
  for (auto _ : state) benchmark::DoNotOptimize(aft.jacobian(motion, tangent).data());
  const double entries = double(aft.coefficients()) * aft.coefficients();
  set_work(state, 2.0 * fft_flops(points) + 20.0 * points / 3.0 + entries, (4.0 * points + entries) * real);
}

void wavelet_transform(benchmark::State& state, int coefficients) {
  const wavelets::FastWaveletTransform transform(wavelets::daubechies_filter(coefficients));
  const auto size = static_cast<Eigen::Index>(state.range(0));
  const Eigen::VectorXd signal = Eigen::VectorXd::Random(size);
  const int levels = static_cast<int>(std::log2(double(size)));
  for (auto _ : state) benchmark::DoNotOptimize(transform.analysis(signal, levels).data());
  set_work(state, 4.0 * coefficients * double(size), 4.0 * real * double(size));
}
void wavelet_transform_6(benchmark::State& state) { wavelet_transform(state, 6); }
void wavelet_transform_20(benchmark::State& state) { wavelet_transform(state, 20); }

BENCHMARK(symbol_fourier)->Arg(64)->Arg(1024)->Arg(16384)->Unit(benchmark::kMicrosecond);
BENCHMARK(symbol_bspline)->Arg(64)->Arg(1024)->Arg(16384)->Unit(benchmark::kMicrosecond);
BENCHMARK(symbol_daubechies6)->Arg(64)->Arg(1024)->Arg(16384)->Unit(benchmark::kMicrosecond);
BENCHMARK(condensation)->Arg(25)->Arg(1000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(fft_pair)->Arg(256)->Arg(4096)->Arg(65536)->Unit(benchmark::kMicrosecond);
BENCHMARK(compliance_product)->Arg(256)->Arg(4096)->Arg(65536)->Unit(benchmark::kMicrosecond);
BENCHMARK(force_evaluation)->Arg(256)->Arg(4096)->Arg(65536)->Unit(benchmark::kMicrosecond);
BENCHMARK(newton_step)->Arg(256)->Arg(1024)->Arg(4096)->Unit(benchmark::kMicrosecond);
BENCHMARK(newton_step_gmres)->Arg(256)->Arg(1024)->Arg(4096)->Arg(65536)->Unit(benchmark::kMicrosecond);
BENCHMARK(aft_force)->Arg(256)->Arg(4096)->Arg(65536)->Unit(benchmark::kMicrosecond);
BENCHMARK(aft_jacobian)->Arg(256)->Arg(1024)->Arg(4096)->Unit(benchmark::kMicrosecond);
BENCHMARK(wavelet_transform_6)->Arg(1024)->Arg(65536)->Unit(benchmark::kMicrosecond);
BENCHMARK(wavelet_transform_20)->Arg(1024)->Arg(65536)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace wavebalance::bench
