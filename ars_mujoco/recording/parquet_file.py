"""A run as a table: column `time` in s, then one column a channel in its SI unit, every step kept."""

from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from ars_mujoco.recording.recording import Recording
from ars_mujoco.schema.channels import Channel

TIME = Channel("time", "s", "time since the start of the run")
TITLE = b"ars_mujoco:title"


def write_parquet(path: Path, run: Recording) -> None:
    """Write the channels of `run`; unit, description and the role of an energy stand in each field's metadata."""
    channels = [TIME, *run.channels.values()]
    schema = pa.schema([_field(channel) for channel in channels], metadata={TITLE: run.title.encode()})
    columns = [pa.array(run.time), *(pa.array(column) for column in np.ascontiguousarray(run.values.T))]
    # dictionaries cost time and save nothing on measured signals
    pq.write_table(pa.Table.from_arrays(columns, schema=schema), path, use_dictionary=False, compression="zstd")


def read_parquet(path: Path) -> Recording:
    """A run written by `write_parquet`: its title, channels, time and values; poses, tabs and events are not in it."""
    table = pq.read_table(path)
    channels = [_channel(field) for field in table.schema if field.name != TIME.name]
    return Recording(
        title=table.schema.metadata[TITLE].decode(),
        channels={channel.name: channel for channel in channels},
        time=table[TIME.name].to_numpy(),
        values=np.column_stack([table[channel.name].to_numpy() for channel in channels]),
    )


def _field(channel: Channel) -> pa.Field:
    metadata = {"unit": channel.unit, "description": channel.description}
    if channel.role:
        metadata["role"] = channel.role
    return pa.field(channel.name, pa.float64(), nullable=False, metadata=metadata)


def _channel(field: pa.Field) -> Channel:
    told = {key.decode(): value.decode() for key, value in field.metadata.items()}
    return Channel(field.name, told["unit"], told["description"], told.get("role"))
