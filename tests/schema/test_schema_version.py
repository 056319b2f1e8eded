"""The schema version that a file may state."""

import pytest

from ars_mujoco.schema.document import SCHEMA_VERSION, read
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters, quantity


class Bar(Parameters):
    length: float = quantity("m", gt=0)


@pytest.fixture
def written(tmp_path):
    def write(first: str):
        path = tmp_path / "bar.yaml"
        path.write_text(f"{first}\nlength: 1 m\n")
        return path

    return write


@pytest.mark.parametrize("first", ["", *(f"schema_version: {each + 1}" for each in range(SCHEMA_VERSION))])
def test_a_file_states_its_version_or_none(written, first):
    assert read(Bar, written(first), "actuator").value == Bar(length="1 m")


@pytest.mark.parametrize("version", [SCHEMA_VERSION + 1, 0, "two", "[1]"])
def test_a_file_of_a_later_release_is_refused_with_what_is_read(written, version):
    with pytest.raises(InputError, match=rf"bar.yaml: schema_version: .*this release reads 1 to {SCHEMA_VERSION}"):
        read(Bar, written(f"schema_version: {version}"), "actuator")
