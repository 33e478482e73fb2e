"""Files of the program ll10 for the blade compared with independent values."""

import numpy as np
import pytest
import wavebalance as wb
from paper_results import SCENES

FIG07, FIG08 = "fig07_blade_backbone", "fig08_blade_shapes"


@pytest.fixture(scope="module")
def ratio_at(results):
    """The ratio of a formulation at an energy ratio, linear between its rows."""
    table = results.table(f"{FIG07}.csv")

    def ratio(formulation, energy_ratio, column="frequency_ratio"):
        rows = table.where(formulation=formulation)
        energy, value = rows.numbers("energy_ratio"), rows.numbers(column)
        i = np.flatnonzero((energy[:-1] <= energy_ratio) & (energy_ratio <= energy[1:]))[0]
        return value[i] + (value[i + 1] - value[i]) * (energy_ratio - energy[i]) / (energy[i + 1] - energy[i])

    return ratio


def test_the_model_is_reduced_as_the_paper_says_and_its_nodes_are_listed(results):
    assert results.passes("fig06_blade", "Craig-Bampton procedure")
    table = results.table("fig06_blade.csv")
    assert len(table) == 24
    assert np.all(table.numbers("z_m") == 0.091)
    assert table.numbers("x_m")[0] < table.numbers("x_m")[-1]
    assert results.has("fig06_blade.svg", "fig06_blade.png")


# Points that an independent program found for this blade with 5 harmonics and 20 samples.
@pytest.mark.parametrize("energy, frequency", [(1.2, 1.0069), (2.0, 1.0377), (3.0, 1.0808), (7.0, 1.1931)])
def test_the_backbone_is_the_one_found_independently(ratio_at, energy, frequency):
    assert ratio_at("consistent", energy) == pytest.approx(frequency, abs=0.003)


def test_the_published_formula_falls_short_of_the_backbone(results, ratio_at):
    table = results.table(f"{FIG07}.csv")
    assert table.columns == ["formulation", "energy_ratio", "frequency_ratio", "rayleigh_frequency_ratio"]
    assert table.where(formulation="consistent").numbers("energy_ratio")[-1] > 10.4
    published = ratio_at("published", 7.0)
    assert published < 1.13
    assert published == pytest.approx(ratio_at("consistent", 7.0, "rayleigh_frequency_ratio"), abs=0.03)


# With an inner tolerance below rounding they ended at 5 or 9, with the BLAS kernels of the processor.
def test_the_printed_equations_are_followed_to_the_end_of_the_axis(results):
    assert results.table(f"{FIG07}.csv").where(formulation="published").numbers("energy_ratio")[-1] == 12.0
    assert "not found beyond" not in results.text(f"{FIG07}.figure.js")


@pytest.mark.parametrize("stem, words, verdict", [(FIG07, "increase of the natural frequency", "agrees"),
                                                  (FIG07, "leading and trailing", "holds in part"),
                                                  (FIG08, "torsion effects", "agrees"),
                                                  (FIG08, "Sensitivity of mode shapes", "agrees")])
def test_a_statement_on_the_blade_has_its_verdict(results, stem, words, verdict):
    assert results.verdict(stem, words) == verdict


@pytest.mark.parametrize("stem", [FIG07, FIG08])
def test_statements_on_the_blade_are_judged_apart(results, stem):
    assert {statement["apart"] for statement in results.record(stem)["statements"]} == {"on our blade"}


# The augmented Lagrangian, started from the condensed solution, solves the same equations on all coordinates.
def test_a_second_solver_finds_the_backbone_of_the_blade(results, ratio_at):
    second = next(one for one in results.panels(FIG07)[0]["series"] if "augmented Lagrangian" in one["label"])
    assert second["x"] == [1.2, 2.0, 3.0, 7.0, 10.4]
    for energy, frequency in zip(second["x"], second["y"]):
        assert ratio_at("consistent", energy) == pytest.approx(frequency, abs=1e-3), energy


def test_shapes_touch_with_the_leading_edge_first_and_the_trailing_one_half_a_period_later(results):
    table = results.table(f"{FIG08}.csv")
    assert len(table) == 3 * 2 * 24
    energy, time, u = (table.numbers(name) for name in ("energy_ratio", "time_fraction", "u_z_over_gap"))
    assert np.all(u <= 1.0 + 1e-9)
    assert np.all(u[energy < 1.0] < 1.0)
    leading = np.arange(len(table)) % 24 < 12
    for ratio in (4.7, 10.4):
        for fraction in (0.0, 0.5):
            for edge in (True, False):
                largest = u[(energy == ratio) & (time == fraction) & (leading == edge)].max()
                assert (largest > 1.0 - 1e-9) == (edge == (fraction == 0.0)), (ratio, fraction, edge)


def test_motions_of_the_shapes_are_written(results):
    body = results.text("fig08_energy_4.7.body.js")
    assert body.startswith('((window.wavebalance ??= {}).bodies ??= {})["fig08_energy_4.7"] = {')
    assert '"label":"energy 4.7"' in body.replace(": ", ":")
    assert results.has(*(f"fig08_energy_{energy}.pvd" for energy in ("0.8", "4.7", "10.4")))
    assert results.has("fig08_energy_10.4_15.vtu")


@pytest.mark.parametrize("scene", ["blade_mode", "rod"])
def test_every_point_of_a_backbone_balances_its_forces(scene):
    curve = wb.run(SCENES / "laxalde_legrand_2010" / f"{scene}.toml").backbone
    on_curve = np.array(curve["status"]) == "converged"
    assert np.count_nonzero(on_curve) > 50
    assert np.all(curve["virial_residual"][on_curve] < 1e-12)  # omega^2 = r + <force> gap / m
    assert np.all(curve["residual"][on_curve] < 1e-9)
    assert np.all(curve["min_contact_force_N"][on_curve] >= 0.0)
