#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "blade.hpp"
#include "figures.hpp"
#include "wavebalance/app/page/body.hpp"
#include "wavebalance/fem/vtu.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::ll10 {
namespace {

constexpr int shape_times = 16;
constexpr double axes_length = 15.0;  // mm
constexpr double drawn_gap = 1e-3;    // m

/// One mode motion, displacements over the gap.
struct Shape {
  double energy;
  solvers::ModePoint point;
  std::vector<Eigen::Matrix3Xd> frames;
};

/// The contact nodes that bear a force at the sample nearest to a fraction of the period.
std::vector<int> touching(const fem::Blade& blade, const solvers::ModePoint& point, double fraction) {
  const auto sample =
      static_cast<Eigen::Index>(std::lround(fraction * static_cast<double>(point.force.cols())));
  std::vector<int> nodes;
  for (Eigen::Index i = 0; i < point.force.rows(); ++i)
    if (point.force(i, sample) > 0.0) nodes.push_back(blade.contact_nodes[static_cast<std::size_t>(i)]);
  return nodes;
}

double largest(const Eigen::Matrix3Xd& displacement) { return displacement.colwise().norm().maxCoeff(); }

void add_panel(app::Figure& figure, const fem::Blade& blade, const Shape& shape, bool half_period,
               double upper) {
  const Eigen::Matrix3Xd& u = shape.frames[half_period ? shape_times / 2 : 0];
  auto& panel =
      figure.add_panel("energy " + report::number(shape.energy) + (half_period ? ", t = T/2" : ", t = 0"));
  blade::SurfaceView view;
  view.surfaces = {blade::surface(blade), blade::surface(blade, u, drawn_gap)};
  view.surfaces[0].outline = true;
  const Eigen::VectorXd magnitude = u.colwise().norm();
  view.surfaces[1].values.assign(magnitude.begin(), magnitude.end());
  view.colours = {0.0, upper, 10, "|u| / g_0"};
  view.surfaces[1].marks.push_back(
      {"in contact", touching(blade, shape.point, half_period ? 0.5 : 0.0), app::Colour::vermillion, 1});
  view.azimuth = -35.0;
  view.elevation = 22.0;
  view.axes = axes_length;
  panel.x = axis("", -42.0, 42.0);
  panel.y = axis("", -18.0, 104.0);
  paint(panel, view, "shape" + std::to_string(figure.panels.size()));
}

/// Gap-sized motions as a series for ParaView, and as the body that the page moves.
void attach_series(report::Artefact& artefact, const fem::Blade& blade, const Shape& shape) {
  const std::string stem = "fig08_energy_" + report::number(shape.energy);
  const auto& mesh = blade.model.mesh;
  app::MovingBody body{
      "energy " + report::number(shape.energy), mesh.nodes, fem::surface_of(fem::mesh_of(mesh)), {}};
  std::vector<fem::PvdEntry> entries;
  for (std::size_t frame = 0; frame < shape.frames.size(); ++frame) {
    const std::string name = stem + "_" + (frame < 10 ? "0" : "") + std::to_string(frame) + ".vtu";
    body.frames.push_back(drawn_gap * shape.frames[frame]);
    const fem::PointField fields[] = {{"displacement", body.frames.back()}};
    artefact.attach(name, fem::vtu_text(fem::mesh_of(mesh), fields), false);
    entries.push_back({static_cast<double>(frame) / shape_times, name});
  }
  artefact.attach(stem + ".pvd", fem::pvd_text(entries));
  artefact.attach(stem + ".body.js", app::body_script(stem, body), false);
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

/// Largest difference of two shapes, each over its own largest displacement and of the sign that fits best.
double unlikeness(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  const double sign = a.cwiseProduct(b).sum() < 0.0 ? -1.0 : 1.0;
  return largest(a / largest(a) - sign * b / largest(b));
}

void claim_torsion(report::Artefact& artefact, const app::ModeStudy& study,
                   const std::vector<Shape>& shapes) {
  const auto torsion = blade::torsion_modes(study);
  std::string measured;
  std::vector<double> shares, twists;
  for (const Shape& shape : shapes) {
    shares.push_back(blade::torsion_share(torsion, shape.point));
    twists.push_back(blade::twist_amplitude(*study.model().blade, shape.frames) * drawn_gap * 180.0 /
                     std::numbers::pi);
    measured +=
        fmt::format("{}{} and {}° at energy {}", measured.empty() ? "" : ", ", report::percent(shares.back()),
                    report::number(twists.back()), report::number(shape.energy));
  }
  const auto grows = [](const std::vector<double>& values) {
    return report::lower({values.begin(), values.end() - 1}, {values.begin() + 1, values.end()});
  };
  judge(
      artefact,
      {.place = "section 5.2",
       .quote =
           "torsion effects tends to appear as modal energy increases and contact becomes more prominent",
       .criterion =
           "the share of torsion modes in the kinetic energy, and the amplitude of the tip's rotation about z for "
           "a gap of 1 mm, are lower at each of the paper's three energies than at the next",
       .measured = measured,
       .verdict = report::together({grows(shares), grows(twists)}),
       .apart = on_our_blade},
      "One of them does not grow from one energy to the next.");
}

void claim_sensitivity(report::Artefact& artefact, const std::vector<Shape>& shapes) {
  std::string measured;
  double largest_difference = 0.0;
  for (const Shape& shape : shapes) {
    const double difference = unlikeness(shape.frames[0], shape.frames[shape_times / 2]);
    if (shape.energy > 1.0) largest_difference = std::max(largest_difference, difference);
    measured += fmt::format("{}{} at energy {}", measured.empty() ? "" : ", ", report::percent(difference, 2),
                            report::number(shape.energy));
  }
  judge(artefact,
        {.place = "section 5.2",
         .quote = "Sensitivity of mode shapes to contacts is noticeable.",
         .criterion = fmt::format(
             "the shapes at t = 0 and T/2, equal but for sign without contact, differ with contact by more "
             "than {} of their largest displacement",
             report::percent(report::visible_share)),
         .measured = measured,
         .verdict = report::plain(largest_difference > report::visible_share),
         .panel = "(c) to (f)",
         .apart = on_our_blade},
        "The shapes differ by less.");
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
  figure.panel_height = 300;
  double upper = 0.0;
  for (const Shape& shape : shapes)
    for (const auto& frame : shape.frames) upper = std::max(upper, largest(frame));
  for (const Shape& shape : shapes)
    for (const bool half_period : {false, true})
      add_panel(figure, blade, shape, half_period, std::ceil(upper / 10.0) * 10.0);
  artefact.picture(figure);
  artefact.data(shapes_table(blade, shapes), "displacements of the contact nodes over the gap",
                {"contacts as in fig06_blade.csv"});
  for (const Shape& shape : shapes) attach_series(artefact, blade, shape);
  artefact.caption(fmt::format(
      "Shapes at t = 0 (contact of the leading edge) and T/2 (trailing edge), to scale for a gap of {} mm; arrows of the axes "
      "{} mm. Colours are the displacement over the gap. Dots are the nodes that bear a force. The .pvd files are for "
      "ParaView.",
      report::number(1e3 * drawn_gap), report::number(axes_length)));
  claim_torsion(artefact, study, shapes);
  claim_sensitivity(artefact, shapes);
}

}  // namespace wavebalance::ll10
