"""Kernels: compiled arithmetic on floats, without MuJoCo."""
