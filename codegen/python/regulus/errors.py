# SPDX-License-Identifier: GPL-3.0-or-later
"""The errors of Regulus. Every one of them is a RegulusError."""

from __future__ import annotations

from typing import Any


def _of_python(text: object) -> object:
    """Names an argument of Python, where the message names an option of the command."""
    return text[2:] if isinstance(text, str) and text.startswith("--") else text


class RegulusError(Exception):
    """What every error of Regulus is."""


class InputError(RegulusError, ValueError):
    """A mistake in a model file, a file of way-points or a robot file.

    Attributes:
        file: its path, or the name of the robot.
        line: its line; 0 if it is not known.
        problem: what is wrong, or what was found.
        remedy: what to do, or what was expected.
        symbol: the name at fault; empty if there is none.
    """

    def __init__(
        self,
        message: str,
        file: str = "",
        line: int = 0,
        problem: str = "",
        remedy: str = "",
        symbol: str = "",
    ) -> None:
        super().__init__(message)
        self.file = file
        self.line = line
        self.problem = problem
        self.remedy = remedy
        self.symbol = symbol

    def __reduce__(self) -> tuple[Any, ...]:
        return (
            InputError,
            (str(self), self.file, self.line, self.problem, self.remedy, self.symbol),
        )


class UsageError(RegulusError, ValueError):
    """An argument that does not fit the model: an unknown motion, for example."""

    def __init__(self, *words: object) -> None:
        super().__init__(*map(_of_python, words))


class FileError(RegulusError, OSError):
    """A file that cannot be read or written."""


class CompileError(RegulusError, RuntimeError):
    """The compiler cannot be opened, or refused the text of a kernel."""


class InternalError(RegulusError, RuntimeError):
    """A fault of Regulus itself."""
