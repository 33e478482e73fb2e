#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/output_words.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// A periodic motion of supports, amplitudes of the harmonics of the load.
struct SupportMotion {
  Eigen::VectorXcd harmonics;
  int derivative = 0;  ///< of which they are the amplitudes: 0 of a displacement (m), 2 of an acceleration
};

/// A place whose motion a record shows: degrees of freedom, or a contact.
struct Output {
  std::string name;            ///< "node 1052 z", "-row 17", "velocity of row 3", "contact 2"
  std::string title;           ///< the name, of contacts with the place: "contact 2, -node 18 z"
  std::string column;          ///< the beginning of the names of its columns, "minus_row_17"
  std::string unit = "m";      ///< of its values: "rad" of a rotation, "g"; empty of a ratio
  std::string suffix = "m";    ///< the unit at the end of a column's name
  std::vector<int> rows = {};  ///< of matrices or nodes of a bar, from 0; none of a contact
  double weight = 1.0;         ///< of each row: the mean with a sign
  int derivative = 0;          ///< of the displacement: 1 of a velocity, 2 of an acceleration
  double size = 1.0;           ///< of the unit in SI units: values are divided by it
  int contact = -1;            ///< the direction of contact, from 0; -1 of a degree of freedom
  std::string number = {};     ///< of a contact "contact 2", whatever its name
  /// The direction whose force shows whether that contact is closed, the normal one where it has tangents;
  /// -1 where it never opens.
  int closed_by = -1;
  std::vector<SupportMotion> added = {};  ///< motions added to obtain its frame of reference
  std::vector<SupportMotion> over = {};   ///< over whose half peak-to-peak value it is a ratio; or none

  bool is_contact() const { return contact >= 0; }
  /// Whether its name holds more than the place.
  bool names_quantity() const { return !is_contact() && name.find(" of ") != std::string::npos; }
  /// "node_1052_z_max_m".
  std::string column_of(const std::string& value) const;
  /// "Vibration", "Velocity" or another quantity as an axis names it.
  std::string quantity_words(const std::string& of_displacement) const;
};

/// Name of a place as the beginning of a column: "minus_node_18_x", "contact_2".
std::string column_of(const std::string& name);

/// The unit of the displacement of a contact: "rad" if all its rows are rotations, otherwise "m".
std::string displacement_unit(const Scene& scene, const SceneContact& contact);
/// "rad" where all contacts are between rotations, otherwise "m".
std::string displacement_unit(const Scene& scene);
/// "N", or "N m" of contacts whose displacement has the unit "rad".
std::string force_unit(const std::string& displacement_unit);

/// Name of an output as the beginning of a column, "minus_row_17".
std::string column_of(const std::string& name);

/// analysis.outputs of a scene and, with analysis.contact_outputs, its contacts after them. Throws
/// std::invalid_argument for words that are none.
std::vector<Output> outputs_of(const Scene& scene);

/// The output of analysis.peak_of by the name that it has; empty if none is requested.
std::string peak_name(const Scene& scene);

/// Index of the first output: analysis.peak_of, else the first of analysis.outputs; none if only contacts are
/// outputs.
std::optional<std::size_t> leading_output(const std::vector<Output>& outputs, const Scene& scene);

/// outputs x r: the displacements of degrees of freedom from the coordinates of the structure that is solved;
/// zero rows of contacts. O(outputs r).
Eigen::MatrixXd rows_of_outputs(const std::vector<Output>& outputs, const Scene& scene,
                                const StructureModel& model);

/// A derivative of a motion of supports at uniform times of `periods` periods of the load, Hz; all but its
/// static part `factor` times as large.
Eigen::VectorXd support_values(const SupportMotion& motion, int derivative, double frequency, double factor,
                               int points, int periods);

}  // namespace wavebalance::app
