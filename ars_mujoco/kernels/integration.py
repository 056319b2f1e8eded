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
from ars_mujoco.kernels.records import along, divided, numbers, store, zeros

LATER_STAGES = ((0.5, 2.0), (0.5, 2.0), (1.0, 1.0))  # (of the step ahead, weight) of the stages after the first


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
        # a loop, as `rates` written out once an evaluation would be most of what a system takes to compile
        k, power, torque = rates(p, demand, t, state)
        slope, powers, torques = k, power, torque
        for ahead, weight in LATER_STAGES:
            k, power, torque = rates(p, demand, t + ahead * h, along(state, k, ahead * h))
            slope, powers, torques = (
                along(slope, k, weight),
                along(powers, power, weight),
                along(torques, torque, weight),
            )
        return along(state, slope, h / 6.0), divided(powers, 6.0), divided(torques, 6.0)

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
