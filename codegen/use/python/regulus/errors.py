# SPDX-License-Identifier: GPL-3.0-or-later
"""The errors of Regulus. Every one of them is a RegulusError."""

from __future__ import annotations

import re
from importlib.util import find_spec
from typing import Any

_ARGUMENTS = {"filter": "filters", "weight": "weights", "no-cache": "use_cache=False"}


def _argument(option: re.Match[str]) -> str:
    return _ARGUMENTS.get(option[1], option[1].replace("-", "_"))


def _with_ranges(text: str) -> str:
    """Writes the ranges of the command's words as those of Python: (lo, hi), (lo, None)."""
    text = re.sub(
        r"(?<![\w-])--([a-z][a-z0-9-]*) (\w+)=LO:HI",
        lambda given: f'{_argument(given)}={{"{given[2]}": (lo, hi)}}',
        text,
    )
    text = re.sub(
        r"(?<![\w-])--([a-z][a-z0-9-]*) LO:HI", lambda given: f"{_argument(given)}=(lo, hi)", text
    )
    text = text.replace("LO:HI, such as 0:0.5", "(lo, hi), such as (0, 0.5)")
    text = re.sub(r"\bLO:HI\b", "(lo, hi)", text)
    text = re.sub(r"\bLO:(?= )", "(lo, None)", text)
    return re.sub(r"\ba smaller HI\b", "a smaller hi", text)


def _of_python(text: Any) -> Any:
    """Names arguments and functions of Python, where a message names the command's."""
    if not isinstance(text, str):
        return text
    text = re.sub(r"`?\bregulus (check|locate|margin|bound|solve|verify)\b`?", r"\1()", text)
    text = _with_ranges(text)
    text = re.sub(r"^(MOTION|QUANTITY): ", lambda place: place[0].lower(), text)
    return re.sub(r"(?<![\w-])--([a-z][a-z0-9-]*)", _argument, text)


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
        super().__init__(_of_python(message))
        self.file = file
        self.line = line
        self.problem = problem
        self.remedy = _of_python(remedy)
        self.symbol = symbol

    def __reduce__(self) -> tuple[Any, ...]:
        return (
            InputError,
            (str(self), self.file, self.line, self.problem, self.remedy, self.symbol),
        )


class UsageError(RegulusError, ValueError):
    """A wrong argument: an unknown motion, for example, or a number that is not finite."""

    def __init__(self, *words: object) -> None:
        super().__init__(*map(_of_python, words))


class ArgumentTypeError(UsageError, TypeError):
    """An argument of the wrong type: a list for a number, for example."""


class FileError(RegulusError, OSError):
    """A file that cannot be read or written."""


class CompileError(RegulusError, RuntimeError):
    """The compiler cannot be opened, or refused the text of a kernel."""


class MissingPackageError(RegulusError, ImportError):
    """A package of Python that an answer needs, and that is not installed."""


class InternalError(RegulusError, RuntimeError):
    """A fault of Regulus itself."""


_PACKAGES = {"numpy": "NumPy", "matplotlib": "Matplotlib"}


def require_package(package: str, what: str) -> None:
    """Raises MissingPackageError if `what` needs a package that is not installed."""
    if find_spec(package) is None:
        raise MissingPackageError(
            f"{what} needs {_PACKAGES[package]}, which is not installed: pip install {package}"
        )
