"""Start: a world and the model that carries it, while both are made ready for a run."""

from functools import cached_property
from types import ModuleType

import mujoco
import numpy as np

from ars_mujoco.actuators.actuator import Actuator, fill_axle, start_axle
from ars_mujoco.bridge.world import NUMERIC, new_world
from ars_mujoco.control.law import Law
from ars_mujoco.manoeuvres.cycle import Cycle
from ars_mujoco.schema.errors import InputError
from ars_mujoco.simulation.simulation import Simulation


class Start:
    """A new world of `rig`, to be filled through `parameters`, and the simulation whose model it is stored in."""

    def __init__(self, rig: ModuleType, spec: mujoco.MjSpec, cycle: Cycle, law: Law | None):
        self.rig, self.spec, self.cycle, self.law = rig, spec, cycle, law
        self.step = spec.option.timestep  # s
        self.world = new_world(rig.WORLD, self.step)
        self.parameters = self.world[0].parameters

    @cached_property
    def simulation(self) -> Simulation:
        """The simulation, compiled with room for the world in userdata and in the last custom numeric.

        Raises InputError where MuJoCo refuses the vehicle's model.
        """
        size = self.world.nbytes // 8
        self.spec.nuserdata = size
        self.spec.add_numeric(name=NUMERIC, size=size, data=np.zeros(size))
        try:
            model = self.spec.compile()
        except ValueError as error:
            raise InputError(f"vehicle: MuJoCo refuses its model: {'; '.join(str(error).splitlines())}") from None
        return Simulation(self.rig, model, self.cycle.duration, self.cycle.title, self.law)

    def fill_stabilizer(self, axle: str, actuator: Actuator, stiffness: float, passive_stiffness: float) -> None:
        """Write an axle ("front" or "rear") of `actuator` as `actuator.fill_axle` does, at rest and charged."""
        stabilizers = self.parameters.stabilizers
        bypassed = bool(np.any(getattr(self.cycle.valves, f"{axle}_bypass").signal().values))
        fill_axle(stabilizers[axle], actuator, axle, stiffness, passive_stiffness, self.step, bypassed)
        start_axle(stabilizers[axle], self.world[0].now.stabilizers[axle])
        for valve in ("bypass", "fail_safe"):
            stabilizers[f"{axle}_valves"][valve] = getattr(self.cycle.valves, f"{axle}_{valve}").signal()

    def stored(self) -> Simulation:
        """The simulation, with the world as it is now written into its model."""
        model = self.simulation.model
        model.numeric_data[-model.nuserdata :] = self.world.view(np.float64).reshape(-1)
        return self.simulation
