#include "compose/compose_parts.hpp"

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <set>

#include "matrices/load_places.hpp"
#include "matrices/loads.hpp"
#include "matrices/structure_files.hpp"

namespace wavebalance::app {
namespace {

bool moves_supports(const ForcingTerm& term) {
  return term.kind == LoadKind::base_displacement || term.kind == LoadKind::base_acceleration;
}

std::vector<ForcingTerm> support_terms(const Scene& scene) {
  std::vector<ForcingTerm> terms = scene.forcing.terms;
  std::erase_if(terms, [](const ForcingTerm& term) { return !moves_supports(term); });
  return terms;
}

/// How far the output moves with supports that move by 1 along a base acceleration.
double share_of_acceleration(const Output& output, const ForcingTerm& term, const Scene& scene) {
  if (scene.structure.type != StructureType::matrices) return output.weight;  // a bar moves along itself
  const Eigen::VectorXd direction = base_direction(term, *structure_files(scene));
  double share = 0.0;
  for (const int row : output.rows) share += output.weight * direction[row];
  return share;
}

/// The same of a base displacement: of the rows that move those along the output's direction, which are all
/// without a dof map.
double share_of_displacement(const Output& output, const ForcingTerm& term, const StructureFiles& files) {
  std::set<int> signs;
  for (const int dof : term.dofs) {
    const int row = std::abs(dof) - 1;
    const bool along = !files.dof_map ||
                       files.dof_map->dof(row).direction == files.dof_map->dof(output.rows.front()).direction;
    if (along) signs.insert(dof > 0 ? 1 : -1);
  }
  if (signs.size() > 1)
    throw std::invalid_argument(
        "the supports move both ways along it, so that there is no displacement relative to them");
  return signs.empty() ? 0.0 : *signs.begin() * output.weight * double(output.rows.size());
}

std::set<int> rows_that_move(const ForcingTerm& term) {
  std::set<int> rows;
  for (const int dof : term.dofs) rows.insert(std::abs(dof));
  return rows;
}

bool move_alike(const ForcingTerm& one, const ForcingTerm& other) {
  return one.kind == other.kind && one.dofs == other.dofs && one.direction == other.direction;
}

/// Motions that add the accelerated supports.
void add_supports(Output& output, const std::vector<ForcingTerm>& terms, const Scene& scene) {
  for (const ForcingTerm& term : terms) {
    if (term.kind != LoadKind::base_acceleration) continue;
    const double share = share_of_acceleration(output, term, scene);
    if (share == 0.0) continue;
    const Eigen::VectorXcd harmonics = harmonics_of(term);
    if (std::abs(harmonics[0]) > 1e-12 * harmonics.cwiseAbs().maxCoeff() && output.derivative < 2)
      throw std::invalid_argument(
          "a static base_acceleration moves the supports without bound; expected an acceleration, or a "
          "displacement relative to them");
    output.added.push_back({share * harmonics, 2});
  }
}

void subtract_supports(Output& output, const std::vector<ForcingTerm>& terms, const Scene& scene) {
  const ForcingTerm* first = nullptr;
  for (const ForcingTerm& term : terms) {
    if (term.kind != LoadKind::base_displacement) continue;
    if (first == nullptr) first = &term;
    if (rows_that_move(term) != rows_that_move(*first))
      throw std::invalid_argument(
          "supports move each for itself, so that there is no displacement relative to all of them");
    const double share = share_of_displacement(output, term, *structure_files(scene));
    if (share != 0.0) output.added.push_back({-share * harmonics_of(term), 0});
  }
}

}  // namespace

void set_frame(Output& output, const OutputWords& words, const Scene& scene) {
  const bool ratio = words.quantity == OutputQuantity::transmissibility;
  if (words.frame == OutputFrame::given && !ratio) return;
  if (scene.analysis.type == AnalysisType::nonlinear_mode)
    throw std::invalid_argument(
        "a mode is a free motion, in which no support moves; expected the displacement, the velocity or the "
        "acceleration of the place");
  const std::vector<ForcingTerm> terms = support_terms(scene);
  if (terms.empty())
    throw std::invalid_argument(
        "no support moves; expected a term of [[forcing.terms]] with kind = \"base_acceleration\" or "
        "\"base_displacement\"");
  if (ratio) {
    if (!std::ranges::all_of(terms, [&](const ForcingTerm& one) { return move_alike(one, terms.front()); }))
      throw std::invalid_argument(
          "supports move in several ways, so that it is the ratio to none; expected terms of one kind with the "
          "same dofs or direction");
    output.derivative = terms.front().kind == LoadKind::base_acceleration ? 2 : 0;
    for (const ForcingTerm& term : terms) output.over.push_back({harmonics_of(term), output.derivative});
  }
  if (words.frame == OutputFrame::relative)
    subtract_supports(output, terms, scene);
  else
    add_supports(output, terms, scene);
}

Eigen::VectorXd support_values(const SupportMotion& motion, int derivative, double frequency, double factor,
                               int points, int periods) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(points);
  for (Eigen::Index n = 0; n < motion.harmonics.size(); ++n) {
    if (motion.harmonics[n] == 0.0) continue;
    const std::complex<double> rate(0.0, 2.0 * std::numbers::pi * double(n) * frequency);
    const int order = derivative - motion.derivative;
    const std::complex<double> amplitude =
        (n == 0 ? (order == 0 ? 1.0 : 0.0) : factor * std::pow(rate, order)) * motion.harmonics[n];
    for (Eigen::Index l = 0; l < points; ++l) {
      const double turn = double(n * periods * l % points) / double(points);
      values[l] += std::real(amplitude * std::polar(1.0, 2.0 * std::numbers::pi * turn));
    }
  }
  return values;
}

}  // namespace wavebalance::app
