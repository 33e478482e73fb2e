#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// A surface's part of a script: its data, the commands before the plot, and the items of the plot command.
/// Faces are projected, ordered and cut into bands here, because gnuplot 5.4 gives a polygon one colour,
/// draws back faces as well, and writes several times as much SVG.
struct SurfaceScript {
  std::string data;
  std::string setup;
  std::vector<std::string> items;
};

/// Throws std::invalid_argument if a vertex number is out of range, there is not one value per vertex, a face
/// has fewer than 3 vertices or the colours have no range.
void check(const SurfaceView& view);

/// `name` begins the names of its data blocks; x and y limit the projection where they are set.
SurfaceScript surface_script(const SurfaceView& view, const Axis& x, const Axis& y, const std::string& name);

}  // namespace wavebalance::app
