"""Manoeuvres: what is driven, for how long, and what is expected of it."""
