#include "motion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::jl14 {
namespace {

constexpr Eigen::Index instants = 128;

/// The samples at `count` uniform instants, which divides their number.
template <class Matrix>
Matrix at_instants(const Matrix& samples, Eigen::Index count) {
  const Eigen::Index step = samples.cols() / count;
  return Matrix::NullaryExpr(samples.rows(), count,
                             [&](Eigen::Index i, Eigen::Index j) { return samples(i, j * step); });
}

std::string list(const Eigen::VectorXd& values) {
  return fmt::format("[{:.6g}]", fmt::join(values.begin(), values.end(), ","));
}

/// One motion: `nodes` is n x (nodes without the clamped one), the last of which is the tip.
std::string motion_object(const std::string& label, const std::string& name, const Eigen::MatrixXd& nodes,
                          const Eigen::VectorXd& force) {
  std::string rows;
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(nodes.cols() + 1);
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    whole.tail(nodes.cols()) = nodes.row(i).transpose();
    rows += (i == 0 ? "" : ",\n") + list(whole);
  }
  return fmt::format(R"({{"label":"{}","name":"{}","nodes":[
{}],
"tip":{},
"force":{}}})",
                     label, name, rows, list(nodes.rightCols(1)), list(force));
}

}  // namespace

Table node_columns(const solvers::Motion& structure) {
  const Eigen::MatrixXd nodes = at_instants(structure.displacement, instants);
  Table table;
  table.add_column("time_fraction", app::time_fractions(static_cast<int>(instants)));
  for (Eigen::Index i = 0; i < nodes.rows(); ++i)
    table.add_column(fmt::format("node_{}_m", i + 1), Eigen::VectorXd(nodes.row(i)));
  return table;
}

std::string motion_json(const Case& study, const std::vector<app::Response>& responses, const Table& nodes) {
  const app::Scene& scene = study.scene();
  const auto count = static_cast<Eigen::Index>(nodes.rows());
  Eigen::MatrixXd moves(count, nodes.columns().size() - 1);
  for (Eigen::Index i = 0; i < moves.cols(); ++i) {
    const auto values = nodes.numbers(nodes.columns()[static_cast<std::size_t>(i) + 1]);
    moves.col(i) = Eigen::Map<const Eigen::VectorXd>(values.data(), count);
  }
  const auto force = [&](const app::Response& response) -> Eigen::VectorXd {
    return at_instants(response.contacts.force, count).transpose() / scene.forcing.amplitude;
  };
  std::string moving;
  for (std::size_t i = 0; i < responses.size(); ++i) {
    if (!responses[i].converged) continue;
    moving += moving.empty() ? "" : ",\n";
    moving += motion_object(pairs()[i].label, pairs()[i].name(),
                            at_instants(responses[i].structure.displacement, count).transpose(),
                            force(responses[i]));
  }
  return fmt::format(R"({{"gap":{:.6g},"amplitude":{:.6g},"frequency":{:.6g},"length":{:.6g},
"time":{},
"pairs":[{}],
"reference":{}}}
)",
                     study.gap(), scene.forcing.amplitude, scene.forcing.frequency, scene.structure.length,
                     list(app::time_fractions(static_cast<int>(count))), moving,
                     motion_object(reference_label, "reference", moves, force(study.reference())));
}

void attach_motion(report::Artefact& artefact, const Case& study,
                   const std::vector<app::Response>& responses) {
  const Table nodes = artefact.result(fmt::format("reference_case{}_nodes.csv", study.number()));
  const std::string json = motion_json(study, responses, nodes);
  artefact.attach(fmt::format("motion_case{}.json", study.number()), json, false);
  artefact.script("motions", "motion", json);
}

}  // namespace wavebalance::jl14
