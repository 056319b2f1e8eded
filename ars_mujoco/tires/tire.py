"""Tire: what a wheel on a road feels, from its motion and the deflection of its carcass.

Signs are those of `magic_formula`; the frame of the patch is that of `contact`.
"""

import math

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, number, quantity
from ars_mujoco.tires import contact, magic_formula, relaxation
from ars_mujoco.tires.magic_formula import MagicFormula
from ars_mujoco.tires.relaxation import Relaxation


class Tire(Parameters):
    """A passenger-car tire, of the size 205/60R15."""

    radius: float = quantity("m", gt=0, default=0.3135)  # unloaded
    stiffness: float = quantity("N/m", gt=0, default=225e3)  # vertical
    damping: float = quantity("Ns/m", ge=0, default=150.0)  # vertical
    rolling_resistance: float = number(ge=0, default=0.01)  # its moment over load and radius; judgement
    rolling_speed: float = quantity(
        "m/s", gt=0, default=0.1
    )  # it fades below this speed: it stops a car, it does not hold one
    mu: float = number(gt=0, default=1.0)  # friction of the road, 1 is that of the tire's measurement
    relaxation: Relaxation = Relaxation()
    magic: MagicFormula = MagicFormula()


class TireState(Parameters):
    """Deflection of the carcass at the patch."""

    u: float = quantity("m", default=0.0)  # longitudinal
    v: float = quantity("m", default=0.0)  # lateral


class TireOutput(Parameters):
    """What one tire does, in the frame of its patch."""

    vertical_force: float = channel("N", "load on the tire, along the road's normal")
    lateral_force: float = channel("N", "force on the tire to its left")
    longitudinal_force: float = channel("N", "force on the tire forward")
    slip_angle: float = channel("rad", "slip angle of the patch, positive when it moves to the left")
    slip_ratio: float = channel("1", "longitudinal slip of the patch, positive when driving")
    camber: float = channel("rad", "camber, positive when the top leans to the right")
    aligning_moment: float = channel("Nm", "moment about the road's normal")


@kernel
def tire(p, now, next, out, h, px, py, pz, ax, ay, az, vx, vy, vz, wx, wy, wz, spin, road_height, slope_x, slope_y):
    """World force (N) at, and world torque (Nm) about, the wheel's centre: (Fx, Fy, Fz, Tx, Ty, Tz).

    p, now, next, out: records of Tire, TireState (twice) and TireOutput. h: time step (s). The wheel's centre p (m),
    its spin axis a (unit vector to the left), the hub's velocity v (m/s) at the wheel's centre and angular velocity w
    (rad/s), the wheel's rate on the hub `spin` (rad/s). The road's height (m) and slopes at (px, py).

    A pure function of all but `next` and `out`, which it writes: the deflection a step later, and the channels. The
    force is that of the deflection a step later, as a semi-implicit step's positions would be: with the one at its
    start, the spin of a wheel against its carcass would gain energy.
    """
    nx, ny, nz = contact.normal(slope_x, slope_y)
    xx, xy, xz, cos, sin = contact.heading(ax, ay, az, nx, ny, nz)
    yx, yy, yz = contact.cross(nx, ny, nz, xx, xy, xz)
    height = (pz - road_height) * nz
    tan = sin / cos
    Vx, Vy, Vn = contact.patch_velocity(vx, vy, vz, wx, wy, wz, xx, xy, xz, yx, yy, yz, nx, ny, nz, height, tan)

    deflection = contact.deflection(p.radius, height, cos)
    Fz = contact.vertical_force(p.stiffness, p.damping, deflection, -Vn)
    rolling = contact.rolling_radius(p.radius, max(0.0, deflection)) * (spin + contact.dot(wx, wy, wz, ax, ay, az))
    camber = math.asin(max(-1.0, min(1.0, sin)))

    u, v, kappa, tan_alpha = transient_slip(p, now.u, now.v, h, Fz, Vx, Vx - rolling, Vy)
    Fx, Fy, Mz = magic_formula.forces(p.magic, p.mu, Fz, kappa, tan_alpha, camber)
    My = rolling_moment(p, Fz, rolling)
    next.u, next.v = u, v
    record(out, Fz, Fx, Fy, Mz, kappa, tan_alpha, camber)

    # torque about the centre, in the frame of the patch: the patch is at y = height tan(camber), n = -height
    lever = height * tan
    Tx, Ty, Tn = lever * Fz + height * Fy, -height * Fx, Mz - lever * Fx
    return (
        Fx * xx + Fy * yx + Fz * nx,
        Fx * xy + Fy * yy + Fz * ny,
        Fx * xz + Fy * yz + Fz * nz,
        Tx * xx + Ty * yx + Tn * nx + My * ax,
        Tx * xy + Ty * yy + Tn * ny + My * ay,
        Tx * xz + Ty * yz + Tn * nz + My * az,
    )


@kernel
def transient_slip(p, u, v, h, Fz, Vx, Vsx, Vsy):
    """(u, v, kappa, tan_alpha) of the contact patch after the step h (s). Off the road (Fz = 0) the carcass is free."""
    lag, speed = p.relaxation, abs(Vx)
    u = relaxation.advance(u, -Vsx, speed, lag.longitudinal, h)
    v = relaxation.advance(v, Vsy, speed, lag.lateral, h)
    x, y = magic_formula.normalised_slip(p.magic, p.mu, Fz, u / lag.longitudinal, v / lag.lateral, 0.0)
    rho, motion = magic_formula.magnitude(x, y), speed + abs(Vsx) + abs(Vsy)
    kept = relaxation.limit(lag, rho, motion) if Fz > 0.0 else 0.0
    u, v, damping = kept * u, kept * v, relaxation.damping(lag, speed)
    return u, v, (u - damping * Vsx) / lag.longitudinal, (v + damping * Vsy) / lag.lateral


@kernel
def rolling_moment(p, Fz, rolling):
    """Rolling resistance (Nm) about the spin axis of a wheel that rolls at `rolling` (m/s)."""
    return -p.rolling_resistance * p.radius * Fz * rolling / math.sqrt(rolling**2 + p.rolling_speed**2)


@kernel
def record(out, Fz, Fx, Fy, Mz, kappa, tan_alpha, camber):
    """Write the channels."""
    out.vertical_force = Fz
    out.lateral_force = Fy
    out.longitudinal_force = Fx
    out.slip_angle = math.atan(tan_alpha)
    out.slip_ratio = kappa
    out.camber = camber
    out.aligning_moment = Mz
