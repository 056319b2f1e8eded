"""Valve-controlled: one pump on the engine, two pressure valves in series, and a vane motor in each bar."""
