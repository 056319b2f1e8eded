"""Driving: who steers, and where to."""
