"""Quotation: what a user wrote, as an error may repeat it: short, and harmless to a terminal."""

import unicodedata

MOST = 60  # characters of a text that an error repeats
MOST_OF_A_PATH = 300
UNSEEN = ("Cc", "Cs", "Co", "Cn")  # categories that a terminal obeys, or cannot show
REORDERING = set("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")  # turn the text after them


def quoted(text: object, most: int = MOST) -> str:
    """`text` between quotation marks: of a long one the beginning and its length, of what is not seen the escapes."""
    whole = str(text)
    short = whole if len(whole) <= most else whole[: most - 20]
    more = f"... ({len(whole)} characters)" if short != whole else ""
    return f"'{seen(short)}{more}'"


def seen(text: str) -> str:
    """`text` with escapes for whatever is not printed, line breaks too."""
    return "".join(each if each.isprintable() else repr(each)[1:-1] for each in text)


def is_unseen(character: str) -> bool:
    """Whether a terminal obeys a character, or cannot show it; marks within words and emoji are no such ones."""
    return unicodedata.category(character) in UNSEEN or character in REORDERING
