#pragma once
#include <string>

#include "readings.hpp"

namespace wavebalance::jl14 {

/// One time history under all ways to form the sums, for the choices of the page.
struct SumsView {
  std::string label;                                  ///< of the ordinate
  Eigen::VectorXd (app::Response::*history)() const;  ///< such as &app::Response::force
  double scale = 1.0;                                 ///< from SI units to the unit of the label
  double from = -0.5, to = 0.5;                       ///< t/T that is shown
  double level = solvers::missing;                    ///< an ordinate to mark, such as the gap
};

/// The script <stem>.readings.js: wavebalance.readings["<stem>"] with the curves of all pairs and of the
/// reference in integers of 1/5000 of their range, the relative rms errors, and for each statement of the
/// artefact that has a reading of that name its verdict. The statements must have been added before.
void attach_sums(report::Artefact& artefact, const Case& study, const Readings& readings,
                 const SumsView& view);

}  // namespace wavebalance::jl14
