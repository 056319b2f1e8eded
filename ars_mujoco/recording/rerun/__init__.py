"""Rerun: recordings to look at."""
