"""The layout a recording opens with: the chase view on the left, plots in tabs on the right, one time for all."""

import rerun.blueprint as rrb

from ars_mujoco.recording.rerun.batch import TIMELINE
from ars_mujoco.recording.rerun.car import BODY, Car
from ars_mujoco.recording.rerun.run import RerunRun
from ars_mujoco.recording.rerun.signals import plot_range
from ars_mujoco.recording.rerun.solids import KINDS
from ars_mujoco.schema.plots import Plot, recorded

NOTHING = (float("inf"), float("-inf"))  # the extremes of a run without samples
BACKGROUND = (24, 27, 32)
# behind the car and a little above: the body's roll against the level; and three quarters from the front for small rigs
CHASE_EYE, CHASE_TARGET = (-5.6, 0.0, 1.7), (0.0, 0.0, 0.85)
NEAR_EYE, NEAR_TARGET = (1.1, 0.9, 0.7), (0.0, 0.0, 0.1)
MOTOR_EYE = (-1.05, 0.65, 0.6)  # m from the motor


def layout(runs: list[RerunRun]) -> rrb.Blueprint:
    """The blueprint of a file with `runs`, the first of them drawn solid, the others its ghosts."""
    return rrb.Blueprint(
        rrb.Horizontal(_left(runs), rrb.Tabs(*_plot_tabs(runs)), column_shares=[5, 6]),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(state="collapsed", timeline=TIMELINE),
        auto_views=False,
        auto_layout=False,
    )


def _left(runs: list[RerunRun]) -> rrb.Tabs:
    roots = [run.root for run in runs]
    pages = [rrb.TextDocumentView(origin=f"{root}/meta/run", name=_named("run", root)) for root in roots]
    events = rrb.TextLogView(contents=[f"{root}/events" for root in roots], name="events")
    return rrb.Tabs(*_views(runs), *pages, events)


def _views(runs: list[RerunRun]) -> list[rrb.Spatial3DView]:
    car = runs[0].car
    everything = [f"{run.root}/world/**" for run in runs]
    if not car.follows:
        return [_view("view", car.chase, everything, NEAR_EYE, NEAR_TARGET)]
    chase = _view("chase", car.chase, everything, CHASE_EYE, CHASE_TARGET)
    return [chase, *(_motor_view(car, axle) for axle in car.motors)]


def _motor_view(car: Car, axle: str) -> rrb.Spatial3DView:
    """A bar from near by, fixed to the body, without the body's own solids before it."""
    center = car.motors[axle]
    shell = [f"- {car.car}/{BODY}/{kind}" for kind in KINDS]
    contents = [f"+ {car.car}/**", *shell]
    return _view(f"{axle} bar", f"{car.car}/{BODY}", contents, tuple(center + MOTOR_EYE), tuple(center))


def _view(name: str, origin: str, contents: list[str], eye: tuple, target: tuple) -> rrb.Spatial3DView:
    return rrb.Spatial3DView(
        name=name,
        origin=origin,
        contents=contents,
        background=BACKGROUND,
        line_grid=False,
        eye_controls=rrb.EyeControls3D(position=eye, look_target=target, eye_up=(0, 0, 1)),
    )


def _plot_tabs(runs: list[RerunRun]) -> list[rrb.Vertical]:
    """The plots in which some signal is not 0 all the time; a reduced circuit, say, has no valves to show."""
    channels = {name for run in runs for name in run.signals.channels}
    found = recorded(runs[0].signals.tabs, channels)  # of a comparison each run has the tabs of all
    tabs = {tab.name: [plot for plot in tab.plots if _moves(runs, plot)] for tab in found}
    return [rrb.Vertical(*(_plot(runs, plot) for plot in plots), name=name) for name, plots in tabs.items() if plots]


def _moves(runs: list[RerunRun], plot: Plot) -> bool:
    return any(run.signals.extremes(plot) not in ((0.0, 0.0), NOTHING) for run in runs)


def _plot(runs: list[RerunRun], plot: Plot) -> rrb.TimeSeriesView:
    signals = [run.signals for run in runs]
    return rrb.TimeSeriesView(
        name=plot.name,
        contents=[path for run in reversed(signals) for path in run.paths(plot)],
        axis_x=rrb.TimeAxis(link="LinkToGlobal"),
        axis_y=rrb.ScalarAxis(range=plot_range(signals, plot), zoom_lock=True),
    )


def _named(text: str, root: str) -> str:
    return f"{text} {root.strip('/').replace('_', ' ')}".strip()
