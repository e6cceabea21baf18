# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of questions: plain data, which can be copied and pickled."""

from __future__ import annotations

import html
import json
import os
from typing import TYPE_CHECKING, Any, Generic, Mapping, Optional, TypeVar, Union, cast

from .arguments import path_of
from .page import picture_and_link, write_answer, write_page
from .reports import BoundReport, CheckReport, ForcesReport, ForceWitness, LimitMarginReport
from .reports import MarginReport, PathForcesReport, PathMarginReport, PathReport, Range, Witness

if TYPE_CHECKING:
    from .robot import Question

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]
Report = TypeVar("Report")

_COLOURS = {
    "no-singularity": "#0a5c91",
    "within": "#0a5c91",
    "feasible": "#0a5c91",
    "verified": "#0a5c91",
    "singularity": "#a84300",
    "exceeded": "#a84300",
    "infeasible": "#a84300",
    "rejected": "#a84300",
}


def _table(title: str, word: str, rows: list[tuple[str, str]]) -> str:
    colour = _COLOURS.get(word, "#57606a")
    lines = "".join(
        f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
        f"<td style='text-align:left'>{html.escape(text)}</td></tr>"
        for name, text in rows
        if text
    )
    return (
        f"<table><caption style='color:{colour};font-weight:bold;text-align:left'>"
        f"{html.escape(title)}</caption>{lines}</table>"
    )


def _places(values: Optional[dict[str, Range]]) -> str:
    return ", ".join(
        f"{name} = {lo:.6g}" if lo == hi else f"{name} in [{lo:.6g}, {hi:.6g}]"
        for name, (lo, hi) in (values or {}).items()
    )


def _proof_files(report: Mapping[str, Any]) -> list[str]:
    parts = [report, *report.get("components", [])]
    return [file for p in parts for file in (p.get("certificates") or {}).values() if file]


class Result(Generic[Report]):
    """What the results of all questions have.

    Attributes:
        report: the lines that the command prints before its last line, with notes on floats.
        json: the report of `--json` as a dict; `regulus.reports` has its type.
    """

    def __init__(self, report: str, text: str, notes: list[str]) -> None:
        self._notes = list(notes)
        self._report = report
        self._text = text

    @property
    def report(self) -> str:
        return self._report + "".join(f"note       {note}\n" for note in self._notes)

    @property
    def json(self) -> Report:
        read: dict[str, Any] = json.loads(self._text)
        if self._notes:
            read["notes"] = read.get("notes", []) + self._notes
        return cast(Report, read)


class Certificate:
    """The proof of a verdict, to be written to a file."""

    def __init__(self, question: Question, path: str = "") -> None:
        self.question = question
        self.path: Optional[str] = path or None
        """The file that has the proof, once it is written."""

    def write(self, path: Path) -> str:
        """Writes the proof to a file, and returns its path.

        The question is searched again for this. To write the proof during the search, give check()
        the path.

        Raises:
            UsageError: if nothing is proved, or the proof cannot be written in the format.
            FileError: if the file cannot be written.
        """
        self.path = self.question.prove(path_of("path", path))
        return self.path


class Check(Result[Union[CheckReport, PathReport]]):
    """The answer of Robot.check().

    Attributes:
        verdict: "no-singularity", "singularity" or "possible-problem".
        claim: what is proved, in words.
        reason: why the search ended with this verdict.
        boxes: the number of boxes that were evaluated.
        seconds: of the whole call.
        certificate: the proof, to be written to a file.
    """

    def __init__(self, question: Question, finding: Any, notes: list[str]) -> None:
        super().__init__(finding.report, finding.json, notes)
        self.verdict: str = finding.verdict
        self.claim: str = finding.claim
        self.reason: str = finding.reason
        self.boxes: int = finding.boxes
        self.seconds: float = finding.seconds
        self.certificate = Certificate(question, finding.certificate)
        self._page = ""  # written last

    @property
    def witness(self) -> Optional[Witness]:
        """The proof of a singularity: points with enclosures of parameters, pose, uncertain values
        and determinant (None for more rows than columns). None after other verdicts.
        """
        return self.json["witness"]

    @property
    def blocking_box(self) -> Optional[dict[str, Range]]:
        """The box that could not be decided: [lower, upper] of each variable. None if there is
        none.
        """
        return cast(CheckReport, self.json).get("blocking_box")

    def __bool__(self) -> bool:
        """True if it is proved that there is no singularity."""
        return self.verdict == "no-singularity"

    def __repr__(self) -> str:
        return f"<{_words(self.verdict)}: {self.claim}; {_counted(self.boxes)}>"

    def page(self, path: Path) -> str:
        """Writes one HTML file about the answer, for any browser, and returns its path.

        The proof is in the page; the question is searched again for it if it was not written.

        Raises:
            FileError: if this build has no page, or the file cannot be written.
        """
        page = path_of("path", path)
        write_page(self, page)
        self._page = page
        return page

    def _repr_html_(self) -> str:
        report = self.json
        rows = [
            ("model", str(report["model"])),
            ("motion", str(report["motion"])),
            ("claim", self.claim),
            ("blocked", _places(self.blocking_box)),
            ("boxes", f"{self.boxes}"),
            ("time", f"{self.seconds:.3g} s"),
        ]
        rows += [("note", note) for note in self._notes]
        return _table(_words(self.verdict), self.verdict, rows) + picture_and_link(self, self._page)


class PreparedCheck(Check):
    """The answer of Prepared.check(). Its report is made when it is read."""

    def __init__(
        self,
        question: Question,
        finding: Any,
        notes: list[str],
        prepared: Any,
        limits: dict[str, Any],
    ) -> None:
        super().__init__(question, finding, notes)
        self._asked: tuple[Any, ...] = (prepared, question.question, finding, limits)

    def _describe(self) -> None:
        if self._text:
            return
        prepared, question, finding, limits = self._asked
        described = prepared.describe(question, finding, **limits)
        self._report, self._text = described.report, described.json

    @property
    def report(self) -> str:
        self._describe()
        return super().report

    @property
    def json(self) -> Union[CheckReport, PathReport]:
        self._describe()
        return super().json

    def __getstate__(self) -> dict[str, Any]:
        self._describe()
        state = dict(self.__dict__)
        del state["_asked"]
        return state


class Margin(Result[Union[MarginReport, PathMarginReport, LimitMarginReport]]):
    """The answer of Robot.margin().

    Attributes:
        safe: the largest value at which there is proved to be no singularity, or at which the limit
            is proved to be kept, as an exact text; None if there is none.
        singular: the least value at which a singularity is proved; None if there is none.
        exceeded: the least value at which the limit is proved to be exceeded; None if there is none.
        closed: whether the bracket is as narrow as `gap` asks.
        bracket: "SAFE UP TO a, NOT AT b", or "WITHIN UP TO a, EXCEEDED AT b" for a limit.
    """

    def __init__(self, question: Question, finding: Any, notes: list[str]) -> None:
        super().__init__(finding.report, finding.json, notes)
        self._question = question
        self.safe: Optional[str] = finding.safe
        self.singular: Optional[str] = finding.singular
        self.exceeded: Optional[str] = finding.exceeded
        self.closed: bool = finding.closed
        self.bracket: str = finding.bracket

    @property
    def certificates(self) -> list[str]:
        """The files of the proofs that were written, two for each component."""
        return _proof_files(self.json)

    def page(self, path: Path) -> str:
        """Writes one HTML file about the answer, for any browser, and returns its path.

        Raises:
            FileError: if this build has no page, or the file cannot be written.
        """
        return write_answer(self._question, "margin", self.bracket, self, path)

    def __repr__(self) -> str:
        return f"<{self.bracket}>"

    def _repr_html_(self) -> str:
        report = self.json
        rows = [("model", str(report["model"])), ("motion", str(report["motion"]))]
        return _table(self.bracket, "", rows + [("note", note) for note in self._notes])


class Bound(Result[BoundReport]):
    """The answer of Robot.bound().

    Attributes:
        attained: a value that is attained, rounded so that it claims no more; None if not known.
        proved: a value that is proved not to be passed; None if not known.
        unit: of both.
        closed: whether the bracket is as narrow as `gap` asks.
        verdict: "within", "exceeded" or "possible-problem" if there was a limit; otherwise "".
        result: the last line of the command: "BETWEEN 21.12 AND 21.29 N (leg 3)".
    """

    def __init__(self, question: Question, finding: Any, notes: list[str]) -> None:
        super().__init__(finding.report, finding.json, notes)
        self._question = question
        self.attained: Optional[float] = finding.attained
        self.proved: Optional[float] = finding.proved
        self.unit: str = finding.unit
        self.closed: bool = finding.closed
        self.verdict: str = finding.verdict
        self.result: str = finding.result

    @property
    def certificates(self) -> list[str]:
        """The files of the proofs that were written, two for each component."""
        return _proof_files(self.json)

    def page(self, path: Path) -> str:
        """Writes one HTML file about the answer, for any browser, and returns its path.

        Raises:
            FileError: if this build has no page, or the file cannot be written.
        """
        return write_answer(self._question, "bound", self.result, self, path)

    def __repr__(self) -> str:
        return f"<{self.result}>"

    def _repr_html_(self) -> str:
        report = self.json
        rows = [("bound", str(report["bound"])), ("model", str(report["model"]))]
        rows += [("motion", str(report["motion"]))] + [("note", note) for note in self._notes]
        return _table(self.result, self.verdict, rows)


class LoadCheck(Result[Union[ForcesReport, PathForcesReport]]):
    """The answer of Robot.check_load().

    Attributes:
        verdict: "feasible", "infeasible" or "possible-problem".
        claim: what is proved, in words; "" if nothing is.
        reason: why neither could be shown; "" otherwise.
        boxes: the number of boxes that were evaluated.
        seconds: of the whole call.
        certificate: the file of the proof; None if there is none.
    """

    def __init__(self, question: Question, finding: Any, notes: list[str]) -> None:
        super().__init__(finding.report, finding.json, notes)
        self._question = question
        self.verdict: str = finding.verdict
        self.claim: str = finding.claim
        self.reason: str = finding.reason
        self.boxes: int = finding.boxes
        self.seconds: float = finding.seconds
        self.certificate: Optional[str] = finding.certificate or None

    @property
    def witness(self) -> Optional[ForceWitness]:
        """A pose and a wrench that no forces within the limits hold, with enclosures. None after
        other verdicts.
        """
        return self.json["witness"]

    def __bool__(self) -> bool:
        """True if the load is held everywhere."""
        return self.verdict == "feasible"

    def page(self, path: Path) -> str:
        """Writes one HTML file about the answer, for any browser, and returns its path.

        Raises:
            FileError: if this build has no page, or the file cannot be written.
        """
        return write_answer(self._question, "load", _words(self.verdict), self, path)

    def __repr__(self) -> str:
        return f"<{_words(self.verdict)}: {self.claim or self.reason or 'a pose is shown'}>"

    def _repr_html_(self) -> str:
        rows = [("claim", self.claim), ("reason", self.reason)]
        if self.witness is not None:
            rows.append(("not held at", _places(self.witness["parameters"])))
        rows += [("note", note) for note in self._notes]
        return _table(_words(self.verdict), self.verdict, rows)


class Verification:
    """The answer of verify().

    Attributes:
        outcome: "verified", "rejected" or "unfinished".
        claim: what the certificate claims.
        reason: why it is not verified; empty if it is.
        json: the report of `--json` as a dict.
    """

    def __init__(self, found: Any) -> None:
        self.outcome: str = found.outcome
        self.claim: str = found.claim
        self.reason: str = found.reason
        self.json: dict[str, Any] = json.loads(found.json)

    def __bool__(self) -> bool:
        """True if the claim was proved again."""
        return self.outcome == "verified"

    def __repr__(self) -> str:
        return f"<{self.outcome.upper()}: {self.claim if self else self.reason}>"

    def _repr_html_(self) -> str:
        rows = [("claim", self.claim), ("reason", self.reason)]
        return _table(self.outcome.upper(), self.outcome, rows)


def _counted(boxes: int) -> str:
    return f"{boxes} box" if boxes == 1 else f"{boxes} boxes"


def _words(verdict: str) -> str:
    return verdict.replace("-", " ").upper()
