"""Page: the claims as one HTML file that needs nothing else, figures inside, for screen, phone and paper."""

import base64
import html
import io
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from string import Template

import matplotlib
from matplotlib.figure import Figure

from ars_mujoco.reproduce.claim import Claim, Kind, Number

COLUMNS = ("claim", "paper", "ours", "verdict", "why")
PAPER = "Pump Controlled Active Roll Stabilizer"

PAGE = Template("""\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
$style</style>
</head>
<body>
<header>
<h1>$title</h1>
<p>$introduction</p>
<ul class="counts">
$counts
</ul>
</header>
<nav aria-label="Contents">
<h2>Contents</h2>
<ol>
$contents
</ol>
</nav>
<main>
$sections
</main>
<footer>
<h2 id="inputs">Inputs</h2>
<ul>
$inputs
</ul>
</footer>
</body>
</html>
""")

STYLE = """\
:root { --ink: #1b2733; --soft: #5d6873; --line: #d9dee3; --yes: #2f6b46; --part: #8a6414; --no: #a5372a; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 76rem; padding: 2rem 1.5rem 4rem; color: var(--ink); background: #fff;
       font: 15px/1.5 system-ui, "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.7rem; font-weight: 600; line-height: 1.2; margin: 0 0 .5rem; }
h2 { font-size: 1.15rem; font-weight: 600; margin: 2.5rem 0 .75rem; }
p { max-width: 46rem; margin: 0 0 .75rem; }
a { color: inherit; text-decoration-color: var(--line); text-underline-offset: .2em; }
nav h2 { margin-top: 1.5rem; }
nav ol { padding-left: 1.4rem; margin: 0; columns: 22rem 2; column-gap: 3rem; }
nav li { break-inside: avoid; padding: .1rem 0; }
nav small, .place, .name { color: var(--soft); }
.counts { list-style: none; display: flex; flex-wrap: wrap; gap: .25rem 1.5rem; padding: 0; margin: 0; }
table { width: 100%; border-collapse: collapse; table-layout: fixed; }
th { text-align: left; font-weight: 600; font-size: .85rem; color: var(--soft); }
th, td { padding: .55rem .9rem .55rem 0; vertical-align: top; border-bottom: 1px solid var(--line);
         overflow-wrap: break-word; }
th:nth-child(1) { width: 22%; } th:nth-child(2) { width: 14%; } th:nth-child(3) { width: 22%; }
th:nth-child(4) { width: 13%; }
tr:target td { background: #f5f7f9; }
td { font-size: .9rem; }
sub, sup { line-height: 0; }
.place { display: block; font-size: .82rem; }
.number + .number { margin-top: .3rem; }
.name { display: block; font-size: .82rem; line-height: 1.3; }
.value { font-variant-numeric: tabular-nums; }
.verdict { font-weight: 600; }
.reproduced { color: var(--yes); } .partly { color: var(--part); } .not { color: var(--no); }
.open { color: var(--soft); }
figure { margin: 1.5rem 0; break-inside: avoid; }
figure img { display: block; max-width: 100%; height: auto; }
figcaption { font-size: .85rem; color: var(--soft); margin-top: .4rem; }
footer li { font-size: .82rem; overflow-wrap: anywhere; }
code { font-size: .95em; }
@media (max-width: 46rem) {
  body { padding: 1rem 1rem 3rem; }
  nav ol { columns: auto; }
  thead { display: none; }
  table, tbody, tr, td { display: block; width: 100%; }
  tr { border-bottom: 1px solid var(--line); padding: .7rem 0; }
  td { border: 0; padding: .15rem 0; }
  td[data-label]::before { content: attr(data-label); display: block; font-size: .78rem; font-weight: 600; }
}
@media print {
  @page { size: A4 landscape; margin: 12mm; }
  body { max-width: none; padding: 0; font-size: 8.5pt; }
  th, td { padding: .3rem .8rem .3rem 0; }
  td { font-size: 8.5pt; }
  tr { break-inside: avoid; }
  thead { display: table-header-group; }
  h2 { break-after: avoid; }
  a { text-decoration: none; }
}
"""

MARKS = {
    Kind.REPRODUCED: "reproduced",
    Kind.WITHIN: "reproduced",
    Kind.HOLDS_ONLY: "partly",
    Kind.DOES_NOT_FOLLOW: "not",
    Kind.CONTRADICTS_ITSELF: "not",
    Kind.NOT_CHECKABLE: "open",
}
COUNTED = {  # how a count of them is worded
    Kind.WITHIN: "reproduced within a distance",
    Kind.HOLDS_ONLY: "hold only in part",
    Kind.DOES_NOT_FOLLOW: "do not follow",
    Kind.CONTRADICTS_ITSELF: "contradict themselves",
}
SIGNS = {"+-": "\u00b1", "&lt;=": "\u2264", "&gt;=": "\u2265", "<sup>-": "<sup>\u2212"}
GREEK = {name: chr(code) for name, code in {
    "Theta": 0x398, "omega": 0x3C9, "phi": 0x3C6, "tau": 0x3C4, "rho": 0x3C1, "lambda": 0x3BB, "nu": 0x3BD,
}.items()}  # fmt: skip
SYMBOL = re.compile(rf"\b({'|'.join(GREEK)})(?=_|\b)")
INDEX = re.compile(r"(?<![\w.])([A-Za-z\u0370-\u03ff])_(\w+)")
POWER = re.compile(r"\^(-?\w+|\([^)]+\))")
EXPONENT = re.compile(r"(\d)e([+-])0*(\d+)\b")


@dataclass(frozen=True)
class Section:
    """A group's title with its claims."""

    title: str
    claims: Sequence[Claim]

    @property
    def id(self) -> str:
        """The section's anchor."""
        return re.sub(r"[^a-z0-9]+", "_", self.title.lower()).strip("_")


def page(sections: Sequence[Section], introduction: str, inputs: Sequence[str]) -> str:
    """The page of `sections`; `inputs` are lines about what was run."""
    kinds = Counter(claim.verdict.kind for section in sections for claim in section.claims)
    counts = (f'<li class="{MARKS[kind]}">{kinds[kind]} {COUNTED.get(kind, kind)}</li>' for kind in Kind if kinds[kind])
    return PAGE.substitute(
        title=html.escape(f"{PAPER}: the paper's claims, checked"),
        style=STYLE,
        introduction=html.escape(introduction),
        counts="\n".join(counts),
        contents="\n".join(map(_entry, sections)),
        sections="\n".join(map(_section, sections)),
        inputs="\n".join(f"<li>{html.escape(line)}</li>" for line in inputs),
    )


def typeset(text: str) -> str:
    """Plain text as HTML: escaped, with Greek letters, indices, powers and exponents."""
    escaped = html.escape(text)
    escaped = SYMBOL.sub(lambda match: GREEK[match[1]], escaped)
    escaped = EXPONENT.sub(
        lambda m: f"{m[1]}\u2009\u00b7\u200910<sup>{'-' if m[2] == '-' else ''}{m[3]}</sup>", escaped
    )
    escaped = INDEX.sub(r"\1<sub>\2</sub>", escaped)
    marked = POWER.sub(r"<sup>\1</sup>", escaped)
    for written, sign in SIGNS.items():
        marked = marked.replace(written, sign)
    return marked


def inlined(figure: Figure) -> str:
    """`figure` as an address that holds all of it; the same figure gives the same address."""
    buffer = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": PAPER}):
        figure.savefig(buffer, format="svg", metadata={"Date": None})
    return "data:image/svg+xml;base64," + base64.b64encode(buffer.getvalue()).decode()


def _entry(section: Section) -> str:
    count = f"{len(section.claims)} claim{'s' * (len(section.claims) != 1)}"
    return f'<li><a href="#{section.id}">{typeset(section.title)}</a> <small>{count}</small></li>'


def _section(section: Section) -> str:
    head = "".join(f'<th scope="col">{name}</th>' for name in COLUMNS)
    rows = "\n".join(map(_row, section.claims))
    figures = "\n".join(_figure(claim) for claim in section.claims if claim.figure)
    return (
        f'<section>\n<h2 id="{section.id}">{typeset(section.title)}</h2>\n'
        f"<table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}\n</tbody>\n</table>\n{figures}\n</section>"
    )


def _row(claim: Claim) -> str:
    below = f' <a href="#figure_{claim.id}">Figure.</a>' if claim.figure else ""
    text = f'<a href="#{claim.id}">{typeset(claim.text)}</a><span class="place">{typeset(claim.place)}</span>'
    cells = (
        f"<td>{text}</td>",
        f'<td data-label="paper">{_numbers(claim.paper)}</td>'
        if claim.paper
        else '<td data-label="paper"><span class="name">see claim</span></td>',
        f'<td data-label="ours">{_numbers(claim.ours)}</td>',
        f'<td data-label="verdict"><span class="verdict {MARKS[claim.verdict.kind]}">'
        f"{typeset(str(claim.verdict))}</span></td>",
        f'<td data-label="why">{typeset(claim.why)}{below}</td>',
    )
    return f'<tr id="{claim.id}">{"".join(cells)}</tr>'


def _numbers(numbers: Sequence[Number]) -> str:
    return "".join(
        f'<div class="number"><span class="name">{typeset(each.name)}</span>'
        f'<span class="value">{typeset(each.text)}</span></div>'
        for each in numbers
    )


def _figure(claim: Claim) -> str:
    caption = f'{typeset(claim.text.rstrip("."))}: <a href="#{claim.id}">{typeset(str(claim.verdict))}</a>.'
    return (
        f'<figure id="figure_{claim.id}"><img src="{inlined(claim.figure())}" alt="{html.escape(claim.text)}">'
        f"<figcaption>{caption}</figcaption></figure>"
    )
