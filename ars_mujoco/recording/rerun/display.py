"""How signals are shown: engineers' units, names with their unit, colours and the range of an axis.

Only for looking at; tables and metrics stay in SI.
"""

import math

import numpy as np

from ars_mujoco.schema.channels import Channel

CORNERS = ("fl", "fr", "rl", "rr")
CORNER_COLORS = {"fl": (66, 165, 245), "fr": (239, 83, 80), "rl": (38, 198, 218), "rr": (255, 167, 38)}
PALETTE = ((66, 165, 245), (255, 167, 38), (102, 187, 106), (239, 83, 80), (171, 71, 188), (255, 238, 88))

G = 9.80665
BY_UNIT = {
    "rad": ("deg", 180 / math.pi),
    "rad/s": ("deg/s", 180 / math.pi),
    "Pa": ("bar", 1e-5),
    "m^3/s": ("L/min", 6e4),
    "m/s^2": ("g", 1 / G),
    "N": ("kN", 1e-3),
    "Nm": ("Nm", 1.0),
    "J": ("kJ", 1e-3),
    "1": ("-", 1.0),
}
BY_NAME_AND_UNIT = {
    ("speed", "m/s"): ("km/h", 3.6),
    ("speed", "rad/s"): ("rpm", 30 / math.pi),
    ("heave", "m"): ("mm", 1e3),
    ("travel", "m"): ("mm", 1e3),
}

QUANTITIES = {
    "deg": "angle",
    "deg/s": "rate",
    "bar": "pressure",
    "L/min": "flow",
    "g": "acceleration",
    "kN": "force",
    "Nm": "torque",
    "W": "power",
    "kJ": "energy",
    "m": "position",
    "mm": "travel",
    "m/s": "velocity",
    "A": "current",
    "V": "voltage",
    "V*s": "flux",
    "rpm": "speed",
    "-": "fraction",
}

# half of the least range of an axis, so that noise about zero looks like what it is
LEAST = {
    "deg": 1.0,
    "deg/s": 5.0,
    "bar": 10.0,
    "g": 1.0,
    "kN": 0.5,
    "Nm": 50.0,
    "W": 50.0,
    "kJ": 0.1,
    "mm": 5.0,
    "km/h": 5.0,
    "rpm": 100.0,
    "A": 5.0,
    "V": 1.0,
}
MARGIN = 0.06
FEW_LABELS = 0.5  # of a decade: a half range above it leaves no room for the labels of a tenth of the decade


def unit_and_factor(channel: Channel) -> tuple[str, float]:
    """The unit a channel is shown in and its factor from SI."""
    last = channel.name.rsplit(".", 1)[-1]
    special = BY_NAME_AND_UNIT.get((last, channel.unit))
    return special or BY_UNIT.get(channel.unit, (channel.unit, 1.0))


def quantity_of(channel: Channel) -> str:
    """The name of what a channel measures: "angle", "power"; for an unlisted unit the unit, as a word."""
    unit = unit_and_factor(channel)[0]
    return QUANTITIES.get(unit, unit.replace("/", "_per_"))


def series_name(channel: Channel) -> str:
    """`front.bar.angle` as "front bar angle [deg]", `body.roll` as "roll [deg]"."""
    name = channel.name.removeprefix("body.").replace(".", " ").replace("_", " ")
    return f"{name} [{unit_and_factor(channel)[0]}]"


def axis_range(low: float, high: float, unit: str) -> tuple[float, float]:
    """The range of a plot whose series lie between `low` and `high`, both in `unit`: with a margin, and never tiny.

    Rerun labels an axis in powers of ten only; a half range of 7 would show nothing but 0, so it is widened to 10.
    """
    if not (math.isfinite(low) and math.isfinite(high)):
        return (-1.0, 1.0)
    middle = (low + high) / 2
    half = max((high - low) / 2, LEAST.get(unit, 0.0), 1e-9 + 1e-3 * abs(middle))
    decade = 10.0 ** math.ceil(math.log10(half))
    if half > FEW_LABELS * decade:
        half = decade
    return (middle - half * (1 + MARGIN), middle + half * (1 + MARGIN))


def rgba32(color: np.ndarray | tuple, alpha: int = 255) -> int:
    """A color of 0 to 255 as the integer 0xRRGGBBAA."""
    red, green, blue = (int(c) for c in color[:3])
    return red << 24 | green << 16 | blue << 8 | alpha
