"""A rig with a system in it: what a run of both records, where that lies, and whose state another rig refuses."""

from itertools import combinations, product

import numpy as np
import pytest

from ars_mujoco.actuators.registry import actuator_schema, system_for
from ars_mujoco.rigs.rig import rig
from ars_mujoco.schema import library
from ars_mujoco.schema.channels import channels
from ars_mujoco.schema.document import read

RIGS = ("bench", "roll_plane", "sedan")
FILES = [read(actuator_schema(), name, "actuator").value for name in sorted(library.shipped("actuator"))]
SYSTEMS = list(dict.fromkeys(map(system_for, FILES)))
PAIRS = list(product(RIGS, SYSTEMS))
TORSION_BAR = system_for(read(actuator_schema(), "passive", "actuator").value)


def told(value) -> str:
    return value if isinstance(value, str) else value.__name__.removeprefix("ars_mujoco.actuators.")


def names(*blocks) -> set[str]:
    return {channel.name for block in blocks for channel in channels(block)}


def places(dtype: np.dtype, start: int, prefix: str = ""):
    """(dotted name, number of the double) of every number in a record that begins at byte `start`."""
    for name in dtype.names:
        kind, offset = dtype.fields[name][:2]
        if kind.names:
            yield from places(kind, start + offset, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", (start + offset) // 8


@pytest.mark.parametrize("system", SYSTEMS, ids=told)
def test_the_bench_has_no_rear(system):
    bench, car = rig("bench", system).channels, rig("sedan", system).channels
    assert not [name for name in bench if name.startswith("rear.")]
    assert [name for name in bench if name.startswith("front.")] == [name for name in car if name.startswith("front.")]


@pytest.mark.parametrize("name", RIGS)
def test_a_passive_run_records_of_its_bars_their_torsion_alone(name):
    pair, axles = rig(name, TORSION_BAR), ("front",) if name == "bench" else ("front", "rear")
    torsion = {f"{axle}.energy.bar" for axle in axles}
    assert set(pair.channels) == names(pair.frame.output, pair.frame.bars) | torsion


@pytest.mark.parametrize(("name", "system"), PAIRS, ids=told)
def test_a_channel_is_read_where_the_record_has_it(name, system):
    pair = rig(name, system)
    out, start = pair.WORLD.fields["out"][:2]
    written = {}
    for part in out.names:
        kind, offset = out.fields[part][:2]
        written |= dict(places(kind, start + offset))
    assert dict(zip(pair.channels, pair.slots, strict=True)) == {each: written[each] for each in pair.channels}


@pytest.mark.parametrize(("name", "system"), PAIRS, ids=told)
def test_a_pair_is_made_once(name, system):
    assert rig(name, system) is rig(name, system)


@pytest.mark.parametrize("system", SYSTEMS, ids=told)
def test_each_rig_has_a_layout_of_its_own(system):
    for one, other in combinations(RIGS, 2):
        assert rig(one, system).VERSION != rig(other, system).VERSION


@pytest.mark.parametrize("name", RIGS)
def test_each_kind_of_system_has_a_layout_of_its_own(name):
    for one, other in combinations(SYSTEMS, 2):
        if one.NAME != other.NAME:
            assert rig(name, one).VERSION != rig(name, other).VERSION
