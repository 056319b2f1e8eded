"""A published model of a 107 cm^3 axial piston pump, by fit-losses and by similarity (Pourmovahed 1992).

torque loss = C_v mu d w + C_f d dp + x C_h rho w^2 d^(5/3)/2        d: displacement, m^3/rad; x: stroke
flow loss = C_s d dp/mu + x d w dp/K
"""

import math
from itertools import product

import numpy as np
import pytest

from ars_mujoco.analysis.fit_losses import Measurements, fit

C_V, C_F, C_H, C_S = 2.35e4, 0.0537, 53.6, 4.26e-9  # the maker's
VISCOSITY, DENSITY, BULK_MODULUS = 0.0278, 870.0, 1.7e9  # Pa s, kg/m^3, Pa
LARGE, SMALL = (each * 1e-6 / (2.0 * math.pi) for each in (107.0, 1.8))  # m^3/rad
SPEED, PRESSURE = 3000.0 * math.pi / 30.0, 180e5


def torque_loss(d, x, w, dp):
    return C_V * VISCOSITY * d * w + C_F * d * dp + x * C_H * DENSITY * w**2 * d ** (5.0 / 3.0) / 2.0


def flow_loss(d, x, w, dp):
    return C_S * d * dp / VISCOSITY + x * d * w * dp / BULK_MODULUS


@pytest.fixture(scope="module")
def fitted():
    grid = product(np.linspace(0.0, 1.0, 5), np.linspace(0.2, 1.0, 6) * SPEED, np.linspace(0.1, 1.0, 6) * PRESSURE)
    x, w, dp = np.transpose(list(grid))
    flow, torque = x * LARGE * w - flow_loss(LARGE, x, w, dp), x * LARGE * dp + torque_loss(LARGE, x, w, dp)
    flow, torque = fit(Measurements(w, dp, x, flow, torque, LARGE), (1, 2, 1))
    return flow.loss, torque.loss


def test_a_fit_finds_the_coefficients_of_the_model(fitted):
    flow, torque = (each.terms for each in fitted)
    known = {(0, 1, 0): 0.0114, (0, 0, 1): 0.0537, (1, 2, 0): 0.0056 * (107.0 / 1.8) ** (2.0 / 3.0)}
    for term, value in torque.items():
        assert value == pytest.approx(known.get(term, 0.0), rel=0.01, abs=1e-9), term
    for term, value in flow.items():
        assert value == pytest.approx({(0, 0, 1): 0.0088, (1, 1, 1): 0.0106}.get(term, 0.0), rel=0.01, abs=1e-9), term


def test_scaled_to_the_papers_size_friction_and_whirled_oil_are_the_models(fitted):
    """Viscous losses are not: the model has them by the speed, similarity by the speed of the sliding parts."""
    torque = fitted[1].scaled(SMALL / LARGE)
    full, still = (torque.at(x, SPEED, PRESSURE) for x in (1.0, 0.0))
    assert full - still == pytest.approx(torque_loss(SMALL, 1.0, SPEED, 0.0) - torque_loss(SMALL, 0.0, SPEED, 0.0))
    assert torque.at(0.0, 0.0, PRESSURE) == pytest.approx(C_F * SMALL * PRESSURE)
    length = (SMALL / LARGE) ** (1.0 / 3.0)
    assert torque.at(0.0, SPEED, 0.0) == pytest.approx(length * torque_loss(SMALL, 0.0, SPEED, 0.0))


def test_the_papers_pump_is_judged_a_third_worse_than_the_model(fitted):
    share = torque_loss(SMALL, 1.0, SPEED, PRESSURE) / (SMALL * PRESSURE)
    assert share == pytest.approx(0.071, abs=0.0005)
    assert 0.095 / share == pytest.approx(1.34, abs=0.02)
