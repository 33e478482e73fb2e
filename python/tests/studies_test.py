"""A scene over values of its keys."""

import concurrent.futures
import multiprocessing
import os
import pickle

import numpy as np
import pytest
import scipy.sparse

import wavebalance as wb

PARAMETERS = {"forcing.frequency": np.linspace(120.0, 160.0, 5), "contact.gap": [1e-3, 2e-3]}


def same(one, other):
    """Equal tables but for the times."""
    assert one.table.keys() == other.table.keys()
    for name, column in one.table.items():
        if name != "seconds":
            np.testing.assert_array_equal(column, other.table[name], err_msg=name)


def test_a_study_has_the_values_of_its_runs(bar):
    study = wb.study(bar, PARAMETERS)
    assert study.converged and len(study) == 10
    assert "10 runs, 10 converged" in repr(study)
    assert list(study.table["contact.gap"]) == [1e-3, 2e-3] * 5
    alone = wb.run(bar, {"forcing.frequency": 130.0, "contact.gap": 2e-3})
    assert study.table["max_displacement_m"][3] == alone.summary["max_displacement_m"]
    assert study.summary["quantiles"]["quantity"]


def test_samples_fill_their_intervals(bar):
    gaps = {"contact.gap": {"from": 1e-4, "to": 1e-2, "spacing": "logarithmic"}}
    study = wb.study(bar, gaps, sampling="sobol", samples=31)
    assert 15 <= np.sum(np.asarray(study.table["contact.gap"]) < 1e-3) <= 16
    assert "<svg" in study.svg() and "<svg" in study._repr_html_()


def test_files_are_those_of_the_command(bar, tmp_path, command):
    study = wb.study(bar, PARAMETERS, output=tmp_path / "out")
    arrays = np.load(tmp_path / "out" / "study.npz")
    assert set(arrays) == set(study.table)
    for name, column in study.table.items():
        np.testing.assert_array_equal(arrays[name], column, err_msg=name)
    (tmp_path / "study.toml").write_text(
        'scene = "bar.toml"\n[[parameters]]\nkey = "forcing.frequency"\nvalues = [120.0, 130.0, 140.0, 150.0, 160.0]\n'
        '[[parameters]]\nkey = "contact.gap"\nvalues = [1e-3, 2e-3]\n'
    )
    (tmp_path / "bar.toml").write_text(wb.complete(bar))
    assert command("study", "study.toml", "--output", "other").returncode == 0
    other = np.load(tmp_path / "other" / "study.npz")
    for name in arrays:
        if name != "seconds":
            np.testing.assert_array_equal(other[name], arrays[name], err_msg=name)


@pytest.mark.parametrize("kind", ["threads", "processes"])
def test_an_executor_gives_the_same_rows(bar, kind):
    spawned = multiprocessing.get_context("spawn")
    executor = (
        concurrent.futures.ThreadPoolExecutor(2)
        if kind == "threads"
        else concurrent.futures.ProcessPoolExecutor(2, mp_context=spawned)
    )
    with executor:
        same(wb.study(bar, PARAMETERS, executor=executor), wb.study(bar, PARAMETERS, threads=1))


def test_dask_is_an_executor(bar):
    distributed = pytest.importorskip("distributed", reason="Debian: python3-distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster, distributed.Client(cluster) as client:
        same(wb.study(bar, PARAMETERS, executor=client.get_executor()), wb.study(bar, PARAMETERS))


class FailingExecutor(concurrent.futures.Executor):
    """Solves at once, until it fails for good."""

    def __init__(self, tasks):
        self.tasks = tasks

    def submit(self, function, /, *arguments, **keywords):
        future = concurrent.futures.Future()
        self.tasks -= 1
        if self.tasks < 0:
            future.set_exception(RuntimeError("a worker died"))
        else:
            future.set_result(function(*arguments, **keywords))
        return future


def test_what_was_solved_before_a_failure_is_not_solved_again(bar, tmp_path):
    with pytest.raises(RuntimeError, match="a worker died"):
        wb.study(bar, PARAMETERS, output=tmp_path, executor=FailingExecutor(4))
    rows = (tmp_path / "study.journal").read_text().count("\n") - 1
    assert rows == 4
    study = wb.study(bar, PARAMETERS, output=tmp_path)
    assert study.summary["runs_solved_now"] == 6
    same(study, wb.study(bar, PARAMETERS))


def test_matrices_in_memory_are_solved_here_and_refused_elsewhere():
    n = 5
    stiffness = 1e6 * scipy.sparse.diags([-1, 2, -1], [-1, 0, 1], shape=(n, n))
    scene = {
        "structure": {
            "type": "matrices",
            "mass": 0.5 * scipy.sparse.identity(n),
            "stiffness": stiffness,
            "stiffness_damping": 1e-5,
            "contact_dofs": [n],
        },
        "contact": {"law": "linear", "stiffness": 1e6, "gap": 1e-4},
        "forcing": {"load_dofs": [n], "amplitude": 50.0, "frequency": 30.0},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 31},
    }
    study = wb.study(scene, {"forcing.frequency": [20.0, 30.0]})
    assert study.converged and study.table["max_displacement_m"][0] > 0
    with concurrent.futures.ThreadPoolExecutor(1) as executor, pytest.raises(ValueError, match="names of files"):
        wb.study(scene, {"forcing.frequency": [20.0]}, executor=executor)


def test_workers_in_other_folders_find_the_files_of_a_scene(scenes, monkeypatch):
    monkeypatch.chdir(scenes / "matrices")
    frequencies = {"forcing.frequency": [70.0, 75.0]}
    here = wb.study("strip_forced.toml", frequencies, {"time.functions": 15})
    assert here.converged
    with concurrent.futures.ProcessPoolExecutor(
        1, mp_context=multiprocessing.get_context("spawn"), initializer=os.chdir, initargs=("/",)
    ) as executor:
        same(wb.study("strip_forced.toml", frequencies, {"time.functions": 15}, executor=executor), here)


def test_a_wrong_study_names_the_key_and_what_is_allowed(bar, tmp_path):
    with pytest.raises(wb.SceneError, match="did you mean contact.gap"):
        wb.study(bar, {"contact.gab": [1.0]}, output=tmp_path / "out")
    with pytest.raises(wb.SceneError, match="expected one of"):
        wb.study(bar, PARAMETERS, sampling="random")
    with pytest.raises(wb.SceneError, match="count: missing"):
        wb.study(bar, {"contact.gap": {"from": 1.0, "to": 2.0}})
    with pytest.raises(wb.SceneError, match="time.functions"):
        wb.study(bar, {"time.functions": [15, -1]})
    with pytest.raises(TypeError, match="expected a list of values or an interval"):
        wb.study(bar, {"contact.gap": 1.0})
    assert not (tmp_path / "out").exists()


def test_a_study_can_be_pickled(bar):
    copy = pickle.loads(pickle.dumps(wb.study(bar, {"contact.gap": [1e-3]})))
    assert copy.converged and copy.table["run"][0] == 1
    with pytest.raises(ValueError, match="from a pickle"):
        copy.svg()
