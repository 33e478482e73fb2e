#include "wavebalance/fem/blade.hpp"

#include <cmath>
#include <numbers>

#include "require.hpp"

namespace wavebalance::fem {
namespace {

void require_blade_positive(const char* member, double value) {
  detail::require_value(value > 0.0 && std::isfinite(value), "BladeOptions", member, value,
                        "positive and finite");
}

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
  for (int end : {0, 1}) {
    const auto at = static_cast<std::size_t>(end);
    require_blade_positive("chord", chord[at]);
    require_blade_positive("thickness_ratio", thickness_ratio[at]);
    detail::require_value(std::isfinite(camber_ratio[at]), "BladeOptions", "camber_ratio", camber_ratio[at],
                          "finite");
    detail::require_value(std::isfinite(angle_degrees[at]), "BladeOptions", "angle_degrees",
                          angle_degrees[at], "finite");
  }
  detail::require_value(edge_thickness > 0.0 && edge_thickness <= 1.0, "BladeOptions", "edge_thickness",
                        edge_thickness, "in (0, 1]");
  require_blade_positive("length", length);
  material.validate();
  detail::require_value(chord_elements >= 1, "BladeOptions", "chord_elements", chord_elements, "at least 1");
  detail::require_value(thickness_elements >= 1, "BladeOptions", "thickness_elements", thickness_elements,
                        "at least 1");
  detail::require_value(span_elements >= 1, "BladeOptions", "span_elements", span_elements, "at least 1");
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
