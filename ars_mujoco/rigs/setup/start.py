"""Start: a world and the model that carries it, while both are made ready for a run."""

from functools import cached_property

import mujoco
import numpy as np

from ars_mujoco.actuators import stiffest
from ars_mujoco.actuators.registry import system_for
from ars_mujoco.actuators.system import Car, Torsion
from ars_mujoco.bridge.world import NUMERIC, TABLES, new_world
from ars_mujoco.control.control_unit import ControlUnit, check_timing
from ars_mujoco.control.law import Law
from ars_mujoco.kernels.substeps import TooFastError
from ars_mujoco.manoeuvres.cycle import Cycle
from ars_mujoco.rigs.rig import rig
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters, fill
from ars_mujoco.simulation.simulation import Simulation


class Start:
    """A new world of the cycle's rig with `actuator` in it, to be filled through `parameters`, and the simulation whose
    model it is stored in.
    """

    def __init__(
        self, spec: mujoco.MjSpec, cycle: Cycle, actuator: Parameters, unit: ControlUnit, law: Law | None = None
    ):
        self.rig, self.actuator = rig(cycle.rig, system_for(actuator)), actuator
        self.spec, self.cycle, self.unit, self.law = spec, cycle, unit, law
        self.step = spec.option.timestep  # s
        check_timing(unit, self.step)
        self.world = new_world(self.rig.WORLD, self.step)
        self.parameters = self.world[0].parameters
        fill(self.parameters.unit, unit)

    @cached_property
    def simulation(self) -> Simulation:
        """The simulation, compiled with room for the world in userdata and, after the tables, in a custom numeric.

        Raises InputError where MuJoCo refuses the vehicle's model.
        """
        size = self.world.nbytes // 8
        self.spec.nuserdata = size
        tables = self.rig.TABLES_SIZE
        self.spec.add_numeric(name=TABLES, size=tables, data=np.zeros(tables))
        self.spec.add_numeric(name=NUMERIC, size=size, data=np.zeros(size))
        try:
            model = self.spec.compile()
        except ValueError as error:
            raise InputError(f"vehicle: MuJoCo refuses its model: {'; '.join(str(error).splitlines())}") from None
        return Simulation(self.rig, model, self.cycle.duration, self.cycle.title, self.law)

    def fill_system(self, front: Torsion, rear: Torsion | None, has_road: bool) -> None:
        """Write the bars' torsions, the inputs that the cycle commands, and the system at rest.

        Raises InputError where the actuator's values do not go together, with the one at fault where that can be told.
        """
        parameters, system, inputs = self.parameters, self.rig.system, {}
        parameters.bars.front = front.stiffness
        parameters.bars.rear = rear.stiffness if rear else 0.0
        for i, name in enumerate(system.INPUTS):
            inputs[name] = parameters.inputs[i] = getattr(self.cycle.inputs, name).signal()
        car = Car(front, rear, self.unit, inputs, has_road)

        def fill_from(file: Parameters, car: Car) -> None:
            system.fill(parameters.system, file, car, self.step)

        try:
            fill_from(self.actuator, car)
            system.start(parameters.system, self.world[0].now.system)
        except TooFastError as error:
            raise stiffest.told(error, fill_from, self.actuator, car) from None
        except (np.linalg.LinAlgError, ArithmeticError) as error:
            raise InputError(f"actuator: its values do not go together: {error}") from None

    def stored(self) -> Simulation:
        """The simulation, with the world as it is now written into its model."""
        model = self.simulation.model
        model.numeric_data[-model.nuserdata :] = self.world.view(np.float64).reshape(-1)
        return self.simulation
