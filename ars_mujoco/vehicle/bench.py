"""The bench's file: a split bar whose ends are held or moved. Values: mjcf/bench/bench.yaml."""

from ars_mujoco.schema.parameters import Parameters, quantity


class Bench(Parameters):
    """A split bar on a bench."""

    arm: float = quantity("m", gt=0)
    stiffness: float = quantity("Nm/rad", ge=0)  # torsion of the split bar, both halves in series; 0: a free shaft
    width: float = quantity("m", gt=0)  # between the two ends
    height: float = quantity("m", gt=0)  # of the bar's axis above the floor
    link_length: float = quantity("m", gt=0)
