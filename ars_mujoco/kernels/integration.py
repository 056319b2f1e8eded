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
from ars_mujoco.kernels.records import along, numbers, store, weighted, zeros


def runge_kutta(rates):
    """A kernel that takes one step `h` (s) from `t`: the new state, and the means over it of powers and torques."""

    @inlined
    def stepped(p, demand, t, state, h):
        k1, p1, m1 = rates(p, demand, t, state)
        k2, p2, m2 = rates(p, demand, t + 0.5 * h, along(state, k1, 0.5 * h))
        k3, p3, m3 = rates(p, demand, t + 0.5 * h, along(state, k2, 0.5 * h))
        k4, p4, m4 = rates(p, demand, t + h, along(state, k3, h))
        return (
            weighted(state, k1, k2, k3, k4, h),
            weighted(zeros(p1), p1, p2, p3, p4, 1.0),
            weighted(zeros(m1), m1, m2, m3, m4, 1.0),
        )

    return stepped


def integrated(rates):
    """A kernel that takes a system through a physics step (s) in `count` substeps, and returns its mean torques.

    `now` and `later` are records with a `state` and an `energy`, whose numbers are the states and what the powers have
    summed up to (J), with the weights of the states.
    """
    stepped = runge_kutta(rates)

    @inlined
    def advance(p, now, later, demand, step, count):
        state, h = numbers(now.state), step / count
        _, powers, torques = rates(p, demand, 0.0, state)
        sums, means = zeros(powers), zeros(torques)
        for i in range(count):
            state, power, torque = stepped(p, demand, i * h, state, h)
            sums, means = along(sums, power, 1.0), along(means, torque, 1.0)
        store(later.state, state)
        store(later.energy, along(numbers(now.energy), sums, h))
        return along(zeros(means), means, 1.0 / count)

    return advance
