"""Pairs of bases in NumPy: what a record's samples weigh, harmonic by harmonic of the translates."""

import numpy as np

from wavebalance import wavelets


class FourierPair:
    """Harmonics 0 to (M - 1) / 2 of N samples, trial and weight functions alike."""

    def __init__(self, functions, points):
        self.points, self.kept = points, np.arange((functions - 1) // 2 + 1)
        # The deviation of a coefficient by samples with errors of deviation one.
        self.noise = np.full(len(self.kept), points ** -0.5)

    def symbol(self, derivative):
        return (2j * np.pi * self.kept) ** derivative

    def project(self, samples):
        """Inner products of rows of samples with the weight functions."""
        return np.fft.rfft(samples, axis=-1)[..., self.kept] / self.points

    coefficients = project

    def load(self):
        """Inner products of cos(2 pi t)."""
        return np.where(self.kept == 1, 0.5, 0.0)

    def evaluate(self, coefficients):
        """The samples of rows of coefficients."""
        spectra = np.zeros((*coefficients.shape[:-1], self.points // 2 + 1), complex)
        spectra[..., self.kept] = coefficients * self.points
        return np.fft.irfft(spectra, self.points, axis=-1)


class TranslatePair:
    """Translates of two generators, the points a multiple of them; derivatives act on the weight functions."""

    def __init__(self, trial, weight, functions, points):
        self.functions, self.points = functions, points
        self.kept = np.arange((functions - 1) // 2 + 1)  # the alternating coefficient is dropped
        self.trial = np.fft.fft(wavelets.generator(trial, functions, points))
        self.weight = np.fft.fft(wavelets.generator(weight, functions, points))
        self.gram = self._fold(self.trial, self.trial).real
        self.noise = np.sqrt(points / self.gram)
        self.exact = trial if trial == weight and trial.startswith("daubechies") else None
        if self.exact:
            self.symbols = [self._connected(trial, derivative) for derivative in range(3)]
        else:
            self.symbols = [self._sampled(weight, derivative) for derivative in range(3)]

    def _fold(self, factor, samples):
        """The sums of conj(factor) samples over all harmonics that are the same to the translates."""
        product = np.conj(factor) * samples
        folded = product.reshape(*product.shape[:-1], self.points // self.functions, self.functions).sum(axis=-2)
        return folded[..., self.kept]

    def _sampled(self, weight, derivative):
        derived = np.fft.fft(wavelets.generator(weight, self.functions, self.points, derivative))
        return (-1) ** derivative * self._fold(derived, self.trial)

    def _connected(self, basis, derivative):
        """Exact inner products, by connection coefficients."""
        shifts, values = wavelets.connection_coefficients(basis, None, derivative)
        turns = np.exp(-2j * np.pi * np.outer(self.kept, shifts) / self.functions)
        return turns @ values * self.functions ** (derivative - 2.0) * self.points ** 2

    def symbol(self, derivative):
        return self.symbols[derivative]

    def project(self, samples):
        return self._fold(self.weight, np.fft.fft(samples, axis=-1))

    def load(self):
        load = np.zeros(len(self.kept), complex)
        weight = self.points * wavelets.harmonic(self.exact, self.functions, 1) if self.exact else self.weight[1]
        load[1:2] = 0.5 * self.points * np.conj(weight)
        return load

    def coefficients(self, samples):
        return self._fold(self.trial, np.fft.fft(samples, axis=-1)) / self.gram

    def evaluate(self, coefficients):
        spectra = np.zeros((*coefficients.shape[:-1], self.functions), complex)
        spectra[..., self.kept] = coefficients
        spectra[..., -self.kept[1:]] = np.conj(coefficients[..., 1:])
        copies = np.tile(spectra, self.points // self.functions)
        return np.fft.ifft(self.trial * copies, axis=-1).real


def pair_of(time):
    """The pair of a completed scene's [time], in its default formulation and inner products."""
    for key, default in (("formulation", "distributional"), ("inner_products", "quadrature"), ("nyquist", "drop")):
        assert time.get(key, default) == default
    functions, points = time["functions"], time["quadrature_points"]
    if time["trial"] == time["weight"] == "fourier":
        return FourierPair(functions, points)
    return TranslatePair(time["trial"], time["weight"], functions, points)
