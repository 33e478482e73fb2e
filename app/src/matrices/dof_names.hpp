#pragma once

#include "scene/scene_document.hpp"
#include "wavebalance/fem/dof_map.hpp"

namespace wavebalance::app {

/// A degree of freedom by its name.
struct NamedDof {
  int sign = 1;
  fem::NodeDof dof;
  bool numbered = false;  ///< "node 2 z #2", one of several rows of the name
};

/// "node 1042 z" or "node 2 z #2", with a minus sign before it or not; none if the text is another.
std::optional<NamedDof> named_dof(std::string text);
/// The rows from 0 that a name means: all copies for a node of an expanded beam or shell. None if the map
/// has none.
std::vector<int> rows_of(const fem::DofMap& map, const NamedDof& named);
/// Why a map, the file `path`, has no such row.
std::string absent_text(const fem::DofMap& map, const fem::NodeDof& dof, const std::string& path);

/// The document with rows of the matrices, counted from 1, instead of names such as "node 1042 z" or "-node
/// 1042 z" in its lists of degrees of freedom. structure.dof_map defines the row of a name. A name of
/// several rows is their mean: in contacts and forces its coefficient is shared equally by all of them, so
/// that a force does work with the mean. Throws SceneError at a name that is none or is not in the map, or
/// if there is no map.
Document with_rows_for_names(Document document);

}  // namespace wavebalance::app
