# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes model files that people can read."""

from __future__ import annotations

import json
import re
from typing import Any, Mapping, Sequence

from .arguments import elements_of
from .errors import UsageError
from .numbers import Number, Range, Texts

_INTEGER = re.compile(r"-?\d{1,18}$")


def quoted(text: str) -> str:
    """Returns a string of TOML."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


class Writer:
    """Collects the lines of a model file. Numbers keep their exact values."""

    def __init__(self, texts: Texts) -> None:
        self._texts = texts
        self._lines: list[str] = []

    def head(self, name: str, source: str) -> None:
        self._lines += ["regulus = 1", f"name = {quoted(name)}"]
        if source:
            self._lines.append(f"source = {quoted(source)}")

    def table(self, name: str) -> None:
        self._lines += ["", f"[{name}]"]

    def line(self, name: str, value: str) -> None:
        self._lines.append(f"{name} = {value}")

    def text(self, name: str, value: str) -> None:
        self.line(name, quoted(value))

    def number(self, value: Any, name: str = "") -> str:
        text = self._texts.of(value, name)
        return text if _INTEGER.match(text) else quoted(text)

    def numbers(self, values: Sequence[Number], name: str = "") -> str:
        return "[" + ", ".join(self.number(value, name) for value in values) + "]"

    def texts(self, name: str, texts: Sequence[str]) -> None:
        self.line(name, "[" + ", ".join(map(quoted, texts)) + "]")

    def rows(self, name: str, rows: Sequence[Sequence[str]]) -> None:
        lines = ",\n  ".join("[" + ", ".join(map(quoted, row)) + "]" for row in rows)
        self.line(name, f"[\n  {lines},\n]")

    def quantity(self, name: str, value: Range) -> None:
        """Writes a constant, or (value, tolerance) in a group of its own."""
        pair = elements_of(value)
        if pair is None:
            self.line(name, self.number(value, name))
            return
        if len(pair) != 2:
            raise UsageError(f"geometry: {name!r} has {len(pair)} numbers; give (value, tolerance)")
        self.line(
            name,
            f"{{ value = {self.number(pair[0], name)}, tolerance = {self.number(pair[1], name)}, "
            f"group = {quoted(name)} }}",
        )

    def model(self) -> str:
        """Returns the text, with the notes on floats as comments."""
        notes = [f"# {note}" for note in self._texts.notes]
        return "\n".join([*notes, *self._lines]) + "\n"


def motion_tables(writer: Writer, motions: Mapping[str, Mapping[Any, Any]]) -> None:
    """Writes [motion.NAME] tables: a range or a value of each pose parameter."""
    for name, ranges in motions.items():
        writer.table(f"motion.{name}")
        for parameter, value in ranges.items():
            ends, where = elements_of(value), f"{name}: {parameter}"
            text = writer.number(value, where) if ends is None else writer.numbers(ends, where)
            writer.line(str(parameter), text)
