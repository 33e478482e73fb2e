#include <fmt/format.h>

#include <algorithm>

#include "blade.hpp"
#include "figures.hpp"

namespace wavebalance::ll10 {
namespace {

constexpr double arrow_length = 15.0;  // mm

Table contact_nodes(const fem::Blade& blade, double gap) {
  Table table({"contact", "node", "face", "x_m", "y_m", "z_m", "gap_m"});
  const auto& nodes = blade.contact_nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Eigen::Vector3d at = blade.model.mesh.nodes.col(nodes[i]);
    table.append_row({static_cast<double>(i + 1), static_cast<double>(nodes[i] + 1),
                      i % 2 == 0 ? "eta = -1" : "eta = 1", at.x(), at.y(), at.z(), gap});
  }
  return table;
}

std::vector<int> held_nodes(const fem::Blade& blade) {
  std::vector<int> nodes;
  for (int node = 0; node < blade.model.mesh.nodes.cols(); ++node)
    if (blade.model.dofs.unknown(3 * node) < 0) nodes.push_back(node);
  return nodes;
}

/// Limits of a panel that shows the vertices and `below` and `above` them, in shares of their width.
void frame(app::Panel& panel, const blade::SurfaceView& view, const std::vector<int>& vertices, double below,
           double above) {
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(1e300), upper = -lower;
  for (const int vertex : vertices) {
    const Eigen::Vector2d at = projected(view, view.surfaces[0].vertices.col(vertex));
    lower = lower.cwiseMin(at);
    upper = upper.cwiseMax(at);
  }
  const double width = upper.x() - lower.x();
  panel.x = axis("", lower.x() - 0.1 * width, upper.x() + 0.1 * width);
  panel.y = axis("", lower.y() - below * width, upper.y() + above * width);
}

blade::SurfaceView view_of(const fem::Blade& blade, double azimuth, double elevation) {
  blade::SurfaceView view;
  view.surfaces = {blade::surface(blade)};
  view.azimuth = azimuth;
  view.elevation = elevation;
  return view;
}

void mark(blade::SurfaceView& view, const std::string& label, const std::vector<int>& nodes,
          app::Colour colour, int marker) {
  view.surfaces[0].marks.push_back({label, nodes, colour, marker});
}

/// Arrows from the contact nodes in the direction in which they may touch, z.
void add_contact_direction(app::Panel& panel, const blade::SurfaceView& view, const std::vector<int>& nodes) {
  constexpr double length = 7.0;  // mm
  for (std::size_t i = 0; i < nodes.size(); i += 2) {
    const Eigen::Vector3d node = view.surfaces[0].vertices.col(nodes[i]);
    const Eigen::Vector2d from = projected(view, node),
                          to = projected(view, node + Eigen::Vector3d(0, 0, length));
    panel.segments.push_back(
        {from.x(), from.y(), to.x(), to.y(), true, app::Dash::solid, app::Colour::vermillion, 1.0});
  }
}

app::Figure drawn(const fem::Blade& blade) {
  app::Figure figure;
  figure.columns = 3;
  figure.panel_width = 350;
  figure.panel_height = 330;
  const auto held = held_nodes(blade);
  const std::string contacts = std::to_string(blade.contact_nodes.size()) + " contact nodes";
  const std::string clamped = std::to_string(held.size()) + " clamped nodes";
  auto whole = view_of(blade, -55.0, 28.0);
  whole.axes = arrow_length;
  mark(whole, contacts, blade.contact_nodes, app::Colour::vermillion, 1);
  mark(whole, clamped, held, app::Colour::blue, 3);
  paint(figure.add_panel("the mesh"), whole, "mesh");
  auto tip = view_of(blade, -60.0, 50.0);
  tip.shading = 0.15;
  mark(tip, contacts, blade.contact_nodes, app::Colour::vermillion, 1);
  app::Panel& above = figure.add_panel("the tip, from above");
  frame(above, tip, blade.contact_nodes, 0.35, 0.20);
  add_contact_direction(above, tip, blade.contact_nodes);
  paint(above, tip, "tip");
  auto root = view_of(blade, -55.0, -40.0);
  root.shading = 0.15;
  mark(root, clamped, held, app::Colour::blue, 3);
  app::Panel& below = figure.add_panel("the root, from below");
  frame(below, root, held, 0.1, 0.35);
  paint(below, root, "root");
  return figure;
}

}  // namespace

void fig06(report::Artefact& artefact) {
  const app::ModeStudy study(artefact.scene("blade_mode.toml"));
  const fem::Blade& blade = *study.model().blade;
  artefact.picture(drawn(blade));
  artefact.data(contact_nodes(blade, study.scene().contact.gap),
                "contact nodes from the leading to the trailing edge; metres",
                {"node numbers of the mesh from 1; eta = -1 and 1 are the two faces of the blade"});
  const auto& mesh = blade.model.mesh;
  artefact.caption(fmt::format(
      "An open titanium blade instead of the paper's proprietary one: {} hexahedra of 20 nodes, {} unknowns, clamped at "
      "the root. Contact is in the radial direction z (arrows in (b)) at the corner nodes of the tip. Arrows of the axes: {} mm.",
      mesh.elements.cols(), study.model().unknowns, report::number(arrow_length)));
  const double error = reduction_error(study);
  const auto coordinates = study.model().size();
  artefact.check(
      {"section 5.2",
       "This model is reduced by means of a Craig-Bampton procedure composed of 72 constraints modes "
       "associated with the physical displacements of 24 retained interface nodes belonging to the contact "
       "surface Γ_C complemented by 40 component normal modes.",
       "24 contact nodes, 112 coordinates, and the eight lowest frequencies within 5e-4 of the "
       "whole blade",
       fmt::format(
           "{} contact nodes, {} coordinates from {} unknowns; eight frequencies within {}; first {} Hz; "
           "assembled and reduced in {} s",
           blade.contact_nodes.size(), coordinates, study.model().unknowns, report::number(error, 2),
           report::number(study.linear_frequency(), 5), report::number(study.model().reduction_seconds, 3)),
       blade.contact_nodes.size() == 24 && coordinates == 112 && error < 5e-4});
}

}  // namespace wavebalance::ll10
