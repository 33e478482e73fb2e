#include "matrices/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "files/frequency_table.hpp"
#include "matrices/load_places.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::app {
namespace {

using solvers::PeriodicForce;

/// Refuses a file whose first row are numbers, which would otherwise be lost.
void require_names(const Table& table, const std::string& file) {
  for (const std::string& name : table.columns()) {
    char* end = nullptr;
    std::strtod(name.c_str(), &end);
    if (end == name.c_str() || *end != '\0') return;
  }
  throw SamplesFault(file + ": line 1: holds numbers; expected the names of the columns");
}

std::vector<double> samples_in(const std::string& file) {
  std::vector<double> samples;
  try {
    const Table table = read_csv(file, max_table_bytes);
    require_names(table, file);
    samples = table.numbers(table.columns().back());
  } catch (const std::exception& error) {
    throw SamplesFault(error.what());
  }
  for (const double value : samples)
    if (!std::isfinite(value))
      throw SamplesFault(file + ": the last column has an entry that is no finite number");
  if (samples.size() < 2)
    throw SamplesFault(fmt::format("{}: there are {} samples; expected at least 2", file, samples.size()));
  return samples;
}

/// The real Fourier series through samples at uniform times; of an even number the last harmonic is a cosine.
Eigen::VectorXcd series_through(const std::vector<double>& samples) {
  spectral::RealFft fft(static_cast<int>(samples.size()));
  Eigen::VectorXcd harmonics(fft.harmonics());
  fft.forward(samples, {harmonics.data(), static_cast<std::size_t>(harmonics.size())});
  harmonics *= 2.0 / static_cast<double>(samples.size());
  harmonics[0] *= 0.5;
  if (samples.size() % 2 == 0) harmonics[harmonics.size() - 1] *= 0.5;
  return harmonics;
}

/// Adds to a force of the same shape and derivative, or as another one.
void add_force(std::vector<PeriodicForce>& forces, PeriodicForce added) {
  if (added.shape.isZero(0.0) || added.harmonics.isZero(0.0)) return;
  for (PeriodicForce& force : forces) {
    if (force.derivative != added.derivative || force.shape != added.shape || !(force.factor == added.factor))
      continue;
    if (force.harmonics.size() < added.harmonics.size()) force.harmonics.swap(added.harmonics);
    force.harmonics.head(added.harmonics.size()) += added.harmonics;
    return;
  }
  forces.push_back(std::move(added));
}

/// -K_b x_b - C_b x_b' - M_b x_b'' of the rows that move and of those that they carry.
void add_base_displacement(std::vector<PeriodicForce>& forces, const ForcingTerm& term,
                           const LoadPlaces& places) {
  const StructureFiles& files = *places.files;
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(std::ssize(files.moving));
  for (const int dof : term.dofs) {
    const auto place = std::lower_bound(files.moving.begin(), files.moving.end(), std::abs(dof) - 1);
    direction[place - files.moving.begin()] = dof > 0 ? 1.0 : -1.0;
  }
  const Eigen::VectorXcd harmonics = harmonics_of(term);
  const auto moved = [&](auto member) {
    Eigen::VectorXd force = files.coupling.*member * direction;
    if (places.carried.size() > 0) force += files.matrices.*member * (places.carried * direction).eval();
    return force;
  };
  const Eigen::VectorXd spring = moved(&fem::Matrices::stiffness);
  add_force(forces, {-spring, harmonics, 0});
  if (files.matrices.damping.size() > 0) add_force(forces, {-moved(&fem::Matrices::damping), harmonics, 1});
  if (places.stiffness_damping > 0.0) add_force(forces, {-places.stiffness_damping * spring, harmonics, 1});
  add_force(forces, {-moved(&fem::Matrices::mass), harmonics, 2});
}

/// m e (h w)^2 cos(h w t + phase) along the first row, and a quarter of a turn later along the second.
void add_unbalance(std::vector<PeriodicForce>& forces, ForcingTerm term, const StructureFiles& files) {
  for (const int dof : term.dofs) {
    add_force(forces, {-forces_at_dofs({dof}, files), harmonics_of(term), 2});
    term.phase -= 90.0;
  }
}

/// The forces of a term at its amplitude.
void add_term(std::vector<PeriodicForce>& forces, const Forcing& forcing, std::size_t index,
              const LoadPlaces& places) {
  const ForcingTerm& term = forcing.terms[index];
  if (term.kind == LoadKind::base_displacement)
    add_base_displacement(forces, term, places);
  else if (term.kind == LoadKind::unbalance)
    add_unbalance(forces, term, *places.files);
  else if (term.kind == LoadKind::base_acceleration)
    add_force(forces, {-(places.files == nullptr ? places.inertia : inertia_of(term, *places.files)),
                       harmonics_of(term), 0});
  else
    add_force(forces,
              {places.files == nullptr ? places.force : force_of(forcing, index, *places.files, places.force),
               harmonics_of(term), 0});
}

/// A exp(i phi) of the table is A cos(phi) on the harmonics and A sin(phi) on those a quarter of a turn
/// ahead.
void add_by_table(std::vector<PeriodicForce>& forces, PeriodicForce force, const AmplitudeTable& table) {
  const auto count = std::ssize(table.frequencies);
  const auto factor = [&](double (*part)(double)) {
    solvers::FrequencyFactor result{Eigen::VectorXd::Map(table.frequencies.data(), count),
                                    Eigen::VectorXd(count)};
    for (Eigen::Index i = 0; i < count; ++i)
      result.values[i] =
          table.amplitudes[std::size_t(i)] * part(table.phases[std::size_t(i)] * std::numbers::pi / 180.0);
    return result;
  };
  PeriodicForce ahead = force;
  ahead.harmonics *= std::complex<double>(0.0, 1.0);
  force.factor = factor([](double angle) { return std::cos(angle); });
  ahead.factor = factor([](double angle) { return std::sin(angle); });
  add_force(forces, std::move(force));
  if (!ahead.factor.values.isZero(0.0)) add_force(forces, std::move(ahead));
}

}  // namespace

AmplitudeTable amplitude_table(const std::string& file) {
  if (file.empty()) return {};
  try {
    const Table table = read_frequency_table(file, "amplitude", "phase_degrees");
    return {table.numbers("frequency_Hz"), table.numbers("amplitude"),
            table.has_column("phase_degrees") ? table.numbers("phase_degrees")
                                              : std::vector<double>(table.rows(), 0.0)};
  } catch (const std::exception& error) {
    throw SamplesFault(error.what());
  }
}

void check_amplitude_table(const Scene& scene, const std::string& file) {
  const AmplitudeTable table = amplitude_table(file);
  if (table.empty()) return;
  const auto [from, to] = load_frequencies(scene);
  try {
    require_frequencies(file, table.frequencies, from, to);
  } catch (const std::runtime_error& error) {
    throw SamplesFault(error.what());
  }
}

double plain_amplitude(const Forcing& forcing) {
  return forcing.amplitude_table.empty() ? forcing.amplitude : 0.0;
}

Eigen::VectorXcd harmonics_of(const ForcingTerm& term) {
  if (!term.samples.empty())
    return term.amplitude * (term.unit == "g" ? standard_gravity : 1.0) *
           series_through(samples_in(term.samples));
  Eigen::VectorXcd harmonics = Eigen::VectorXcd::Zero(term.harmonic + 1);
  const double amplitude = term.amplitude * (term.unit == "g" ? standard_gravity : 1.0);
  harmonics[term.harmonic] =
      term.harmonic == 0 ? amplitude : std::polar(1.0, term.phase * std::numbers::pi / 180.0) * amplitude;
  return harmonics;
}

std::vector<PeriodicForce> forces_of(const Forcing& forcing, const LoadPlaces& places) {
  std::vector<PeriodicForce> forces;
  if (places.files != nullptr && !forcing.weight.empty())
    add_force(forces, {weight_of(forcing, *places.files), Eigen::VectorXcd::Ones(1), 0});
  if (const AmplitudeTable table = amplitude_table(forcing.amplitude_table); !table.empty())
    add_by_table(forces, {forcing.amplitude * places.force, Eigen::VectorXcd::Unit(2, 1), 0}, table);
  for (std::size_t i = 0; i < forcing.terms.size(); ++i) {
    const AmplitudeTable table = amplitude_table(forcing.terms[i].amplitude_table);
    std::vector<PeriodicForce> own;
    add_term(table.empty() ? forces : own, forcing, i, places);
    for (PeriodicForce& force : own) add_by_table(forces, std::move(force), table);
  }
  return forces;
}

}  // namespace wavebalance::app
