#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "jl14.hpp"

/// The details of the sums over the period that JL14 leaves open, and what its statements are found to be
/// under each of them.
namespace wavebalance::jl14 {

/// One way to compute the inner products. The paper computes them "as discrete inner products using 256
/// points", and its Fourier functions are 1, cos 2 pi t, sin 2 pi t, ..., so that the last of 64 is a
/// cosine. It does not specify the places of the points.
struct Sums {
  int samples = 256;          ///< uniform, over the period
  double offset = 0.0;        ///< 0: at the left ends of the 1/samples, 0.5: at their middles
  bool exact = false;         ///< exact A_d; the force is summed over the samples in any case
  bool keeps_nyquist = true;  ///< the Nyquist coefficient of 64 functions
  bool sine = false;          ///< the sine instead of the cosine as last Fourier function opposite Haar

  std::string name() const;  ///< "256 left ends, same sums"
  std::string key() const;   ///< "256_left_sums", for the columns of a table
  /// The same in words, one for each of choice_names(): {"256", "left ends", "same sums", "cosine"}.
  std::vector<std::string> choices() const;
  /// The overrides of a scene with this pair. One sample per function is a reading only for pairs with Haar
  /// trial functions, which have one value per cell; the others keep 256. At mid-points the cosine has no
  /// product with the alternating Haar function, so that this coefficient is zero; a scene uses the sine
  /// there unless it drops the coefficient.
  std::vector<std::string> overrides(const Pair& pair) const;
  /// Whether the paper's text allows it.
  bool of_text() const { return samples == 256 && !exact && keeps_nyquist && !sine; }
};

/// Choices: number and places of points, the products, the last Fourier function opposite Haar.
std::vector<std::string> choice_names();

/// The two that the text allows, 256 points at left ends and at mid-points, come first, beginning with the
/// one of the scenes. Then 256 points without the Nyquist coefficient and with the sine; exact products;
/// and 64, 512 and 1024 samples, at left ends and at mid-points, with the same sums for A_d or exact.
const std::vector<Sums>& all_sums();

/// Verdict on a statement under one reading.
struct Finding {
  report::Verdict verdict = report::Verdict::differs;
  std::string measured;
};

/// The solutions of a case with 64 functions under all_sums().
class Readings {
 public:
  /// The slow ones, of Haar pairs in case 1, start from haar_readings_cells.csv, where an earlier step has
  /// left them; those without a solution there have none here.
  Readings(report::Artefact& artefact, const Case& study, std::vector<Pair> chosen = pairs());

  const std::vector<Pair>& chosen() const { return chosen_; }
  /// Throws std::out_of_range for a pair that was not chosen.
  const app::Response& at(std::size_t reading, const std::string& pair) const;
  /// Histories of all pairs in the order chosen; missing values where none was found.
  Values values(std::size_t reading, Eigen::VectorXd (app::Response::*history)() const) const;
  /// The labels of `names` without a solution, ", " between them.
  std::string missing(std::size_t reading, const std::vector<std::string>& names) const;

 private:
  std::vector<Pair> chosen_;
  std::vector<std::vector<app::Response>> responses_;
};

/// The solution with Haar trial functions whose iterations start from these displacements of its cells.
/// `near`: only by what stays near them, which finds other solutions and fails soon.
app::Response solved_from_cells(const app::Scene& scene, const Eigen::VectorXd& cells, bool near = false);
/// The displacements of the cells of a Haar solution, and its column in haar_readings_cells.csv.
Eigen::VectorXd cell_values(const app::Response& response, int cells);
std::string cells_column(const Pair& pair, const Sums& sums);

/// A finding for each of all_sums(); a reading for which `missing` names a pair differs and reports it.
std::vector<report::Reading> judged(const std::function<Finding(std::size_t)>& judge,
                                    const std::function<std::string(std::size_t)>& missing);
/// The same of solutions of `needed` pairs of Table 2.
std::vector<report::Reading> judged(const Readings& readings, const std::vector<std::string>& needed,
                                    const std::function<Finding(std::size_t)>& judge);

/// Whether errors are lower than others or similar to them: "reasonably", "relatively well", "comparable"
/// with another pair. Holds if most entries are at most report::similar_factor times as high, as
/// report::mostly; unknown ones count as higher.
report::Verdict within_twice(const std::vector<double>& errors, const std::vector<double>& others);
/// The same of each of two pairs, by the rms and the mean of the error.
report::Verdict both_within_twice(const std::array<double, 2>& rms, const std::array<double, 2>& mean,
                                  double other_rms, double other_mean);

/// The lowest of the errors of the pairs with these trial functions.
double lowest_of(const std::string& trial, const std::vector<double>& errors);
/// Whether the better pair with DB6 trial functions has lower errors than all others, rms and mean.
Finding daubechies_lowest(const std::vector<double>& rms, const std::vector<double>& mean);
/// The lowest of the errors of all pairs without DB6 trial functions.
double lowest_without_daubechies(const std::vector<double>& errors);

/// The statement with the verdict of the readings, and what the first found as `measured`.
report::Statement concluded(report::Statement statement, std::vector<report::Reading> readings);

/// Under which readings of the text a statement agrees, and under which it would if the sums were formed
/// otherwise: their names where they are few, else how many.
std::string spread(const std::vector<report::Reading>& readings);

/// Notes which keys of the scene the readings set.
void note_readings(report::Artefact& artefact);
/// Where that is noted.
void refer_to_readings(report::Artefact& artefact);

}  // namespace wavebalance::jl14
