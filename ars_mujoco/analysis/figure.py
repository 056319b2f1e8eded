"""Figure: the look that all figures of the analysis share; lines differ by dash and darkness, so grey paper does."""

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ars_mujoco.recording.folder import write_whole

DARK, MIDDLE_GREY, LIGHT = "#16324f", "#6d6d6d", "#b4bcc6"
ACCENT = "#b5382a"
DASHES = ("-", "--", "-.", ":")
SHADES = ("#0b1d30", "#2b5278", "#4f82b0", "#86aacb", "#b9cde0")  # dark to light
FORMATS = ("png", "svg")


def label(ax: Axes, title: str, x: str, y: str, legend: bool = True) -> None:
    """Title, axis labels with units, a faint grid, and a legend where there is something to tell apart."""
    ax.set_title(title, loc="left", fontsize=10)
    ax.set_xlabel(x, fontsize=9)
    ax.set_ylabel(y, fontsize=9)
    ax.tick_params(labelsize=8)
    ax.grid(True, which="major", color="#e3e3e3", linewidth=0.6)
    ax.set_axisbelow(True)
    ax.spines[["top", "right"]].set_visible(False)
    if legend:
        ax.legend(fontsize=8, frameon=False)


def legend_beside(figure: Figure, ax: Axes) -> None:
    """The legend of `ax` to the right of all of the figure's axes."""
    figure.legend(*ax.get_legend_handles_labels(), loc="outside right upper", fontsize=8, frameon=False)


def save(figure: Figure, folder: Path, name: str) -> list[Path]:
    """Write `figure` as `name`.png and `name`.svg into `folder`; returns their paths."""
    paths = [folder / f"{name}.{kind}" for kind in FORMATS]
    for path, kind in zip(paths, FORMATS, strict=True):
        write_whole(path, lambda part, kind=kind: figure.savefig(part, format=kind, dpi=160))
    return paths
