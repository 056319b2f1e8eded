"""Claims about the hydraulic lines (section 4.2.1)."""

from dataclasses import replace

import numpy as np

from ars_mujoco.analysis.line_inertance import limits, reflected_inertia, without_oil_mass
from ars_mujoco.analysis.loop import LOW_SIDE_HELD
from ars_mujoco.analysis.parameter_box import TABLE_2
from ars_mujoco.hydraulics.pipe import LAMINAR, pressure_drop, reynolds
from ars_mujoco.reproduce.claim import Finding, Group, Number, apart, does_not_follow, holds
from ars_mujoco.reproduce.evidence import Evidence
from ars_mujoco.reproduce.sizing import BAR

NEGLIGIBLE = 0.05  # of Theta
EQUAL = 1e-9  # relative; two forms of one equation agree to this

GROUP = Group("Hydraulic lines (section 4.2.1)")


@GROUP.claim("section 4.2.1", "The forces that accelerate the oil in the lines are negligible beside the payload's.")
def oil_mass(evidence: Evidence) -> Finding:
    loop, length = replace(evidence.full_loop, checks=LOW_SIDE_HELD), float(evidence.pipe.length)
    reflected = float(reflected_inertia(loop))
    massless, heavy = (limits(each) for each in (without_oil_mass(loop), loop))
    return Finding(
        ours=(
            Number(f"oil of two lines of {length:.2f} m as inertia at the motor", reflected, "kg m^2"),
            Number("of two lines of 2 m", reflected * 2.0 / length, "kg m^2"),
            Number("Theta, Table 2", TABLE_2["inertia"], "kg m^2"),
            Number("omega_H of the full circuit without the oil's mass", massless["frequency"], "rad/s"),
            Number("with it", heavy["frequency"], "rad/s"),
            Number("stable K_p without the oil's mass", massless["stable"], "1/rad"),
            Number("with it", heavy["stable"], "1/rad"),
        ),
        verdict=holds(reflected < NEGLIGIBLE * evidence.theta, does_not_follow("eq. 35 and Table 1")),
        why=f"rho l/A_L of eq. 35 for both lines times D^2 is {reflected / evidence.theta:.1f} times Theta: "
        f"{length:.2f} m of 10 mm bore hold Table 1's V_L. The full circuit is linearized with its low-pressure side "
        "held, as the paper assumes.",
    )


@GROUP.claim("eqs. 36 to 39", "The flow in the lines is laminar, and its pressure loss 32 rho l nu v/d^2.")
def laminar_loss(evidence: Evidence) -> Finding:
    pipe, fluid, flow = evidence.pipe, evidence.fluid, evidence.full_flow
    speed = flow / (0.25 * np.pi * float(pipe.diameter) ** 2)
    printed = float(32.0 * fluid.density * pipe.length * fluid.viscosity * speed / pipe.diameter**2)
    running, number = float(pressure_drop(pipe, fluid, flow)), float(reynolds(pipe, fluid, flow))
    fastest = number * TABLE_2["speed"][1] / evidence.speed
    return Finding(
        ours=(
            Number("Reynolds number at full flow", number),
            Number("at full flow and 6000 rpm", fastest),
            Number("loss of one line, running code", running / BAR, "bar"),
            Number("by eq. 39", printed / BAR, "bar"),
        ),
        verdict=holds(apart(printed, running) < EQUAL and fastest < LAMINAR, does_not_follow("eq. 37")),
        why=f"Laminar up to {LAMINAR:g}, in a bore of 10 mm with {1e6 * float(fluid.viscosity):.0f} mm^2/s; hot oil of "
        f"{1e6 * float(fluid.viscosity) * fastest / LAMINAR:.0f} mm^2/s would turn turbulent at 6000 rpm.",
    )


@GROUP.claim("Tables 1 and 2, eq. 32", "The hydraulic capacitance is 4e-14 to 8e-14 m^3/Pa.")
def capacitance_range(evidence: Evidence) -> Finding:
    volume, modulus = evidence.V_L + evidence.D * evidence.phi_n, float(evidence.fluid.bulk_modulus)
    least, greatest = TABLE_2["capacitance"]
    ours = 0.5 * volume / modulus
    moduli = tuple(0.5 * volume / each / 1e9 for each in (greatest, least))
    return Finding(
        paper=(Number("C_H", TABLE_2["capacitance"], "m^3/Pa"),),
        ours=(
            Number("C_H of Table 1's volume", ours, "m^3/Pa"),
            Number("bulk modulus that Table 2 needs", moduli, "GPa"),
        ),
        verdict=holds(least <= ours <= greatest, does_not_follow("Table 1 and eq. 32")),
        why=f"V_L and the motor's chamber in its middle are {1e6 * volume:.0f} cm^3 a side; oil has "
        f"{modulus / 1e9:.1f} GPa here, air and walls aside. Table 1's V_L is "
        f"{evidence.V_L / (2.0 * np.pi * evidence.D):.3f} of V_M: it may be a chamber's volume instead of a line's.",
    )
