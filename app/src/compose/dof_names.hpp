#pragma once
#include "scene/scene_document.hpp"

namespace wavebalance::app {

/// The document with rows of the matrices, counted from 1, in place of names such as "node 1042 z" or
/// "-node 1042 z" in its lists of degrees of freedom. structure.dof_map says which row a name is. Throws
/// SceneError at a name that is none or is not in the map, or if there is no map.
Document with_rows_for_names(Document document);

}  // namespace wavebalance::app
