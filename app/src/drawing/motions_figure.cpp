#include "drawing/figures.hpp"

#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

constexpr std::size_t most_motions = 8;

Series look(Series series, const FoundMotion& motion, std::size_t number) {
  const std::string periods =
      motion.found.periods == 1 ? "" : ", " + std::to_string(motion.found.periods) + " periods";
  series.label = "motion " + std::to_string(number + 1) + periods + ", " + motion.found.stability.status;
  if (motion.found.stability.unstable > 0) series.dash = Dash::dashed;
  return series;
}

}  // namespace

Figure motions_figure(const Scene& scene, const Motions& all) {
  Figure figure;
  if (all.motions.empty()) return figure;
  const std::size_t count = std::min(all.motions.size(), most_motions);
  const int row = all.motions.front().contact;
  double reach = 0.0, fastest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    reach = std::max(reach, all.motions[i].contacts.displacement.row(row).cwiseAbs().maxCoeff());
    fastest = std::max(fastest, all.motions[i].contacts.velocity.row(row).cwiseAbs().maxCoeff());
  }
  const Scale length = axis_scale(reach), speed = axis_scale(fastest);
  const std::vector<SceneContact> contacts = contact_places(scene);
  const std::string name = contacts.size() > 1 ? " of " + plain(name_of(contacts[std::size_t(row)])) : "";
  const std::string unit = displacement_unit(scene, contacts[std::size_t(row)]);
  figure.title = all.motions.size() > count ? "The first " + std::to_string(count) + " motions" : "";
  figure.panel_width = 600;
  figure.panel_height = 320;
  const std::string displacement = "Displacement (" + length.prefix + unit + ")";
  figure.add_panel("Displacement" + name, "Time (forcing periods)", displacement);
  figure.add_panel("Velocity over displacement", displacement, "Velocity (" + speed.prefix + unit + "/s)");
  for (std::size_t i = 0; i < count; ++i) {
    const FoundMotion& motion = all.motions[i];
    const Eigen::VectorXd u = once_around(motion.contacts.displacement, row, length.factor),
                          v = once_around(motion.contacts.velocity, row, speed.factor);
    const Eigen::VectorXd periods = Eigen::VectorXd::LinSpaced(u.size(), 0.0, motion.found.periods);
    figure.panels[0].add(look(Series("", periods, u), motion, i));
    figure.panels[1].add(look(Series("", u, v), motion, i));
  }
  return figure;
}

}  // namespace wavebalance::app
