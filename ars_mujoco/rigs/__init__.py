"""Rigs: what a cycle can run on. Each is a module with its world's layout, its step and its callback."""
