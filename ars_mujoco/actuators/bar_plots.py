"""What a recording shows of the bars, whatever stands between their halves."""

from ars_mujoco.schema.plots import Plot, Tab


def _axle(axle: str) -> Tab:
    angles = ("command", "angle", "twist")
    return Tab(
        f"{axle} axle",
        (
            Plot("bar angle", tuple(f"{axle}.bar.{angle}" for angle in angles)),
            Plot("bar torque", (f"{axle}.bar.torque",)),
        ),
    )


PLOTS = (_axle("front"), _axle("rear"))
