# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages about results."""

from __future__ import annotations

import html
import os
import tempfile
import urllib.parse
from typing import TYPE_CHECKING, Any

from . import _regulus
from .arguments import path_of
from .errors import RegulusError, UsageError

if TYPE_CHECKING:
    from .results import Check, Path, Result
    from .robot import Question

_PROVED = ("no-singularity", "singularity")


# From the folder of this package: in a wheel, as installed in a system, and as built.
_TEMPLATES = ("page.html", "../../../../share/regulus/page.html", "../../share/regulus/page.html")


def _template() -> str:
    """Returns the page without data."""
    package = os.path.dirname(os.path.abspath(_regulus.__file__))
    paths = [os.path.normpath(os.path.join(package, place)) for place in _TEMPLATES]
    return next((path for path in paths if os.path.exists(path)), paths[0])


def _proof(check: Check, folder: str) -> str:
    """Returns the file of the proof, in the folder or not; "" if there is none."""
    written = check.certificate.path
    if written and os.path.exists(written):
        return os.path.abspath(written)
    if check.verdict not in _PROVED:
        return ""
    try:
        return check.certificate.question.prove(os.path.join(folder, "proof.txt"))
    except UsageError:
        return ""  # the question has no certificate, and the page says so


def write_page(check: Check, path: str) -> None:
    """Writes the page of a check.

    Raises:
        FileError: if this build has no page, or the file cannot be written.
    """
    with tempfile.TemporaryDirectory() as folder:
        proof = _proof(check, folder)
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


def write_answer(
    question: Question,
    kind: str,
    headline: str,
    result: Result[Any],
    path: Path,
    certificate: str = "",
) -> str:
    """Writes the page of another answer, with its proof if there is a file of it; returns its path."""
    file = path_of("path", path)
    proof = certificate if os.path.exists(certificate) else ""
    _regulus.write_page(
        question.question, kind, headline, result.report, result._text, proof, _template(), file
    )
    return file


def picture_and_link(check: Check, page: str) -> str:
    """Returns a picture of the robot for a notebook, and a link to the page that was written last; some
    kilobytes, so that notebooks stay small. "" stands for no page yet.
    """
    try:
        picture = _regulus.robot_picture(check.certificate.question.question)
    except RegulusError:
        picture = ""
    link = (
        f'<a href="{html.escape(urllib.parse.quote(page))}">{html.escape(page)}</a>'
        if page
        else '<code>.page("FILE.html")</code> writes the page: robot, boxes, proof'
    )
    return f"{picture}<p>{link}</p>"
