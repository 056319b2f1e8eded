"""ars_mujoco: a testbed for active stabilizer bars, a car in MuJoCo driven by hydraulics in compiled Python."""

__version__ = "0.1.0"
