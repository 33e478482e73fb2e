#pragma once
#include <string>
#include <vector>

#include "study.hpp"

namespace wavebalance::bench {

/// One way to compute a study's response, and what came of it.
struct Point {
  std::string method;  ///< "weighted_residual", "dense", "time_stepping", "shooting"
  std::string trial, weight;
  std::string inner_products;  ///< "exact" or "quadrature"
  int functions = 0;           ///< M; 0 where there is none
  int points = 0;              ///< N
  double tolerance = 0.0;      ///< of time stepping and shooting
  double construction_seconds = 0.0;
  double seconds = 0.0;  ///< least of several solves from the contact-free response, plans made before
  double error = 0.0;    ///< relative rms of the tip displacement against the reference
  bool converged = false;
  std::string status;  ///< why not; "not_run" when smaller sizes took too long
  bool on_front = false;
};

struct SizeSeries {
  std::vector<int> functions;            ///< rising powers of two
  std::vector<int> points_per_function;  ///< rising
  double max_seconds = 1.0;  ///< s: what is expected to take longer is not run, and a homotopy ends there
};

/// Every pair over functions and points.
std::vector<Point> weighted_residual_points(const Study& study, const SizeSeries& series);
/// Fourier functions through the assembled system of all unknowns.
std::vector<Point> dense_points(const Study& study, const std::vector<int>& functions, double max_seconds);
/// Time stepping to each tolerance on the difference of two periods, and shooting to each on its steps.
std::vector<Point> time_stepping_points(const Study& study, const std::vector<double>& tolerances);
std::vector<Point> shooting_points(const Study& study, const std::vector<double>& tolerances);

/// Marks the converged points that no other one beats in both time and error.
void mark_front(std::vector<Point>& points);
/// The converged points of a set that no other one of the set beats, by rising time.
std::vector<Point> envelope(std::vector<Point> points);

}  // namespace wavebalance::bench
