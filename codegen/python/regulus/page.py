# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages about results, which the command `regulus` writes."""

from __future__ import annotations

import functools
import html
import json
import os
import shutil
import subprocess
import tempfile
from typing import TYPE_CHECKING, Optional

from . import _regulus
from .errors import FileError, RegulusError, UsageError

if TYPE_CHECKING:
    from .results import Check

_QUICK = 0.5  # seconds of a search that is done again for its proof
_PROVED = ("no-singularity", "singularity")


@functools.lru_cache(maxsize=None)
def program() -> Optional[str]:
    """Returns the command `regulus` of this version, in the build folder or installed; None if there
    is none.
    """
    built = os.path.join(os.path.dirname(os.path.abspath(_regulus.__file__)), "../../bin/regulus")
    for path in (os.path.normpath(built), shutil.which("regulus")):
        if path is None or not os.access(path, os.X_OK):
            continue
        said = subprocess.run([path, "--version"], stdout=subprocess.PIPE, check=False).stdout
        if _regulus.VERSION in said.decode("utf-8", "replace").split():
            return path
    return None


def _model_file(check: Check, folder: str) -> str:
    """Returns the file of the model, or writes its text to one."""
    robot = check.certificate.question.robot
    if robot.path:
        try:
            with open(robot.path, "rb") as file:
                if file.read() == robot.text.encode("utf-8"):
                    return os.path.abspath(robot.path)
        except OSError:
            pass  # it was changed or removed; the text is what was checked
    robot.write(os.path.join(folder, "model.toml"))
    return "model.toml"


def _proof(check: Check, folder: str, quick: bool) -> Optional[str]:
    """Returns the file of the proof, in the folder or not; None if there is none."""
    written = check.certificate.path
    if written and os.path.exists(written):
        return os.path.abspath(written)
    if check.verdict not in _PROVED or (quick and check.seconds > _QUICK):
        return None
    try:
        check.certificate.question.prove(os.path.join(folder, "proof.txt"))
    except UsageError:
        return None  # the question has no certificate, and the page says so
    return "proof.txt"


def write_page(check: Check, path: str, quick: bool = False) -> None:
    """Writes the page of a check. `quick`: without the proof, if its search was long.

    Raises:
        FileError: if the command is missing, or the file cannot be written.
    """
    command = program()
    if command is None:
        raise FileError("a page is made by the command regulus, which is not installed")
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "check.json"), "w", encoding="utf-8") as file:
            json.dump(check.json, file)
        # In the folder, so that the page does not name it.
        words = [command, "report", _model_file(check, folder), "--from", "check.json"]
        proof = _proof(check, folder, quick)
        if proof:
            words += ["--from", proof]
        waypoints = check.certificate.question.waypoints
        if waypoints:
            words += ["--waypoints", os.path.abspath(waypoints)]
        words += ["--output", os.path.abspath(path), "--quiet"]
        pipe = subprocess.PIPE
        done = subprocess.run(words, cwd=folder, stdout=pipe, stderr=pipe, check=False)
    if done.returncode in (0, 1, 2):
        return
    message = done.stderr.decode("utf-8", "replace").strip()
    raise (FileError if done.returncode == 74 else RegulusError)(message)


def page_frame(check: Check) -> str:
    """Returns the page as a frame for a notebook; "" if there can be none."""
    if program() is None:
        return ""
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
