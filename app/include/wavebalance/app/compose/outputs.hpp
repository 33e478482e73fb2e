#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// A place whose motion a record shows: a degree of freedom, or a contact.
struct Output {
  std::string name;        ///< "node 1052 z", "-row 17", "contact 2"
  std::string title;       ///< the name, of contacts with the place: "contact 2, -node 18 z"
  std::string column;      ///< the name as that of a column begins, "minus_row_17"
  std::string unit = "m";  ///< or "rad" of a rotation
  int dof = 0;             ///< as in analysis.outputs; 0 of a contact
  int contact = -1;        ///< the direction of contact, from 0; -1 of a degree of freedom
  /// The direction whose force tells whether that contact is closed, the normal one where it has tangents; -1
  /// where it never opens.
  int closed_by = -1;

  bool is_contact() const { return contact >= 0; }
};

/// The name of a place as that of a column begins: "minus_node_18_x", "contact_2".
std::string column_of(const std::string& name);

/// The unit of the displacement of a contact: "rad" between rotations alone, otherwise "m".
std::string displacement_unit(const Scene& scene, const SceneContact& contact);
/// "rad" where all contacts are between rotations, otherwise "m".
std::string displacement_unit(const Scene& scene);

/// analysis.outputs of a scene and, with analysis.contact_outputs, its contacts after them.
std::vector<Output> outputs_of(const Scene& scene);

/// The index of the output that was asked for first: that of analysis.peak_of, else the first of
/// analysis.outputs; none where contacts alone are outputs.
std::optional<std::size_t> leading_output(const std::vector<Output>& outputs, const Scene& scene);

/// outputs x r: the displacements of degrees of freedom from the coordinates of the structure that is solved;
/// zero rows of contacts. O(outputs r).
Eigen::MatrixXd rows_of_outputs(const std::vector<Output>& outputs, const Scene& scene,
                                const StructureModel& model);

}  // namespace wavebalance::app
