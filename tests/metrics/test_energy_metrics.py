"""Energies by their roles: made-up books whose answers are known by hand, for actuators that nobody has named."""

import numpy as np
import pytest
from made_up import TIME, recording, values

from ars_mujoco.recording.recording import Recording

GROWN = TIME / TIME[-1]  # from 0 to 1
THERE_AND_BACK = np.interp(TIME, [0.0, 4.0, 10.0], [0.0, 1.0, 0.8])


def books(**blocks) -> Recording:
    """A run of blocks, each a dict {name: (role, energy J over time)}, on top of what was there before."""
    energies = {f"{block}.energy.{name}": each for block, found in blocks.items() for name, each in found.items()}
    signals = {name.replace(".", "__"): 7.0 + energy for name, (_, energy) in energies.items()}
    return recording(TIME, {name: role for name, (role, _) in energies.items()}, **signals)


def axle(astray: float = 0.0, scale: float = 1.0) -> dict:
    """An axle that draws 1000 J, of which it gives 200 J back, does 300 J of work, and misses `astray` J of them."""
    return {
        "electrical": ("drawn", 1000.0 * scale * THERE_AND_BACK),
        "copper": ("lost", (350.0 * scale - astray) * GROWN),
        "friction": ("lost", 50.0 * scale * GROWN),
        "bar": ("stored", 100.0 * scale * GROWN),
        "work": ("done", 300.0 * scale * GROWN),
        "of_the_rotor": ("counted", 1e6 * GROWN),
    }


def supply(astray: float = 0.0) -> dict:
    """A supply that draws 2000 J for the 1600 J that two axles net; a store takes what is left of its losses."""
    return {
        "net": ("drawn", 2000.0 * GROWN),
        "converter": ("lost", (150.0 - astray) * GROWN),
        "store": ("stored", 2000.0 * GROWN - 150.0 * GROWN - 2000.0 * THERE_AND_BACK),
        "axles": ("delivered", 2000.0 * THERE_AND_BACK),
    }


def test_what_is_drawn_and_lost_is_summed_over_the_axles():
    measured = values(books(front=axle(), rear=axle()))
    assert measured["drawn_energy"].value == pytest.approx(1600)
    assert measured["lost_energy"].value == pytest.approx(800)
    assert measured["recovered_energy"].value == pytest.approx(400)
    assert measured["peak_drawn_power"].value == pytest.approx(500)


def test_what_a_supply_hands_on_is_drawn_from_outside_once():
    measured = values(books(front=axle(), rear=axle(), supply=supply()))
    assert measured["drawn_energy"].value == pytest.approx(2000)
    assert measured["lost_energy"].value == pytest.approx(950)
    assert measured["peak_drawn_power"].value == pytest.approx(200)


def test_what_comes_back_is_counted_where_the_axles_give_it_back():
    measured = values(books(front=axle(), rear=axle(), supply=supply()))
    assert measured["recovered_energy"].value == pytest.approx(400)


def test_of_two_sources_one_that_gives_is_not_hidden_by_one_that_takes():
    pumps = {"shaft": ("drawn", -10.0 * GROWN), "charge": ("drawn", 500.0 * GROWN)}
    assert values(books(front=pumps))["recovered_energy"].value == pytest.approx(10)


def test_each_block_closes_on_its_own():
    measured = values(books(front=axle(), rear=axle(), supply=supply()))
    assert measured["energy_audit_error"].value == pytest.approx(0, abs=1e-12)


def test_the_audit_is_relative_to_what_crossed_the_borders():
    crossed = 1000 + 200 + 300  # drawn, given back, done
    assert values(books(front=axle(astray=3.0)))["energy_audit_error"].value == pytest.approx(3 / crossed)
    crossed += 2000 + 2000 + 400  # the supply's, drawn, delivered and taken back
    run = books(front=axle(), supply=supply(astray=3.0))
    assert values(run)["energy_audit_error"].value == pytest.approx(3 / crossed)


def test_what_one_block_lost_another_cannot_cover():
    run = books(front=axle(astray=3.0), rear=axle(astray=-3.0))
    assert values(run)["energy_audit_error"].value == pytest.approx(6 / 3000)


def test_energies_at_any_depth_of_a_block_are_in_its_books():
    nested = {f"front.{name}": each for name, each in axle().items()}
    energies = {
        name.replace("front.", "front.motor." if "copper" in name else "front."): e for name, e in nested.items()
    }
    signals = {name.replace(".", "__"): energy for name, (_, energy) in energies.items()}
    run = recording(TIME, {name: role for name, (role, _) in energies.items()}, **signals)
    assert values(run)["energy_audit_error"].value == pytest.approx(0, abs=1e-12)


def test_the_audit_is_absolute_where_less_than_a_joule_crossed():
    measured = values(books(front=axle(astray=0.01, scale=1e-4)))["energy_audit_error"]
    assert measured.value == pytest.approx(0.01)
    assert "absolute" in measured.note


def test_a_passive_bar_draws_nothing_and_is_audited_by_its_work():
    bar = {"bar": ("stored", -20.0 * GROWN), "work": ("done", 20.0 * GROWN)}
    measured = values(books(front=bar))
    assert [measured[name].value for name in ("drawn_energy", "recovered_energy", "lost_energy")] == [0, 0, 0]
    assert measured["peak_drawn_power"].value == 0
    assert measured["energy_audit_error"].value == pytest.approx(0, abs=1e-12)


def test_a_car_in_which_nothing_happened_has_no_audit():
    measured = values(books(front=axle(scale=0.0)))
    assert measured["drawn_energy"].value == 0.0
    assert measured["energy_audit_error"].note == "nothing was drawn and no work was done"


def test_energy_from_nowhere_is_told_although_nothing_crossed():
    measured = values(books(front={"bar": ("stored", 5.0 * GROWN)}))["energy_audit_error"]
    assert measured.value == pytest.approx(5.0)


def test_a_run_without_energies_says_so():
    measured = values(recording(body__roll=0.0))
    for name in ("drawn_energy", "recovered_energy", "lost_energy", "peak_drawn_power", "energy_audit_error"):
        assert measured[name].note == "the run records no energies"


def test_a_short_peak_counts_as_a_mean():
    spike = np.where(TIME >= 5.0, 3.0, 0.0)  # J in a millisecond
    assert values(books(front={"net": ("drawn", spike)}))["peak_drawn_power"].value == pytest.approx(300)


# ---- pumps


def test_pumps_tell_the_energy_of_shaft_and_charge_supply_apart():
    pump = {"energy__shaft": 1000.0 * GROWN, "energy__charge": 50.0 * GROWN}
    pump |= {"pump__shaft_power": 100.0 * np.sin(2 * np.pi * TIME)}
    run = recording(**{f"{axle}__{name}": each for axle in ("front", "rear") for name, each in pump.items()})
    measured = values(run)
    assert measured["shaft_energy"].value == pytest.approx(2000)
    assert measured["charge_energy"].value == pytest.approx(100)
    assert measured["peak_shaft_power"].value == pytest.approx(200)


def test_a_run_without_pumps_says_so():
    measured = values(books(front=axle()))
    for name in ("shaft_energy", "charge_energy", "peak_shaft_power", "loss_extrapolation"):
        assert measured[name].note == "the run records no pump"
