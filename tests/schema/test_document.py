"""A file that cannot be used is refused in one error: each problem with its line, key, value and what is allowed."""

import hashlib
import os
from typing import Annotated, Literal

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from pydantic import Field

from ars_mujoco.schema.document import Document, override, read
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters, fill, number, quantity, record_dtype
from ars_mujoco.schema.units import Unit


class Spring(Parameters):
    kind: Literal["spring"]
    stiffness: float = quantity("N/m", gt=0)
    preload: float = quantity("N", default=0.0)


class Damper(Parameters):
    kind: Literal["damper"]
    rate: float = quantity("N*s/m", ge=0)


class Wheel(Parameters):
    mass: float = quantity("kg", gt=0)
    share: float = number(ge=0, le=1, default=0.5)


class Machine(Parameters):
    name: str
    mass: float = quantity("kg", gt=0)
    element: Annotated[Spring | Damper, Field(discriminator="kind")]
    front: Wheel
    rear: Wheel
    knots: list[tuple[Annotated[float, Unit("s")], Annotated[float, Unit("m")]]] = []


GOOD = """\
name: a machine  # of the test
mass: 12 kg
element:
  kind: spring
  stiffness: 3 kN/m
front: &front
  mass: 40 kg
  share: 60 %
rear:
  <<: *front
  mass: 42 kg
knots:
  - [0 s, 0 m]
  - [10 ms, 5 mm]
"""


@pytest.fixture
def machine(tmp_path, monkeypatch):
    """Read a text as a Machine in the file machine.yaml, with settings."""
    monkeypatch.chdir(tmp_path)

    def read_text(text, *settings):
        (tmp_path / "machine.yaml").write_text(text)
        return read(Machine, "machine.yaml", "vehicle", [override(each) for each in settings])

    return read_text


def problems(machine, text, *settings):
    with pytest.raises(InputError) as error:
        machine(text, *settings)
    return list(error.value.problems)


def test_a_file_is_read_in_si(machine):
    value = machine(GOOD).value
    assert (value.name, value.mass, value.element.stiffness) == ("a machine", 12.0, 3000.0)
    assert value.knots == [(0.0, 0.0), (0.01, 0.005)]


def test_a_merged_block_keeps_its_own_values(machine):
    value = machine(GOOD).value
    assert (value.front.mass, value.rear.mass, value.rear.share) == (40.0, 42.0, 0.6)


def test_of_a_list_of_merged_blocks_the_first_that_has_a_key_gives_it(machine):
    both = GOOD.replace("  <<: *front\n  mass: 42 kg", "  <<: [*front, {mass: 7 kg, share: 10 %}, {share: 20 %}]")
    assert (machine(both).value.rear.mass, machine(both).value.rear.share) == (40.0, 0.6)
    turned = GOOD.replace("  <<: *front\n  mass: 42 kg", "  <<: [{share: 20 %}, *front]\n  mass: 42 kg")
    assert (machine(turned).value.rear.mass, machine(turned).value.rear.share) == (42.0, 0.2)


def test_the_hash_is_that_of_the_file(machine):
    assert machine(GOOD).sha256 == hashlib.sha256(GOOD.encode()).hexdigest()


def test_a_schema_is_the_layout_of_a_record(machine):
    wheel = machine(GOOD).value.rear
    record = np.zeros(1, record_dtype(Wheel))[0]
    fill(record, wheel)
    assert (record["mass"], record["share"]) == (wheel.mass, wheel.share)


@pytest.mark.parametrize(
    ("good", "bad", "problem"),
    [
        ("stiffness", "stifness", "5: element.stifness: unknown key; did you mean 'stiffness'?; "),
        ("mass: 12 kg", "mass: -12 kg", "2: mass: '-12 kg': must be greater than 0 kg"),
        ("mass: 12 kg", "mass: nan kg", "2: mass: 'nan kg': not a finite number"),
        ("mass: 12 kg", "mass: 12", "2: mass: '12': needs a unit: kg, t or lb"),
        ("mass: 12 kg", "mass: 12 bar", "2: mass: '12 bar': wrong unit; allowed: kg, t or lb"),
        ("mass: 12 kg", "mass: 12 kgg", "2: mass: '12 kgg': unknown unit 'kgg'; did you mean 'kg'?"),
        ("mass: 12 kg", "mass:", "2: mass: is empty; a value in kg, t or lb"),
        ("mass: 12 kg", "mass: [12 kg]", "2: mass: not a finite number"),
        ("mass: 12 kg", "mass: 12 kg\nmass: 13 kg", "3: mass: stands twice; first on line 2"),
        ("mass: 12 kg", "mass: !!python/name:os.system x", "2: mass: tag "),
        ("mass: 12 kg\n", "", "1: mass: is missing; a value in kg, t or lb"),
        (
            "kind: spring",
            "kind: sprong",
            "4: element.kind: 'sprong': unknown; did you mean 'spring'?; allowed: spring, ",
        ),
        ("kind: spring", "", "3: element.kind: is missing"),
        ("name: a machine", "name: [a, machine]", "1: name: needs a text"),
        ("front: &front\n  mass: 40 kg\n  share: 60 %", "front: &front 3", "6: front: '3': needs a block of keys"),
        ("<<: *front", "<<: [*front, 3]", "10: rear.<<: merges a block of keys, or a list of such blocks"),
        ("<<: *front", "<<: front", "10: rear.<<: merges a block of keys, or a list of such blocks"),
        ("a machine", '"\\e[31mred"', "1: name: holds the character '\\x1b', which is no text"),
        ("a machine", '"\\u202eeno"', "1: name: holds the character '\\u202e', which is no text"),
        ("mass: 12 kg", f"mass: {'9' * 200} m", f"2: mass: '{'9' * 40}... (202 characters)': wrong unit"),
        ("share: 60 %", "share: 120 %", "8: front.share: '120 %': must be at most 100 %"),
        ("[10 ms, 5 mm]", "[10 ms]", "14: knots.1.1: is missing"),
        ("[10 ms, 5 mm]", "[10 ms, 5 bar]", "14: knots.1.1: '5 bar': wrong unit; allowed: m, cm, mm, km, in or ft"),
        ("[10 ms, 5 mm]", "[10 ms, 5 mm", "15: expected ',' or ']'"),
    ],
)
def test_a_problem_is_told_with_its_place(machine, good, bad, problem):
    assert good in GOOD
    assert any(each.startswith("machine.yaml:" + problem) for each in problems(machine, GOOD.replace(good, bad, 1)))


def test_an_unknown_key_lists_the_known_ones(machine):
    text = GOOD.replace("preload", "").replace("  kind: spring", "  kind: spring\n  damping: 3")
    assert problems(machine, text) == [
        "machine.yaml:5: element.damping: unknown key; allowed: kind, stiffness, preload"
    ]


def test_all_problems_are_told_at_once_in_the_order_of_the_lines(machine):
    text = GOOD.replace("12 kg", "12 g").replace("3 kN/m", "0 N/m").replace("42 kg", "42")
    assert [line.split(": ")[0] for line in problems(machine, text)] == [f"machine.yaml:{n}" for n in (2, 5, 11)]


def test_a_setting_replaces_a_value(machine):
    read_machine = machine(GOOD, "mass=13 kg", "rear.share=0.25", "knots=[[0 s, 1 mm]]")
    assert (read_machine.value.mass, read_machine.value.rear.share) == (13.0, 0.25)
    assert read_machine.value.knots == [(0.0, 0.001)]
    assert read_machine.overrides == ("--set mass=13 kg", "--set rear.share=0.25", "--set knots=[[0 s, 1 mm]]")


def test_a_setting_of_a_merged_block_leaves_its_source_alone(machine):
    value = machine(GOOD, "rear.share=0.25").value
    assert (value.front.share, value.rear.share) == (0.6, 0.25)


@pytest.mark.parametrize(
    ("setting", "problem"),
    [
        ("mas=3 kg", "mas: unknown key; did you mean 'mass'?; allowed: name, mass, element, front, rear, knots"),
        ("mass=3 m", "mass: '3 m': wrong unit; allowed: kg, t or lb"),
        ("front.mas=3 kg", "front.mas: unknown key; did you mean 'mass'?; allowed: mass, share"),
        ("mass.front=3 kg", "mass: holds no keys"),
        ("mass", "not a setting; written as key=value, such as duration='3 s'"),
        (".mass=3", "not a setting; written as key=value, such as duration='3 s'"),
    ],
)
def test_a_bad_setting_is_told_as_such(machine, setting, problem):
    assert problems(machine, GOOD, setting) == [f"--set {setting}: {problem}"]


def test_an_alias_of_itself_is_refused(machine):
    (line,) = problems(machine, GOOD.replace("rear:", "rear: &rear\n  self: *rear"))
    assert line == "machine.yaml: nested too deeply, or an alias that refers to itself"


BOMB = "a0: &a0 [x,x,x,x,x,x,x,x,x,x]\n" + "".join(
    f"a{n}: &a{n} [{','.join([f'*a{n - 1}'] * 10)}]\n" for n in range(1, 9)
)
MERGE_BOMB = "a0: &a0 {x: y}\n" + "".join(
    f"a{n}: &a{n} {{<<: [{','.join([f'*a{n - 1}'] * 10)}]}}\n" for n in range(1, 9)
)
EMPTY_MERGE_BOMB = MERGE_BOMB.replace("{x: y}", "{}")


@pytest.mark.parametrize("bomb", [BOMB, MERGE_BOMB, EMPTY_MERGE_BOMB])
def test_aliases_that_repeat_each_other_without_end_are_refused(machine, bomb):
    (line,) = problems(machine, bomb)
    assert line == "machine.yaml: holds more than 50000 values, those counted that aliases repeat"


def test_of_many_problems_the_first_are_told_and_how_many_more(machine):
    lines = problems(machine, GOOD + "".join(f"k{n}: {n}\n" for n in range(5_000)))
    assert [line.split(": unknown")[0] for line in lines[:2]] == ["machine.yaml:15: k0", "machine.yaml:16: k1"]
    assert (len(lines), lines[-1]) == (31, "machine.yaml: and 4970 more")


@pytest.mark.parametrize("text", ["root:x:0:0:secret", "- secret\n- word", "|\n  secret\n  word"])
def test_of_a_file_that_is_none_of_ours_nothing_is_told(machine, text):
    assert problems(machine, text) == ["machine.yaml:1: needs a block of keys"]


def test_no_name_of_a_file_leads_out_of_the_folder_of_results(machine, tmp_path):
    for name in ("...yaml", "..yaml"):
        (tmp_path / name).write_text(GOOD)
        with pytest.raises(InputError, match="is none without its ending; rename it"):
            read(Machine, name, "vehicle")


def test_what_is_no_file_or_too_long_a_one_is_not_read(tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")
    for name in ("/dev/zero", "pipe.yaml", "x" * 5000):
        with pytest.raises(InputError, match="no vehicle '"):
            read(Machine, name, "vehicle", beside=tmp_path)
    (tmp_path / "long.yaml").write_text("#" * 1_000_001)
    with pytest.raises(InputError, match="long.yaml: is too long: more than 1 MB"):
        read(Machine, "long.yaml", "vehicle", beside=tmp_path)


@pytest.mark.parametrize(("content", "problem"), [(b"\xff\xfe\x00", "cannot be read"), (b"a: \x00\x01", "unaccept")])
def test_what_is_no_text_is_refused_in_one_line(tmp_path, content, problem):
    path = tmp_path / "binary.yaml"
    path.write_bytes(content)
    with pytest.raises(InputError, match=rf"^[^\n]*binary\.yaml: {problem}[^\n]*$"):
        read(Machine, path, "vehicle")


@pytest.mark.parametrize("text", ["", "\n", "# only a comment\n", "---\n", "{}"])
def test_an_empty_file_is_told_as_such(machine, text):
    assert problems(machine, text) == ["machine.yaml: is empty"]


def test_a_file_that_holds_a_part_misses_every_other_key(machine):
    lines = problems(machine, "name: a machine\n")
    assert [line.split(":")[2].strip() for line in lines] == ["mass", "element", "front", "rear"]


trees = st.recursive(
    st.none() | st.text("am1 -:'\n", max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(list(Machine.model_fields)), inner),
    max_leaves=12,
)


@given(tree=trees, setting=st.sampled_from(["mass=1 kg", "front.mass=1 kg", "knots.0=3", "element.kind=spring"]))
def test_whatever_yaml_holds_is_read_or_refused_in_clear_lines(tree, setting):
    document = Document("machine.yaml", yaml.safe_dump(tree))
    document.override(override(setting))
    try:
        document.validate(Machine)
    except InputError as error:
        assert all(each.startswith(("machine.yaml:", "--set ")) for each in error.problems)
