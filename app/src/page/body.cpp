#include "wavebalance/app/page/body.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

namespace wavebalance::app {
namespace {

constexpr double parts_of_size = 20000.0, parts_of_displacement = 2000.0;

double size_of(const MovingBody& body) {
  return (body.points.rowwise().maxCoeff() - body.points.rowwise().minCoeff()).maxCoeff();
}

double largest_of(const MovingBody& body) {
  double largest = 0.0;
  for (const Eigen::Matrix3Xd& frame : body.frames)
    largest = std::max(largest, frame.colwise().norm().maxCoeff());
  return largest;
}

/// The points in the order of their first use, which numbers the points of the surface.
std::vector<int> renumbered(const std::vector<int>& points, std::map<int, int>& number) {
  std::vector<int> list;
  for (const int point : points)
    list.push_back(number.try_emplace(point, static_cast<int>(number.size())).first->second);
  return list;
}

/// The columns of `values` at the points of the surface, in units of `unit`.
std::vector<int> in_units(const Eigen::Matrix3Xd& values, const std::map<int, int>& number, double unit) {
  std::vector<int> list(3 * number.size());
  for (const auto& [point, place] : number)
    for (int row = 0; row < 3; ++row)
      list[static_cast<std::size_t>(3 * place + row)] =
          static_cast<int>(std::lround(values(row, point) / unit));
  return list;
}

}  // namespace

double exaggeration(const MovingBody& body) {
  const double largest = largest_of(body), wanted = 0.1 * size_of(body);
  if (!(largest > 0.0) || largest >= 0.5 * wanted) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(wanted / largest)));
  const double leading = wanted / largest / power;
  return (leading >= 5.0 ? 5.0 : leading >= 2.0 ? 2.0 : 1.0) * power;
}

std::string body_script(const std::string& name, const MovingBody& body) {
  const double largest = largest_of(body), length = size_of(body) / parts_of_size;
  const double unit = largest > 0.0 ? largest / parts_of_displacement : 1.0;
  std::map<int, int> number;
  nlohmann::ordered_json data{
      {"label", body.label}, {"length", length}, {"unit", unit}, {"largest", largest}, {"times", body.times}};
  data["triangles"] = renumbered(body.surface.triangles, number);
  data["segments"] = renumbered(body.surface.segments, number);
  data["points"] = in_units(body.points, number, length);
  data["frames"] = nlohmann::ordered_json::array();
  for (const Eigen::Matrix3Xd& frame : body.frames) data["frames"].push_back(in_units(frame, number, unit));
  return "((window.wavebalance ?\?= {}).bodies ?\?= {})[" + nlohmann::json(name).dump() +
         "] = " + data.dump() + ";\n";
}

}  // namespace wavebalance::app
