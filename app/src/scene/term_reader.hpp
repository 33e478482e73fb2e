#pragma once

#include "scene/scene_document.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Entries of [[forcing.terms]] that a scene may have.
inline constexpr int most_terms = 200;

/// Whether a section has the name of an entry of [[forcing.terms]].
bool is_term_section(std::string_view section);

/// The number of these entries in `document`. Throws SceneError for more than most_terms.
std::size_t count_terms(const Document& document);

/// Reads all entries of [[forcing.terms]] into scene.forcing.terms, which has their number, once the other
/// keys are read. Throws SceneError.
void read_terms(const Document& document, Scene& scene);

}  // namespace wavebalance::app
