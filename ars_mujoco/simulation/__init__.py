"""Simulation: the loop, its samples and its events."""
