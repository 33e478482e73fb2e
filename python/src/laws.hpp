#pragma once
#include <pybind11/pybind11.h>

#include "wavebalance/solvers/balance/contact_laws.hpp"

namespace wavebalance::python {

/// One law for all contacts, or a sequence of one each. Throws std::invalid_argument for anything else.
solvers::ContactLaws laws_of(const pybind11::object& laws);

}  // namespace wavebalance::python
