"""Fitting losses: known coefficients come back, within what the noise allows, and bad data is refused."""

from itertools import product

import numpy as np
import pytest

from ars_mujoco.analysis.fit_losses import fit, fit_losses, remarks
from ars_mujoco.analysis.measurements import Measurements, read_measurements
from ars_mujoco.schema.errors import InputError

RPM, BAR, V = 2 * np.pi / 60, 1e5, 1.8e-6 / (2 * np.pi)
SPEED, PRESSURE = 6000 * RPM, 200 * BAR
FLOW = {(0, 0, 1): 0.03, (0, 0, 2): 0.01, (1, 1, 0): 0.004}
TORQUE = {(0, 0, 0): 0.02, (0, 1, 0): 0.03, (0, 0, 1): 0.025, (1, 0, 1): 0.03, (0, 2, 0): 0.01}
HEADER = "speed (rpm),pressure (bar),displacement (cm^3/rev),flow (L/min),torque (Nm)"


def share(terms, x, n, y):
    return sum(value * x**i * n**j * y**k for (i, j, k), value in terms.items())


def measured(flow=FLOW, torque=TORQUE, noise=0.0, seed=0) -> Measurements:
    """Points in all four quadrants of a pump with these losses, with noise as a share of their norms."""
    random = np.random.default_rng(seed)
    points = product(np.linspace(-1, 1, 9), np.linspace(0.2, 1, 5) * SPEED, np.linspace(-1, 1, 8) * PRESSURE)
    stroke, speed, pressure = np.transpose(list(points))
    sizes = np.abs(stroke), speed / SPEED, np.abs(pressure) / PRESSURE
    lost = share(flow, *sizes) + noise * random.normal(size=stroke.shape)
    paid = share(torque, *sizes) + noise * random.normal(size=stroke.shape)
    return Measurements(
        speed, pressure, stroke, V * (stroke * speed - np.sign(pressure) * SPEED * lost),
        V * (stroke * pressure + PRESSURE * paid), V,
    )  # fmt: skip


def written(points: Measurements, path, header=HEADER):
    columns = (points.speed / RPM, points.pressure / BAR, points.stroke * 1.8, points.flow * 6e4, points.torque)
    path.write_text("\n".join([header, *(",".join(map(repr, map(float, row))) for row in zip(*columns, strict=True))]))
    return path


@pytest.fixture
def data(tmp_path):
    return written(measured(), tmp_path / "pump.csv")


def test_known_coefficients_come_back():
    for found, known in zip(fit(measured(), (1, 2, 2)), (FLOW, TORQUE), strict=True):
        for term, value in found.loss.terms.items():
            assert value == pytest.approx(known.get(term, 0.0), abs=1e-12)
        assert found.r_squared == pytest.approx(1.0)


@pytest.mark.parametrize("orders", [(0, 0, 0), (1, 2, 3), (4, 4, 3), (2, 0, 1)])
def test_the_number_of_coefficients_is_eq_23(orders):
    p, q, r = orders
    for found in fit(measured(), orders):
        assert len(found.loss.coefficients) == (p + 1) * (q + 1) * (r + 1)
        assert found.loss.order == max(orders)


def test_noise_scatters_the_coefficients_as_their_standard_errors_say():
    pulls = []
    for seed in range(40):
        for found, known in zip(fit(measured(noise=1e-3, seed=seed), (1, 2, 2)), (FLOW, TORQUE), strict=True):
            terms = zip(found.loss.terms.items(), found.errors.values(), strict=True)
            pulls += [(value - known.get(term, 0.0)) / error for (term, value), error in terms]
    assert np.mean(pulls) == pytest.approx(0.0, abs=0.1)
    assert np.std(pulls) == pytest.approx(1.0, abs=0.05)


def test_residuals_are_the_noise():
    flow, torque = fit(measured(noise=1e-3), (1, 2, 2))
    assert np.std(flow.residuals) == pytest.approx(1e-3 * V * SPEED, rel=0.1)
    assert np.std(torque.residuals) == pytest.approx(1e-3 * V * PRESSURE, rel=0.1)


def test_the_range_is_that_of_the_points():
    for found in fit(measured(), (1, 1, 1)):
        assert found.loss.limits == ((0.0, 1.0), (0.2 * SPEED, SPEED), pytest.approx((PRESSURE / 7, PRESSURE)))


def test_a_loss_that_is_negative_in_its_range_is_told(tmp_path):
    path = written(measured(torque=TORQUE | {(0, 0, 0): -0.02}), tmp_path / "pump.csv")
    result = fit_losses(path, (1, 2, 2), tmp_path / "out")
    assert remarks(result) == ["the torque loss is negative somewhere in its range; the simulation takes zero there"]
    least = -0.02 + 0.03 * 0.2 + 0.01 * 0.04 + 0.025 / 7
    assert result["torque_loss"]["least_loss"] == pytest.approx(V * PRESSURE * least)


def test_a_file_is_read_in_its_own_units(data):
    read, made = read_measurements(data), measured()
    assert read.displacement == pytest.approx(V)
    for name in ("speed", "pressure", "stroke", "flow", "torque"):
        assert getattr(read, name) == pytest.approx(getattr(made, name), rel=1e-12, abs=1e-18)


def test_a_stroke_may_stand_for_the_displacement(tmp_path):
    path = tmp_path / "pump.csv"
    path.write_text("stroke (%),flow (L/min),torque (Nm),pressure (MPa),speed (rad/s),oil (degC)\n50,1,2,3,4,55\n")
    points = read_measurements(path, V)
    assert (points.stroke, points.pressure, points.displacement) == (0.5, 3e6, V)
    with pytest.raises(InputError, match="a stroke needs the full displacement: --displacement"):
        read_measurements(path)


def test_losses_for_another_size_keep_their_coefficients(data, tmp_path):
    result = fit_losses(data, (1, 2, 2), tmp_path / "out", scale_to="14.4 cm^3/rev")
    for name, growth in (("flow_loss", 4.0), ("torque_loss", 8.0)):
        own, scaled = result[name], result["scaled_to"][name]
        assert scaled["coefficients"] == own["coefficients"]
        assert scaled["norm"] == pytest.approx(growth * own["norm"])
        assert scaled["normal_speed"] == pytest.approx(own["normal_speed"] / 2)
    assert "displacement: 14.4 cm^3/rev" in (tmp_path / "out" / "losses.yaml").read_text()


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("", "is empty"),
        (HEADER, "holds a header but no points"),
        (HEADER.replace("bar", "mm"), "line 1: 'pressure (mm)': wrong unit; allowed: Pa, kPa, MPa, bar or psi"),
        (HEADER.replace("speed (rpm)", "speed"), "line 1: 'speed': needs a unit"),
        (HEADER.replace("rpm", "rqm"), "line 1: 'speed (rqm)': unknown unit 'rqm'; did you mean 'rpm'?"),
        (HEADER.replace("torque", "torqe"), r"column 'torque (UNIT)' is missing; did you mean 'torqe'?"),
        (HEADER.replace("torque (Nm)", "flow (L/min)"), "flow: stands twice"),
        (HEADER + "\n3000,100,1.8,nan,3", "pump.csv: line 2: flow: 'nan': not a finite number"),
        (HEADER + "\n3000,100,1.8,5", "pump.csv: line 2 has 4 cells, the header 5"),
        (HEADER + "\n0,100,1.8,5,3", "pump.csv: line 2: speed: '0': must be greater than 0 rpm"),
        (HEADER + "\n3000,100,0,5,3", "displacement: is zero at every point"),
    ],
)
def test_a_bad_file_is_refused(tmp_path, text, error):
    path = tmp_path / "pump.csv"
    path.write_text(text)
    with pytest.raises(InputError) as refused:
        fit_losses(path, (1, 1, 1), tmp_path / "out")
    assert error in str(refused.value)
    assert not (tmp_path / "out").exists()


TIED = [40 * i + 9 * j for i in range(9) for j in range(4)]  # each speed with one pressure only


def some(rows):
    whole = measured()
    columns = {name: getattr(whole, name)[rows] for name in ("speed", "pressure", "stroke", "flow", "torque")}
    return Measurements(**columns, displacement=V)


@pytest.mark.parametrize(
    ("rows", "orders", "error"),
    [
        (slice(None), (1, 5, 1), "--orders 1 5 1: each is 0 to 4"),
        (slice(0, 360, 31), (2, 2, 1), "18 coefficients need at least as many points, not 12"),
        (slice(0, 40), (1, 1, 1), "stroke: order 1 needs at least 2 different values, not 1"),
        (TIED, (0, 1, 1), "the points do not tell the 4 coefficients apart"),
    ],
)
def test_points_that_cannot_determine_the_coefficients_are_refused(rows, orders, error):
    with pytest.raises(InputError) as refused:
        fit(some(rows), orders)
    assert error in str(refused.value)


def test_a_displacement_over_the_full_one_is_refused(data, tmp_path):
    with pytest.raises(InputError, match="a stroke of 120 % is over the full one"):
        fit_losses(data, (1, 1, 1), tmp_path, displacement="1.5 cm^3/rev")
    with pytest.raises(InputError, match="--scale-to '2 cm': wrong unit"):
        fit_losses(data, (1, 1, 1), tmp_path, scale_to="2 cm")


def test_a_stroke_that_scatters_over_the_full_one_is_taken_and_told(data, tmp_path):
    result = fit_losses(data, (1, 2, 2), tmp_path, displacement=f"{1.8 / 1.004} cm^3/rev")
    assert remarks(result)[0] == "the largest stroke is 100.4 % of the full one: taken for scatter, as it is"
    assert result["flow_loss"]["validity"]["stroke"] == [0.0, 1.0]


def test_a_fit_through_every_point_is_told_to_say_nothing_of_its_errors():
    fine = {"least_loss": 0.0}
    result = {"orders": [1, 0, 1], "points": 4, "largest_stroke": 1.0, "flow_loss": fine, "torque_loss": fine}
    assert remarks(result) == ["4 points for 4 coefficients: the fit goes through each, errors say nothing of it"]
    assert remarks(result | {"points": 5}) == []
