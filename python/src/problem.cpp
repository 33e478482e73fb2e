#include "problem.hpp"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <tuple>

#include "arrays.hpp"
#include "bindings.hpp"
#include "unlocked.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/fem/check_structure.hpp"
#include "wavebalance/solvers/structure/rigid_modes.hpp"

namespace wavebalance::python {

namespace py = pybind11;
using Sparse = Eigen::SparseMatrix<double>;

namespace {

using Force = std::tuple<Eigen::VectorXd, Eigen::VectorXcd, int>;

/// "node" checks of the command's matrices, with rows counted from 0.
void check(const Structure& structure, bool unsymmetric, bool free) {
  structure.validate();
  try {
    fem::check_structure({structure.mass, structure.damping, structure.stiffness},
                         {.allow_free = free, .unsymmetric = unsymmetric, .first_index = 0});
  } catch (const fem::StructureFault& fault) {
    throw std::invalid_argument(std::string(to_string(fault.matrix())) + ": the matrix " + fault.reason());
  }
}

/// Replaces the structure by its modes and contacts without mass, as scenes with contact.mass =
/// "redistribute".
void redistribute_mass(Structure& structure) {
  if (!structure.rigid_modes.isZero(0.0))
    throw std::invalid_argument(
        "contact_mass is \"redistribute\"; a structure that is free to move keeps its mass");
  app::StructureModel model;
  model.structure = structure;
  model.unknowns = structure.size();
  app::make_contacts_massless(model, structure.size() - structure.contacts());
  static_cast<solvers::LinearStructure&>(structure) = std::move(model.structure);
  structure.recovery = std::move(model.recovery);
}

/// C + speed G and K + speed^2 K_s, at the speed of the load where that is 0.
void let_turn(Structure& structure, const Sparse& gyroscopic, const Sparse& stiffness, double speed) {
  const Eigen::Index size = structure.size();
  for (const auto& [part, name] : {std::pair{&gyroscopic, "gyroscopic"}, {&stiffness, "spin_stiffness"}})
    if (part->rows() != size || part->cols() != size)
      throw std::invalid_argument(std::string(name) + " is " + std::to_string(part->rows()) + " x " +
                                  std::to_string(part->cols()) + "; expected " + std::to_string(size) +
                                  " x " + std::to_string(size));
  if (speed > 0.0) {
    structure.damping += speed * gyroscopic;
    structure.stiffness += speed * speed * stiffness;
    return;
  }
  if (gyroscopic.nonZeros() > 0) structure.turning.gyroscopic = gyroscopic;
  if (stiffness.nonZeros() > 0) structure.turning.stiffness = stiffness;
}

std::shared_ptr<Structure> make_structure(Sparse mass, Sparse damping, Sparse stiffness, Eigen::VectorXd load,
                                          const Sparse& contacts, const std::vector<Force>& forces,
                                          double loss_factor, bool unsymmetric, bool free,
                                          const Sparse& gyroscopic, const Sparse& spin_stiffness,
                                          double spin_speed, bool redistribute) {
  auto structure = std::make_shared<Structure>();
  structure->mass = std::move(mass);
  structure->damping = std::move(damping);
  structure->stiffness = std::move(stiffness);
  structure->load = std::move(load);
  structure->contact_directions = contacts;
  structure->loss_factor = loss_factor;
  for (const auto& [shape, harmonics, derivative] : forces)
    structure->forces.push_back({shape, harmonics, derivative});
  structure->validate();
  let_turn(*structure, gyroscopic, spin_stiffness, spin_speed);
  unlocked([&](const solvers::Observer&) {
    check(*structure, unsymmetric || gyroscopic.nonZeros() > 0, free);
    if (free) structure->rigid_modes = solvers::find_rigid_modes(structure->mass, structure->stiffness);
    if (redistribute) redistribute_mass(*structure);
    return true;
  });
  return structure;
}

void add_structure(py::module_& module) {
  py::class_<Structure, std::shared_ptr<Structure>>(module, "Structure")
      .def(py::init(&make_structure))
      .def_property_readonly("size", &Structure::size)
      .def_property_readonly("contacts", &Structure::contacts)
      .def_property_readonly("is_free", &Structure::is_free)
      .def_property_readonly("symmetric", &Structure::symmetric);
}

/// The pair "trial:weight" of scenes with their keys; with a single name both functions are the same.
std::shared_ptr<solvers::TimePair> make_pair(const std::string& name, int functions, int points,
                                             const std::string& formulation,
                                             const std::string& inner_products, const std::string& nyquist,
                                             double sample_offset) {
  const auto pairs = app::parse_pairs(name.find(':') == std::string::npos ? name + ":" + name : name);
  if (pairs.size() != 1)
    throw std::invalid_argument("pair is \"" + name + "\"; expected one pair, as in \"fourier:fourier\"");
  if (functions < 1)
    throw std::invalid_argument("functions is " + std::to_string(functions) + "; expected 1 or more");
  app::Time time;
  time.trial = pairs.front().trial;
  time.weight = pairs.front().weight;
  time.functions = functions;
  time.quadrature_points = points;
  time.sample_offset = sample_offset;
  time.formulation = named<solvers::Formulation>("formulation", formulation);
  time.inner_products = named<solvers::InnerProducts>("inner_products", inner_products);
  time.nyquist = named<solvers::NyquistCoefficient>("nyquist", nyquist);
  return std::make_shared<solvers::TimePair>(app::make_pair(time));
}

void add_pair(py::module_& module) {
  using solvers::TimePair;
  py::class_<TimePair, std::shared_ptr<TimePair>>(module, "Pair")
      .def(py::init(&make_pair))
      .def_property_readonly("functions", &TimePair::functions)
      .def_property_readonly("points", &TimePair::points)
      .def_property_readonly("first_sample", &TimePair::first_sample)
      .def("symbol", [](const TimePair& pair, int derivative) {
        if (derivative < 0 || derivative > 2)
          throw std::invalid_argument("derivative is " + std::to_string(derivative) + "; expected 0, 1 or 2");
        return pair.symbol(derivative);
      });
}

std::shared_ptr<Problem> make_problem(const Structure& structure, const solvers::TimePair& pair,
                                      const Eigen::VectorXcd& harmonics, int threads) {
  return unlocked([&](const solvers::Observer&) {
    solvers::CondensedProblem problem(pair, structure, harmonics);
    problem.set_threads(threads);
    return std::make_shared<Problem>(std::move(problem), structure.recovery);
  });
}

}  // namespace

void add_problem(py::module_& module) {
  add_structure(module);
  add_pair(module);
  py::class_<Problem, std::shared_ptr<Problem>>(module, "Problem")
      .def(py::init(&make_problem), py::arg("structure"), py::arg("pair"), py::arg("harmonics"),
           py::arg("threads"))
      .def_property_readonly("contacts", [](const Problem& one) { return one.condensed().contacts(); })
      .def_property_readonly("points", [](const Problem& one) { return one.condensed().points(); })
      .def_property_readonly("functions",
                             [](const Problem& one) { return one.condensed().pair().functions(); });
}

}  // namespace wavebalance::python
