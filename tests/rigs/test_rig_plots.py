"""What rigs and actuators show and tell: every channel they name exists, and plots have one unit."""

import pytest

from ars_mujoco.actuators import bar_plots
from ars_mujoco.actuators.pump_controlled import plots as pump_plots
from ars_mujoco.recording.rerun.display import unit_and_factor
from ars_mujoco.rigs import plots as rig_plots
from ars_mujoco.schema.plots import merged
from ars_mujoco.studies.channels import recorded_channels

CHANNELS = {channel.name: channel for _, channels in recorded_channels() for channel in channels}
TABS = merged(
    bar_plots.PLOTS,
    pump_plots.PLOTS,
    *(each for rig in (rig_plots.SEDAN, rig_plots.ROLL_PLANE, rig_plots.BENCH) for each in (rig.before, rig.after)),
)


@pytest.mark.parametrize("tab", TABS, ids=lambda tab: tab.name)
def test_a_plot_shows_what_can_be_recorded_in_one_unit(tab):
    for plot in tab.plots:
        assert len({unit_and_factor(CHANNELS[name])[0] for name in plot.channels}) == 1, plot.name


def test_a_channel_stands_in_one_plot():
    named = [name for tab in TABS for plot in tab.plots for name in plot.channels]
    assert len(named) == len(set(named))


def test_events_are_of_what_can_be_recorded():
    assert {each.channel for each in (*rig_plots.SEDAN_EVENTS, *pump_plots.EVENTS)} <= set(CHANNELS)


def test_the_stabilizers_stand_between_the_tabs_of_their_rig():
    names = [tab.name for tab in rig_plots.SEDAN.around(bar_plots.PLOTS, pump_plots.PLOTS)]
    assert names == "body/front axle/rear axle/circuit/pump/energy/drive/tires/driving".split("/")
