#include "wavebalance/app/outputs/output_measures.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "files/missing.hpp"

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

}  // namespace

Eigen::MatrixXd motion_of_outputs(const std::vector<Output>& outputs, const Scene& scene,
                                  const StructureModel& model, const solvers::Motion& contacts,
                                  const Eigen::MatrixXd& structure) {
  Eigen::MatrixXd motion = Eigen::MatrixXd::Constant(std::ssize(outputs), contacts.points(), missing);
  if (structure.cols() == motion.cols()) motion = rows_of_outputs(outputs, scene, model) * structure;
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (outputs[i].is_contact()) motion.row(Eigen::Index(i)) = contacts.displacement.row(outputs[i].contact);
  return motion;
}

MeasuredPoint measure(const std::vector<Output>& outputs, const Eigen::MatrixXd& displacement,
                      const Eigen::MatrixXd& forces, int harmonics, int periods) {
  const Eigen::MatrixXcd series = harmonics_of_rows(displacement, harmonics, periods);
  MeasuredPoint measured(outputs.size());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    OutputMeasures& one = measured[i];
    const auto row = displacement.row(Eigen::Index(i));
    one.max = row.maxCoeff();
    one.min = row.minCoeff();
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
    columns.push_back(output.column + "_" + value + "_" + output.unit);
  for (int n = 1; n <= harmonics; ++n) {
    const std::string number = std::to_string(n);
    columns.push_back(output.column + "_amplitude_" + number + "_" + output.unit);
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
