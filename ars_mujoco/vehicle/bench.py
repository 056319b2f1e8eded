"""The bench's file: a split bar whose ends are held or moved. Values: mjcf/bench/bench.yaml."""

from ars_mujoco.parameters import Parameters, Quantity


class Bench(Parameters):
    """A split bar on a bench."""

    arm: Quantity("m", gt=0)
    stiffness: Quantity("Nm/rad", ge=0)  # torsion of the split bar, both halves in series; 0: a free shaft
    width: Quantity("m", gt=0)  # between the two ends
    height: Quantity("m", gt=0)  # of the bar's axis above the floor
    link_length: Quantity("m", gt=0)
