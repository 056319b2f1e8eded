"""A native callback is compiled once, whichever thread asks first: its code lives as long as it does."""

import ctypes
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

from numba import types

from ars_mujoco.kernels.kernel import NativeCallback

THREADS = 4


def test_threads_that_ask_at_once_get_the_same_code():
    callback = NativeCallback(types.float64(types.float64), lambda x: 2.0 * x, cached=False)
    together = Barrier(THREADS)

    def ask(_):
        together.wait()
        return callback.address

    with ThreadPoolExecutor(THREADS) as pool:
        addresses = set(pool.map(ask, range(THREADS)))
    assert addresses == {callback.address}
    assert ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)(callback.address)(21.0) == 42.0
