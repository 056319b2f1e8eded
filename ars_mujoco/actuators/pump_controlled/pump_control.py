"""Pump control: servo valve, control cylinder and swash plate at three stages of simplification (paper section 4.1.1).

    stroke command ─> swash-plate loop ─> servo valve ─> control cylinder ─> swash plate (X)
                             ^                                                  │
                             └──────────────────── X ───────────────────────────┘

THIRD_ORDER is eqs. 18 to 20: the valve's lag and an integrator. REDUCED adds the piston's mass and forces under one
load pressure (eq. 16), FULL both chambers and every edge (eqs. 1 to 15). The cylinder's own dynamics reach 8e4 1/s but
last a fraction of a millisecond, so one linearly implicit step (Rodas3: third order, L-stable, stiffly accurate; Sandu
and others 1997) takes them over a whole substep of the circuit. Where they do matter, as the piston meets its stop, the
step's own estimate of its error tells, and the substep is divided.
"""

from ars_mujoco.actuators.pump_controlled.swash_plate_loop import valve_command
from ars_mujoco.hydraulics.control_cylinder import (
    chamber_capacitance,
    chamber_volumes,
    common_capacitance,
    piston_acceleration,
)
from ars_mujoco.hydraulics.metering_edge import (
    common_flow,
    edge_flow_a,
    edge_flow_b,
    mean_supply_power,
    supply_power,
)
from ars_mujoco.hydraulics.servo_valve import spool_acceleration
from ars_mujoco.hydraulics.swash_plate import held, stroke_rate
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import along

THIRD_ORDER, REDUCED, FULL = 0.0, 1.0, 2.0

TOLERANCE = 0.1  # error of a chamber's pressure, over that pressure, above which a step is divided
MOST_PARTS = 256


@kernel
def advance_pump_control(circuit, detail, state, command, pressure, h: float):
    """The state one substep `h` (s) later, at the stage that `detail` names.

    A state is (spool, spool rate, p_A, p_B, stroke, piston speed): fractions and 1/s, Pa, m/s; at the reduced stage p_A
    stands for the load pressure. `command` is (stroke command at the start, at the end, its rate at the start),
    `pressure` (of the main pump, Pa) the same.
    """
    if detail.stage == THIRD_ORDER:
        return _third_order_step(circuit, state, command, h)
    return _implicit_steps(circuit, detail, state, command, pressure, h)


@kernel
def control_power(circuit, detail, state) -> float:
    """Power (W) drawn from the control supply, all of it lost in the valve and the cylinder."""
    if detail.stage == FULL:
        return supply_power(circuit.metering_edge, state[0], state[2], state[3])
    return mean_supply_power(circuit.metering_edge, state[0])


@kernel
def stroke_speed(circuit, detail, state) -> float:
    """Rate of the pump stroke (1/s)."""
    if detail.stage == THIRD_ORDER:
        return stroke_rate(circuit.swash_plate, state[0])
    return state[5] / circuit.control_cylinder.travel


@kernel
def control_rates(circuit, detail, state, stroke_command: float, pressure: float):
    """Derivatives of the six states at the stage that `detail` names, at a pressure (Pa) of the main pump; what a stage
    has no equation for stands still.
    """
    if detail.stage == THIRD_ORDER:
        nowhere = (0.0, 0.0, 0.0)
        spool_rate, acceleration, stroke = _third_order_rates(circuit, state, 0.0, nowhere, stroke_command)
        return spool_rate, acceleration, 0.0, 0.0, stroke, 0.0
    return cylinder_rates(circuit, detail, state, stroke_command, pressure)[0]


@kernel
def cylinder_rates(circuit, detail, state, stroke_command: float, pressure: float):
    """Derivatives of the six states with a cylinder, and the slopes that a linearly implicit step needs.

    The slopes are of spool acceleration (by spool, spool rate, stroke), of p_A' (by spool, p_A, p_B, stroke, speed), of
    p_B' (the same) and of piston acceleration (by p_A, p_B, stroke, speed).
    """
    spool, spool_rate, p_a, p_b, stroke, rate = state
    cylinder, edge, area = circuit.control_cylinder, circuit.metering_edge, circuit.control_cylinder.area
    travel, inverse_mass = cylinder.travel * stroke, 1.0 / cylinder.mass
    acceleration, valve_slopes = _valve(circuit, spool, spool_rate, stroke, stroke_command)
    v_a, v_b = chamber_volumes(cylinder, travel)
    if detail.stage == FULL:
        a_flow, a_by_spool, a_by_pressure = edge_flow_a(edge, spool, p_a)
        b_flow, b_by_spool, b_by_pressure = edge_flow_b(edge, spool, p_b)
        c_a, c_a_slope = chamber_capacitance(detail.fluid, v_a, p_a)
        c_b, c_b_slope = chamber_capacitance(detail.fluid, v_b, p_b)
        across, out, tank = cylinder.internal_leakage, cylinder.external_leakage, edge.return_pressure
        a_rate = (a_flow - area * rate - out * (p_a - tank) - across * (p_a - p_b)) / c_a
        b_rate = (b_flow + area * rate - out * (p_b - tank) - across * (p_b - p_a)) / c_b
        force, b_share = area * (p_a - p_b), -area
        a_slopes = (
            a_by_spool / c_a,
            (a_by_pressure - out - across - a_rate * c_a_slope) / c_a,
            across / c_a,
            -a_rate * area * cylinder.travel / v_a,
            -area / c_a,
        )
        b_slopes = (
            b_by_spool / c_b,
            across / c_b,
            (b_by_pressure - out - across - b_rate * c_b_slope) / c_b,
            b_rate * area * cylinder.travel / v_b,
            area / c_b,
        )
    else:
        flow, by_spool, by_pressure = common_flow(edge, spool, p_a)
        c = common_capacitance(cylinder, detail.fluid, travel, 0.5 * (edge.supply_pressure + edge.return_pressure))
        leakage = cylinder.internal_leakage + 0.5 * cylinder.external_leakage + edge.leakage
        a_rate, b_rate = (flow - area * rate - leakage * p_a) / c, 0.0
        force, b_share = area * p_a, 0.0
        softening = area * cylinder.travel * (1.0 / v_a - 1.0 / v_b)
        a_slopes = (by_spool / c, (by_pressure - leakage) / c, 0.0, -a_rate * softening, -area / c)
        b_slopes = (0.0, 0.0, 0.0, 0.0, 0.0)
    piston, by_travel, by_rate = piston_acceleration(cylinder, force, travel, rate, pressure)
    piston_slopes = (inverse_mass * area, inverse_mass * b_share, by_travel * cylinder.travel, by_rate)
    rates = (spool_rate, acceleration, a_rate, b_rate, rate / cylinder.travel, piston)
    return rates, valve_slopes, a_slopes, b_slopes, piston_slopes


@kernel
def _valve(circuit, spool, spool_rate, stroke, stroke_command):
    # spool acceleration and its slopes by spool, spool rate and stroke; a saturated quantity has none
    valve, gain = circuit.servo_valve, circuit.swash_plate_loop.gain / circuit.swash_plate.max_rate
    command = valve_command(circuit.swash_plate_loop, circuit.swash_plate, stroke_command, stroke)
    wanted = valve.frequency / (2.0 * valve.damping) * (command - spool)
    slope = valve.frequency * valve.frequency if abs(wanted) < valve.max_rate else 0.0
    by_stroke = -slope * gain if abs(command) < 1.0 else 0.0
    acceleration = spool_acceleration(valve, spool, spool_rate, command)
    return acceleration, (-slope, -2.0 * valve.damping * valve.frequency, by_stroke)


@kernel
def _third_order_step(circuit, state, command, h):
    # classical Runge-Kutta of eqs. 18 to 20; the other three states stay as they are
    start, end, rate = command
    middle = 0.75 * start + 0.25 * end + 0.25 * h * rate  # of the parabola
    k1 = _third_order_rates(circuit, state, 0.0, (0.0, 0.0, 0.0), start)
    k2 = _third_order_rates(circuit, state, 0.5 * h, k1, middle)
    k3 = _third_order_rates(circuit, state, 0.5 * h, k2, middle)
    k4 = _third_order_rates(circuit, state, h, k3, end)
    w = h / 6.0
    return (
        state[0] + w * (k1[0] + 2.0 * (k2[0] + k3[0]) + k4[0]),
        state[1] + w * (k1[1] + 2.0 * (k2[1] + k3[1]) + k4[1]),
        state[2],
        state[3],
        held(circuit.swash_plate, state[4] + w * (k1[2] + 2.0 * (k2[2] + k3[2]) + k4[2])),
        state[5],
    )


@kernel
def _third_order_rates(circuit, state, h, k, command):
    spool, spool_rate, stroke = state[0] + h * k[0], state[1] + h * k[1], state[4] + h * k[2]
    wanted = valve_command(circuit.swash_plate_loop, circuit.swash_plate, command, stroke)
    acceleration = spool_acceleration(circuit.servo_valve, spool, spool_rate, wanted)
    return spool_rate, acceleration, stroke_rate(circuit.swash_plate, spool)


@kernel
def _implicit_steps(circuit, detail, state, command, pressure, h):
    # equal parts of the substep, twice as many until the chambers' pressures are right in each
    parts = 1
    while True:
        end, right, part = state, True, 1.0 / parts
        for i in range(parts):
            asked, load = _piece(command, h, i * part, (i + 1) * part), _piece(pressure, h, i * part, (i + 1) * part)
            end, error = _implicit_step(circuit, detail, end, asked, load, part * h)
            right = parts == MOST_PARTS or _is_right(circuit, detail, end, error)
            if not right:
                break
        if right:
            return end
        parts *= 2


@kernel
def _piece(course, h, first, last):
    # a (start, end, rate at the start) over a substep `h`, between two shares of it
    start, end, rate = course
    straight = h * rate
    bend = end - start - straight
    return (
        start + first * (straight + first * bend),
        start + last * (straight + last * bend),
        rate + 2.0 * first * bend / h,
    )


@kernel
def _is_right(circuit, detail, end, error):
    # at the reduced stage the load pressure may be zero; it is judged by the supply's
    if detail.stage == FULL:
        return abs(error[2]) < TOLERANCE * end[2] and abs(error[3]) < TOLERANCE * end[3]
    return abs(error[2]) < TOLERANCE * circuit.metering_edge.supply_pressure


@kernel
def _implicit_step(circuit, detail, state, command, pressure, h):
    # Rodas3 in the form that needs no product with the Jacobian; its second stage reuses the first evaluation, and its
    # last is the estimate of the error
    start = cylinder_rates(circuit, detail, state, command[0], pressure[0])
    first = start[0]
    f_t = _drift(circuit, start, command, pressure)
    factors = _eliminate(circuit, start, 2.0 / h)
    k1 = _solve(factors, along(first, f_t, 0.5 * h))
    k2 = _solve(factors, along(along(first, f_t, 1.5 * h), k1, 4.0 / h))
    third = along(state, k1, 2.0)
    f3 = cylinder_rates(circuit, detail, third, command[1], pressure[1])[0]
    k3 = _solve(factors, along(along(f3, k1, 1.0 / h), k2, -1.0 / h))
    fourth = along(third, k3, 1.0)
    f4 = cylinder_rates(circuit, detail, fourth, command[1], pressure[1])[0]
    k4 = _solve(factors, along(along(along(f4, k1, 1.0 / h), k2, -1.0 / h), k3, -8.0 / (3.0 * h)))
    return along(fourth, k4, 1.0), k4


@kernel
def _drift(circuit, start, command, pressure):
    # the derivatives' own change with time: stroke command and main pressure move while the state stands still
    by_stroke, cylinder = start[1][2], circuit.control_cylinder
    swash = cylinder.swash_force / (cylinder.swash_pressure * cylinder.mass)
    return 0.0, -by_stroke * command[2], 0.0, 0.0, 0.0, -swash * pressure[2]


@kernel
def _eliminate(circuit, start, sigma):
    # (sigma 1 - J) k = r by hand: spool rate and piston speed go first, then spool and both pressures, stroke is left
    _, (yy, yr, yx), (ay, aa, ab, ax, av), (by, ba, bb, bx, bv), (va, vb, vx, vv) = start
    inverse_travel = 1.0 / circuit.control_cylinder.travel
    valve = 1.0 / (sigma * (sigma - yr) - yy)
    per_stroke = sigma / inverse_travel  # piston speed over stroke
    a_x = ax + per_stroke * av + ay * valve * yx
    b_x = bx + per_stroke * bv + by * valve * yx
    aa, bb = sigma - aa, sigma - bb
    determinant = 1.0 / (aa * bb - ab * ba)
    p_x, q_x = determinant * (bb * a_x + ab * b_x), determinant * (aa * b_x + ba * a_x)
    last = 1.0 / ((sigma - vv) * per_stroke - vx - va * p_x - vb * q_x)
    return sigma, yr, yx, ay, by, av, bv, va, vb, vv, aa, bb, ab, ba, valve, determinant, p_x, q_x, last, inverse_travel


@kernel
def _solve(factors, r):
    sigma, yr, yx, ay, by, av, bv, va, vb, vv, aa, bb, ab, ba, valve, determinant, p_x, q_x, last, inverse = factors
    # with the stroke at 0: spool, piston speed, pressures
    spool = valve * (r[1] + (sigma - yr) * r[0])
    rate = -r[4] / inverse
    a, b = r[2] + av * rate + ay * spool, r[3] + bv * rate + by * spool
    p_a, p_b = determinant * (bb * a + ab * b), determinant * (aa * b + ba * a)
    stroke = last * (r[5] - (sigma - vv) * rate + va * p_a + vb * p_b)
    spool += valve * yx * stroke
    return (
        spool,
        sigma * spool - r[0],
        p_a + p_x * stroke,
        p_b + q_x * stroke,
        stroke,
        rate + sigma / inverse * stroke,
    )
