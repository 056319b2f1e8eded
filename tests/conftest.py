"""Makes the modules beside this file importable from every test, and draws hypothesis' examples the same every time."""

from hypothesis import settings

settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")
