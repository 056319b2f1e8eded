"""The table of a run: every step, in SI, with units and descriptions."""

import numpy as np
import pyarrow.parquet as pq

from ars_mujoco.recording.parquet_file import read_parquet, write_parquet


def test_the_table_has_time_first_then_a_column_a_channel(run, tmp_path):
    write_parquet(tmp_path / "run.parquet", run)
    table = pq.read_table(tmp_path / "run.parquet")
    assert table.column_names == ["time", *run.channels]
    np.testing.assert_array_equal(table["time"].to_numpy(), run.time)
    np.testing.assert_array_equal(table["front.bar.torque"].to_numpy(), run["front.bar.torque"])
    metadata = table.schema.field("front.motor.pressure").metadata
    assert metadata[b"unit"] == b"Pa"
    assert metadata[b"description"] == b"made-up front.motor.pressure"
    assert b"role" not in metadata
    assert table.schema.field("front.energy.shaft").metadata[b"role"] == b"drawn"


def test_reading_back_gives_the_same(run, tmp_path):
    write_parquet(tmp_path / "run.parquet", run)
    back = read_parquet(tmp_path / "run.parquet")
    assert back.title == run.title
    assert back.channels == run.channels
    np.testing.assert_array_equal(back.time, run.time)
    np.testing.assert_array_equal(back.values, run.values)
