"""Records: what kernels do with a record field by field, written out for its fields while compiling."""

from numba.extending import overload

from ars_mujoco.kernels.kernel import JIT_OPTIONS, interpreted


def share(target, source) -> None:
    """Write every number of `source` that the record `target` has a field for."""
    for name in target.dtype.names:
        if name in source.dtype.names:
            target[name] = source[name]


if not interpreted:

    @overload(share, jit_options=JIT_OPTIONS)
    def _share(target, source):
        both = [name for name in target.fields if name in source.fields]
        lines = [f"    target.{name} = source.{name}" for name in both]
        scope: dict = {}
        exec("\n".join(["def share(target, source):", "    pass", *lines]), scope)
        return scope["share"]
