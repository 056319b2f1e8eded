"""Torsion bar: a bar without an actuator in it."""
