"""Magic Formula: the steady force of a rolling tire from its load, slip and camber.

Signs (ISO-W: x forward, y left, z up), used by all of `ars_mujoco.tires`:
    kappa     = -V_sx / |V_x|, positive when driving: Fx has the sign of kappa
    tan_alpha =  V_sy / |V_x|, positive when the contact patch moves to the left: Fy has the opposite sign
    camber    positive about x, the top of the wheel leaning to the right: its thrust points to the right (Fy < 0)
    Mz        positive about z; the trail makes it turn the wheel out of its slip: Mz has the sign of tan_alpha

Combined slip is by similarity (Pacejka, Tyre and Vehicle Dynamics, section 4.3.2), not by weighting functions: the
slips are normalised by the ratio of slip stiffness to friction and the pure curve is read at the length of that vector.
It gives each pure curve exactly, can never leave the friction ellipse, always dissipates, has no pole at a locked
wheel, and goes through zero slip smoothly; and it needs no coefficients beyond those of the pure curves. What it
simplifies: a fully sliding patch is opposed along the normalised slip, some degrees off its sliding velocity.
"""

import math

from pydantic import model_validator

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity

NO_SLIP = 1e-24  # far under the square of any slip: zero slip gets a finite direction, and exactly no force


class MagicFormula(Parameters):
    """Coefficients with Pacejka's names, less shifts; positive where his sign convention makes them negative.

    Lateral: the sedan's set. Longitudinal, camber and trail: of the size published for a 205/60R15 (Pacejka, appendix
    3), grade "judgement".
    """

    Fz0: float = quantity("N", gt=0, default=4000.0)  # nominal load
    Fz_max: float = quantity("N", gt=0, default=10000.0)  # friction and trail are held beyond it: the fits end there
    pCy1: float = number(ge=1, le=2, default=1.35)  # lateral shape
    pDy1: float = number(gt=0, default=1.05)  # lateral friction at Fz0
    pDy2: float = number(default=-0.18)  # its change per dfz = (Fz - Fz0) / Fz0
    pEy1: float = number(le=1, default=-0.8)  # lateral curvature
    pKy1: float = number(gt=0, default=22.0)  # greatest cornering stiffness over Fz0, 1/rad; the sedan's rear has 24.5
    pKy2: float = number(gt=0, default=2.0)  # load of the greatest cornering stiffness over Fz0
    pKy6: float = number(ge=0, default=0.92)  # camber stiffness over Fz, 1/rad
    pCx1: float = number(ge=1, le=2, default=1.65)  # longitudinal shape
    pDx1: float = number(gt=0, default=1.15)  # longitudinal friction at Fz0
    pDx2: float = number(default=-0.10)  # its change per dfz
    pEx1: float = number(le=1, default=0.3)  # longitudinal curvature
    pKx1: float = number(gt=0, default=21.5)  # longitudinal slip stiffness over Fz
    trail: float = quantity("m", ge=0, default=0.03)  # pneumatic trail at Fz0 and no slip; in proportion to the load
    trail_slip: float = number(gt=0, default=2.2)  # normalised slip at which half of the trail is left

    @model_validator(mode="after")
    def _friction_is_positive(self):
        for name, at_nominal, change in (("pDx", self.pDx1, self.pDx2), ("pDy", self.pDy1, self.pDy2)):
            if min(at_nominal - change, at_nominal + change * (self.Fz_max / self.Fz0 - 1.0)) <= 0.0:
                raise ValueError(f"friction {name}1 + {name}2 dfz must be positive at every load up to Fz_max")
        return self


@kernel
def load_change(p, Fz):
    """dfz = (Fz - Fz0) / Fz0, held beyond Fz_max."""
    return min(Fz, p.Fz_max) / p.Fz0 - 1.0


@kernel
def friction(p, mu, Fz):
    """Peak friction coefficients (x, y) at load Fz (N) on a road of friction scale `mu`."""
    dfz = load_change(p, Fz)
    return mu * (p.pDx1 + p.pDx2 * dfz), mu * (p.pDy1 + p.pDy2 * dfz)


@kernel
def cornering_stiffness(p, Fz):
    """Cornering stiffness over load, 1/rad: pKy1 Fz0 sin(2 atan(Fz / (pKy2 Fz0))) / Fz, finite at no load."""
    r = Fz / (p.pKy2 * p.Fz0)
    return 2.0 * p.pKy1 / p.pKy2 / (1.0 + r * r)


@kernel
def normalised_slip(p, mu, Fz, kappa, tan_alpha, camber):
    """Slips (x, y) times slip stiffness over friction: the force is friction x load x slip while they are small."""
    mu_x, mu_y = friction(p, mu, Fz)
    return p.pKx1 / mu_x * kappa, (cornering_stiffness(p, Fz) * tan_alpha + p.pKy6 * camber) / mu_y


@kernel
def magnitude(x, y):
    """Length of a slip (x, y), never quite 0."""
    return math.sqrt(x * x + y * y + NO_SLIP)


@kernel
def shape(C, E, rho):
    """sin(C atan(B rho - E (B rho - atan(B rho)))) with B = 1/C: slope 1 at zero, peak 1."""
    x = rho / C
    return math.sin(C * math.atan(x - E * (x - math.atan(x))))


@kernel
def forces(p, mu, Fz, kappa, tan_alpha, camber):
    """(Fx N, Fy N, Mz Nm) at load Fz (N, >= 0), slips and camber (rad); `mu` scales the friction of the road."""
    mu_x, mu_y = friction(p, mu, Fz)
    x, y = normalised_slip(p, mu, Fz, kappa, tan_alpha, camber)
    rho = magnitude(x, y)
    along = (x / rho) ** 2  # the curve's shape turns with the slip's direction
    curve = shape(p.pCy1 + (p.pCx1 - p.pCy1) * along, p.pEy1 + (p.pEx1 - p.pEy1) * along, rho) / rho
    Fy = -mu_y * Fz * curve * y
    trail = p.trail * (1.0 + load_change(p, Fz)) / (1.0 + (rho / p.trail_slip) ** 2)
    return mu_x * Fz * curve * x, Fy, -trail * Fy
