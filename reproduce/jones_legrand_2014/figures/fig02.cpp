#include "figures.hpp"
#include "jl14.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::jl14 {
namespace {

const std::vector<std::string> basis_names{"1", "cos 2πt", "sin 2πt", "cos 4πt", "sin 4πt", "cos 6πt"};

// Samples of function i of the basis, whose spectrum has one entry.
Eigen::VectorXd samples(std::size_t i, int points) {
  std::vector<std::complex<double>> spectrum(static_cast<std::size_t>(points) / 2 + 1);
  if (i == 0)
    spectrum[0] = 1.0;
  else
    spectrum[(i + 1) / 2] = i % 2 == 1 ? std::complex(0.5, 0.0) : std::complex(0.0, -0.5);
  Eigen::VectorXd values(points);
  spectral::RealFft(points).inverse(spectrum, {values.data(), static_cast<std::size_t>(points)});
  return values;
}

Table functions_table() {
  constexpr int points = 1024;
  Table table;
  table.add_column("time_fraction", app::time_fractions(points));
  for (std::size_t i = 0; i < basis_names.size(); ++i)
    table.add_column("function_" + std::to_string(i + 1), samples(i, points));
  return table;
}

app::Figure functions_figure(const Table& table) {
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 400;
  figure.panel_height = 200;
  for (std::size_t i = 0; i < basis_names.size(); ++i) {
    const auto values = table.numbers("function_" + std::to_string(i + 1));
    auto& panel = figure.add_panel(basis_names[i]);
    panel.add(periodic_series("", Eigen::Map<const Eigen::VectorXd>(values.data(), values.size())));
    panel.x = axis(i >= 4 ? time_label : "", 0.0, 1.0);
    panel.y = axis("Amplitude (-)", -1.2, 1.2);
  }
  return figure;
}

/// Largest relative difference of the harmonic balance response between the three formulations.
double formulation_spread(report::Artefact& artefact) {
  const auto response = [&](const std::string& formulation) {
    const auto scene = artefact.scene("case1.toml", {"time.formulation=" + formulation});
    return app::weighted_residual_response(scene).displacement();
  };
  const Eigen::VectorXd distributional = response("distributional");
  return std::max(app::relative_rms_error(response("strong"), distributional),
                  app::relative_rms_error(response("weak"), distributional));
}

}  // namespace

void fig02(report::Artefact& artefact) {
  const auto table = functions_table();
  artefact.data(table, "time in periods, functions without unit",
                {"functions 1 to 6: 1, cos 2 pi t, sin 2 pi t, cos 4 pi t, sin 4 pi t, cos 6 pi t"});
  artefact.picture(functions_figure(table));
  artefact.caption(
      "The Fourier basis of L² on the circle, in the order in which it is cut after M functions.");
  const double spread = formulation_spread(artefact);
  artefact.check(
      {"section 3.1",
       "It is worthy to note that the HBM formulations of Eqs. (14), (15), and (16) are identical.",
       "case 1 with 64 functions: strong, weak and distributional responses differ by less than 1e-9 "
       "(relative rms)",
       "largest difference " + report::number(spread), spread < 1e-9});
}

}  // namespace wavebalance::jl14
