#pragma once
#include <pybind11/pybind11.h>

#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::python {

/// One law for all contacts, or a sequence of one each. Throws std::invalid_argument for anything else.
solvers::ContactLaws laws_of(const pybind11::object& laws);
/// The same for the contacts of a structure. Throws std::invalid_argument for rigid laws at contacts with
/// mass.
solvers::ContactLaws laws_of(const pybind11::object& laws, const solvers::LinearStructure& structure);

}  // namespace wavebalance::python
