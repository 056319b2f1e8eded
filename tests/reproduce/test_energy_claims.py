"""Power and energy on the S-curve, Figs. 15 to 18, and beside valve-controlled systems."""

import numpy as np
import pytest
from verdicts import ours, verdict

from ars_mujoco.reproduce.valve_systems import SYSTEMS, demand_of, shaft_energy

ONLY_LOAD = "actuator.front.pump.torque_loss.coefficients={k_001: 0.001, k_101: 0.001}"


def test_the_lost_figure_cannot_be_checked(claims):
    reversals, (least, most), change = ours(claims["drive_cycle"])
    assert (reversals, change) == (9, 0.0)
    assert (least, most) == pytest.approx((-10, 12), abs=1e-3)
    assert verdict(claims["drive_cycle"]).startswith("not checkable")


@pytest.mark.parametrize("name", ["motor_power", "holding_power", "shaft_and_motor"])
def test_what_figs_16_and_17_show_is_reproduced(claims, name):
    assert verdict(claims[name]) == "reproduced"


def test_the_motor_s_power_is_the_bar_s_torque_times_the_rate(claims):
    by_change, by_product = ours(claims["power_and_change"])
    assert by_change < 0.9 < 0.999 < by_product
    assert verdict(claims["power_and_change"]).startswith("holds only")


def test_the_reversal_gives_back_before_it_winds_up_again(claims, evidence):
    given, taken, _ = ours(claims["bar_drives_motor"])
    wound = 0.5 * evidence.c * np.radians([10.0, 8.0]) ** 2
    assert given == pytest.approx(wound[0] + wound[0] - wound[1], rel=0.02)
    assert taken == pytest.approx(wound[0], rel=0.02)
    assert verdict(claims["bar_drives_motor"]) == "holds only while the bar unwinds"


def test_under_one_percent_is_recovered_at_the_shaft(claims):
    recovered, share, *_ = ours(claims["recovery"])
    assert recovered > 0.0
    assert share < 1.0
    assert verdict(claims["recovery"]).startswith("holds only for 0.")


def test_a_pump_without_drag_recovers_much_and_takes_no_power_without_load(with_settings):
    assert verdict(with_settings("recovery", ONLY_LOAD)) == "reproduced"
    assert verdict(with_settings("load_dependent", ONLY_LOAD)) == "reproduced"


def test_the_losses_follow_the_pressure(claims):
    flow, pressure = ours(claims["loss_and_flow"])
    assert flow < 0.2 < 0.9 < pressure
    assert verdict(claims["loss_and_flow"]).startswith("does not follow")


def test_the_full_circuit_throttles_next_to_nothing(claims):
    lost, share = ours(claims["throttling"])
    assert lost > 0.0
    assert share < 1.0
    assert verdict(claims["throttling"]) == "reproduced"


def test_half_of_the_shaft_s_work_is_drag(claims):
    assert ours(claims["load_dependent"])[1] == pytest.approx(49, abs=1)
    assert verdict(claims["load_dependent"]).startswith("does not follow")


def test_throttling_is_saved_but_the_charge_supply_outweighs_load_sensing(claims):
    bare, charged = np.reshape(ours(claims["against_valves"]), (2, 3))
    assert np.all(bare < 1.0)
    assert np.all(bare[:-1] < bare[1:])
    assert charged[2] > 1.0
    assert verdict(claims["against_valves"]) == "holds only against open centre and constant pressure"


@pytest.mark.parametrize("system", SYSTEMS)
def test_a_valve_system_s_shaft_pays_for_all_that_its_motor_takes(evidence, system):
    demand = demand_of(evidence, evidence.s_curve)
    taken = np.trapezoid(demand.flow * demand.pressure, evidence.s_curve.time)
    assert shaft_energy(evidence, evidence.s_curve, system) > taken > 0.0
