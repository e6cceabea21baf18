# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages about results."""

from __future__ import annotations

import html
import os
import tempfile
from typing import TYPE_CHECKING, Any

from . import _regulus
from .errors import RegulusError, UsageError

if TYPE_CHECKING:
    from .results import Check, Path, Result
    from .robot import Question

_QUICK = 0.5  # seconds of a search that is done again for its proof
_PROVED = ("no-singularity", "singularity")


# From the folder of this package: in a wheel, as installed in a system, and as built.
_TEMPLATES = ("page.html", "../../../../share/regulus/page.html", "../../share/regulus/page.html")


def _template() -> str:
    """Returns the page without data."""
    package = os.path.dirname(os.path.abspath(_regulus.__file__))
    paths = [os.path.normpath(os.path.join(package, place)) for place in _TEMPLATES]
    return next((path for path in paths if os.path.exists(path)), paths[0])


def _proof(check: Check, folder: str, quick: bool) -> str:
    """Returns the file of the proof, in the folder or not; "" if there is none."""
    written = check.certificate.path
    if written and os.path.exists(written):
        return os.path.abspath(written)
    if check.verdict not in _PROVED or (quick and check.seconds > _QUICK):
        return ""
    try:
        return check.certificate.question.prove(os.path.join(folder, "proof.txt"))
    except UsageError:
        return ""  # the question has no certificate, and the page says so


def write_page(check: Check, path: str, quick: bool = False) -> None:
    """Writes the page of a check. `quick`: without the proof, if its search was long.

    Raises:
        FileError: if this build has no page, or the file cannot be written.
    """
    with tempfile.TemporaryDirectory() as folder:
        proof = _proof(check, folder, quick)
        _regulus.write_page(
            check.certificate.question.question,
            "check",
            check.verdict.replace("-", " ").upper(),
            check.report,
            check._text,
            proof,
            _template(),
            path,
        )


def write_answer(question: Question, kind: str, headline: str, result: Result[Any], path: Path) -> str:
    """Writes the page of another answer, and returns its path."""
    file = os.fspath(path)
    _regulus.write_page(
        question.question, kind, headline, result.report, result._text, "", _template(), file
    )
    return file


def page_frame(check: Check) -> str:
    """Returns the page as a frame for a notebook; "" if there can be none."""
    try:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "page.html")
            write_page(check, path, quick=True)
            with open(path, encoding="utf-8") as file:
                text = file.read()
    except RegulusError:
        return ""
    return (
        "<details><summary>The page: robot, boxes, proof</summary>"
        '<iframe sandbox="allow-scripts allow-downloads" style="width:100%;height:44rem;border:0" '
        f'srcdoc="{html.escape(text)}"></iframe></details>'
    )
