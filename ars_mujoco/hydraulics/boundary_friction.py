"""Boundary friction of a displacement machine: dry at standstill, fading as speed builds up a film of oil."""

from ars_mujoco.schema.parameters import Parameters, number, quantity


class BoundaryFriction(Parameters):
    """In shares of the torque loss's norm."""

    share: float = number(ge=0)  # of the norm, at standstill
    decay_speed: float = quantity("rad/s", gt=0)  # over which it fades by 1/e
    sign_speed: float = quantity("rad/s", gt=0)  # over which the sign of all losses is rounded
