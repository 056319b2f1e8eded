"""Electro-hydrostatic: a fixed pump on a machine of its own and a vane motor between the halves of each bar."""
