"""Records of one axle's circuit: its parameters and its state, in the lockstep of the verification set or in detail."""

from ars_mujoco.actuators.pump_controlled.full_circuit import Detail, DetailState, FullCircuitEnergy
from ars_mujoco.actuators.pump_controlled.third_order_circuit import CircuitEnergy, CircuitState, ReducedCircuit
from ars_mujoco.schema.parameters import Parameters, number, quantity


class Axle(Parameters):
    """Parameters of one axle's circuit."""

    stiffness: float = quantity("Nm/rad", ge=0)  # torsion of the bar, both halves in series
    substeps: float = number(ge=0)  # of the circuit in a physics step; 0: the axle has no circuit
    circuit: ReducedCircuit


class AxleState(Parameters):
    """State of one axle's circuit."""

    circuit: CircuitState
    energy: CircuitEnergy


class DetailedAxle(Parameters):
    """The same, at any stage of pump control before either plant.

    What it has more comes first: a record that begins like another passes for it with numba, and is warned of.
    """

    detail: Detail
    stiffness: float = quantity("Nm/rad", ge=0)
    substeps: float = number(ge=0)
    circuit: ReducedCircuit


class DetailedAxleState(Parameters):
    """Its state."""

    detail: DetailState
    circuit: CircuitState
    energy: FullCircuitEnergy
