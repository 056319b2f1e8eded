"""The kernels know nothing of what is around them."""

import subprocess
import sys

import pytest

KERNELS = (
    "actuators.pump_controlled.third_order_circuit", "actuators.pump_controlled.drive_speed", "hydraulics.pump",
    "control.accelerometer", "tires.tire", "driving.driver", "machines.electric_drive",
)  # fmt: skip


@pytest.mark.parametrize("kernel", KERNELS)
def test_a_kernel_imports_no_simulator_no_viewer_and_no_table(kernel):
    program = f"import sys, ars_mujoco.{kernel}; print({{'mujoco', 'rerun', 'pyarrow', 'typer'}} & set(sys.modules))"
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert result.stdout.strip() == "set()"
