"""Scenes from Python equal scenes of the command."""

import csv
import json
import pickle

import numpy as np
import pytest
import scipy.sparse

import wavebalance


def read_csv(file):
    with open(file, newline="") as lines:
        rows = list(csv.reader(lines))
    return {name: [row[i] for row in rows[1:]] for i, name in enumerate(rows[0])}


def as_number(text):
    return {"true": 1.0, "false": 0.0}.get(text) if text in ("true", "false") else float(text)


def as_toml(scene):
    return wavebalance.complete(scene)


@pytest.mark.parametrize("scene", 
    [
        "jones_legrand_2014/case1.toml",
        "jones_legrand_2014/case2_sweep.toml",
        "laxalde_legrand_2010/rod.toml",
        "matrices/strip_forced.toml",
        "laws/backlash.toml",
        "laws/rubber_stop.toml",
    ],
)
def test_a_record_has_the_digits_of_the_command(scene, scenes, command, tmp_path):
    ended = command("run", scenes / scene, "--output", tmp_path / "run", "--quiet", "--no-report")
    record = wavebalance.run(scenes / scene)
    assert record.converged == (ended.returncode == 0)
    (name,) = [one for one in ("response", "sweep", "backbone") if getattr(record, one)]
    table, written = getattr(record, name), read_csv(tmp_path / "run" / f"{name}.csv")
    assert list(written) == list(table)
    for column, values in written.items():
        if isinstance(table[column], list):
            assert values == table[column]
        else:
            np.testing.assert_array_equal(np.array([as_number(one) for one in values]), table[column], err_msg=column)
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    for key, value in summary.items():
        if isinstance(value, (int, float)) and not key.endswith("_seconds"):
            assert value == record.summary[key], key


def test_a_dictionary_a_text_and_a_file_are_one_scene(bar, tmp_path):
    text = as_toml(bar)
    (tmp_path / "bar.toml").write_text(text)
    records = [wavebalance.run(one) for one in (bar, text, tmp_path / "bar.toml", str(tmp_path / "bar.toml"))]
    for record in records[1:]:
        np.testing.assert_array_equal(record.response["displacement_m"], records[0].response["displacement_m"])


def test_overrides_are_those_of_the_command(bar):
    changed = wavebalance.run(bar, {"contact.gap": 2e-3})
    bar["contact"]["gap"] = 2e-3
    expected = wavebalance.run(bar)
    assert changed.summary["max_displacement_m"] == expected.summary["max_displacement_m"]
    assert wavebalance.run(bar, ["contact.gap=2e-3"]).summary["max_displacement_m"] == expected.summary["max_displacement_m"]


def test_a_wrong_value_has_the_text_of_the_command(bar, command, tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text(as_toml(bar).replace("gap = 0.001", 'gap = "big"'))
    with pytest.raises(wavebalance.SceneError) as raised:
        wavebalance.run(str(file))
    assert issubclass(wavebalance.SceneError, ValueError)
    assert raised.value.key == "contact.gap" and raised.value.line > 0
    ended = command("run", file, "--output", tmp_path / "run")
    assert ended.returncode == 2 and str(raised.value) in ended.stderr


def test_a_dictionary_with_a_wrong_value_is_refused_without_a_line(bar):
    bar["contact"]["gap"] = "big"
    with pytest.raises(wavebalance.SceneError, match=r"^scene: contact\.gap = "):
        wavebalance.run(bar)


def test_a_value_that_no_scene_has_is_refused_with_its_key(bar):
    bar["contact"]["gap"] = object()
    with pytest.raises(TypeError, match=r"contact\.gap: object"):
        wavebalance.run(bar)


def test_a_dictionary_in_place_of_a_value_is_refused_with_the_key_to_write(bar):
    with pytest.raises(TypeError, match=r"dictionary is no value of a scene; expected keys with dots, as in .'contact.gap'"):
        wavebalance.run(bar, {"contact": {"gap": 2e-3}})


def test_a_file_that_no_record_lists_and_the_scene_are_not_replaced(bar, tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text(as_toml(bar))
    with pytest.raises(OSError, match="scene.toml: is read by this command"):
        wavebalance.run(scene, output=tmp_path)
    assert scene.read_text() == as_toml(bar)
    record = wavebalance.run(bar, output=tmp_path / "out")
    record.write(tmp_path / "out")
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "response.csv").write_text("measured")
    with pytest.raises(OSError, match="response.csv: would be replaced"):
        record.write(tmp_path / "other")
    assert (tmp_path / "other" / "response.csv").read_text() == "measured"


def test_not_to_converge_is_a_status(bar):
    bar["analysis"] = {"type": "time_stepping", "max_periods": 1}
    del bar["time"]
    record = wavebalance.run(bar)
    assert not record.converged and record.status == "iteration_limit"


def test_output_holds_the_files_of_the_command(bar, command, tmp_path):
    (tmp_path / "bar.toml").write_text(as_toml(bar))
    command("run", tmp_path / "bar.toml", "--output", tmp_path / "command", "--quiet")
    record = wavebalance.run(tmp_path / "bar.toml", output=tmp_path / "python")
    names = sorted(one.name for one in (tmp_path / "command").iterdir())
    assert sorted(one.name for one in (tmp_path / "python").iterdir()) == names
    for name in ("response.csv", "scene.toml", "response.svg"):
        assert (tmp_path / "python" / name).read_bytes() == (tmp_path / "command" / name).read_bytes()
    record.write(tmp_path / "again")
    assert (tmp_path / "again" / "response.csv").read_bytes() == (tmp_path / "python" / "response.csv").read_bytes()


def chain(size):
    stiffness = 1e4 * scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(size, size))
    return scipy.sparse.identity(size, format="csr"), stiffness


def chain_scene(mass, stiffness):
    return {
        "structure": {"type": "matrices", "mass": mass, "stiffness": stiffness, "modal_damping": 0.02, "contact_dofs": [4]},
        "contact": {"law": "linear", "stiffness": 1e5, "gap": 1e-3},
        "forcing": {"load_dofs": [1], "amplitude": 20.0, "frequency": 9.0},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 15, "quadrature_points": 64},
    }


def test_matrices_in_memory_in_npz_and_in_mtx_files_give_the_same_digits(tmp_path):
    mass, stiffness = chain(5)
    from scipy.io import mmwrite

    scipy.sparse.save_npz(tmp_path / "k.npz", stiffness.tocsr())
    mmwrite(tmp_path / "m.mtx", mass, precision=17)
    mmwrite(tmp_path / "k.mtx", stiffness, precision=17)
    in_memory = wavebalance.run(chain_scene(mass, stiffness.toarray()))
    in_files = wavebalance.run(chain_scene(tmp_path / "m.mtx", tmp_path / "k.mtx"))
    (tmp_path / "chain.toml").write_text(as_toml(chain_scene(tmp_path / "m.mtx", tmp_path / "k.mtx")).replace("k.mtx", "k.npz"))
    in_npz = wavebalance.run(tmp_path / "chain.toml")
    assert in_memory.converged and in_memory.summary["contact_fraction"] > 0.0
    for record in (in_files, in_npz):
        np.testing.assert_array_equal(record.response["displacement_m"], in_memory.response["displacement_m"])


def test_matrices_in_memory_are_kept_beside_the_record_that_names_them(tmp_path):
    record = wavebalance.run(chain_scene(*chain(5)), output=tmp_path / "out")
    again = wavebalance.run(tmp_path / "out" / "scene.toml")
    np.testing.assert_array_equal(again.response["displacement_m"], record.response["displacement_m"])


def test_a_scene_that_is_refused_writes_nothing(tmp_path):
    scene = chain_scene(*chain(5))
    scene["contact"]["gap"] = "big"
    with pytest.raises(wavebalance.SceneError):
        wavebalance.run(scene, output=tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_matrix_that_does_not_fit_is_named_without_the_folder_of_its_copy():
    scene = chain_scene(chain(4)[0], chain(5)[1])
    with pytest.raises(wavebalance.SceneError, match="the matrix in given_mass.mtx is 4 x 4") as raised:
        wavebalance.run(scene)
    assert raised.value.key == "structure.mass"


def test_a_record_survives_a_pickle(bar):
    record = wavebalance.run(bar)
    copy = pickle.loads(pickle.dumps(record))
    assert copy.summary == record.summary
    np.testing.assert_array_equal(copy.response["displacement_m"], record.response["displacement_m"])
    with pytest.raises(ValueError, match="read from a pickle"):
        copy.svg()


def test_a_notebook_shows_the_picture_and_the_summary(bar):
    shown = wavebalance.run(bar)._repr_html_()
    assert "<svg" in shown and "max_displacement_m" in shown


def test_plot_draws_the_motion(bar):
    pytest.importorskip("matplotlib")
    record = wavebalance.run(bar)
    (line,) = record.plot().get_lines()
    np.testing.assert_array_equal(line.get_ydata(), record.response["displacement_m"])


def test_check_says_what_would_be_solved(bar):
    assert "31" in wavebalance.check(bar)


def test_a_comparison_is_decided_by_the_error_that_is_named(bar):
    found = wavebalance.compare(bar, pairs="fourier:fourier", error="force", budget=0.5)
    assert found.summary["error_of"] == "force"
    with pytest.raises(ValueError, match="--error energy: expected displacement, force or both"):
        wavebalance.compare(bar, error="energy")


def test_a_scene_that_is_no_text_is_refused_as_by_the_command(tmp_path):
    (tmp_path / "bytes.toml").write_bytes(b'[structure]\ntype = "bar\xff"\n')
    for scene in (tmp_path / "bytes.toml", "/dev/zero", tmp_path):
        with pytest.raises(wavebalance.SceneError):
            wavebalance.check(scene)


def test_a_structure_is_a_scene_of_a_nonlinear_mode():
    structure = wavebalance.Structure(np.eye(1), None, 100.0 * np.eye(1), contacts=[0], load=[1.0])
    scene = structure.scene(wavebalance.Penalty(400.0, 0.01), type="nonlinear_mode", energy_ratio=2.0)
    stiff = np.sqrt(500.0)  # free for 3/4 of the own period, then with the stop, from the speed w gap
    period = 1.5 * np.pi / 10.0 + 2.0 * np.arctan2(10.0 / stiff, 0.2) / stiff
    assert wavebalance.run(scene).summary["frequency_Hz"] == pytest.approx(1.0 / period, rel=1e-4)
