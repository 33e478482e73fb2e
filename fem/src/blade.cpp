#include "wavebalance/fem/blade.hpp"

#include <numbers>

#include "require.hpp"

namespace wavebalance::fem {
namespace {

double between(const std::array<double, 2>& ends, double s) { return ends[0] + (ends[1] - ends[0]) * s; }

Eigen::Vector3d position(const BladeOptions& options, const Eigen::Vector3d& parameters) {
  const double xi = 2.0 * parameters[0] - 1.0, eta = 2.0 * parameters[1] - 1.0, s = parameters[2];
  const double chord = between(options.chord, s);
  const double thickness = between(options.thickness_ratio, s) * chord;
  const double camber = between(options.camber_ratio, s) * chord;
  const double angle = between(options.angle_degrees, s) * std::numbers::pi / 180.0;
  const double bow = 1.0 - xi * xi;
  const double profile = options.edge_thickness + (1.0 - options.edge_thickness) * bow;
  const double x = xi * chord / 2.0;
  const double y = camber * bow - 2.0 * camber / 3.0 + eta / 2.0 * thickness * profile;
  return {x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle),
          s * options.length};
}

}  // namespace

void BladeOptions::validate() const {
  constexpr const char* who = "BladeOptions";
  const auto require_elements = [](const char* member, int count) {
    detail::require_value(count >= 1, who, member, count, "at least 1");
  };
  for (const std::size_t end : {0u, 1u}) {
    detail::require_positive(who, "chord", chord[end]);
    detail::require_positive(who, "thickness_ratio", thickness_ratio[end]);
    detail::require_value(std::isfinite(camber_ratio[end]), who, "camber_ratio", camber_ratio[end], "finite");
    detail::require_value(std::isfinite(angle_degrees[end]), who, "angle_degrees", angle_degrees[end],
                          "finite");
  }
  detail::require_value(edge_thickness > 0.0 && edge_thickness <= 1.0, who, "edge_thickness", edge_thickness,
                        "in (0, 1]");
  detail::require_positive(who, "length", length);
  material.validate();
  require_elements("chord_elements", chord_elements);
  require_elements("thickness_elements", thickness_elements);
  require_elements("span_elements", span_elements);
}

Blade blade(const BladeOptions& options) {
  options.validate();
  StructuredMesh block = structured_mesh(
      options.element, {options.chord_elements, options.thickness_elements, options.span_elements},
      [&](const Eigen::Vector3d& parameters) { return position(options, parameters); });
  Blade result;
  for (int i = 0; i <= options.chord_elements; ++i) {
    const double along = static_cast<double>(i) / options.chord_elements;
    const auto pair = block.nodes_where([&](const Eigen::Vector3d& at) {
      return at[2] == 1.0 && (at[1] == 0.0 || at[1] == 1.0) && std::abs(at[0] - along) < 1e-9;
    });
    result.contact_nodes.insert(result.contact_nodes.end(), pair.begin(), pair.end());
  }
  const std::vector<int> root = block.nodes_where([](const Eigen::Vector3d& at) { return at[2] == 0.0; });
  result.model = hold_nodes(std::move(block.mesh), options.material, root);
  for (int node : result.contact_nodes) {
    for (int axis = 0; axis < 3; ++axis)
      result.boundary_unknowns.push_back(result.model.dofs.unknown(3 * node + axis));
    result.contact_unknowns.push_back(result.boundary_unknowns.back());
  }
  return result;
}

}  // namespace wavebalance::fem
