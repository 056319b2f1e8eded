"""Temperature: what a warmer, thinner oil changes in a circuit whose values are stated at 50 degC."""

from ars_mujoco.actuators.pump_controlled.third_order_circuit import Circuit, ReducedCircuit
from ars_mujoco.hydraulics.oil import stiffness_ratio, viscosity_ratio

# in proportion to the viscosity, and in proportion to its inverse (laminar gaps)
THICKER = {"motor": ("viscous_friction",), "control_cylinder": ("viscous_friction",)}
THINNER = {
    "pump": ("leakage",),
    "motor": ("leakage",),
    "control_cylinder": ("internal_leakage", "external_leakage"),
    "metering_edge": ("leakage",),
}


def at_temperature(circuit: Circuit) -> Circuit:
    """`circuit` with viscous friction, laminar leakages and stated capacitance at its oil's temperature; as it is where
    none is stated.

    Lines take the viscosity itself, and the full circuit's volumes the bulk modulus. A pump's measured loss polynomials
    hold at the temperature they were measured at.
    """
    if circuit.oil is None:
        return circuit
    ratio = viscosity_ratio(circuit.oil)
    changed = {}
    for names, factor in ((THICKER, ratio), (THINNER, 1.0 / ratio)):
        for block, keys in names.items():
            part = changed.get(block, getattr(circuit, block))
            if part is not None:
                changed[block] = part.model_copy(update={key: factor * getattr(part, key) for key in keys})
    if isinstance(circuit, ReducedCircuit):
        softer = circuit.line.capacitance / stiffness_ratio(circuit.oil)
        changed["line"] = circuit.line.model_copy(update={"capacitance": softer})
    else:
        changed["tank_leakage"] = circuit.tank_leakage / ratio
    return circuit.model_copy(update=changed)
