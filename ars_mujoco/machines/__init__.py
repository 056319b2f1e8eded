"""Machines: what turns and what gears down."""
