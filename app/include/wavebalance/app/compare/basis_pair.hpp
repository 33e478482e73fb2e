#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Trial and weighting functions, by the names of Time::trial and Time::weight, or phases().
struct BasisPair {
  std::string trial, weight;

  /// The exact solution among the pairs of bases: it has no weighting functions.
  static BasisPair phases() { return {"phases", ""}; }
  bool is_phases() const { return *this == phases(); }
  bool is_fourier() const { return trial == "fourier" && weight == "fourier"; }
  bool operator==(const BasisPair&) const = default;
};

/// "haar:fourier", as a command's argument and a table have it; "phases".
std::string name_of(const BasisPair& pair);
/// "Haar:Fourier", "DB6:DB6", "collocation": in pictures and sentences.
std::string label_of(const BasisPair& pair);

/// Reads "fourier:fourier,haar:fourier". Throws std::invalid_argument, which names what is wrong and what is
/// allowed, for anything else, unknown bases and a pair that is there twice.
std::vector<BasisPair> parse_pairs(std::string_view text);

/// Every pair of "fourier", "haar", "bspline" and "daubechies6", admissible or not, Fourier:Fourier first,
/// and "daubechies10" with itself and with Fourier weights.
std::vector<BasisPair> common_pairs();

/// Whether the pair can be taken with the scene's formulation and inner products, and if not, the reason.
solvers::Admissibility admissibility_of(const BasisPair& pair, const Scene& scene);

/// How a pair is drawn, in every picture.
struct PairStyle {
  Colour colour = Colour::grey;
  int marker = 8;
  Dash dash = Dash::solid;
};

/// The six pairs of JL14's Table 2 have a colour each and are solid; others have the colour of their trial
/// functions and dashes by their weights.
PairStyle style_of(const BasisPair& pair);

/// `series` in this style; the exact solution is black and wider.
Series styled(Series series, const BasisPair& pair);

}  // namespace wavebalance::app
