"""Integration: ordinary differential equations through a physics step, in substeps of classical Runge-Kutta.

A system writes its equations as

    @inlined
    def rates(p, demand, t, state):
        return derivatives, powers, torques

three tuples: of the states' derivatives, of the powers (W) behind its energies, and of the bars' torques (Nm), at a
time t (s) since the start of the step. `demand` is whatever holds over the step. States and powers stand in the order
of the records that keep them.
"""

from ars_mujoco.kernels.kernel import inlined
from ars_mujoco.kernels.records import along, divided, mean, numbers, store, weighted, zeros


@inlined
def left(p, state):
    """`settled` of a system whose states may go anywhere."""
    return state


@inlined
def alone(powers):
    """`counted` of a system whose energies are the integrals of its powers."""
    return powers


def runge_kutta(rates):
    """A kernel that takes one step `h` (s) from `t`: the new state, and the means over it of powers and torques."""

    @inlined
    def stepped(p, demand, t, state, h):
        k1, p1, m1 = rates(p, demand, t, state)
        k2, p2, m2 = rates(p, demand, t + 0.5 * h, along(state, k1, 0.5 * h))
        k3, p3, m3 = rates(p, demand, t + 0.5 * h, along(state, k2, 0.5 * h))
        k4, p4, m4 = rates(p, demand, t + h, along(state, k3, h))
        return weighted(state, k1, k2, k3, k4, h), mean(p1, p2, p3, p4), mean(m1, m2, m3, m4)

    return stepped


def in_substeps(rates, settled=left, counted=alone):
    """A kernel that takes a tuple of states through a physics step of `step` s in `count` substeps, one at least.

    It gives the new state, the energies of the step (J, with the weights of the states), and the mean torques (Nm).
    `settled(p, state)` is where the state comes to stand after a substep, as at a stop that holds it; `counted(powers)`
    makes of the mean powers of a substep those to be summed up, as of what needs |.|.
    """
    stepped = runge_kutta(rates)

    @inlined
    def through(p, demand, state, step, count):
        h = step / count
        for i in range(count):
            state, powers, torques = stepped(p, demand, i * h, state, h)
            state, powers = settled(p, state), counted(powers)
            if i == 0:  # as many sums as there are powers; an evaluation of `rates` for their number would cost
                sums, totals = powers, torques
            else:
                sums, totals = along(sums, powers, 1.0), along(totals, torques, 1.0)
        return state, along(zeros(sums), sums, h), divided(totals, count)

    return through


def integrated(rates, settled=left, counted=alone):
    """A kernel that takes the records of a system through a physics step, see `in_substeps`; returns its mean torques.

    `now` and `later` (they may be the same) have a `state` and an `energy`, whose numbers are the states and what the
    counted powers have summed up to (J).
    """
    through = in_substeps(rates, settled, counted)

    @inlined
    def advance(p, now, later, demand, step, count):
        state, energies, torques = through(p, demand, numbers(now.state), step, count)
        store(later.state, state)
        store(later.energy, along(numbers(now.energy), energies, 1.0))
        return torques

    return advance
