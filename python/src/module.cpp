#include "bindings.hpp"
#include "unlocked.hpp"
#include "wavebalance/app/files/output.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace wavebalance;
  module.doc() = "The compiled part of wavebalance.";
  module.attr("version") = std::string(app::version());
  module.def("exchange_progress", &python::exchange_progress);
  python::add_exceptions(module);
  python::add_scenes(module);
  python::add_comparison(module);
  python::add_studies(module);
  python::add_laws(module);
  python::add_matrices(module);
  python::add_problem(module);
  python::add_response(module);
  python::add_stability(module);
  python::add_sweeps(module);
  python::add_pickles(module);
  python::add_modes(module);
  python::add_wavelets(module);
}
