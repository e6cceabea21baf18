# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments as the module takes them: a wrong one is a UsageError that names it."""

from __future__ import annotations

import math
import os
from typing import Any, Mapping, Optional, Sequence, Union

from .errors import ArgumentTypeError, UsageError
from .numbers import Texts

_LARGEST = (1 << 64) - 1
_BOUNDS = {
    "threads": (0, 1024),
    "max_boxes": (0, _LARGEST),
    "symbolic_budget": (1, _LARGEST),
    "precision": (53, 1 << 20),
}


def text_of(name: str, value: Any) -> str:
    """Returns a text, such as the name of a motion."""
    if not isinstance(value, str):
        raise ArgumentTypeError(f"{name}: found {value!r}; give a text")
    return value


def path_of(name: str, path: Any) -> str:
    """Returns a path as a text; bytes are decoded as the system does."""
    try:
        text = os.fsdecode(path)
    except TypeError:
        raise ArgumentTypeError(f"{name}: found {path!r}; give a path") from None
    try:
        text.encode()
    except UnicodeEncodeError:
        raise UsageError(f"{name}: the path {text!r} is not UTF-8; rename the file") from None
    return text


def optional_path(name: str, path: Any) -> str:
    """Returns "" for None."""
    return "" if path is None else path_of(name, path)


def proof_of(certificate: Any, shard_size: Any) -> tuple[str, int]:
    """Returns the file of a proof, "" for None, and the size of its shards."""
    return optional_path("certificate", certificate), count_of("shard_size", shard_size)


def mapping_of(name: str, value: Any) -> Mapping[str, Any]:
    """Returns the entries of a dict whose keys are names; {} for None."""
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise ArgumentTypeError(f"{name}: found {value!r}; give a dict, such as {{'x': 1}}")
    for key in value:
        text_of(f"{name}: a key", key)
    return value


def elements_of(value: Any) -> Optional[Sequence[Any]]:
    """Returns the elements of a tuple, a list or an array of NumPy; None for a single number."""
    if hasattr(value, "tolist") and hasattr(value, "ndim"):
        return list(value) if value.ndim > 0 else None
    return value if isinstance(value, (tuple, list)) else None


def assignments_of(name: str, numbers: Any, texts: Texts) -> list[str]:
    """Returns "NAME=VALUE" of each entry of a dict."""
    result = []
    for key, value in mapping_of(name, numbers).items():
        if elements_of(value) is not None:
            raise ArgumentTypeError(
                f"{name}: {key} has several numbers; give one, or ask solve_many()"
            )
        result.append(f"{key}={texts.of(value, f'{name}: {key}')}")
    return result


def places_of(name: str, lists: Mapping[str, Sequence[Any]], texts: Texts) -> list[list[str]]:
    """Returns "NAME=VALUE" of each number of each place, from a list of numbers for each name."""
    sizes = {key: len(values) for key, values in lists.items()}
    if len(set(sizes.values())) > 1:
        raise UsageError(f"{name}: the lists have different lengths: {sizes}")
    if 0 in sizes.values():
        raise UsageError(f"{name}: the lists are empty; give a number for each place")
    columns = []
    for key, values in lists.items():
        of_list = Texts()
        column = [f"{key}={of_list.of(v, f'{name}: {key}[{i}]')}" for i, v in enumerate(values)]
        columns.append(column)
        if of_list.notes:
            texts.notes.append(f"the floats of {key} are the doubles that they are, no decimals")
    return [list(place) for place in zip(*columns)]


def count_of(name: str, value: Any, least: int = 0, most: int = _LARGEST) -> int:
    """Returns a whole number."""
    try:
        if isinstance(value, bool):
            raise TypeError
        count = value.__index__()
    except (AttributeError, TypeError):
        raise ArgumentTypeError(f"{name}: found {value!r}; give a whole number") from None
    if not least <= count <= most:
        raise UsageError(f"{name}: found {count}; give a whole number from {least} to {most}")
    return int(count)


def seconds_of(name: str, value: Any) -> float:
    """Returns a time in seconds; 0: no limit."""
    if isinstance(value, (bool, str, bytes)):
        raise ArgumentTypeError(f"{name}: found {value!r}; give a number of seconds")
    try:
        seconds = float(value)
    except (TypeError, ValueError, OverflowError):
        raise ArgumentTypeError(f"{name}: found {value!r}; give a number of seconds") from None
    if not (math.isfinite(seconds) and seconds >= 0):
        raise UsageError(f"{name}: found {value!r}; give a number of seconds, 0 for no limit")
    return seconds


def words_of(name: str, value: Any) -> list[str]:
    """Returns a list of texts."""
    if isinstance(value, (str, bytes)) or not hasattr(value, "__iter__"):
        raise ArgumentTypeError(f"{name}: found {value!r}; give a list of texts")
    return [text_of(name, word) for word in value]


def option_of(name: str, value: Any) -> Union[str, int, float, bool, list[str]]:
    """Returns the value of an option of the search."""
    if name == "time_limit":
        return seconds_of(name, value)
    if name in _BOUNDS:
        return count_of(name, value, *_BOUNDS[name])
    if name == "use_cache":
        if not isinstance(value, bool):
            raise ArgumentTypeError(f"{name}: found {value!r}; give True or False")
        return value
    if name == "weights":
        return assignments_of(name, value, Texts())
    if name in ("filters", "without"):
        return words_of(name, value)
    return text_of(name, value)
