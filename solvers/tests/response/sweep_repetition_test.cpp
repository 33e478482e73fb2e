// Curves that come back to an earlier point of themselves.

#include <optional>

#include "continuation/return_detector.hpp"
#include "dense_algebra.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

// A cantilever of steel, 0.5 m x 20 mm x 5 mm, as one element of deflection and slope at its tip, shaken at
// its base, every mode damped by 1 % of the critical damping.
LinearStructure shaken_beam() {
  constexpr double length = 0.5, width = 0.02, height = 0.005, modulus = 210e9, density = 7850.0,
                   ratio = 0.01;
  const double bending = modulus * width * std::pow(height, 3) / 12.0 / std::pow(length, 3);
  const double inertia = density * width * height * length / 420.0;
  Eigen::Matrix2d stiffness, mass;
  stiffness << 12.0, -6.0 * length, -6.0 * length, 4.0 * length * length;
  mass << 156.0, -22.0 * length, -22.0 * length, 4.0 * length * length;
  stiffness *= bending;
  mass *= inertia;
  const auto modes = oracle::generalized_eigen(stiffness, mass);
  const Eigen::Matrix2d shapes = mass * modes.vectors;
  const Eigen::Vector2d damping = 2.0 * ratio * modes.values.cwiseSqrt();
  return testing::structure(mass, shapes * damping.asDiagonal() * shapes.transpose(), stiffness,
                            -inertia * Eigen::Vector2d(210.0, -35.0 * length), contact_rows({0}, 2));
}

// The beam against a stiff stop, followed by steps so long that one of them jumps to a closed curve.
struct Beam {
  CondensedProblem problem{testing::fourier_pair(63, 256), shaken_beam(), testing::cosine_load()};
  testing::LinearContact stop{1e5, 1e-3};

  static FrequencySweepOptions options() {
    FrequencySweepOptions options = testing::between(12.0, 25.0);
    options.max_points = 3000;
    options.output_points = 64;
    auto& arc = options.arc_length;
    arc.grazing_events = GrazingEvents::at_turning_points;
    arc.displacement_scale = 1e-3;
    arc.parameter_scale = 0.65;
    arc.max_step = 0.3 / arc.parameter_scale;
    arc.initial_step = 0.15 / arc.parameter_scale;
    return options;
  }

  FrequencySweep sweep(GrazingEvents events) {
    FrequencySweepOptions how = options();
    how.arc_length.grazing_events = events;
    return frequency_sweep(problem, stop, how);
  }
};

TEST(SweepRepetition, AJumpToAClosedCurveIsFollowedAgainWithShorterSteps) {
  Beam beam;
  const FrequencySweep found = beam.sweep(GrazingEvents::at_turning_points);
  EXPECT_EQ(found.status, SweepStatus::reached_end);
  EXPECT_LT(found.points.size(), 1500u);
  for (std::size_t i = 1; i < found.points.size(); ++i)
    for (std::size_t j = 0; j + 1 < i; ++j) {
      const SweepPoint &a = found.points[i], &b = found.points[j];
      EXPECT_FALSE(a.frequency == b.frequency && a.rms_displacement == b.rms_displacement)
          << j << " and " << i;
    }
}

// Advances until the curve returns to a kept point; none within `most` points.
std::optional<std::size_t> returned_within(ArcLength& curve, ReturnDetector& detector, int most,
                                           int& points) {
  for (points = 1; points <= most; ++points) {
    detector.add(curve.point(), points);
    if (curve.advance() != ArcLength::Status::advanced) return std::nullopt;
    if (const auto index = detector.returned_to(curve)) return index;
  }
  return std::nullopt;
}

// A point that the curve from 12 Hz keeps after a long step has jumped.
CurvePoint point_of_the_closed_curve(Beam& beam) {
  beam.problem.set_frequency(12.0);
  ContactSystem system(beam.problem, beam.stop);
  const FrequencyParameter frequency;
  const ArcLengthOptions arc = Beam::options().arc_length;
  ArcLength curve(system, frequency, arc);
  const PeriodicResponse first = forced_response(beam.problem, beam.stop, {});
  EXPECT_EQ(curve.start(first.unknown, 12.0, 1.0), ArcLength::Status::advanced);
  ReturnDetector detector(arc);
  int entered = 0;
  const auto index = returned_within(curve, detector, 3000, entered);
  EXPECT_TRUE(index) << "long steps jump to a closed curve";
  if (!index) return curve.point();
  EXPECT_GT(*index, 0u);
  return detector[*index].point;
}

TEST(SweepRepetition, AClosedCurveReturnsToItsFirstPoint) {
  Beam beam;
  const CurvePoint on_it = point_of_the_closed_curve(beam);
  ContactSystem system(beam.problem, beam.stop);
  const FrequencyParameter frequency;
  ArcLengthOptions arc = Beam::options().arc_length;
  arc.grazing_events = GrazingEvents::all;
  ArcLength closed(system, frequency, arc);
  const double direction = on_it.parameter_tangent > 0.0 ? 1.0 : -1.0;
  ASSERT_EQ(closed.start(on_it.displacement, on_it.parameter, direction), ArcLength::Status::advanced);
  ReturnDetector fresh(arc);
  int lap = 0;
  const auto again = returned_within(closed, fresh, 500, lap);
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, 0u);
  EXPECT_GT(lap, 5);
}

TEST(SweepRepetition, AClosedCurveFollowedFromOneOfItsPointsIsComplete) {
  Beam beam;
  const CurvePoint on_it = point_of_the_closed_curve(beam);
  FrequencySweepOptions how = Beam::options();
  how.arc_length.grazing_events = GrazingEvents::all;
  SweepStart start;
  ContactSystem system(beam.problem, beam.stop);
  beam.problem.set_load_frequency(on_it.parameter);
  start.response = response_at(system, on_it.displacement);
  start.direction = on_it.displacement_tangent;
  const FrequencySweep found = frequency_sweep(beam.problem, beam.stop, how, start);
  EXPECT_EQ(found.status, SweepStatus::closed);
  EXPECT_TRUE(found.closed_at_start);
  EXPECT_GT(found.points.size(), 5u);
  EXPECT_LT(found.points.size(), 500u);
}

TEST(SweepRepetition, ACurveThatTurnsBackAndOnAgainDoesNotReturn) {
  Beam beam;
  const FrequencySweep found = beam.sweep(GrazingEvents::all);
  EXPECT_EQ(found.status, SweepStatus::reached_end);
  EXPECT_GT(found.turning_points.size(), 10u);
}

}  // namespace
}  // namespace wavebalance::solvers
