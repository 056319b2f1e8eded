"""Channels: declared once, with unit, meaning and, where energies, their role."""

from ars_mujoco.schema.channels import (
    ROLES,
    Channel,
    Scale,
    channel,
    channels,
    counted,
    delivered,
    done,
    drawn,
    lost,
    stored,
)
from ars_mujoco.schema.parameters import Parameters, record_dtype


class Motor(Parameters):
    rate: float = channel("rad/s", "its rate", scale=0.1)
    torque: float = channel("Nm", "its torque")


class Energy(Parameters):
    electrical: float = drawn("from the supply")
    copper: float = lost("in the windings")
    inertia: float = stored("in the rotor")
    work: float = done("on the car")
    bus: float = delivered("to the axles")
    motor: float = counted("on the bar")


class Axle(Parameters):
    motor: Motor
    energy: Energy


def test_nested_blocks_are_dotted_names_in_the_order_of_the_record():
    found = channels(Axle, "front.")
    assert found[0] == Channel("front.motor.rate", "rad/s", "its rate")
    assert [each.name.rsplit(".", 1)[1] for each in found] == [
        *record_dtype(Motor).names,
        *record_dtype(Energy).names,
    ]


def test_energies_are_in_joule_and_carry_their_role():
    found = channels(Energy)
    assert {each.unit for each in found} == {"J"}
    assert [each.role for each in found] == ["drawn", "lost", "stored", "done", "delivered", "counted"]
    assert {each.role for each in found} == set(ROLES)


def test_a_state_keeps_the_size_of_a_small_change():
    assert Scale(0.1) in Motor.model_fields["rate"].metadata
    assert not any(isinstance(item, Scale) for item in Motor.model_fields["torque"].metadata)
