# SPDX-License-Identifier: GPL-3.0-or-later
"""Pavings: boxes that are proved free, proved singular, or undecided."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence, SupportsFloat, Union, cast

from . import _regulus
from .errors import UsageError, require_package
from .reports import ForcesReport, PathForcePavingReport, PathPavingReport, PavingReport, Range
from .results import Result, _counted, _places, _table, _words

if TYPE_CHECKING:
    import numpy
    import numpy.typing

CLAIMS: tuple[str, ...] = _regulus.CLAIMS
"""The claims of boxes: "free", "singular", "undecided", "outside", "unreachable"."""

LOAD_CLAIMS: tuple[str, ...] = _regulus.LOAD_CLAIMS
"""The claims of boxes about a load: "feasible", "infeasible", "undecided", "outside"."""

# Those of pictures and pages.
_COLOURS = {
    "free": "#56b4e9",
    "singular": "#d55e00",
    "undecided": "#f0e442",
    "outside": "#dddddd",
    "unreachable": "#999999",
    "feasible": "#56b4e9",
    "infeasible": "#d55e00",
}


def _array_of(finding: Any, known: tuple[str, ...]) -> numpy.typing.NDArray[Any]:
    import numpy

    names = list(finding.variables)
    claim = "claim"
    while claim in names:
        claim += "_"
    kinds: list[Any] = [(claim, "U11")] + [(name, "f8", (2,)) for name in names]
    boxes = numpy.zeros(len(finding.claims()), dtype=kinds)
    boxes[claim] = numpy.array(known, dtype="U11")[finding.claims()]
    bounds = finding.bounds()
    for i, name in enumerate(names):
        boxes[name] = bounds[:, i, :]
    return boxes


def _claims_of(boxes: numpy.typing.NDArray[Any]) -> numpy.typing.NDArray[Any]:
    found: numpy.typing.NDArray[Any] = boxes[list(boxes.dtype.names or ())[0]]
    return found


_Report = Union[PavingReport, PathPavingReport, ForcesReport, PathForcePavingReport]


class Paving(Result[_Report]):
    """The answer of Robot.locate().

    Attributes:
        verdict: of the whole motion: "no-singularity", "singularity" or "possible-problem".
        reason: why the search ended with this verdict.
        boxes: a structured array of NumPy, a row for each box: `claim` (one of CLAIMS), and for
            each variable its lower and upper bound, in its unit. The boxes cover the motion and
            overlap at most in their sides. Uncertain quantities come after the motion parameters.
        variables: the names of the variables.
        stretches: of a motion along way-points, which has no boxes: dicts, as `regulus locate
            --output` writes them, with `kind` (one of CLAIMS), `segments`, `lines` and `time`.
        certificate: the file of the proof; None if there is none.
        no_certificate: why there is none, if one was wanted.
    """

    _known: tuple[str, ...] = CLAIMS

    def __init__(self, finding: Any, notes: list[str]) -> None:
        super().__init__(finding.report, finding.json, notes)
        self.verdict: str = finding.verdict
        self.reason: str = finding.reason
        self.variables: list[str] = list(finding.variables)
        self.boxes = _array_of(finding, self._known)
        self.stretches: list[dict[str, Any]] = [json.loads(s) for s in finding.stretches]
        self.certificate: Optional[str] = finding.certificate or None
        self.no_certificate: str = finding.no_certificate

    @property
    def claims(self) -> numpy.typing.NDArray[Any]:
        """The claim of each box, in the order of `boxes`."""
        return _claims_of(self.boxes)

    @property
    def fractions(self) -> dict[str, Range]:
        """Proved bounds [lower, upper] of the part of the motion's ranges with each claim.

        Raises:
            UsageError: for a motion along way-points; json["share"] has approximate shares.
        """
        self._require_boxes()
        report: Mapping[str, Any] = self.json
        shares = report.get("boxes_by_claim", report)
        return {claim: shares[claim]["fraction"] for claim in self._known}

    def _require_boxes(self) -> None:
        if self.stretches:
            raise UsageError("a motion along way-points has no boxes; see stretches")

    def __repr__(self) -> str:
        if self.stretches:
            return f"<{_words(self.verdict)}: {len(self.stretches)} stretches>"
        return f"<{_words(self.verdict)}: {_counted(len(self.boxes))} of {', '.join(self.variables)}>"

    def _repr_html_(self) -> str:
        if self.stretches:
            report = cast(PathPavingReport, self.json)
            shares = [(claim, f"{100 * share:.3g} %") for claim, share in report["share"].items()]
            return _table(_words(self.verdict), self.verdict, shares)
        fractions = [
            (claim, _counted(int((self.claims == claim).sum())))
            for claim in self._known
            if (self.claims == claim).any()
        ]
        return _table(_words(self.verdict), self.verdict, fractions)

    def _range(self, name: str) -> tuple[float, float]:
        ends = self.boxes[name]
        return float(ends[:, 0].min()), float(ends[:, 1].max())

    def _moving(self) -> list[str]:
        """The variables that are no single value, which may lie between two doubles."""
        ranges = ((name, *self._range(name)) for name in self.variables)
        return [name for name, lo, hi in ranges if math.nextafter(lo, math.inf) < hi]

    def _slice(self, axes: list[str], at: dict[str, float]) -> numpy.typing.NDArray[Any]:
        import numpy

        kept = numpy.ones(len(self.boxes), dtype=bool)
        for name in self.variables:
            if name in axes:
                continue
            lo, hi = self.boxes[name][:, 0], self.boxes[name][:, 1]
            # On a side that two boxes share, one of them is shown.
            last = hi == self._range(name)[1]
            kept &= (lo <= at[name]) & ((at[name] < hi) | (last & (at[name] <= hi)))
        found: numpy.typing.NDArray[Any] = self.boxes[kept]
        return found

    def _middle(self, axes: list[str], at: Optional[Mapping[str, SupportsFloat]]) -> dict[str, float]:
        given = {name: float(value) for name, value in (at or {}).items()}
        for name in given:
            if name not in self.variables or name in axes:
                raise UsageError(f"at: {name!r} is not a variable that is not drawn")
        for name in self.variables:
            if name not in axes:
                lo, hi = self._range(name)
                given.setdefault(name, lo / 2 + hi / 2)
        return given

    def plot(
        self,
        ax: Any = None,
        axes: Optional[Sequence[str]] = None,
        at: Optional[Mapping[str, SupportsFloat]] = None,
    ) -> Any:
        """Draws the boxes on axes of Matplotlib, and returns these.

        Args:
            ax: axes of Matplotlib; None: the current ones.
            axes: the two variables to draw; by default the first two that have a width.
            at: values of other variables, in their units. The picture is the slice of the boxes
                there; by default in the middle of each range.

        Raises:
            UsageError: for variables that the paving does not have.
        """
        require_package("matplotlib", "plot()")
        from matplotlib import pyplot

        self._require_boxes()
        across = self._across(axes)
        place = self._middle(across, at)
        ax = pyplot.gca() if ax is None else ax
        self._draw(ax, self._slice(across, place), across)
        ax.set_xlabel(across[0])
        ax.set_ylabel(across[1] if len(across) > 1 else "")
        moving = self._moving()
        sliced = {name: [at, at] for name, at in place.items() if name in moving}
        if sliced:
            ax.set_title("slice at " + _places(sliced))
        return ax

    def _draw(self, ax: Any, shown: numpy.typing.NDArray[Any], across: list[str]) -> None:
        from matplotlib import patches
        from matplotlib.collections import PatchCollection

        claims = _claims_of(shown)
        handles = []
        for claim in self._known:
            boxes = shown[claims == claim]
            if len(boxes) == 0:
                continue
            rectangles = [
                patches.Rectangle((x[0], y[0]), x[1] - x[0], y[1] - y[0])
                for x, y in zip(*self._sides(boxes, across))
            ]
            ax.add_collection(
                PatchCollection(
                    rectangles, facecolor=_COLOURS[claim], edgecolor="white", linewidth=0.3
                )
            )
            handles.append(patches.Patch(facecolor=_COLOURS[claim], label=claim))
        ax.autoscale_view()
        ax.legend(handles=handles)

    def _across(self, axes: Optional[Sequence[str]]) -> list[str]:
        if axes is None:
            moving = self._moving()
            return moving[:2] if moving else self.variables[:1]
        for name in axes:
            if name not in self.variables:
                known = ", ".join(self.variables)
                raise UsageError(f"axes: no variable {name!r}; this paving has: {known}")
        return list(axes)

    def _sides(
        self, boxes: numpy.typing.NDArray[Any], across: list[str]
    ) -> tuple[numpy.typing.NDArray[Any], numpy.typing.NDArray[Any]]:
        import numpy

        x = boxes[across[0]]
        if len(across) > 1:
            return x, boxes[across[1]]
        return x, numpy.tile([0.0, 1.0], (len(boxes), 1))


class LoadPaving(Paving):
    """The answer of Robot.locate_load(): a Paving whose claims are LOAD_CLAIMS.

    Attributes:
        verdict: of the whole motion: "feasible", "infeasible" or "possible-problem".
        certificate: the file of the proof of each box; None if there is none.
    """

    _known: tuple[str, ...] = LOAD_CLAIMS

    def __init__(self, finding: Any, notes: list[str]) -> None:
        super().__init__(finding, notes)
