#include "wavebalance/app/compare/solve_point.hpp"

#include "files/contains.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

constexpr std::array common_bases{"fourier", "bspline", "daubechies6", "haar"};

std::string basis_label(const std::string& basis) {
  if (basis == "fourier") return "Fourier";
  if (basis == "haar") return "Haar";
  if (basis == "bspline") return "B-spline";
  return "DB" + std::to_string(daubechies_coefficients(basis));
}

/// The pairs of JL14's Table 2, which are solid, and trial functions of other pairs. Those have the colour of
/// the first with their trial functions, and dashes.
struct NamedStyle {
  BasisPair pair;
  Colour colour;
  int marker;
};
const std::array<NamedStyle, 9>& named_styles() {
  static const std::array<NamedStyle, 9> all{{{{"fourier", "fourier"}, Colour::blue, 1},
                                              {{"bspline", "bspline"}, Colour::vermillion, 2},
                                              {{"daubechies6", "daubechies6"}, Colour::green, 3},
                                              {{"haar", "fourier"}, Colour::purple, 4},
                                              {{"daubechies6", "fourier"}, Colour::orange, 5},
                                              {{"haar", "bspline"}, Colour::sky_blue, 6},
                                              {{"daubechies8", ""}, Colour::sky_blue, 5},
                                              {{"daubechies10", ""}, Colour::black, 6},
                                              {{"daubechies20", ""}, Colour::grey, 7}}};
  return all;
}

Dash dash_of(const BasisPair& pair) {
  return pair.weight == "fourier"   ? Dash::dash_dotted
         : pair.weight == "bspline" ? Dash::dotted
                                    : Dash::dashed;
}

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
  throw std::invalid_argument("--pairs " + std::string(text) + ": " + why);
}

void check_basis(std::string_view text, const std::string& basis) {
  try {
    is_wavelet(basis);
  } catch (const std::invalid_argument&) {
    refuse(text, "\"" + basis +
                     "\" is no basis; expected \"fourier\", \"haar\", \"bspline\" or \"daubechies\" with an "
                     "even number");
  }
}

BasisPair parse_pair(std::string_view text, const std::string& one) {
  const auto colon = one.find(':');
  if (colon == std::string::npos)
    refuse(text, "\"" + one + "\" is no pair; expected TRIAL:WEIGHT, several with commas, such as " +
                     "fourier:fourier,haar:fourier");
  BasisPair pair{one.substr(0, colon), one.substr(colon + 1)};
  check_basis(text, pair.trial);
  check_basis(text, pair.weight);
  return pair;
}

}  // namespace

std::string name_of(const BasisPair& pair) {
  return pair.is_exact() ? pair.trial : pair.trial + ":" + pair.weight;
}

std::string label_of(const BasisPair& pair) {
  if (pair.is_exact()) return "exact solution";
  return basis_label(pair.trial) + ":" + basis_label(pair.weight);
}

std::vector<BasisPair> parse_pairs(std::string_view text) {
  std::vector<BasisPair> pairs;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    BasisPair pair = parse_pair(text, std::string(text.substr(begin, end - begin)));
    if (contains(pairs, pair)) refuse(text, name_of(pair) + " is there twice; expected each pair once");
    pairs.push_back(std::move(pair));
    begin = end + 1;
  }
  return pairs;
}

std::vector<BasisPair> common_pairs() {
  std::vector<BasisPair> pairs;
  for (const char* weight : common_bases)
    for (const char* trial : common_bases) pairs.push_back({trial, weight});
  // The best pairs for rigid obstacles, as measured by bench.
  for (const char* weight : {"daubechies10", "fourier"}) pairs.push_back({"daubechies10", weight});
  return pairs;
}

solvers::Admissibility admissibility_of(const BasisPair& pair, const Scene& scene) {
  Time tried = scene.time;
  tried.trial = pair.trial;
  tried.weight = pair.weight;
  tried.functions = 16;  // no matter how many: exponents and derivatives decide
  tried.quadrature_points = 4 * tried.functions;
  const bool damped = make_laws(scene).depend_on_velocity();
  if (damped && make_basis(pair.trial, tried.functions).pointwise_derivatives() < 1)
    return {
        false,
        "the contact force depends on the velocity, and the trial functions have no pointwise derivative"};
  return pair_admissibility(tried);
}

PairStyle style_of(const BasisPair& pair) {
  if (pair.is_exact()) return {Colour::black, 7};
  const auto& styles = named_styles();
  auto found = std::ranges::find(styles, pair, &NamedStyle::pair);
  if (found != styles.end()) return {found->colour, found->marker};
  found = std::ranges::find_if(styles, [&](const NamedStyle& one) { return one.pair.trial == pair.trial; });
  if (found != styles.end()) return {found->colour, found->marker, dash_of(pair)};
  return {Colour::grey, 8, dash_of(pair)};
}

Series styled(Series series, const BasisPair& pair) {
  const PairStyle style = style_of(pair);
  series.colour = style.colour;
  series.marker = style.marker;
  series.dash = style.dash;
  if (pair.is_exact()) series.width = 2.4;
  return series;
}

}  // namespace wavebalance::app
