"""With analysis.outputs the terminal, the page, studies and overlays are about the outputs."""

import re

import numpy as np
import pytest
import wavebalance as wb
from command_scenes import rows_of

SWEEP = ("--analysis", "frequency_sweep", "--set", "analysis.frequency_from=40", "--set", "analysis.frequency_to=90",
         "--set", "contact.gap=1e-4", "--set", "analysis.stability=false", "--set", "structure.modal_damping=0.05")
OUTPUTS = ("--set", 'analysis.outputs=["row 1", "velocity of row 3 in mm/s"]')
STUDY = """scene = "case.toml"
set = ["contact.gap=1e-4", "structure.modal_damping=0.05", 'analysis.outputs=["row 1"]']
[[parameters]]
key = "forcing.frequency"
from = 40
to = 60
count = 5
"""


def values_of(text):
    """The lines that --verbose prints, as names and texts, in their order."""
    return dict(line.split(maxsplit=1) for line in text.splitlines() if len(line.split(maxsplit=1)) == 2)


def test_the_terminal_and_the_page_begin_with_them(command, masses):
    record = command("run", masses, "--output", "out", "--verbose", *SWEEP, *OUTPUTS)
    assert record.code == 0, record.errors
    names = list(values_of(record.text))
    assert names[2:5] == ["leading_output", "row_1_half_peak_to_peak_m", "row_1_peak_frequency_Hz"]
    assert names.index("velocity_of_row_3_half_peak_to_peak_mm_per_s") < names.index("max_displacement_m")
    words = re.sub(r"\s+", " ", re.sub("<[^>]*>", " ", record.page))
    assert words.index("The vibration of row 1 is at most") < words.index("The curve has")
    assert words.index("The curve has") < words.index("The largest vibration of a contact")
    assert "The velocity of row 3 is at most" in words
    assert words.count("The vibration of row 1 is at most") == 1
    drawn = (record.folder / "sweep.figure.js").read_text()
    assert drawn.index('"title":"Vibration of row 1"') < drawn.index("of the contacts")
    assert "Harmonics of row 1" in (record.folder / "outputs.figure.js").read_text()
    below = drawn[drawn.index("Displacement of the contacts"):]
    assert '"label":"least"' in below and "rms including mean" not in below


def test_without_outputs_nothing_is_told_of_them(command, masses):
    record = command("run", masses, "--output", "out", "--verbose", *SWEEP)
    names = list(values_of(record.text))
    assert names[2] == "residual" and "leading_output" not in names
    assert "[plot]" not in (record.folder / "scene.toml").read_text()
    assert "Harmonics of" not in (record.folder / "outputs.figure.js").read_text()


def test_a_study_has_their_columns_and_draws_the_first(command, masses, tmp_path):
    (tmp_path / "study.toml").write_text(STUDY.replace("case.toml", masses.name))
    study = command("study", "study.toml", "--output", "out")
    assert study.code == 0, study.errors
    rows = rows_of(study.folder / "study.csv")
    alone = wb.run(masses, {"forcing.frequency": 45.0, "contact.gap": 1e-4, "structure.modal_damping": 0.05,
                            "analysis.outputs": ["row 1"]}).outputs["row_1_m"]
    assert float(rows[1]["row_1_half_peak_to_peak_m"]) == pytest.approx(0.5 * np.ptp(alone), rel=1e-9)
    assert study.summary["quantity"] == "row_1_half_peak_to_peak_m"
    assert "Row 1 half peak to peak (µm)" in (study.folder / "study.figure.js").read_text()


def test_an_overlay_draws_the_output_that_all_have(command, masses):
    for name, gap in (("near", "1e-4"), ("far", "1e-3")):
        assert command("run", masses, "--output", name, *SWEEP, "--set", f"contact.gap={gap}", *OUTPUTS).code == 0
    assert command("run", masses, "--output", "bare", *SWEEP).code == 0
    laid = command("overlay", "near", "far", "--output", "out", "--quiet")
    assert laid.code == 0 and laid.summary["quantity"] == "row 1"
    drawn = [float(row["row_1_half_peak_to_peak_m"]) for row in rows_of(laid.folder / "overlay.csv")
             if row["curve"] == "far"]
    kept = [float(row["row_1_half_peak_to_peak_m"]) for row in rows_of(laid.folder.parent / "far" / "sweep.csv")]
    assert drawn == kept
    assert command("overlay", "near", "bare", "--output", "out", "--quiet").summary["quantity"] == "max"
    asked = command("overlay", "near", "far", "--output", "out", "--quantity", "velocity of row 3 in mm/s")
    assert asked.summary["quantity"] == "velocity of row 3"
    refused = command("overlay", "near", "bare", "--output", "out", "--quantity", "row 1")
    assert refused.code == 2 and "bare has" in refused.errors and "an output of all folders" in refused.errors


def test_contacts_are_called_by_the_names_of_their_pairs(command, masses):
    text = masses.read_text()
    text = re.sub(r"contact_dofs = .*\n", "", text)
    text = text.replace("[contact]\n", '[[contact.pairs]]\ndofs = [1]\nname = "upper stop"\n[[contact.pairs]]\n'
                        'dofs = [3]\nname = "lower stop"\n[contact]\n')
    masses.write_text(text)
    assert "m/N at upper stop" in command("check", masses).text
    record = command("run", masses, "--output", "out", *SWEEP, "--set", 'analysis.peak_of="lower stop"')
    assert record.code == 0, record.errors
    columns = list(rows_of(record.folder / "sweep.csv")[0])
    assert "upper_stop_max_m" in columns and "lower_stop_max_force_N" in columns
    assert "The vibration of lower stop is at most" in record.page
    masses.write_text(text.replace("lower stop", "upper stop"))
    assert "another of [[contact.pairs]] has this name" in command("check", masses).errors
