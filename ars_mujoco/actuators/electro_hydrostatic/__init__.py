"""Electro-hydrostatic: a fixed pump on an electric machine of its own and a vane motor between the halves of each bar."""
