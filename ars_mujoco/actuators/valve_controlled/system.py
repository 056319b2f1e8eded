"""Valve-controlled: one pump on the engine feeds a valve block, whose pressures are the torques of two vane motors.

    pump ─┬─ front node ─[PVV]─ rear node ─[PVH]─ return line        see `block`
          │       │                 │
          │  direction valve ──── direction valve                     one spool for both axles
          │       │                 │
          │  fail-safe valve        │                                 see `axle`
          │       │                 │
         relief  front motor       rear motor

The pump always circulates its whole flow: what it takes follows from the front's pressure, whether a bar moves or not.
The block, the pump and the control unit are the block `supply` of the channels.
"""

import math

import numpy as np

from ars_mujoco.actuators.system import Beyond, Car, Input
from ars_mujoco.actuators.valve_controlled.block import Setting
from ars_mujoco.actuators.valve_controlled.channels import EVENTS, PLOTS, Output, report_axle, report_supply
from ars_mujoco.actuators.valve_controlled.equations import (
    BLOCK_POWERS,
    PARAMETERS,
    POWERS,
    Demand,
    Energy,
    State,
    rates,
    settled,
)
from ars_mujoco.actuators.valve_controlled.file import AXLES, fill_system, released
from ars_mujoco.actuators.valve_controlled.file import ValveControlled as File
from ars_mujoco.actuators.valve_controlled.sizing import SIZING
from ars_mujoco.actuators.valve_controlled.unit import UnitState, sample
from ars_mujoco.control.control_unit import samples_now
from ars_mujoco.hydraulics.pressure_valve import open_pressure
from ars_mujoco.hydraulics.radial_piston_pump import intake_wanted, limited_flow
from ars_mujoco.kernels.integration import integrated
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import numbers, share
from ars_mujoco.kernels.substeps import derivatives, fewest_substeps, scales, slopes
from ars_mujoco.machines.belt_drive import BeltDriveState, first_speed, pump_speed
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import record_dtype

NAME = "valve_controlled"
FOLLOWS = "torque"
INPUTS = {"front_fail_safe": Input("1", 1.0, 0.0, 1.0)}  # 0 shuts the valve, as a fault of supply or unit does
FAIL_SAFE = 0
BEYOND = Beyond("over 1000 bar, or far past its stop", ("front.motor.pressure", "rear.motor.pressure"))
FAR_PRESSURE = 1000e5  # Pa
FAR_ANGLE = 2.0  # of the motor's stop
HELD_FRONT, HELD_REAR, HELD_OPENING = 120e5, 75e5, 0.12  # Pa, Pa and an opening, of a held torque
DRAWN = -0.5e5  # Pa, at which check valves are open


class DriveState(BeltDriveState):
    """State of what drives the pump, and of its intake."""

    intake: float = channel("1", "share of the flow limit that the restrictor leaves")
    idle: float = channel("s", "time since a torque was last asked for")


STATE = np.dtype(
    [
        ("state", record_dtype(State)),
        ("energy", record_dtype(Energy)),
        ("unit", record_dtype(UnitState)),
        ("drive", record_dtype(DriveState)),
    ]
)

step_through = integrated(rates, settled)
_derivatives = derivatives(rates)


@kernel
def advance(p, now, later, out, work, command, twists, moment):
    """Both axles over the coming step, see `actuators.system`."""
    speed = pump_speed(p.drive, now.drive, later.drive, moment.time, moment.road_speed)
    _open_intake(p.pump.intake, now.drive, later.drive, command, moment.step)
    flow = limited_flow(p.pump, speed, now.drive.intake)
    share(later.unit, now.unit)
    if samples_now(p.control, moment.time, moment.step):
        period = max(p.control.sample_time, moment.step)
        road_speed = moment.road_speed if p.has_road == 1.0 else math.inf  # a rig without a road is a car that drives
        conditions = (period, road_speed, command.inputs[FAIL_SAFE], flow)
        sample(p, later.unit, now.state.supply, command, conditions)
    unit = later.unit
    setting = Setting(flow, speed, unit.front_current, unit.rear_current, unit.side, unit.fail_safe)
    _report(p, now, later, out, command, Demand(setting, twists.front.angle, twists.rear.angle))
    held = Demand(setting, twists.front.held, twists.rear.held)
    return step_through(p, now, later, held, moment.step, int(p.substeps))


@kernel
def _open_intake(intake, now, later, command, step):
    # the intake restrictor over a step
    asked = max(abs(command.front.torque), abs(command.rear.torque))
    later.idle = 0.0 if asked >= intake.wake_torque else now.idle + step
    wanted = intake_wanted(intake, later.idle)
    later.intake = wanted + (now.intake - wanted) * math.exp(-step / intake.time)


@kernel
def _report(p, now, later, out, command, demand):
    # what a run records of the state now, and of what the unit makes of it
    state, energy = now.state, now.energy
    _, powers, _ = rates(p, demand, 0.0, numbers(state))
    report_axle(p.front, state.front, energy.front, out.front, demand.front_twist, powers[0:POWERS])
    report_axle(p.rear, state.rear, energy.rear, out.rear, demand.rear_twist, powers[POWERS:BLOCK_POWERS])
    out.front.bar.command, out.rear.bar.command = command.front.angle[0], command.rear.angle[0]
    share(out.supply.unit, later.unit)
    report_supply(p, now, out.supply, demand.setting, powers[BLOCK_POWERS:])


@kernel
def sense(p, now, sensors) -> None:
    """The motors' angles, and the bars' torques as pressures and direction valve tell them."""
    supply, outlet = now.state.supply, p.block.return_pressure
    sensors.front_angle, sensors.rear_angle = now.state.front.angle, now.state.rear.angle
    sensors.front_torque = p.front.axle.motor.displacement * supply.spool * (supply.front_sensed - outlet)
    sensors.rear_torque = p.rear.axle.motor.displacement * supply.spool * (supply.rear_sensed - outlet)


@kernel
def is_beyond(p, state) -> bool:
    """Whether a pressure or an angle has left all that is physical."""
    return _is_beyond(p.front, state.state.front) or _is_beyond(p.rear, state.state.rear)


@kernel
def _is_beyond(p, state):
    pressure = max(abs(state.chamber_a), abs(state.chamber_b))
    return pressure > FAR_PRESSURE or abs(state.angle) > FAR_ANGLE * p.axle.motor.stop_angle


def fill(record, file: File, car: Car, step: float) -> None:
    """Write the parameters; without a rear bar, as on the bench, there is no rear motor."""
    fill_system(record, file, car, step)
    record.substeps = fewest_substeps(_slopes(record), step)


def start(record, state) -> None:
    """Write the state at rest: for long the pump has circulated what the restrictor leaves it through open valves, and
    the motors lie at the return line.
    """
    intake = record.pump.intake
    _rest(record, state.state, limited_flow(record.pump, first_speed(record.drive), intake.least_share))
    state.drive.intake, state.drive.idle, state.unit.fail_safe = intake.least_share, intake.hold, 1.0


def _rest(record, state, flow: float) -> None:
    # a State in which `flow` (m^3/s) circulates
    block, supply = record.block, state.supply
    supply.rear_pressure = block.return_pressure + open_pressure(block.rear_valve, flow)
    supply.front_pressure = supply.rear_pressure + open_pressure(block.front_valve, flow)
    supply.front_sensed, supply.rear_sensed = supply.front_pressure, supply.rear_pressure
    supply.front_opening = supply.rear_opening = supply.fail_safe = 1.0
    for name in AXLES:
        state[name].chamber_a = state[name].chamber_b = block.return_pressure


def _slopes(record) -> list[np.ndarray]:
    """Slopes of the equations (1/s) where they are stiffest, for the substeps.

    At rest without flow, where friction is rounded and open pressure valves flow laminar; the same with the direction
    valve at an end, which then flows laminar too; at a held pressure; in motion; over the relief valve's pressure; with
    open check valves; past the motor's stop.
    """
    demand = Demand(Setting(0.0, 0.0, 0.0, 0.0, 0.0, 1.0), 0.0, 0.0)
    looks = np.zeros(7, record_dtype(State)).view(np.recarray)
    for look in looks:
        _rest(record, look, 0.0)
    _, switched, holding, moving, relieved, drawn, stopped = looks
    switched.supply.spool = holding.supply.spool = 1.0
    holding.supply.front_pressure, holding.supply.rear_pressure = HELD_FRONT, HELD_REAR
    holding.supply.front_opening = holding.supply.rear_opening = HELD_OPENING
    holding.front.chamber_a, holding.rear.chamber_a = HELD_FRONT, HELD_REAR
    relieved.supply.front_pressure = 1.1 * record.block.relief_valve.pressure
    for name in AXLES:
        moving[name].rate = 1.0
        drawn[name].chamber_a = drawn[name].chamber_b = DRAWN
        stopped[name].angle = 1.01 * record[name].axle.motor.stop_angle
    return [slopes(_derivatives, record, demand, look, scales(State)) for look in looks]
