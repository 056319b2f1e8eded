"""Metrics: the figures a run is judged by; with this room open, `metric.METRICS` has them all, in this order."""

from ars_mujoco.metrics import roll, energy, limits, real_time  # noqa: F401, I001
