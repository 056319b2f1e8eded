"""Electric supply: a converter of limited power, a store that sags, a line; the books close at every instant."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled
from scipy.integrate import solve_ivp

from ars_mujoco.machines.electric_supply import ElectricSupply, budget, store_energy, supply_rates, terminal_voltage

SUPPLY = filled(
    ElectricSupply(
        voltage="48 V", least_voltage="36 V", capacitance="5 F", store_power="5 kW", line_resistance="10 mohm",
        converter_power="1.2 kW", converter_lag="1 ms", converter_gain="200 W/V", efficiency=0.95,
        controller_power="10 W",
    )
)  # fmt: skip
stores, loads = st.floats(36.0, 52.0), st.floats(-3000.0, 6000.0)


@given(store=stores, converter=st.floats(0.0, 1200.0), load=loads)
def test_what_is_drawn_is_lost_stored_or_delivered(store, converter, load):
    store_rate, _, (drawn, lost, line, controllers, delivered) = supply_rates(SUPPLY, store, converter, load)
    charging = SUPPLY.capacitance * store * store_rate
    assert drawn == pytest.approx(lost + line + controllers + delivered + charging, abs=1e-8)
    assert min(lost, line, controllers) >= 0.0


@given(store=stores, load=loads)
def test_the_loads_get_their_power_through_the_line(store, load):
    voltage = terminal_voltage(SUPPLY, store, load)
    assert (store - voltage) / SUPPLY.line_resistance * voltage == pytest.approx(load, rel=1e-6, abs=1e-6)


def test_the_store_of_5_F_holds_2_5_kJ_over_its_least_voltage():
    assert store_energy(SUPPLY, 48.0) - store_energy(SUPPLY, 36.0) == pytest.approx(2520.0)


def test_near_its_least_voltage_the_loads_get_what_the_converter_gives():
    assert budget(SUPPLY, 48.0) == pytest.approx(6190.0 - 0.01 * (6190.0 / 48.0) ** 2)
    assert budget(SUPPLY, 37.0) == pytest.approx(3690.0 - 0.01 * (3690.0 / 37.0) ** 2)
    assert budget(SUPPLY, 36.0) == pytest.approx(1190.0 - 0.01 * (1190.0 / 36.0) ** 2)


def test_a_store_that_loads_emptied_stands_at_its_least_voltage_while_they_ask_for_more():
    def rates(_, state):
        return supply_rates(SUPPLY, state[0], state[1], min(4000.0, budget(SUPPLY, state[0])))[:2]

    end = solve_ivp(rates, (0.0, 10.0), (48.0, 0.0), "Radau", rtol=1e-8).y[:, -1]
    assert end[0] == pytest.approx(36.0, abs=1e-3)
    assert end[1] == pytest.approx(1200.0)


def test_a_load_that_ends_is_made_up_for_and_the_store_is_full_again():
    end = solve_ivp(lambda _, s: supply_rates(SUPPLY, s[0], s[1], 0.0)[:2], (0, 60), (40.0, 0.0), "Radau").y[:, -1]
    assert end[0] == pytest.approx(48.0, abs=1e-3)
