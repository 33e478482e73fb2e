#pragma once
#include <Eigen/Core>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/report/artefact.hpp"

/// Cases that other programs and papers publish, computed from scenes and compared with their figures.
namespace wavebalance::cases {

/// The response curve of a scene with one contact, and its stability.
struct Curve {
  app::Scene scene;
  app::StructureModel model;
  app::Sweep sweep;
  double unit = 1.0;  ///< 2 pi where frequencies are given in rad/s, 1 where in Hz

  const char* unit_name() const { return unit == 1.0 ? "Hz" : "rad/s"; }
};

/// What is drawn of a motion, from its displacements at the quadrature points.
using Ordinate = std::function<double(const Eigen::VectorXd&)>;

/// Follows the curve of the scene `file` as the command does. Throws report::NotConverged where the curve
/// does not reach its end or the stability of its points is not known, those beside a grazing apart.
Curve followed(report::Artefact& artefact, const std::string& file, double unit,
               const std::vector<std::string>& overrides = {});

/// Amplitudes of harmonics 0 to `count` of samples over one period: |c_0|, 2 |c_1|, ... O(N count).
Eigen::VectorXd harmonics(const Eigen::VectorXd& samples, int count);

/// The response at `frequency` (in the curve's unit) with the functions and points of `time`, from where the
/// curve passes this frequency with the ordinate nearest to `value`. Throws report::NotConverged.
app::Response response_near(const Curve& curve, double frequency, const Ordinate& ordinate, double value,
                            const app::Time& time);

/// The numbers of unstable multipliers along the first passage from `from` to `to`, in the curve's unit; -1
/// for a point where the number is not known.
std::set<int> counts_between(const Curve& curve, double from, double to);

/// Columns frequency (in the curve's unit), max_displacement, ordinate where one is given, unstable,
/// contacts.
app::Table curve_table(const Curve& curve, const Ordinate& ordinate = {});
/// Columns type, frequency and bracket (in the curve's unit), multiplier_real, multiplier_imag,
/// max_displacement.
app::Table special_points_table(const Curve& curve);

/// Where each branch begins and goes, one sentence for each.
std::string branches_text(const Curve& curve);

/// The curve with its special points, unstable parts dashed. Without an ordinate: the largest displacement,
/// times `scale`, and also the branches.
app::Panel curve_panel(const Curve& curve, const std::string& label, double scale,
                       const Ordinate& ordinate = {});

/// Points of another program's curve.
app::Series published_points(const std::string& label, const std::vector<double>& x,
                             const std::vector<double>& y);

/// The panel, and beside it the part of it within the rectangle.
app::Figure with_enlargement(app::Panel panel, const app::Rectangle& part);

}  // namespace wavebalance::cases
