#pragma once
#include <cstddef>
#include <string_view>

#include "scene/scene_document.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Entries of [[contact.pairs]] that a scene may have.
inline constexpr int most_pairs = 2000;

/// Whether a section has the name of an entry of [[contact.pairs]].
bool is_pair_section(std::string_view section);

/// The number of these entries in `document`. Throws SceneError for more than most_pairs.
std::size_t count_pairs(const Document& document);

/// The document with contact.law = that of the first pair, where it has none and all pairs have laws of their
/// own. Throws SceneError where some pairs alone have one.
Document with_law_of_pairs(Document document);

/// Reads all entries of [[contact.pairs]] into scene.contact.pairs, which has their number, once the other
/// keys are read. What an entry leaves out is taken from [contact]. Throws SceneError.
void read_pairs(const Document& document, Scene& scene);

}  // namespace wavebalance::app
