#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::blade {

/// Vertices of a surface that are marked by a symbol; those on hidden faces are left out.
struct SurfaceMarks {
  std::string label;  ///< in the legend
  std::vector<int> vertices;
  app::Colour colour = app::Colour::vermillion;
  int marker = 1;  ///< the n-th symbol
};

/// A closed surface of polygons in space.
struct Surface {
  Eigen::Matrix3Xd vertices;
  std::vector<std::vector<int>> faces;  ///< vertex numbers anticlockwise seen from outside
  std::vector<double> values;           ///< one per vertex, shown as bands of colour; empty: light grey
  bool outline = false;                 ///< only its sharp edges, dashed
  std::vector<SurfaceMarks> marks;
};

/// How values become colours, white to dark blue.
struct ColourBands {
  double lower = 0.0;
  double upper = 1.0;  ///< > lower; values beyond have the last colour
  int bands = 12;      ///< >= 2
  std::string label;   ///< label of the colour bar
};

/// Surfaces in parallel projection with equal scales. Back faces are left out and the others painted from the
/// back, so that nearer ones hide what is behind them; outlines lie behind all faces.
struct SurfaceView {
  std::vector<Surface> surfaces;
  double azimuth = -60.0;   ///< the viewer's angle in degrees, from x to y
  double elevation = 25.0;  ///< the viewer's angle in degrees above the x-y plane, -90..90
  ColourBands colours;
  double shading = 0.3;  ///< 0..1, darkening at an angle to the light of faces without values
  double axes = 0.0;     ///< length of the three arrows that show the axes, in units of the vertices; 0: none
};

/// A point of space as the picture shows it, to the right and up.
Eigen::Vector2d projected(const SurfaceView& view, const Eigen::Vector3d& point);

/// Draws the view in the panel, without axes. The limits that the panel's x and y have bound the projection,
/// which fills the panel otherwise; its series and texts have the coordinates of projected(). `name` begins
/// the names of its data blocks, so that the panels of a figure need different ones.
void paint(app::Panel& panel, const SurfaceView& view, const std::string& name);

}  // namespace wavebalance::blade
