"""Several runs of one cycle in one Rerun file: the last drawn solid, the others as ghosts that ride along with it.

A ghost keeps its roll, heave and pitch but takes the solid run's place and heading, so that the bodies can be compared
where their paths drift apart.
"""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np

from ars_mujoco.recording.recording import Recording
from ars_mujoco.recording.rerun.car import BODY, chase_of, in_chase_of
from ars_mujoco.recording.rerun.look import Look, ghost
from ars_mujoco.recording.rerun.rerun_file import close_stream, open_stream, part_of
from ars_mujoco.recording.rerun.run import RerunRun
from ars_mujoco.schema.plots import merged


def write_comparison(path: Path, runs: dict[str, Recording]) -> None:
    """Write `runs`, by name, to `path`: each below `/<name>`, signals overlaid, the last one solid.

    The tabs are those of all runs, so that what one run does not have is shown beside what it has.
    """
    tabs = merged(*(run.tabs for run in runs.values()))
    *ghosts, (name, solid) = [(name, replace(run, tabs=tabs)) for name, run in runs.items()]
    part = part_of(Path(path))
    stream = open_stream(part, f"{solid.title}: {' and '.join(runs)}")
    drawn = [RerunRun(stream, solid, f"/{name}", Look(name))]
    drawn[0].append(solid.at_poses())
    for number, (ghost_name, run) in enumerate(ghosts):
        riding = riding_with(run, solid)
        drawn.append(RerunRun(stream, riding, f"/{ghost_name}", ghost(ghost_name, number), row=number + 1))
        drawn[-1].append(riding.at_poses())
    close_stream(stream, drawn)
    os.replace(part, path)


def riding_with(run: Recording, solid: Recording) -> Recording:
    """`run` with its body's place and heading on the ground taken from `solid` at the same times."""
    if BODY not in run.bodies or BODY not in solid.bodies:
        return run
    frames = np.searchsorted(solid.pose_time, run.pose_time).clip(max=len(solid.pose_time) - 1)
    poses = in_chase_of(run.poses, chase_of(run.body(BODY)), chase_of(solid.body(BODY))[frames])
    return replace(run, poses=poses)
