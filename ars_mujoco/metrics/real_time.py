"""Real time: what a run cost."""

from ars_mujoco.metrics.metric import NotMeasurableError, Run, metric


@metric("1", "simulated time over wall time")
def real_time_factor(run: Run) -> float:
    if run.wall_time is None:
        raise NotMeasurableError("the wall time was not taken")
    if not run.recording.time.size:
        raise NotMeasurableError("nothing was recorded")
    return (run.recording.time[-1] - run.recording.time[0]) / run.wall_time
