"""Pump-controlled: a swash-plate pump and a vane motor between the halves of each bar."""
