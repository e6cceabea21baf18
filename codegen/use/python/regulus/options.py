# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a search as a type, so that a checker of types sees a wrong name."""

from __future__ import annotations

from typing import Iterable, Mapping, Optional, SupportsFloat, SupportsIndex, TypedDict

from .numbers import Number


class Options(TypedDict, total=False):
    """Options of the command, with _ for -. None: the default."""

    beyond_limits: Optional[bool]
    bisect: Optional[str]
    determinant: Optional[str]
    engine: Optional[str]
    entries: Optional[str]
    filters: Optional[Iterable[str]]
    isa: Optional[str]
    kernel: Optional[str]
    max_boxes: Optional[SupportsIndex]
    method: Optional[str]
    precision: Optional[SupportsIndex]
    symbolic_budget: Optional[SupportsIndex]
    threads: Optional[SupportsIndex]
    time_limit: Optional[SupportsFloat]
    uncertainty: Optional[str]
    use_cache: Optional[bool]
    weights: Optional[Mapping[str, Number]]
    without: Optional[Iterable[str]]
