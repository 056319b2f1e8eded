"""The roll plane's file: a body that only rolls (the paper's Fig. 1). Values: mjcf/roll_plane/roll_plane.yaml."""

from ars_mujoco.schema.parameters import Parameters, quantity


class RollPlaneBar(Parameters):
    """Stabilizer bar of one axle, its drop links standing on the ground."""

    arm: float = quantity("m", ge=0.04)  # a shorter one turns too far as its drop link travels by that much
    stiffness: float = quantity("Nm/rad", gt=0)  # torsion of the split bar, both halves in series
    passive_stiffness: float = quantity("Nm/rad", ge=0)  # torsion of the conventional bar in its place
    link_distance: float = quantity("m", gt=0)  # between the left and the right drop link
    link_length: float = quantity("m", ge=0.02)  # a shorter one tilts too far as the arm's end swings
    height: float = quantity("m", gt=0)  # of the bar's axis above the road
    position: float = quantity("m")  # of the drop links ahead of the centre of gravity


class RollPlane(Parameters):
    """A body on its roll axis, with the suspension's roll spring and damper, on rigid ground."""

    mass: float = quantity("kg", gt=0)
    roll_inertia: float = quantity("kg*m^2", gt=0)  # about the centre of gravity
    cg_height: float = quantity("m", gt=0)  # above the road
    roll_axis_height: float = quantity("m", ge=0)
    roll_stiffness: float = quantity("Nm/rad", gt=0)
    roll_damping: float = quantity("Nms/rad", ge=0)
    accelerometer_height: float = quantity("m", ge=0)  # above the road, on the centre line
    front: RollPlaneBar
    rear: RollPlaneBar
