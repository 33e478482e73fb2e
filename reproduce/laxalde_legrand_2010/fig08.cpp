#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "blade.hpp"
#include "figures.hpp"
#include "wavebalance/fem/vtu.hpp"

namespace wavebalance::ll10 {
namespace {

constexpr int shape_times = 16;
constexpr double drawn_gap = 1e-3;  // m

/// One mode motion, displacements over the gap.
struct Shape {
  double energy;
  solvers::ModePoint point;
  std::vector<Eigen::Matrix3Xd> frames;
};

double largest(const Eigen::Matrix3Xd& displacement) { return displacement.colwise().norm().maxCoeff(); }

void add_panel(app::Figure& figure, const fem::Blade& blade, const Shape& shape, bool half_period,
               double upper) {
  const Eigen::Matrix3Xd& u = shape.frames[half_period ? shape_times / 2 : 0];
  auto& panel =
      figure.add_panel("energy " + report::number(shape.energy) + (half_period ? ", t = T/2" : ", t = 0"));
  auto& view = panel.surface.emplace();
  view.surfaces = {blade::surface(blade), blade::surface(blade, u, drawn_gap)};
  view.surfaces[0].outline = true;
  const Eigen::VectorXd magnitude = u.colwise().norm();
  view.surfaces[1].values.assign(magnitude.begin(), magnitude.end());
  view.colours = {app::ColourBands::Map::sequential, 0.0, upper, 10, "|u| / g_0", true};
  view.azimuth = -35.0;
  view.elevation = 22.0;
  view.axes = 15.0;
  panel.x = axis("", -42.0, 42.0);
  panel.y = axis("", -18.0, 104.0);
}

/// Gap-sized motions as a series for ParaView.
void attach_series(report::Artefact& artefact, const fem::Blade& blade, const Shape& shape) {
  const std::string stem = "fig08_energy_" + report::number(shape.energy);
  std::vector<fem::PvdEntry> entries;
  for (std::size_t frame = 0; frame < shape.frames.size(); ++frame) {
    const std::string name = stem + "_" + (frame < 10 ? "0" : "") + std::to_string(frame) + ".vtu";
    const fem::PointField fields[] = {{"displacement", drawn_gap * shape.frames[frame]}};
    std::ostringstream text;
    fem::write_vtu(text, blade.model.mesh, fields);
    artefact.attach(name, text.str(), false);
    entries.push_back({static_cast<double>(frame) / shape_times, name});
  }
  std::ostringstream text;
  fem::write_pvd(text, entries);
  artefact.attach(stem + ".pvd", text.str(), true);
}

Table shapes_table(const fem::Blade& blade, const std::vector<Shape>& shapes) {
  Table table({"energy_ratio", "time_fraction", "contact", "u_x_over_gap", "u_y_over_gap", "u_z_over_gap"});
  for (const Shape& shape : shapes)
    for (const int frame : {0, shape_times / 2})
      for (std::size_t i = 0; i < blade.contact_nodes.size(); ++i) {
        const Eigen::Vector3d u = shape.frames[static_cast<std::size_t>(frame)].col(blade.contact_nodes[i]);
        table.append_row({shape.energy, static_cast<double>(frame) / shape_times, static_cast<double>(i + 1),
                          u.x(), u.y(), u.z()});
      }
  return table;
}

/// |<a, b>| / (|a| |b|): 1 for the same shape, whatever its size.
double likeness(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return std::abs(a.cwiseProduct(b).sum()) / (a.norm() * b.norm());
}

void claims(report::Artefact& artefact, const app::ModeStudy& study, const std::vector<Shape>& shapes) {
  const auto torsion = blade::torsion_modes(study);
  const fem::Blade& blade = *study.model().blade;
  std::string shares, twists, likenesses;
  double before_share = -1.0, before_twist = -1.0, least = 1.0;
  bool grows = true;
  for (const Shape& shape : shapes) {
    const double share = blade::torsion_share(torsion, shape.point);
    const double twist = blade::twist_amplitude(blade, shape.frames) * drawn_gap * 180.0 / std::numbers::pi;
    grows = grows && share > before_share && twist > before_twist;
    before_share = share;
    before_twist = twist;
    const double like = likeness(shape.frames[0], shape.frames[shape_times / 2]);
    least = std::min(least, like);
    const char* comma = shares.empty() ? "" : ", ";
    shares += comma + report::percent(share, 3);
    twists += comma + report::number(twist, 3) + "°";
    likenesses += comma + report::number(like, 4);
  }
  artefact.check(
      {"section 5.2",
       "torsion effects tends to appear as modal energy increases and contact becomes more prominent",
       "from one energy to the next both the share of the kinetic energy in torsion modes and the amplitude "
       "of "
       "the tip's rotation about z grow",
       "at energies 0.8, 4.7, 10.4: " + shares + " of the energy; tip twist " + twists + " for a gap of 1 mm",
       grows});
  artefact.check(
      {"section 5.2", "Sensitivity of mode shapes to contacts is noticeable.",
       "the shapes at t = 0 and T/2, equal but for sign in the linear mode, have a likeness |<a,b>| "
       "/ (|a||b|) below 0.99 at some energy",
       "likeness " + likenesses + " at energies 0.8, 4.7, 10.4", least < 0.99});
}

}  // namespace

void fig08(report::Artefact& artefact) {
  const app::ModeStudy study(artefact.scene("blade_mode.toml"));
  const fem::Blade& blade = *study.model().blade;
  const auto curve = study.backbone();
  std::vector<Shape> shapes;
  for (const double energy : shape_energies) {
    const auto point = accepted_at(study, curve, energy);
    Shape shape{energy, point, blade::motion(study, point, shape_times)};
    for (auto& frame : shape.frames) frame /= study.scene().contact.gap;
    shapes.push_back(std::move(shape));
  }
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 350;
  figure.panel_height = 350;
  for (const Shape& shape : shapes) {
    const double upper = std::max(largest(shape.frames[0]), largest(shape.frames[shape_times / 2]));
    for (const bool half_period : {false, true})
      add_panel(figure, blade, shape, half_period, std::ceil(upper / 10.0) * 10.0);
  }
  artefact.picture(figure);
  artefact.data(shapes_table(blade, shapes), "displacements of the contact nodes over the gap",
                {"contacts as in fig06_blade.csv"});
  for (const Shape& shape : shapes) attach_series(artefact, blade, shape);
  artefact.caption(
      "Shapes at t = 0, the middle of the leading edge's contact, and T/2, of the trailing edge's. "
      "Displacements "
      "to scale for a gap of 1 mm, arrows 15 mm, dashed the blade at rest; colours are the displacement "
      "over the gap. The .pvd files hold the motions for ParaView.");
  claims(artefact, study, shapes);
}

}  // namespace wavebalance::ll10
