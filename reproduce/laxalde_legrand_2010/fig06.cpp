#include <fmt/format.h>

#include <algorithm>

#include "blade.hpp"
#include "figures.hpp"

namespace wavebalance::ll10 {
namespace {

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

/// One panel: the blade from one side, limited to a window around the tip if `tip_only`.
void add_view(app::Figure& figure, const fem::Blade& blade, double azimuth, double elevation, bool tip_only) {
  auto& panel = figure.add_panel(tip_only ? "contact interface at the tip" : "model, arrows 15 mm");
  auto& view = panel.surface.emplace();
  view.surfaces = {blade::surface(blade)};
  auto& marks = view.surfaces[0].marks;
  marks.push_back({"contact nodes", blade.contact_nodes, app::Colour::vermillion, 1});
  if (!tip_only) marks.push_back({"clamped nodes", held_nodes(blade), app::Colour::blue, 3});
  view.azimuth = azimuth;
  view.elevation = elevation;
  if (!tip_only) view.axes = 15.0;
  if (!tip_only) return;
  view.shading = 0.15;
  const auto& tip = view.surfaces[0].vertices;
  double lower = 1e300, upper = -1e300, top = -1e300;
  for (const int node : blade.contact_nodes) {
    const Eigen::Vector2d at = projected(view, tip.col(node));
    lower = std::min(lower, at.x());
    upper = std::max(upper, at.x());
    top = std::max(top, at.y());
  }
  const double width = upper - lower;
  panel.x = axis("", lower - 0.1 * width, upper + 0.1 * width);
  panel.y = axis("", top - 0.55 * width, top + 0.1 * width);
}

}  // namespace

void fig06(report::Artefact& artefact) {
  const app::ModeStudy study(artefact.scene("blade_mode.toml"));
  const fem::Blade& blade = *study.model().blade;
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 470;
  figure.panel_height = 500;
  add_view(figure, blade, -55.0, 28.0, false);
  add_view(figure, blade, -60.0, 62.0, true);
  figure.panels[0].legend = figure.panels[1].legend = app::Legend::below_panel;
  artefact.picture(figure);
  artefact.data(contact_nodes(blade, study.scene().contact.gap),
                "contact nodes from the leading to the trailing edge; metres",
                {"node numbers of the mesh from 1; eta = -1 and 1 are the two faces of the blade"});
  const auto& mesh = blade.model.mesh;
  artefact.caption(fmt::format(
      "An open blade of titanium in place of the paper's proprietary one: {} hexahedra of 20 nodes, {} "
      "unknowns, clamped at the root; contact in the radial direction z at the corner nodes of the tip.",
      mesh.elements.cols(), study.model().unknowns));
  const double error = reduction_error(study);
  const auto coordinates = study.model().size();
  artefact.check(
      {"section 5.2",
       "This model is reduced by means of a Craig-Bampton procedure composed of 72 constraints modes "
       "associated with the physical displacements of 24 retained interface nodes belonging to the contact "
       "surface Γ_C complemented by 40 component normal modes.",
       "24 contact nodes, 112 coordinates, and the eight lowest frequencies within 5e-4 of those of the "
       "whole blade",
       fmt::format(
           "{} contact nodes, {} coordinates from {} unknowns; eight frequencies within {}; first {} Hz; "
           "assembled and reduced in {} s",
           blade.contact_nodes.size(), coordinates, study.model().unknowns, report::number(error, 2),
           report::number(study.linear_frequency(), 5), report::number(study.model().reduction_seconds, 3)),
       blade.contact_nodes.size() == 24 && coordinates == 112 && error < 5e-4});
}

}  // namespace wavebalance::ll10
