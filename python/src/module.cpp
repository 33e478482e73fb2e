#include "bindings.hpp"
#include "unlocked.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace wavebalance;
  module.doc() = "The compiled part of wavebalance.";
  module.attr("version") = std::string(app::version());
  module.def("exchange_progress", &python::exchange_progress);
  module.def("short_number", &app::short_number);
  module.def("quantity", &app::quantity);
  module.def("takes_prefix", &app::takes_prefix);
  module.def("axis_scale", [](double largest, const std::string& unit) {
    const app::Scale scale = app::axis_scale(largest, unit);
    return std::pair(scale.factor, scale.prefix);
  });
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
