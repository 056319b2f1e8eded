"""Contact of a wheel, a thin disc, with a road that is a plane under it.

The patch is where the wheel's plane, followed down from its centre, meets the road (ISO 8855 contact centre). Its frame
is x forward along the wheel's plane, y left in the road's plane, n the road's normal. Vectors are three floats in world
axes; the spin axis points left, so that a positive spin rolls forward.
"""

import math

from ars_mujoco.kernels.kernel import kernel

FLAT_ON_ITS_SIDE = 1e-9  # least cosine of the camber: a wheel that lies on the road has no direction to roll in


@kernel
def dot(ax, ay, az, bx, by, bz):
    """Scalar product."""
    return ax * bx + ay * by + az * bz


@kernel
def cross(ax, ay, az, bx, by, bz):
    """Vector product."""
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


@kernel
def normal(slope_x, slope_y):
    """Unit normal of a road that rises by slope_x forward and slope_y to the left."""
    nz = 1.0 / math.sqrt(1.0 + slope_x * slope_x + slope_y * slope_y)
    return -slope_x * nz, -slope_y * nz, nz


@kernel
def heading(ax, ay, az, nx, ny, nz):
    """Unit vector x forward, and cos and sin of the camber, of a wheel with spin axis a on a road with normal n."""
    x, y, z = cross(ax, ay, az, nx, ny, nz)
    cos = max(math.sqrt(x * x + y * y + z * z), FLAT_ON_ITS_SIDE)
    inverse = 1.0 / cos
    return x * inverse, y * inverse, z * inverse, cos, dot(ax, ay, az, nx, ny, nz)


@kernel
def deflection(radius, height, cos):
    """How far (m) the lowest point of the disc is in the road, its centre `height` (m) above the road's plane."""
    return radius * cos - height


@kernel
def patch_velocity(vx, vy, vz, wx, wy, wz, xx, xy, xz, yx, yy, yz, nx, ny, nz, height, tan_camber):
    """Velocity (m/s) of the contact patch along x, y and n, from the hub's velocity v and angular velocity w.

    The patch does not turn with the hub about the spin axis, so only the rotation about x moves it.
    """
    lean = dot(wx, wy, wz, xx, xy, xz)
    along_x = dot(vx, vy, vz, xx, xy, xz)
    along_y = dot(vx, vy, vz, yx, yy, yz) + height * lean
    along_n = dot(vx, vy, vz, nx, ny, nz) + height * tan_camber * lean
    return along_x, along_y, along_n


@kernel
def rolling_radius(radius, deflection):
    """Effective rolling radius (m): between the unloaded and the loaded one, R - deflection / 3."""
    return radius - deflection / 3.0


@kernel
def vertical_force(stiffness, damping, deflection, rate):
    """Load (N) of the tire's spring (N/m) and damper (Ns/m): it never pulls, and is zero off the road."""
    if deflection <= 0.0:
        return 0.0
    return max(0.0, stiffness * deflection + damping * rate)
