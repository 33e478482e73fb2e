#pragma once
#include <string>

#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// Whether `figure` has curves that a page can zoom: every panel is a diagram with axes in two dimensions,
/// and a series has a point, or a heat map shows its values. Other heat maps, drawings, perspectives and
/// sketches without axes remain pictures.
bool has_curves(const Figure& figure);

/// The data of `figure` as a script, `wavebalance.figures["name"] = {...}`, which curves.js of app/page
/// draws. (A page that is opened as a file may load scripts, but not JSON.) Values have 6 significant digits.
/// Points that lie within 1e-4 of the axes' ranges of the curve through the others are left out of lines, and
/// more where 5000 would remain. Throws std::invalid_argument if the coordinates of a series differ in
/// length.
std::string figure_script(const Figure& figure, const std::string& name);

}  // namespace wavebalance::app
