"""Plots as data: how the tabs of rig, bars and actuator come together, and what a run shows of them."""

from ars_mujoco.schema.plots import Plot, Tab, axles, merged, recorded

BAR = (Tab("front axle", (Plot("bar angle", ("bar.command", "bar.angle")), Plot("bar torque", ("bar.torque",)))),)
MOTOR = (
    Tab("front axle", (Plot("motor current", ("motor.current",)), Plot("bar torque", ("bar.torque", "motor.torque")))),
    Tab("supply", (Plot("voltage", ("supply.voltage",)),)),
)


def test_tabs_and_plots_of_one_name_are_one_where_they_first_appear():
    assert merged(BAR, MOTOR) == (
        Tab(
            "front axle",
            (
                Plot("bar angle", ("bar.command", "bar.angle")),
                Plot("bar torque", ("bar.torque", "motor.torque")),
                Plot("motor current", ("motor.current",)),
            ),
        ),
        MOTOR[1],
    )


def test_what_is_merged_with_itself_stays_as_it_is():
    assert merged(MOTOR, MOTOR) == MOTOR
    assert merged() == ()


def test_what_a_run_does_not_record_has_no_plot_and_no_tab():
    assert recorded(merged(BAR, MOTOR), ["bar.angle", "motor.current", "else"]) == (
        Tab("front axle", (Plot("bar angle", ("bar.angle",)), Plot("motor current", ("motor.current",)))),
    )


def test_a_signal_of_both_axles_is_named_once():
    assert axles("a.x", "a.y") == ("front.a.x", "rear.a.x", "front.a.y", "rear.a.y")
