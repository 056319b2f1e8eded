"""Stand-in of the electric machine, its inverter and the supply, until the components are there."""

import math

from ars_mujoco.hydraulics.vane_motor import rounded_sign
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import Parameters, number, quantity

DRIVEN, OPEN, SHORTED = 0.0, 1.0, 2.0


class Machine(Parameters):
    torque_constant: float = number()
    resistance: float = number()
    inductance: float = number()
    pole_pairs: float = number()
    current_limit: float = number()
    current_bandwidth: float = number()
    nominal_voltage: float = number()
    iron: float = number()
    windage: float = number()
    friction: float = number()
    inverter_power: float = number()
    inverter_share: float = number()


@kernel
def limit(m, speed, voltage):
    knee = 2500 * math.pi / 30 * voltage / m.nominal_voltage
    top = m.current_limit * m.torque_constant
    return max(min(top, top - 0.6 * (abs(speed) - knee) / (500 * math.pi / 30)), 0.0)


@kernel
def current_rate(m, asked, current, speed, phases):
    if phases == DRIVEN:
        return m.current_bandwidth * (asked / m.torque_constant - current)
    if phases == OPEN:
        return -m.current_bandwidth * current
    we, a = m.pole_pairs * speed, m.resistance / m.inductance
    psi = m.torque_constant / (1.5 * m.pole_pairs)
    settled = -psi * we * m.resistance / (m.resistance**2 + (we * m.inductance) ** 2)
    return a * (settled - current)


@kernel
def losses(m, current, speed, phases):
    """copper, iron, inverter, friction torque."""
    size = math.sqrt(current * current + 1e-6)
    copper = 1.5 * m.resistance * current * current
    if phases == SHORTED:
        copper = -m.torque_constant * current * speed
    inverter = m.inverter_power + m.inverter_share * 0.5 * m.nominal_voltage * size if phases == DRIVEN else 0.0
    return copper, m.iron * speed * speed + m.windage * speed * rounded_sign(speed), inverter, m.friction * rounded_sign(speed / 5.0)


class Supply(Parameters):
    power_limit: float = number()
    capacitance: float = number()
    voltage: float = number()
    gain: float = number()
    least_voltage: float = number()


@kernel
def supply_rates(s, voltage, load):
    """U', drawn, lost, delivered."""
    drawn = min(max(s.gain * (s.voltage - voltage), 0.0), s.power_limit)
    return ((drawn - load) / (s.capacitance * voltage),), (drawn, 0.0, load, abs(drawn) + abs(load))


@kernel
def shed(s, voltage):
    return min(max((voltage - s.least_voltage + 2.0) / 2.0, 0.0), 1.0)


from ars_mujoco.schema.channels import channel, counted, delivered, drawn, lost, stored  # noqa: E402


class SupplyState(Parameters):
    voltage: float = channel("V", "of the store", scale=1e-3)


class SupplyEnergy(Parameters):
    converter: float = drawn("drawn from the converter")
    line: float = lost("lost in the line")
    delivered: float = delivered("handed to both axles")
    throughput: float = counted("integral of |converter| + |delivered|")


class SupplyEnergyOutput(SupplyEnergy):
    store: float = stored("in the store")


class SupplyOutput(Parameters):
    voltage: float = channel("V", "of the store")
    power: float = channel("W", "handed to both axles")
    energy: SupplyEnergyOutput
