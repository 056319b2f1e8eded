"""Metrics: the figures a run is judged by."""
