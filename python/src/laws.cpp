#include "problem.hpp"

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "wavebalance/contact/catalogue.hpp"
#include "wavebalance/contact/table_law.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/structure/contact_mass.hpp"

namespace wavebalance::python {

namespace py = pybind11;
using namespace pybind11::literals;
using Law = solvers::AnyContactLaw;

namespace {

/// Functions of Python, each called with numbers and with the lock taken, and what a law of them is.
class LawOfFunctions {
 public:
  LawOfFunctions(std::vector<py::function> functions, double gap, bool unilateral, std::vector<double> kinks)
      : functions_(new std::vector<py::function>(std::move(functions)), &release),
        gap_(gap),
        unilateral_(unilateral),
        kinks_(std::move(kinks)) {}

  double gap() const { return gap_; }
  bool unilateral() const { return unilateral_; }
  std::vector<double> kinks() const { return kinks_; }

 protected:
  template <class... Numbers>
  double call(std::size_t function, Numbers... numbers) const {
    const py::gil_scoped_acquire locked;
    return (*functions_)[function](numbers...).template cast<double>();
  }

 private:
  static void release(std::vector<py::function>* functions) {
    const py::gil_scoped_acquire locked;
    delete functions;
  }

  std::shared_ptr<std::vector<py::function>> functions_;
  double gap_;
  bool unilateral_;
  std::vector<double> kinks_;
};

/// Force, tangent and potential over the displacement.
class FunctionLaw : public LawOfFunctions {
 public:
  FunctionLaw(std::vector<py::function> functions, double gap, bool unilateral, bool monotone,
              std::vector<double> kinks)
      : LawOfFunctions(std::move(functions), gap, unilateral, std::move(kinks)), monotone_(monotone) {}

  double force(double displacement) const { return call(0, displacement); }
  double tangent(double displacement) const { return call(1, displacement); }
  double potential(double displacement) const { return call(2, displacement); }
  bool monotone() const { return monotone_; }

 private:
  bool monotone_;
};

/// Force, tangent and damping over displacement and velocity, and the potential over the displacement.
class VelocityFunctionLaw : public LawOfFunctions {
 public:
  using LawOfFunctions::LawOfFunctions;
  double force(double u, double v) const { return call(0, u, v); }
  double tangent(double u, double v) const { return call(1, u, v); }
  double damping(double u, double v) const { return call(2, u, v); }
  double potential(double u) const { return call(3, u); }
};

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A law of several rows of two functions of Python. Both are called with the displacements of N instants,
/// rows x N, and where the law reads them velocities: `force` returns as many forces, `slopes` those by
/// displacements and by velocities, rows x rows x N.
class VectorFunctionLaw {
 public:
  VectorFunctionLaw(const py::function& force, const py::function& slopes, int rows, bool velocities)
      : functions_(new Functions{force, slopes}, &release), rows_(rows), velocities_(velocities) {}

  int rows() const { return rows_; }
  bool depends_on_velocity() const { return velocities_; }

  void evaluate(const solvers::PeriodKinematics& motion, solvers::PeriodForces& out) const {
    const py::gil_scoped_acquire locked;
    const auto points = py::ssize_t(motion.points);
    py::tuple arguments(velocities_ ? 2 : 1);
    arguments[0] = array_of(motion.displacement, points);
    if (velocities_) arguments[1] = array_of(motion.velocity, points);
    const auto force = functions_->force(*arguments).cast<Numbers>();
    std::copy_n(force.data(), force.size(), out.force.begin());
    const auto slopes = functions_->slopes(*arguments).cast<std::pair<Numbers, Numbers>>();
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j < rows_; ++j)
        for (int l = 0; l < motion.points; ++l)
          add(i * motion.points + l, j * motion.points + l, slopes.first.at(i, j, l),
              velocities_ && !out.velocity_slope.empty() ? slopes.second.at(i, j, l) : 0.0, out);
  }

 private:
  struct Functions {
    py::function force, slopes;
  };

  static void release(Functions* functions) {
    const py::gil_scoped_acquire locked;
    delete functions;
  }
  Numbers array_of(std::span<const double> values, py::ssize_t points) const {
    Numbers array({py::ssize_t(rows_), points});
    std::fill_n(array.mutable_data(), array.size(), 0.0);  // at rest where no velocities are given
    std::copy(values.begin(), values.end(), array.mutable_data());
    return array;
  }
  static void add(int force, int by, double slope, double damping, solvers::PeriodForces& out) {
    out.piece[std::size_t(force)] = 1;
    if (force != by) return out.others.push_back({force, by, slope, damping});
    out.displacement_slope[std::size_t(force)] = slope;
    if (!out.velocity_slope.empty()) out.velocity_slope[std::size_t(force)] = damping;
  }

  std::shared_ptr<Functions> functions_;
  int rows_;
  bool velocities_;
};

/// function(u) at each displacement, of their shape.
template <class Function>
Numbers at_each(const Numbers& displacement, Function function) {
  Numbers result(std::vector<py::ssize_t>(displacement.shape(), displacement.shape() + displacement.ndim()));
  const double* from = displacement.data();
  double* to = result.mutable_data();
  for (py::ssize_t i = 0; i < displacement.size(); ++i) to[i] = function(from[i]);
  return result;
}

py::list law_catalogue() {
  py::list rows;
  for (const contact::LawEntry& law : contact::law_catalogue()) {
    py::list parameters;
    for (const contact::LawParameter& one : law.parameters)
      parameters.append(py::dict("name"_a = one.name, "unit"_a = one.unit, "help"_a = one.help,
                                 "required"_a = one.required(), "default"_a = one.fallback,
                                 "may_be_zero"_a = one.range.contains(0.0)));
    rows.append(py::dict("name"_a = law.name, "force"_a = law.force, "parameters"_a = parameters));
  }
  return rows;
}

/// Whether no balance has the motions, so that a scene of them has no bases.
bool needs_events(const Structure& structure, const py::object& laws) {
  const solvers::ContactLaws all = laws_of(laws);
  all.require(structure.contacts());
  return solvers::need_events(all, structure) || (structure.is_free() && all.act_over_period());
}

void add_factories(py::module_& module) {
  module.def("needs_events", &needs_events);
  module.def("law_catalogue", &law_catalogue);
  module.def("make_law", [](const std::string& name, const contact::LawValues& values) {
    if (contact::law_entry(name).reads_signal)
      throw std::invalid_argument(name +
                                  " has a signal beside its contact, which a scene makes; expected a scene");
    return std::visit([](const auto& law) { return Law(law); }, contact::law_entry(name).make(values));
  });
  module.def("table_law", [](std::vector<double> displacements, std::vector<double> forces) {
    return Law(contact::TableLaw(std::move(displacements), std::move(forces)));
  });
  module.def("function_law", [](const py::function& force, const py::function& tangent,
                                const py::function& potential, double gap, bool unilateral, bool monotone,
                                std::vector<double> kinks) {
    return Law(FunctionLaw({force, tangent, potential}, gap, unilateral, monotone, std::move(kinks)));
  });
  module.def("velocity_law", [](const py::function& force, const py::function& tangent,
                                const py::function& damping, const py::function& potential, double gap,
                                bool unilateral, std::vector<double> kinks) {
    return Law(VelocityFunctionLaw({force, tangent, damping, potential}, gap, unilateral, std::move(kinks)));
  });
  module.def("vector_law",
             [](const py::function& force, const py::function& slopes, int rows, bool velocities) {
               return Law(VectorFunctionLaw(force, slopes, rows, velocities));
             });
}

}  // namespace

solvers::ContactLaws laws_of(const py::object& laws) {
  if (py::isinstance<Law>(laws)) return laws.cast<const Law&>();
  if (!py::isinstance<py::sequence>(laws))
    throw std::invalid_argument("laws is of type " +
                                std::string(py::str(py::type::of(laws).attr("__name__"))) +
                                "; expected a law or a list with one law per contact");
  std::vector<Law> list;
  for (const py::handle one : laws) {
    if (!py::isinstance<Law>(one))
      throw std::invalid_argument("laws[" + std::to_string(list.size()) + "] is of type " +
                                  std::string(py::str(py::type::of(one).attr("__name__"))) +
                                  "; expected a law");
    list.push_back(one.cast<const Law&>());
  }
  return list;
}

solvers::ContactLaws laws_of(const py::object& laws, const solvers::LinearStructure& structure) {
  solvers::ContactLaws all = laws_of(laws);
  all.require(structure.contacts());
  if (solvers::need_events(all, structure)) {
    const bool impacts = all.have_impacts();
    throw std::invalid_argument(
        std::string("laws: motions with ") +
        (impacts ? "impacts (restitution)" : "rigid, static, moving or damped friction") +
        " have no functions; expected wavebalance.run(structure.scene(law, frequency=...)), or " +
        (impacts ? "a rigid obstacle without restitution"
                 : "Coulomb friction with a tangential stiffness alone"));
  }
  if (!contacts_are_massless(structure, all.rigid(structure.contacts())))
    throw std::invalid_argument(
        "laws: a rigid obstacle needs contacts without mass; expected Structure(..., "
        "contact_mass=\"redistribute\"), or a stiff Penalty");
  return all;
}

void add_laws(py::module_& module) {
  py::class_<Law>(module, "Law")
      .def(py::init<const Law&>())
      .def_property_readonly("gap", &Law::gap)
      .def_property_readonly("unilateral", &Law::unilateral)
      .def_property_readonly("is_rigid", &Law::is_rigid)
      .def_property_readonly("rows", &Law::rows)
      .def_property_readonly("depends_on_velocity", &Law::depends_on_velocity)
      .def(
          "force",
          [](const Law& law, const Numbers& displacement, double velocity) {
            return at_each(displacement, [&](double u) { return law.force(u, velocity); });
          },
          py::arg("displacement"), py::arg("velocity") = 0.0)
      .def(
          "tangent",
          [](const Law& law, const Numbers& displacement) {
            return at_each(displacement, [&](double u) { return law.tangent(u); });
          },
          py::arg("displacement"))
      .def(
          "potential",
          [](const Law& law, const Numbers& displacement) {
            return at_each(displacement, [&](double u) { return law.potential(u); });
          },
          py::arg("displacement"));
  add_factories(module);
}

}  // namespace wavebalance::python
