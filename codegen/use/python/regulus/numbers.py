# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact texts of numbers.

Regulus computes with the number that a text denotes: "0.1" is 1/10. A float of Python is the double
that it is, and 0.1 is not 1/10; the report of a question says so.
"""

from __future__ import annotations

import math
import numbers
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Sequence, Tuple, Union

from .errors import ArgumentTypeError, UsageError

if TYPE_CHECKING:
    import numpy
    import numpy.typing
    import sympy

    Array = numpy.typing.NDArray[Any]
    Number = Union[
        str, int, float, Fraction, Decimal, numpy.integer[Any], numpy.floating[Any], sympy.Expr
    ]
else:
    Array = Number = Any

Numbers = Union[Sequence[Number], Array]
Range = Union[Number, Tuple[Number, Number], Numbers]
"""(lower, upper) as a tuple, a list or an array of NumPy, or one value."""


def _text_of_fraction(value: Fraction) -> str:
    if value.denominator == 1:
        return str(value.numerator)
    return f"{value.numerator}/{value.denominator}"


def _is_of_sympy(value: object) -> bool:
    return type(value).__module__.partition(".")[0] == "sympy"


class Texts:
    """Turns numbers into texts, and keeps notes on the floats among them."""

    def __init__(self) -> None:
        self.notes: list[str] = []

    def of(self, value: Any, name: str = "") -> str:
        """Returns the text of a number of a model: an integer, "1/3", "15*deg", a Fraction, a
        Decimal, a constant of SymPy, a float.

        Args:
            name: of the argument, for errors.

        Raises:
            ArgumentTypeError: for what is no number. A bool is none.
            UsageError: for infinities and NaN.
        """
        try:
            return self._of(value)
        except UsageError as wrong:
            if not name:
                raise
            raise type(wrong)(f"{name}: {wrong}") from None

    def _of(self, value: Any) -> str:
        if isinstance(value, str):
            return value
        if getattr(value, "ndim", None) == 0 and hasattr(value, "item"):
            value = value.item()
        if isinstance(value, bool):
            raise ArgumentTypeError(f"{value} is a bool; give a number, or a text such as '0.1'")
        if _is_of_sympy(value):
            from .sympy_models import constant_text

            return constant_text(value, self)
        if isinstance(value, Decimal):
            return self._of_decimal(value)
        if isinstance(value, numbers.Rational):
            return _text_of_fraction(Fraction(value))
        if isinstance(value, numbers.Real):
            if math.isfinite(value) and float(value) != value:
                raise UsageError(f"{value!r} is not a double; give a text or a Fraction")
            return self._of_float(float(value))
        raise ArgumentTypeError(
            f"{value!r} is a {type(value).__name__}; give a number, or a text such as '0.1'"
        )

    def _of_decimal(self, value: Decimal) -> str:
        if not value.is_finite():
            raise UsageError(f"{value} is not a finite number")
        return str(value).lower()

    def _of_float(self, value: float) -> str:
        if not math.isfinite(value):
            raise UsageError(f"{value} is not a finite number")
        decimal = repr(value)
        if Fraction(decimal) == Fraction(value):
            return _text_of_fraction(Fraction(value))
        note = (
            f"the float {decimal} is the double next to it, {float.hex(value)}; "
            f'write "{decimal}" for the decimal'
        )
        if note not in self.notes:
            self.notes.append(note)
        return _text_of_fraction(Fraction(value))
