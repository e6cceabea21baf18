# SPDX-License-Identifier: GPL-3.0-or-later
"""All configurations, poses or postures at one place, or at many."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterator, Optional, overload

from .page import write_answer
from .reports import SolutionsAtPlacesReport, SolutionsReport
from .results import Path, Result, _table

if TYPE_CHECKING:
    import numpy
    import numpy.typing

    from .robot import Question


class Found:
    """What was found at one place.

    Attributes:
        verdict: "complete", "none" or "incomplete".
        unknowns: the names of the numbers of a solution.
        units: by unknown.
        enclosures: an array (solutions, unknowns, 2): proved bounds of each number. There is exactly
            one solution within them. They are in the order of their values.
        signs: of the determinant at each solution: 1 or -1; 0: not shown.
        conditions: of the matrix at each solution, in the 2-norm; approximate.
        limits: of each solution: "none", "within", "beyond" or "border" of the model's limits.
        how: how it is shown that these are all; "" if it is not.
        obstacle: why it is not shown; "" if it is.
        boxes: the number of boxes that were evaluated.
    """

    def __init__(self, found: Any) -> None:
        self.verdict: str = found.verdict
        self.unknowns: list[str] = found.unknowns
        self.units: dict[str, str] = dict(zip(found.unknowns, found.units))
        self.enclosures: numpy.typing.NDArray[numpy.float64] = found.enclosures()
        self.signs: numpy.typing.NDArray[numpy.int8] = found.signs()
        self.conditions: numpy.typing.NDArray[numpy.float64] = found.conditions()
        self.limits: list[str] = found.limits()
        self.how: str = found.how if self.complete else ""
        self.obstacle: str = found.obstacle
        self.boxes: int = found.boxes

    @property
    def complete(self) -> bool:
        """True if it is proved that there are no other solutions; also if there is none at all."""
        return self.verdict != "incomplete"

    @property
    def solutions(self) -> numpy.typing.NDArray[numpy.float64]:
        """The middles of the enclosures: an array (solutions, unknowns)."""
        middles: numpy.typing.NDArray[numpy.float64] = self.enclosures.mean(axis=2)
        return middles

    def __len__(self) -> int:
        """The number of solutions that are certain."""
        return len(self.enclosures)

    def __bool__(self) -> bool:
        """True if there are solutions, and it is proved that these are all."""
        return self.verdict == "complete"

    def __repr__(self) -> str:
        return f"<{self.verdict.upper()}: {len(self)} of {', '.join(self.unknowns)}>"


class Solved(Found, Result[SolutionsReport]):
    """The answer of Robot.solve(): what was found, and the reports.

    Attributes:
        result: the last line of the command: "COMPLETE: 6 poses".
        seconds: of the whole call.
        certificate: the file of the proof; None if there is none.
    """

    def __init__(self, question: Question, finding: Any, notes: list[str]) -> None:
        Found.__init__(self, finding.solutions)
        Result.__init__(self, finding.report, finding.json, notes)
        self._question = question
        self.result: str = finding.headline
        self.seconds: float = finding.seconds
        self.certificate: Optional[str] = finding.certificate or None

    def page(self, path: Path) -> str:
        """Writes one HTML file about the answer, for any browser, and returns its path.

        Raises:
            FileError: if this build has no page, or the file cannot be written.
        """
        proof = self.certificate or ""
        return write_answer(self._question, "solutions", self.result, self, path, proof)

    def __repr__(self) -> str:
        return f"<{self.result}>"

    def _repr_html_(self) -> str:
        report = self.json
        rows = [("model", str(report["model"])), ("motion", str(report["motion"]))]
        rows += [(f"# {i + 1}", _solution(self, i)) for i in range(len(self))]
        rows += [("claim", str(report["claim"]))] + [("note", note) for note in self._notes]
        return _table(self.result, _WORDS[self.verdict], rows)


class SolvedPlaces(Result[SolutionsAtPlacesReport]):
    """The answer of Robot.solve_many(): a sequence of what was found at each place.

    Attributes:
        places: of each place, in their order, a Found.
        left: how many places were not asked any more, after an interrupt.
        result: the last line of the command: "NONE at 1, COMPLETE at 2 of 3 places: 12 poses".
        seconds: of the whole call.
        certificate: the file of the proofs; None if there is none.
    """

    def __init__(self, question: Question, finding: Any, notes: list[str]) -> None:
        super().__init__(finding.report, finding.json, notes)
        self._question = question
        self.places: list[Found] = [Found(found) for found in finding.solutions()]
        self.left: int = finding.left
        self.result: str = finding.headline
        self.seconds: float = finding.seconds
        self.certificate: Optional[str] = finding.certificate or None

    def page(self, path: Path) -> str:
        """Writes one HTML file about the answer, for any browser, and returns its path.

        Raises:
            FileError: if this build has no page, or the file cannot be written.
        """
        return write_answer(self._question, "solutions", self.result, self, path)

    @property
    def verdicts(self) -> numpy.typing.NDArray[Any]:
        """The verdict at each place, an array of texts."""
        import numpy

        return numpy.array([found.verdict for found in self.places], dtype="U10")

    @property
    def counts(self) -> numpy.typing.NDArray[numpy.int64]:
        """The number of certain solutions at each place."""
        import numpy

        return numpy.array([len(found) for found in self.places], dtype=numpy.int64)

    @property
    def solutions(self) -> numpy.typing.NDArray[numpy.float64]:
        """All solutions, one after the other: an array (solutions, unknowns). `indices` has the
        number of the place of each.
        """
        import numpy

        if not self.places:
            return numpy.zeros((0, 0))
        return numpy.concatenate([found.solutions for found in self.places])

    @property
    def indices(self) -> numpy.typing.NDArray[numpy.int64]:
        """Of each of `solutions` the index of its place."""
        import numpy

        return numpy.repeat(numpy.arange(len(self.places)), self.counts)

    @property
    def complete(self) -> bool:
        """True if it is proved at each place that there are no other solutions."""
        return self.left == 0 and all(found.complete for found in self.places)

    def __len__(self) -> int:
        """The number of places that were asked."""
        return len(self.places)

    @overload
    def __getitem__(self, index: int) -> Found: ...
    @overload
    def __getitem__(self, index: slice) -> list[Found]: ...
    def __getitem__(self, index: Any) -> Any:
        return self.places[index]

    def __iter__(self) -> Iterator[Found]:
        return iter(self.places)

    def __bool__(self) -> bool:
        """True if each place has solutions, and it is proved that these are all."""
        return self.left == 0 and all(self.places)

    def __repr__(self) -> str:
        return f"<{self.result}>"

    def _repr_html_(self) -> str:
        report = self.json
        rows = [("model", str(report["model"])), ("motion", str(report["motion"]))]
        worst = "no-singularity" if self else "none" if self.complete else ""
        return _table(self.result, worst, rows + [("note", note) for note in self._notes])


# The colours of a table are those of the words of other answers.
_WORDS = {"complete": "no-singularity", "none": "singularity", "incomplete": ""}


def _solution(found: Found, index: int) -> str:
    units = (unit if unit != "1" else "" for unit in found.units.values())
    numbers = zip(found.unknowns, found.solutions[index], units)
    return ", ".join(f"{name} = {value:.6g} {unit}".rstrip() for name, value, unit in numbers)
