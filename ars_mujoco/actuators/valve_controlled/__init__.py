"""Valve-controlled: one pump on the engine, two pressure valves in series, a vane motor between the halves of each bar."""
