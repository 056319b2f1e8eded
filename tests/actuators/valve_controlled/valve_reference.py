"""An independent solution of the circuit's equations: its own numbers, its own code, an implicit solver.

Nothing of the package is used. The unit's part, currents and the side of the direction valve, is given over the time.
"""

import numpy as np
from scipy.integrate import solve_ivp

D, THETA, BAR = 5.24e-4 / (2 * np.pi), 0.175, 5700.0
NODES, CHAMBERS = (1.75e-13, 2.73e-13), (7.5e-14, 1.17e-13)
RETURN = 1.4e5
WIDE = 1.5e-4 / (1.8e5 / (1.8e5**2 + 0.6e5**2) ** 0.25)  # of an open pressure valve
EDGE = 1.5e-4 / np.sqrt(1e5)
STOP = 1e-5  # s
AXLE_SCALES, VALVE_SCALES = [1e5, 1e5, 0.01, 0.1], [0.1, 0.1, 0.1]
SCALES = np.array([*AXLE_SCALES, *AXLE_SCALES, 1e5, 1e5, *VALVE_SCALES, *VALVE_SCALES, 0.1, 1.0, 1.0, 1.0])


def root(dp, rounding):
    return dp / (dp * dp + rounding * rounding) ** 0.25


def solution(settings, flow, rpm, times):
    """(20, n) states at `times` (s): of front and rear (chambers A and B, angle, rate), both nodes, of both valves
    (current, side of the hysteresis, opening), the spool, and energies (J): shaft, both pressure valves.

    `settings` are (start s, front current A, rear current A, side) pieces; the front works against the rear node.
    """

    def rate(currents, side):
        def of(t, y):
            spool = y[16]
            ways = {
                "pa": max(spool - 0.1, 0.0) / 0.9, "pb": max(-spool - 0.1, 0.0) / 0.9,
                "at": max(0.1 - spool, 0.0) / 1.1, "bt": max(0.1 + spool, 0.0) / 1.1,
            }  # fmt: skip
            axles, taken = [], []
            for i in range(2):
                a, b, phi, w = y[4 * i : 4 * i + 4]
                wide = {name: EDGE * way for name, way in ways.items()}
                if i == 0:  # the fail-safe valve, open, is an edge of the same width
                    wide = {name: EDGE * way / np.sqrt(1.0 + way * way) for name, way in ways.items()}
                pa, pb = wide["pa"] * root(y[8 + i] - a, 1e5), wide["pb"] * root(y[8 + i] - b, 1e5)
                at, bt = wide["at"] * root(a - RETURN, 1e5), wide["bt"] * root(b - RETURN, 1e5)
                check_a, check_b = (8.33e-10 * max(-each - 0.2e5, 0.0) for each in (a, b))
                leak = 1.75e-13 * (a - b)
                friction = 35.0 * np.tanh(w / 0.01) + 16.5 * w
                taken.append(pa + pb)
                axles += [
                    (pa - at + check_a - leak - D * w) / CHAMBERS[i],
                    (pb - bt + check_b + leak + D * w) / CHAMBERS[i],
                    w,
                    (D * (a - b) - BAR * phi - friction) / THETA,
                ]
            drops = (y[8] - y[9], y[9] - RETURN)
            flows, valves = [], []
            for i, dp in enumerate(drops):
                current, turned, opening = y[10 + 3 * i : 13 + 3 * i]
                current_rate = (currents[i] - current) / 5e-3
                setting = 180e5 / 0.95 * (current - 0.15) - 0.5 * 0.03 * 180e5 * turned
                stiffness = 0.4e5 * 6e4 * (0.5 * np.sqrt(70e5) + 0.5 * max(dp, 0.0) / np.sqrt(70e5))
                moving = ((dp - setting) / (stiffness * WIDE) - opening) / 8e-3
                moving -= (opening - min(max(opening, 0.0), 1.0)) / STOP  # its stops are stiff
                flows.append(min(max(opening, 0.0), 1.0) * WIDE * root(dp, 0.6e5) + 2e-13 * dp)
                valves += [current_rate, (current_rate - abs(current_rate) * turned) / 0.03, moving]
            relief = 3e-10 * max(y[8] - 195e5, 0.0)
            nodes = [
                (flow - 8e-13 * y[8] - relief - taken[0] - flows[0] - 2e-13 * (y[8] - RETURN)) / NODES[0],
                (flows[0] - taken[1] - flows[1] - 2e-13 * drops[1]) / NODES[1],
            ]
            moved = min(max((side - spool) / 0.05, -1.0), 1.0) / 0.02
            torque = 21.2 * (0.008 + 0.010 * rpm / 3000.0 + 0.040 * y[8] / 180e5)
            shaft = flow * y[8] + torque * rpm * np.pi / 30.0
            return [*axles, *nodes, *valves, moved, shaft, drops[0] * flows[0], drops[1] * flows[1]]

        return of

    y = np.zeros(20)
    open_root = flow / WIDE
    square = open_root**4
    over = np.sqrt(0.5 * (square + np.sqrt(square**2 + 4.0 * square * 0.6e5**2)))
    y[[0, 1, 4, 5]], y[9], y[8], y[[12, 15]] = RETURN, RETURN + over, RETURN + 2.0 * over, 1.0
    found, ends = [], [*(piece[0] for piece in settings[1:]), times[-1] + 1e-3]
    for (start, front, rear, side), end in zip(settings, ends, strict=True):
        rows = times[(times >= start - 1e-9) & (times < end - 1e-9)]
        solved = solve_ivp(
            rate((front, rear), side), (start, end), y, method="Radau", t_eval=np.append(rows, end), rtol=1e-7,
            atol=1e-8 * SCALES, max_step=5e-3,
        )  # fmt: skip
        found.append(solved.y[:, :-1])
        y = solved.y[:, -1]
    states = np.concatenate(found, axis=1)
    states[[12, 15]] = np.clip(states[[12, 15]], 0.0, 1.0)  # within its stops by what they yield
    return states
