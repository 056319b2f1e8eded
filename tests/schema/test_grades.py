"""Grades: where the values of a file come from, as the comment beside each says."""

from ars_mujoco.schema.library import grades, shipped


def test_the_comments_beside_the_values_are_counted(tmp_path):
    path = tmp_path / "bar.yaml"
    path.write_text("# J  not a value\na: 1 m   # T\nb: 2 m  # J  usual\nc: 3 m  # Just a remark\nd: 4 m # J  too\n")
    assert grades(path) == {"T": 1, "J": 2}


def test_every_active_actuator_says_where_its_values_come_from():
    graded = {name: sum(grades(path).values()) for name, path in shipped("actuator").items()}
    assert all(count > 20 for name, count in graded.items() if name not in ("none", "passive", "locked")), graded
