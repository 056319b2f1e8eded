"""Suggestion: the nearest valid name for what a user wrote."""

import difflib
from collections.abc import Iterable

LONGEST = 300  # characters of a name or a path; longer ones are none


def did_you_mean(written: str, names: Iterable[str]) -> str:
    """For "duraton" the text "; did you mean 'duration'?", or none where no name is near; capitals do not count."""
    if len(written) > LONGEST:
        return ""
    known = {name.casefold(): name for name in names}
    near = difflib.get_close_matches(written.casefold(), known, n=1)
    return f"; did you mean '{known[near[0]]}'?" if near else ""
