"""The folder of a run: three files, each under its name only when whole."""

import json
from dataclasses import replace

import numpy as np
import pytest

from ars_mujoco.recording.folder import RunFolder, write_whole


def test_a_finished_run_leaves_three_files(run, tmp_path):
    folder = RunFolder(tmp_path / "out", run)
    folder.append(run)
    folder.finish(run)
    assert sorted(file.name for file in folder.path.iterdir()) == ["run.parquet", "run.rrd", "summary.json"]


def test_a_run_that_begins_removes_what_an_earlier_one_left(run, tmp_path):
    (tmp_path / "summary.json").write_text("{}")
    RunFolder(tmp_path, run)
    assert not (tmp_path / "summary.json").exists()


def test_the_summary_says_what_ran_and_what_came_out(run, tmp_path):
    factor = {"value": None, "unit": "1", "reason": "the reference rolls too little"}
    metrics = {"factor": factor, "peak": np.float64(0.1), "ratio": np.nan}
    folder = RunFolder(tmp_path, run)
    folder.append(run)
    folder.finish(replace(run, metrics=metrics))
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["schema_version"] == 2
    assert summary["inputs"] == run.inputs
    assert len(summary["inputs_sha256"]) == 64
    assert summary["versions"].keys() >= {"ars_mujoco", "python", "mujoco-core", "rerun-sdk"}
    assert summary["duration"] == {"value": pytest.approx(6.0), "unit": "s"}
    assert summary["metrics"] == {"factor": factor, "peak": 0.1, "ratio": None}
    assert [event["text"] for event in summary["events"]] == ["left curve", "reversal", "straight"]


def test_a_write_that_fails_leaves_nothing_and_keeps_what_was_there(tmp_path):
    path = tmp_path / "table"
    path.write_text("old")

    def fail(part):
        part.write_text("half")
        raise OSError("disk full")

    with pytest.raises(OSError, match="disk full"):
        write_whole(path, fail)
    assert [(file.name, file.read_text()) for file in tmp_path.iterdir()] == [("table", "old")]
