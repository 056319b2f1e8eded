"""Shipped things are found by name, a user's own by path, and an unknown one is answered with the nearest."""

import pytest

from ars_mujoco.schema import library
from ars_mujoco.schema.errors import InputError


def test_the_shipped_cycles_are_those_of_the_project():
    assert list(library.shipped("cycle")) == [
        "bench_ends_free",
        "bench_fail_safe",
        "bench_recorded",
        "bench_s_curve",
        "bench_sine",
        "bench_step_10deg",
        "bench_step_1deg",
        "bench_sweep",
        "robot_step",
        "roll_plane_step",
        "s_curve_120kmh",
        "single_wheel_bump",
        "single_wheel_bump_decoupled",
        "steady_circle_iso4138",
        "step_steer_iso7401",
    ]


def test_the_other_kinds_ship_too():
    assert {"none", "passive", "locked", "pump_controlled"} <= set(library.shipped("actuator"))
    assert {"cascade", "verification"} <= set(library.shipped("controller"))
    assert {"bench", "roll_plane", "sedan"} <= set(library.shipped("vehicle"))


@pytest.mark.parametrize("kind", library.SHIPPED)
def test_a_name_finds_its_file(kind):
    for name, path in library.shipped(kind).items():
        assert library.find(kind, name) == path
        assert path.is_file()


def test_a_path_finds_its_file(tmp_path, monkeypatch):
    (tmp_path / "mine.yaml").write_text("")
    monkeypatch.chdir(tmp_path)
    assert library.find("cycle", "mine.yaml").samefile(tmp_path / "mine.yaml")


def test_a_relative_path_starts_where_it_is_told(tmp_path):
    (tmp_path / "mine.yaml").write_text("")
    assert library.find("cycle", "mine.yaml", tmp_path) == tmp_path / "mine.yaml"


def test_an_unknown_name_is_answered_with_the_nearest_and_all():
    with pytest.raises(InputError) as error:
        library.find("actuator", "pasive")
    assert str(error.value) == (
        "no actuator 'pasive'; did you mean 'passive'? shipped: electro_hydrostatic, electromechanical, locked, "
        "none, passive, pump_controlled, pump_controlled_full, robot_joint, valve_controlled, verification"
    )


def test_a_missing_file_is_answered_with_the_nearest_beside_it(tmp_path):
    (tmp_path / "mine.yaml").write_text("")
    with pytest.raises(InputError, match=r"did you mean '.*mine\.yaml'\?"):
        library.find("cycle", tmp_path / "mien.yaml")


@pytest.mark.parametrize("name", ["x.**", "x.[", "*.yaml", "?", "", ".", "..", "/"])
def test_whatever_is_no_file_is_answered_in_one_line(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder.yaml").mkdir()
    with pytest.raises(InputError) as error:
        library.find("vehicle", name)
    assert str(error.value) == f"no vehicle '{name}'; shipped: bench, robot_joint, roll_plane, sedan"


def test_a_folder_is_no_file(tmp_path):
    (tmp_path / "folder.yaml").mkdir()
    with pytest.raises(InputError, match=r"no vehicle '.*folder\.yaml'; shipped: "):
        library.find("vehicle", tmp_path / "folder.yaml")


def test_a_path_that_an_installed_package_does_not_have_is_answered_with_the_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match=r"did you mean 's_curve_120kmh'\?"):
        library.find("cycle", "cycles/s_curve_120kmh.yaml")
