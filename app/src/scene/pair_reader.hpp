#pragma once

#include "scene/scene_document.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Entries of [[contact.pairs]] that a scene may have.
inline constexpr int most_pairs = 2000;

/// Whether a section has the name of an entry of [[contact.pairs]].
bool is_pair_section(std::string_view section);

/// The number of these entries in `document`. Throws SceneError for more than most_pairs.
std::size_t count_pairs(const Document& document);

/// The document with contact.law set to the law of the first pair, if it has none and all pairs have laws.
/// Throws SceneError if only some pairs have one.
Document with_law_of_pairs(Document document);

/// Reads all entries of [[contact.pairs]] into scene.contact.pairs, which has their number, once the other
/// keys are read. Missing keys of an entry are taken from [contact]. Throws SceneError.
void read_pairs(const Document& document, Scene& scene);

}  // namespace wavebalance::app
