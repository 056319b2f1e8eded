"""The full circuit: two lines with the mass of their oil, two chambers, charge pump, check, relief and other valves.

          ┌──── A: node 0 ═ line ═ ... ═ node N ──[fail-safe]── chamber A ┐
    pump ─┤  check, relief │                                  bypass │    ├─ vane motor ─> bar
          └──── B: node 0 ═ line ═ ... ═ node N ──[fail-safe]── chamber B ┘
                     gallery <── charge pump, charge relief

Pressures are absolute. The oil's air makes it softer the lower the pressure, without bound, so that no pressure falls
to zero: a line that is drawn empty cavitates. A line is N lumps of inertance between N + 1 volumes (paper eqs. 30 to
39); the chambers vary with the motor's angle (eq. 31). Side A drives the motor to positive phi.
"""

import numpy as np
from pydantic import ValidationInfo, field_validator

from ars_mujoco.actuators.pump_controlled.third_order_circuit import Circuit
from ars_mujoco.hydraulics.bypass_valve import BypassValve, bypass_flow
from ars_mujoco.hydraulics.charge_pump import ChargePump, charge_flow, charge_power, charge_relief_flow
from ars_mujoco.hydraulics.check_valve import CheckValve, check_flow
from ars_mujoco.hydraulics.fail_safe_valve import FailSafeValve, fail_safe_drop, is_shut
from ars_mujoco.hydraulics.metering_edge import MeteringEdge
from ars_mujoco.hydraulics.oil import Oil, compressibility, energy_density
from ars_mujoco.hydraulics.pipe import MOST_LUMPS, Pipe, inertance, pressure_drop, volume
from ars_mujoco.hydraulics.pump import flow_loss, ideal_flow, torque_loss
from ars_mujoco.hydraulics.relief_valve import one_way_relief
from ars_mujoco.hydraulics.valve_opening import opening_rate
from ars_mujoco.hydraulics.vane_motor import friction_torque, stop_torque
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import quantity

SHUT_TIME = 6e-5  # s, in which a shut fail-safe valve stops what still flows

# where the states lie: node pressures and flows of both sides, then the rest
A, B = 0, MOST_LUMPS + 1
FLOW_A, FLOW_B = 2 * (MOST_LUMPS + 1), 3 * MOST_LUMPS + 2
GALLERY = 4 * MOST_LUMPS + 2
ANGLE, RATE, BYPASS, FAIL_SAFE = GALLERY + 1, GALLERY + 2, GALLERY + 3, GALLERY + 4
STATES = FAIL_SAFE + 1

# powers (W) behind the energies, and the bar torque (Nm)
SHAFT, TORQUE_LOSS, PUMP_LEAKAGE, MOTOR_LEAKAGE, RELIEF, FRICTION, CAPACITANCE, MOTOR, BAR_TORQUE = range(9)
LINE, CHECK, BYPASS_LOSS, TANK_LEAKAGE, CHARGE, CHARGE_LOSS = range(9, 15)
POWERS = 15


class FullCircuit(Circuit):
    """Components of one axle's full circuit; pressures are absolute."""

    oil: Oil
    metering_edge: MeteringEdge  # gives the control supply and the tank, also where pump control is of third order
    pipe: Pipe
    charge_pump: ChargePump
    check_valve: CheckValve
    bypass_valve: BypassValve
    fail_safe_valve: FailSafeValve
    tank_leakage: float = quantity("m^3/s/Pa", ge=0)  # of one side to the tank

    @field_validator("check_valve")
    @classmethod
    def _charges_the_lines(cls, check_valve: CheckValve, info: ValidationInfo) -> CheckValve:
        edge, charge = info.data.get("metering_edge"), info.data.get("charge_pump")
        opening = check_valve.opening_pressure
        if edge and charge and charge.relief_pressure <= edge.return_pressure + opening:
            raise ValueError(
                f"an opening_pressure of {1e-5 * opening:.4g} bar leaves the lines without a charge; allowed: less "
                f"than charge_pump.relief_pressure ({1e-5 * charge.relief_pressure:.4g} bar) less "
                f"metering_edge.return_pressure ({1e-5 * edge.return_pressure:.4g} bar)"
            )
        return check_valve


@kernel
def full_rates(circuit, detail, bar_stiffness, x, dx, power, stroke, twist, bypass_command, fail_safe_command) -> None:
    """Derivatives `dx` of the STATES `x` and the POWERS `power`, at a pump stroke and a twist (rad) of the bar.

    The valves' commands are openings, 0 shut and 1 open.
    """
    lumps = int(detail.pipe.lumps)
    tank, gallery = circuit.metering_edge.return_pressure, x[GALLERY]
    dx[:] = 0.0  # of the nodes that a line of fewer lumps does not have: the record is shared by lines of other lumps
    dx[BYPASS] = opening_rate(detail.bypass_valve, x[BYPASS], bypass_command)
    dx[FAIL_SAFE] = opening_rate(detail.fail_safe_valve, x[FAIL_SAFE], fail_safe_command)
    power[LINE] = 0.0
    _accelerate(detail, x, dx, power, lumps, A, FLOW_A)
    _accelerate(detail, x, dx, power, lumps, B, FLOW_B)
    pump_flow = _deliver(circuit, power, stroke, x[A] - x[B])
    a_fed, a_lost = _feed(circuit, detail, power, x[A], gallery, tank)
    b_fed, b_lost = _feed(circuit, detail, power, x[B], gallery, tank)
    motor_flow = _turn(circuit, detail, bar_stiffness, x, dx, power, lumps, twist)
    chamber = circuit.motor.displacement * circuit.motor.stop_angle
    swept = circuit.motor.displacement * x[ANGLE]
    _compress(detail, x, dx, lumps, A, FLOW_A, pump_flow + a_fed - a_lost, motor_flow, chamber + swept)
    _compress(detail, x, dx, lumps, B, FLOW_B, b_fed - b_lost - pump_flow, -motor_flow, chamber - swept)
    _charge(circuit, detail, x, dx, power, a_fed + b_fed, tank)


@kernel
def stored_energies(circuit, detail, bar_stiffness, x, twist):
    """Energy (J) now stored in (oil and walls, bar torsion, motor inertia, mechanical stop, moving oil)."""
    pipe, fluid, motor, tank = detail.pipe, detail.fluid, circuit.motor, circuit.metering_edge.return_pressure
    lumps, moving = int(pipe.lumps), 0.0
    oil = detail.charge_pump.gallery_volume * energy_density(fluid, x[GALLERY], tank)
    for side, flow in ((A, FLOW_A), (B, FLOW_B)):
        for j in range(lumps + 1):
            over = x[side + j] - tank
            piece = _node_volume(pipe, lumps, j)
            oil += piece * (energy_density(fluid, x[side + j], tank) + 0.5 * pipe.wall_compliance * over * over)
        for j in range(lumps):
            moving += 0.5 * inertance(pipe, fluid) / lumps * x[flow + j] ** 2
        turned = motor.displacement * (x[ANGLE] if side == A else -x[ANGLE])
        chamber = motor.displacement * motor.stop_angle + turned
        oil += chamber * energy_density(fluid, x[side + lumps], tank)
    beyond = max(abs(x[ANGLE]) - motor.stop_angle, 0.0)
    return (
        oil,
        0.5 * bar_stiffness * (x[ANGLE] - twist) ** 2,
        0.5 * motor.inertia * x[RATE] ** 2,
        0.5 * motor.stop_stiffness * beyond**2,
        moving,
    )


def rest(circuit, detail, x: np.ndarray) -> None:
    """Fill the STATES `x` with those of a charged circuit at rest: what leaks to the tank comes through the checks."""
    charge, check, tank = detail.charge_pump, detail.check_valve, circuit.metering_edge.return_pressure
    leak = detail.tank_leakage
    supplied = charge_flow(charge, circuit.pump.speed)
    # check.conductance (gallery - opening - node) = leak (node - tank), twice, is what the charge relief does not take
    through = check.conductance * leak / (check.conductance + leak)
    relief, start = charge.relief_conductance, charge.relief_pressure
    gallery = (supplied + relief * start + 2.0 * through * (check.opening_pressure + tank)) / (relief + 2.0 * through)
    if gallery < start:  # the leakage takes all of it, and the charge relief stays shut
        gallery = supplied / (2.0 * through) + check.opening_pressure + tank
    node = gallery - check.opening_pressure - through / check.conductance * (gallery - check.opening_pressure - tank)
    x[:] = 0.0
    lumps = int(detail.pipe.lumps)
    x[A : A + lumps + 1] = x[B : B + lumps + 1] = node
    x[GALLERY], x[FAIL_SAFE] = gallery, 1.0


@kernel
def _node_volume(pipe, lumps, j) -> float:
    # m^3 of the line at node j; the nodes at its ends have half a lump each
    share = 0.5 if j == 0 or j == lumps else 1.0
    return share / lumps * volume(pipe)


@kernel
def _accelerate(detail, x, dx, power, lumps, side, flow):
    # the oil's mass in each lump (eqs. 33 to 39); the fail-safe valve lies in the last
    lump = inertance(detail.pipe, detail.fluid) / lumps
    for j in range(lumps):
        q, difference = x[flow + j], x[side + j] - x[side + j + 1]
        drop = pressure_drop(detail.pipe, detail.fluid, q) / lumps
        if j == lumps - 1 and is_shut(detail.fail_safe_valve, x[FAIL_SAFE]):
            dx[flow + j] = -1.0 / SHUT_TIME * q
        else:
            if j == lumps - 1:
                drop += fail_safe_drop(detail.fail_safe_valve, x[FAIL_SAFE], q)
            dx[flow + j] = 1.0 / lump * (difference - drop)
        power[LINE] += q * (difference - lump * dx[flow + j])


@kernel
def _deliver(circuit, power, stroke, pressure):
    # flow of the pump into A, and what its shaft pays
    pump = circuit.pump
    ideal, loss = ideal_flow(pump, stroke), flow_loss(pump, stroke, pressure)
    torque = torque_loss(pump, stroke, pressure) * pump.speed
    power[SHAFT], power[TORQUE_LOSS], power[PUMP_LEAKAGE] = ideal * pressure + torque, torque, loss * pressure
    power[CHECK] = power[RELIEF] = power[TANK_LEAKAGE] = 0.0
    return ideal - loss


@kernel
def _feed(circuit, detail, power, pressure, gallery, tank):
    # net flow from the gallery into the pump's end of a line, and what leaks from there to the tank
    check = check_flow(detail.check_valve, gallery, pressure)
    relief = one_way_relief(circuit.relief_valve, pressure - gallery)
    leakage = detail.tank_leakage * (pressure - tank)
    power[CHECK] += check * (gallery - pressure)
    power[RELIEF] += relief * (pressure - gallery)
    power[TANK_LEAKAGE] += leakage * (pressure - tank)
    return check - relief, leakage


@kernel
def _turn(circuit, detail, bar_stiffness, x, dx, power, lumps, twist):
    # the motor's motion (eq. 25); returns the flow that leaves chamber A for the vane, the leakage and the bypass
    motor, angle, rate = circuit.motor, x[ANGLE], x[RATE]
    p_a, p_b = x[A + lumps], x[B + lumps]
    pressure = p_a - p_b
    friction, bar_torque = friction_torque(motor, rate), bar_stiffness * (angle - twist)
    torque = motor.displacement * pressure - bar_torque - stop_torque(motor, angle) - friction
    dx[ANGLE], dx[RATE] = rate, 1.0 / motor.inertia * torque
    leakage, bypass = motor.leakage * pressure, bypass_flow(detail.bypass_valve, x[BYPASS], pressure)
    swept, tank = motor.displacement * rate, circuit.metering_edge.return_pressure
    power[FRICTION], power[MOTOR], power[BAR_TORQUE] = friction * rate, bar_torque * rate, bar_torque
    power[MOTOR_LEAKAGE], power[BYPASS_LOSS] = leakage * pressure, bypass * pressure
    # the swept volume carries its oil's compression along
    carried = energy_density(detail.fluid, p_a, tank) - energy_density(detail.fluid, p_b, tank)
    power[CAPACITANCE] = -swept * carried
    return swept + leakage + bypass


@kernel
def _compress(detail, x, dx, lumps, side, flow, into_line, into_motor, chamber):
    # the volumes along one side (eqs. 29, 30); the last one has the motor's chamber too
    pipe, into = detail.pipe, into_line
    for j in range(lumps + 1):
        out = x[flow + j] if j < lumps else into_motor
        softness = compressibility(detail.fluid, x[side + j])
        capacitance = _node_volume(pipe, lumps, j) * (softness + pipe.wall_compliance)
        if j == lumps:
            capacitance += chamber * softness
        dx[side + j] = (into - out) / capacitance
        into = out


@kernel
def _charge(circuit, detail, x, dx, power, fed, tank):
    # the gallery between charge pump, charge relief and check valves
    charge, gallery = detail.charge_pump, x[GALLERY]
    flow, relief = charge_flow(charge, circuit.pump.speed), charge_relief_flow(charge, gallery)
    dx[GALLERY] = (flow - relief - fed) / (charge.gallery_volume * compressibility(detail.fluid, gallery))
    power[CHARGE] = charge_power(charge, circuit.pump.speed, gallery, tank)
    power[CHARGE_LOSS] = power[CHARGE] - (flow - relief) * (gallery - tank)
