#pragma once
#include "wavebalance/app/compose/structure_model.hpp"

namespace wavebalance::app {

/// Replaces the structure by its lowest modes and contacts without mass, which deflect beside these modes by
/// the residual flexibility of the omitted ones [R. H. MacNeal, Comput. Struct. 1, 1971, 581-601; massless
/// boundaries: C. Monjaraz-Tec, J. Gross, M. Krack, J. Sound Vib. 526, 2022]. The lowest `modes` frequencies
/// without contact and the static deflections under contact forces are those of the structure; the inertia of
/// the omitted modes is neglected. Displacements of contacts become the last degrees of freedom, one for
/// obstacles on both sides. `modes` is at most the size less the number of contacts. Throws
/// std::invalid_argument if modes < 1, or if the omitted modes do not move the contacts independently of one
/// another. O(n^3).
void make_contacts_massless(StructureModel& model, int modes);

/// Largest relative difference of the first ten natural frequencies of two structures without contact, of as
/// many as both have; NaN beyond 1000 degrees of freedom. O(n^3).
double frequency_change(const solvers::LinearStructure& from, const solvers::LinearStructure& to);

}  // namespace wavebalance::app
