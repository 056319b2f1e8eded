"""A single wheel on its tire, stepped by hand."""

from records import blank, filled

from ars_mujoco.tires.tire import Tire, TireOutput, TireState, tire

LEVEL = (0.0, 0.0, 0.0)  # road: height (m) and slopes
AT_REST = (0.0, 0.0, 0.0)
UPRIGHT = (0.0, 1.0, 0.0)


class Wheel:
    """A tire and its records: `force` is what it feels, `advance` takes it a step on."""

    def __init__(self, **changes):
        self.p = filled(Tire().model_copy(update=changes))
        self.now, self.next, self.out = blank(TireState), blank(TireState), blank(TireOutput)

    def force(self, v=AT_REST, spin=0.0, height=0.295, axis=UPRIGHT, w=AT_REST, road=LEVEL, h=1e-3, kernel=tire):
        """(Fx, Fy, Fz, Tx, Ty, Tz) with the wheel's centre `height` (m) above the origin."""
        return kernel(self.p, self.now, self.next, self.out, h, 0.0, 0.0, height, *axis, *v, *w, spin, *road)

    def advance(self):
        self.now, self.next = self.next, self.now

    def settled(self, seconds=2.0, **motion):
        """The force once the carcass has followed a steady motion."""
        for _ in range(int(seconds / 1e-3)):
            force = self.force(**motion)
            self.advance()
        return force
