"""The command `ars reproduce`."""

import json
import sys

import pytest
from typer.testing import CliRunner

from ars_mujoco.cli import app as cli
from ars_mujoco.reproduce import reproduce as command
from ars_mujoco.reproduce.claim import Kind
from ars_mujoco.schema.errors import InputError


def test_it_writes_a_page_and_all_numbers(written, claims):
    assert {path.name for path in written.folder.iterdir()} == {"reproduce.html", "reproduce.json"}
    numbers = json.loads((written.folder / "reproduce.json").read_text())
    assert numbers == json.loads(json.dumps(written.numbers))
    assert set(numbers["analyses"]) == set(command.ANALYSES)
    assert [each["id"] for group in numbers["groups"] for each in group["claims"]] == list(claims)


def test_the_numbers_have_units_and_the_inputs_hashes(written):
    numbers, kinds = written.numbers, set(map(str, Kind))
    assert numbers["schema_version"] == 1
    assert len(numbers["inputs_sha256"]) == 64
    assert all(len(part["sha256"]) == 64 for each in numbers["inputs"] for part in each.values())
    found = [each for group in numbers["groups"] for each in group["claims"]]
    assert sum(numbers["verdicts"].values()) == len(found)
    for each in found:
        assert each["verdict"]["kind"] in kinds
        assert each["ours"]
        assert all(set(number) == {"name", "value", "unit"} for number in each["paper"] + each["ours"])


def test_every_claim_has_an_id_of_its_own(claims):
    assert len(claims) == sum(len(group.functions) for group in command.GROUPS)


def test_progress_ends_at_one_for_every_group(written):
    assert set(written.progress.values()) == {1.0}
    assert len(written.progress) == len(command.GROUPS)


@pytest.fixture
def ars(monkeypatch, written):
    """Run `ars reproduce` with what was computed already; returns stdout."""
    monkeypatch.setattr(command, "reproduce", lambda *_: written.numbers)
    return lambda *arguments: CliRunner().invoke(cli.app, ["reproduce", *arguments], catch_exceptions=False).stdout


def test_it_prints_every_claim_with_its_verdict(ars, claims):
    out = ars("--out", "here")
    assert "Page: here/reproduce.html" in out
    assert all(each.text[:20] in out for each in claims.values())
    assert "[x, x, x']" in out


def test_it_is_machine_readable(ars, written):
    printed = json.loads(ars("--json"))
    assert printed.pop("folder") == "runs/reproduce"
    assert printed == json.loads(json.dumps({key: written.numbers[key] for key in printed}))
    assert set(printed) == set(written.numbers) - {"analyses"}


def test_a_folder_that_cannot_be_written_to_is_refused_before_anything_runs(evidence, tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="cannot be written to"):
        command.reproduce(evidence, tmp_path / "file" / "out", lambda *_: pytest.fail("it ran"))


def test_a_missing_package_is_named_with_the_extra_that_brings_it(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    for name in [each for each in sys.modules if each.startswith(("ars_mujoco.reproduce", "ars_mujoco.analysis"))]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delattr("ars_mujoco.reproduce")
    monkeypatch.delattr("ars_mujoco.analysis")
    monkeypatch.setitem(sys.modules, "control", None)
    with pytest.raises(InputError, match=r"ars reproduce needs the package 'control'.*ars_mujoco\[analysis\]"):
        CliRunner().invoke(cli.app, ["reproduce"], catch_exceptions=False)
