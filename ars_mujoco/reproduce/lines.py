"""Claims about the hydraulic lines (section 4.2.1)."""

import math

from ars_mujoco.analysis.hydraulic_poles import pole_pair
from ars_mujoco.analysis.parameter_box import TABLE_2
from ars_mujoco.reproduce.claim import Finding, Group, Number, apart, does_not_follow, holds
from ars_mujoco.reproduce.evidence import Evidence
from ars_mujoco.reproduce.sizing import BAR, SLOWEST

BORE, DENSITY, BULK_MODULUS = 0.010, 860.0, 1.4e9  # m, kg/m^3, Pa: stated values, the paper gives none
VISCOSITY = 46e-6, 10e-6  # m^2/s, warm and hot
LAMINAR = 2300.0
NEGLIGIBLE = 0.05
AREA = 0.25 * math.pi * BORE**2

GROUP = Group("Hydraulic lines (section 4.2.1)")


@GROUP.claim("section 4.2.1", "The forces that accelerate the oil in the lines are negligible beside the payload's.")
def oil_mass(evidence: Evidence) -> Finding:
    length = evidence.V_L / AREA
    short, long = (_reflected_inertia(evidence, each) for each in (2.0, length))
    frequency, damping = pole_pair(evidence.loop)
    heavier, _ = pole_pair(evidence.loop.at({"inertia": evidence.theta + long}))
    return Finding(
        ours=(
            Number("oil of two lines as inertia at the motor, 2 m", short, "kg m^2"),
            Number(f"the same, {length:.2f} m, which is Table 1's V_L", long, "kg m^2"),
            Number("Theta, Table 2", TABLE_2["inertia"], "kg m^2"),
            Number("omega_H with Theta alone and with the oil beside it", (heavier, frequency), "rad/s"),
        ),
        verdict=holds(long < NEGLIGIBLE * evidence.theta, does_not_follow("eq. 35 and Table 1")),
        why=f"rho l/A_L of eq. 35 times D^2, for bores of 10 mm: {long / evidence.theta:.1f} times Theta. The lower "
        "frequency has the oil's mass move with the motor, as it does where the oil yields at the pump.",
    )


@GROUP.claim("eqs. 36 to 39", "With laminar flow the pressure loss is 32 rho l nu v/d^2.")
def laminar_loss(evidence: Evidence) -> Finding:
    length, speed = evidence.V_L / AREA, evidence.full_flow / AREA
    reynolds = tuple(speed * BORE / viscosity for viscosity in VISCOSITY)
    loss = 32.0 * DENSITY * length * VISCOSITY[0] * speed / BORE**2
    friction = 0.5 * DENSITY * speed**2 * length / BORE * 64.0 / reynolds[0]
    return Finding(
        ours=(
            Number("Reynolds number at full flow, 46 and 10 mm^2/s", reynolds),
            Number("loss by eq. 39", loss / BAR, "bar"),
            Number("by eqs. 36 to 38", friction / BAR, "bar"),
        ),
        verdict=holds(apart(loss, friction) < 1e-9 and max(reynolds) < LAMINAR, does_not_follow("eq. 37")),
        why=f"Laminar below {LAMINAR:g} at the running pump's full flow in bores of 10 mm; at 6000 rpm and hot the "
        f"Reynolds number is {max(reynolds) * 4.0 * SLOWEST / evidence.speed:.0f}.",
    )


@GROUP.claim("Tables 1 and 2, eq. 32", "The hydraulic capacitance is 4e-14 to 8e-14 m^3/Pa.")
def capacitance_range(evidence: Evidence) -> Finding:
    volume = evidence.V_L + evidence.D * evidence.phi_n
    least, greatest = TABLE_2["capacitance"]
    ours = 0.5 * volume / BULK_MODULUS
    moduli = tuple(0.5 * volume / each / 1e9 for each in (greatest, least))
    return Finding(
        paper=(Number("C_H", TABLE_2["capacitance"], "m^3/Pa"),),
        ours=(
            Number("C_H of Table 1's volume with 1.4 GPa", ours, "m^3/Pa"),
            Number("bulk modulus that Table 2 needs", moduli, "GPa"),
        ),
        verdict=holds(least <= ours <= greatest, does_not_follow("Table 1 and eq. 32")),
        why=f"V_L and the motor's chamber in its middle are {1e6 * volume:.0f} cm^3 a side; mineral oil has 1.2 to "
        "1.8 GPa. Table 1's V_L is also just half of V_M, so it may be a chamber's volume instead of a line's.",
    )


def _reflected_inertia(evidence: Evidence, length: float) -> float:
    """Inertia (kg m^2) that the oil of two lines of `length` (m) adds at the motor: eq. 35 times D^2."""
    return 2.0 * DENSITY * length / AREA * evidence.D**2
