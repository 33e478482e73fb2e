#include "wavebalance/app/outputs/output_measures.hpp"

#include <numbers>

#include "files/missing.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::app {
namespace {

/// 2 / N sum x_l exp(-2 pi i n l / N) of each row, rows x harmonics, n being multiples of `periods`.
Eigen::MatrixXcd harmonics_of_rows(const Eigen::MatrixXd& rows, int harmonics, int periods) {
  const Eigen::Index points = rows.cols();
  Eigen::MatrixXcd waves(points, harmonics);
  for (Eigen::Index n = 1; n <= harmonics; ++n)
    for (Eigen::Index l = 0; l < points; ++l)
      waves(l, n - 1) = std::polar(
          2.0 / double(points), -2.0 * std::numbers::pi * double(n * periods * l % points) / double(points));
  return rows.cast<std::complex<double>>() * waves;
}

double degrees(const std::complex<double>& value) {
  return value == 0.0 ? 0.0 : std::arg(value) * 180.0 / std::numbers::pi;
}

/// The derivative of values at uniform times of so many periods of a load of `frequency` (Hz), of which the
/// Nyquist coefficient has none.
Eigen::RowVectorXd rate_of(const Eigen::RowVectorXd& values, const LoadAt& load) {
  spectral::RealFft fft(int(values.size()));
  Eigen::VectorXcd spectrum(fft.harmonics());
  Eigen::RowVectorXd result = values;
  const std::span<std::complex<double>> coefficients(spectrum.data(), std::size_t(spectrum.size()));
  const std::span<double> samples(result.data(), std::size_t(result.size()));
  fft.forward(samples, coefficients);
  for (Eigen::Index k = 0; k < spectrum.size(); ++k)
    spectrum[k] *= 2 * k == values.size()
                       ? std::complex<double>()
                       : std::complex<double>(0.0, 2.0 * std::numbers::pi * double(k) * load.frequency /
                                                       load.periods / double(values.size()));
  fft.inverse(coefficients, samples);
  return result;
}

/// From the velocity where that is known, since it has fewer derivatives to go.
Eigen::RowVectorXd differentiated(const solvers::Motion& rows, Eigen::Index row, int derivative,
                                  const LoadAt& load) {
  const bool known = derivative > 0 && rows.velocity.size() > 0;
  Eigen::RowVectorXd values = known ? rows.velocity.row(row) : rows.displacement.row(row);
  for (int i = known ? 1 : 0; i < derivative; ++i) values = rate_of(values, load);
  return values;
}

/// Half the peak-to-peak value of what supports do: of one harmonic its amplitude.
double support_amplitude(const std::vector<SupportMotion>& motions, const LoadAt& load) {
  constexpr int points = 4096;
  Eigen::VectorXcd sum;
  for (const SupportMotion& one : motions) {
    if (sum.size() < one.harmonics.size())
      sum.conservativeResizeLike(Eigen::VectorXcd::Zero(one.harmonics.size()));
    sum.head(one.harmonics.size()) += one.harmonics;
  }
  const double largest = sum.tail(sum.size() - 1).cwiseAbs().maxCoeff();
  if ((sum.tail(sum.size() - 1).array() != 0.0).count() == 1) return load.factor * largest;
  const int derivative = motions.front().derivative;
  const Eigen::VectorXd values =
      support_values({sum, derivative}, derivative, load.frequency, load.factor, points, 1);
  return 0.5 * (values.maxCoeff() - values.minCoeff());
}

/// The vertex of the parabola through the largest of periodic samples and its neighbours.
double largest_between(const Eigen::RowVectorXd& values) {
  Eigen::Index at = 0;
  const double top = values.maxCoeff(&at);
  const Eigen::Index count = values.size();
  const double before = values[(at + count - 1) % count], after = values[(at + 1) % count],
               curvature = before - 2.0 * top + after, slope = 0.5 * (after - before);
  return curvature < 0.0 ? top - 0.5 * slope * slope / curvature : top;
}

}  // namespace

Eigen::MatrixXd values_of_outputs(const std::vector<Output>& outputs, const solvers::Motion& rows,
                                  const solvers::Motion& contacts, const LoadAt& load) {
  const int points = contacts.points();
  Eigen::MatrixXd values = Eigen::MatrixXd::Constant(std::ssize(outputs), points, missing);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Output& output = outputs[i];
    auto row = values.row(Eigen::Index(i));
    if (output.is_contact()) {
      row = contacts.displacement.row(output.contact);
      continue;
    }
    if (rows.points() != points) continue;
    row = differentiated(rows, Eigen::Index(i), output.derivative, load);
    for (const SupportMotion& motion : output.added)
      row += support_values(motion, output.derivative, load.frequency, load.factor, points, load.periods)
                 .transpose();
    row /= output.size * (output.over.empty() ? 1.0 : support_amplitude(output.over, load));
  }
  return values;
}

Eigen::MatrixXd values_of_outputs(const std::vector<Output>& outputs, const Scene& scene,
                                  const StructureModel& model, const solvers::Motion& contacts,
                                  const solvers::Motion& structure, const LoadAt& load) {
  solvers::Motion rows;
  if (structure.points() == contacts.points()) {
    const Eigen::MatrixXd places = rows_of_outputs(outputs, scene, model);
    rows.displacement = places * structure.displacement;
    if (structure.velocity.size() > 0) rows.velocity = places * structure.velocity;
  }
  return values_of_outputs(outputs, rows, contacts, load);
}

MeasuredPoint measure(const std::vector<Output>& outputs, const Eigen::MatrixXd& values,
                      const Eigen::MatrixXd& forces, int harmonics, int periods) {
  const Eigen::MatrixXcd series = harmonics_of_rows(values, harmonics, periods);
  MeasuredPoint measured(outputs.size());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    OutputMeasures& one = measured[i];
    const auto row = values.row(Eigen::Index(i));
    one.max = row.maxCoeff();
    one.min = row.minCoeff();
    one.highest = largest_between(row);
    one.lowest = -largest_between(-row);
    one.mean = row.mean();
    one.rms = (row.array() - one.mean).matrix().stableNorm() / std::sqrt(double(row.size()));
    one.harmonics = series.row(Eigen::Index(i)).transpose();
    if (!outputs[i].is_contact() || forces.size() == 0) continue;
    one.max_force = forces.row(outputs[i].contact).maxCoeff();
    if (outputs[i].closed_by >= 0)
      one.contact_fraction = (forces.row(outputs[i].closed_by).array() != 0.0).cast<double>().mean();
  }
  return measured;
}

std::vector<std::string> columns_of(const Output& output, int harmonics) {
  std::vector<std::string> columns;
  for (const char* value : {"max", "min", "half_peak_to_peak", "rms", "mean"})
    columns.push_back(output.column_of(value));
  for (int n = 1; n <= harmonics; ++n) {
    const std::string number = std::to_string(n);
    columns.push_back(output.column_of("amplitude_" + number));
    columns.push_back(output.column + "_phase_" + number + "_degrees");
  }
  if (output.is_contact()) {
    columns.push_back(output.column + "_max_force_N");
    columns.push_back(output.column + "_contact_fraction");
  }
  return columns;
}

std::vector<double> cells_of(const Output& output, const OutputMeasures& measures, int harmonics) {
  std::vector<double> cells{measures.max, measures.min, measures.half_peak_to_peak(), measures.rms,
                            measures.mean};
  for (int n = 0; n < harmonics; ++n) {
    const bool known = n < measures.harmonics.size();
    cells.push_back(known ? std::abs(measures.harmonics[n]) : missing);
    cells.push_back(known ? degrees(measures.harmonics[n]) : missing);
  }
  if (output.is_contact()) cells.insert(cells.end(), {measures.max_force, measures.contact_fraction});
  return cells;
}

}  // namespace wavebalance::app
