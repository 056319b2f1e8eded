"""The page: well-formed, self-contained, complete."""

import base64
import re
from html.parser import HTMLParser

import pytest

from ars_mujoco.reproduce.claim import REPRODUCED, Claim, Number
from ars_mujoco.reproduce.page import Section, inlined, page, typeset

VOID = {"meta", "img", "br", "link", "input"}


class Checked(HTMLParser):
    """What a page opens, closes, names and links to."""

    def __init__(self, text: str):
        super().__init__()
        self.open, self.ids, self.addresses = [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        self.ids += [named["id"]] if "id" in named else []
        self.addresses += [named[name] for name in ("src", "href") if name in named]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def claim(**changes) -> Claim:
    fields = {"id": "torque", "place": "Table 1", "text": "Torque is <1400 Nm>.", "ours": (Number("M", 1501.0, "Nm"),),
              "verdict": REPRODUCED, "why": "By eq. 27 & Table 1."}  # fmt: skip
    return Claim(**fields | changes)


@pytest.fixture(scope="module")
def whole(written) -> str:
    return (written.folder / "reproduce.html").read_text(encoding="utf-8")


def test_the_page_is_well_formed_and_its_anchors_are_unique(whole):
    checked = Checked(whole)
    assert checked.open == []
    assert len(set(checked.ids)) == len(checked.ids)


def test_every_link_leads_to_an_anchor_or_holds_what_it_shows(whole):
    checked = Checked(whole)
    inside, held = (
        [each for each in checked.addresses if each.startswith(start)] for start in ("#", "data:image/svg+xml;base64,")
    )
    assert len(inside) + len(held) == len(checked.addresses)
    assert {each[1:] for each in inside} <= set(checked.ids)
    assert not re.search(r"@import|url\(|<script|<link", whole)


def test_every_claim_is_there_with_its_verdict_and_its_figure(whole, claims):
    ids = set(Checked(whole).ids)
    for each in claims.values():
        assert each.id in ids
        assert typeset(str(each.verdict)) in whole
        assert (f"figure_{each.id}" in ids) == bool(each.figure)


def test_every_figure_can_be_drawn_again_to_the_same_bytes(claims):
    figures = [each.figure for each in claims.values() if each.figure]
    assert len(figures) >= 8
    once, twice = (inlined(figures[0]()) for _ in range(2))
    assert once == twice
    assert base64.b64decode(once.partition(",")[2]).lstrip().startswith(b"<?xml")


def test_what_a_claim_says_is_escaped():
    text = page([Section("Sizes & such", [claim()])], "<b>", ["<i>"])
    assert "Torque is &lt;1400 Nm&gt;." in text
    assert "eq. 27 &amp; Table 1" in text
    assert "<b>" not in text
    assert "<i>" not in text


@pytest.mark.parametrize(
    ("plain", "marked"),
    [
        ("K_p V_p n/D", "K<sub>p</sub> V<sub>p</sub> n/D"),
        ("omega_H and tau_H", "\u03c9<sub>H</sub> and \u03c4<sub>H</sub>"),
        ("m^3/s^2", "m<sup>3</sup>/s<sup>2</sup>"),
        ("V^i/V_norm", "V<sup>i</sup>/V<sub>norm</sub>"),
        ("1.17e-13", "1.17\u2009\u00b7\u200910<sup>\u221213</sup>"),
        ("B in (m^5/kg)^(1/2)", "B in (m<sup>5</sup>/kg)<sup>(1/2)</sup>"),
        ("+-10 % <= 3", "\u00b110 % \u2264 3"),
        ("a lambda of 64/Re", "a \u03bb of 64/Re"),
        ("the number of phases", "the number of phases"),
    ],
)
def test_symbols_are_set_as_such(plain, marked):
    assert typeset(plain) == marked


def test_counts_say_how_many_claims_there_are_of_each_kind():
    text = page([Section("One", [claim(id="a"), claim(id="b")])], "", [])
    assert "2 reproduced</li>" in text
