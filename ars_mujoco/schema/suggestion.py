"""Suggestion: the nearest valid name for what a user wrote."""

import difflib
from collections.abc import Iterable


def did_you_mean(written: str, names: Iterable[str]) -> str:
    """For "duraton" the text "; did you mean 'duration'?", or none where no name is near; capitals do not count."""
    known = {name.casefold(): name for name in names}
    near = difflib.get_close_matches(written.casefold(), known, n=1)
    return f"; did you mean '{known[near[0]]}'?" if near else ""
