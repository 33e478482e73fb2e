"""The pairs of Table 2 of Jones and Legrand."""

#: The column of each pair and how the paper calls it.
PAIRS = {"fourier_fourier": "Fourier:Fourier", "bspline_bspline": "B-spline:B-spline",
         "daubechies6_daubechies6": "DB6:DB6", "haar_fourier": "Haar:Fourier", "daubechies6_fourier": "DB6:Fourier",
         "haar_bspline": "Haar:B-spline"}


def trial_and_weight(pair):
    return dict(zip(("trial", "weight"), pair.split("_")))
