#include "report/page_parts.hpp"

#include <fmt/format.h>

namespace wavebalance::app {
namespace {

std::string list_text(std::span<const double> values) {
  return fmt::format("[{:.6g}]", fmt::join(values, ","));
}

/// The contact force over the amplitude at the instants of the motion, a subset of the response's instants.
std::vector<double> forces(const Scene& scene, const Record& record) {
  const std::vector<double> all = record.response.numbers("contact_force_N");
  const std::size_t instants = static_cast<std::size_t>(record.bar_motion.cols());
  std::vector<double> chosen;
  for (std::size_t k = 0; k < instants; ++k)
    chosen.push_back(all[k * all.size() / instants] / std::abs(scene.forcing.amplitude));
  return chosen;
}

}  // namespace

bool has_bar_motion(const Scene& scene, const Record& record) {
  return record.bar_motion.cols() > 0 && !record.response.empty() && scene.forcing.amplitude != 0.0 &&
         record.response.rows() % static_cast<std::size_t>(record.bar_motion.cols()) == 0;
}

std::string bar_motion_script(const Scene& scene, const Record& record, const std::string& name) {
  const Eigen::MatrixXd& nodes = record.bar_motion;
  const Eigen::VectorXd tip = nodes.row(nodes.rows() - 1);
  std::vector<double> times;
  std::string instants;
  for (Eigen::Index k = 0; k < nodes.cols(); ++k) {
    times.push_back(static_cast<double>(k) / static_cast<double>(nodes.cols()));
    instants += (k == 0 ? "" : ",") +
                list_text(std::span(nodes.col(k).data(), static_cast<std::size_t>(nodes.rows())));
  }
  return fmt::format(
      "(window.wavebalance ?\?= {{}}).motions ?\?= {{}};\n"
      "wavebalance.motions[\"{}\"] = {{\"gap\":{:.6g},\"frequency\":{:.6g},\"time\":{},\"pairs\":[],\n"
      "\"reference\":{{\"label\":\"this motion\",\"tip\":{},\"force\":{},\"nodes\":[{}]}}}};\n",
      name, scene.contact.gap, scene.forcing.frequency, list_text(times),
      list_text(std::span(tip.data(), static_cast<std::size_t>(tip.size()))),
      list_text(forces(scene, record)), instants);
}

}  // namespace wavebalance::app
