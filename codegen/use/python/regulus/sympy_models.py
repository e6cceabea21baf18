# SPDX-License-Identifier: GPL-3.0-or-later
"""Models from matrices of SymPy."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Iterable, Mapping, Optional, Sequence, Union

from .errors import ArgumentTypeError, UsageError
from .numbers import Range, Texts
from .robot import Robot
from .toml import Writer, motion_tables

_FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "Abs")

_SUM, _PRODUCT, _POWER, _ATOM = range(4)


class _Printer:
    """Writes expressions as model files have them."""

    def __init__(self, texts: Texts, symbols: Optional[Iterable[str]] = None) -> None:
        self._texts = texts
        self._symbols = None if symbols is None else set(symbols)

    def text(self, e: Any) -> str:
        import sympy

        return self._written(sympy.sympify(e))[0]

    def _within(self, e: Any, least: int) -> str:
        text, precedence = self._written(e)
        return text if precedence >= least else f"({text})"

    def _written(self, e: Any) -> tuple[str, int]:
        import sympy

        if isinstance(e, sympy.Rational):
            return self._number(Fraction(int(e.p), int(e.q)))
        if isinstance(e, sympy.Float):
            return self._number(Fraction(self._texts.of(float(e))))
        if e is sympy.pi:
            return "pi", _ATOM
        if e is sympy.E:
            return "exp(1)", _ATOM
        if isinstance(e, sympy.Symbol):
            return self._symbol(e.name), _ATOM
        if isinstance(e, sympy.Add):
            return self._sum(e), _SUM
        if isinstance(e, sympy.Mul):
            return self._product(e), _PRODUCT
        if isinstance(e, sympy.exp):
            return f"exp({self.text(e.args[0])})", _ATOM
        if isinstance(e, sympy.Pow):
            return self._power(e)
        return self._function(e), _ATOM

    def _number(self, value: Fraction) -> tuple[str, int]:
        text = str(value.numerator)
        if value.denominator != 1:
            return f"{text}/{value.denominator}", _SUM if value < 0 else _PRODUCT
        return text, _SUM if value < 0 else _ATOM

    def _symbol(self, name: str) -> str:
        if self._symbols is not None and name not in self._symbols:
            known = ", ".join(sorted(self._symbols))
            raise UsageError(f"the symbol {name} is not declared; pose and geometry have: {known}")
        return name

    def _sum(self, e: Any) -> str:
        text = ""
        for term in e.as_ordered_terms():
            if not text:
                text = self.text(term)
            elif term.could_extract_minus_sign():
                text += f" - {self._within(-term, _PRODUCT)}"
            else:
                text += f" + {self._within(term, _PRODUCT)}"
        return text

    def _product(self, e: Any) -> str:
        import sympy

        above, below = e.as_numer_denom() if e.is_commutative else (e, sympy.S.One)
        if below != 1 and above.is_Mul | above.is_Atom | above.is_Function | above.is_Add | above.is_Pow:
            return f"{self._within(above, _PRODUCT)}/{self._within(below, _POWER)}"
        factors = list(e.args)
        sign = ""
        if factors[0] == -1:
            sign, factors = "-", factors[1:]
        return sign + "*".join(self._within(f, _POWER) for f in factors)

    def _power(self, e: Any) -> tuple[str, int]:
        import sympy

        if e.exp == sympy.Rational(1, 2):
            return f"sqrt({self.text(e.base)})", _ATOM
        if e.exp.is_negative and e.exp.is_number:
            return f"1/{self._within(e.base ** -e.exp, _POWER)}", _PRODUCT
        if not isinstance(e.exp, sympy.Rational):
            raise UsageError(f"{e}: an exponent is a rational number in a model")
        return f"{self._within(e.base, _ATOM)}^{self._within(e.exp, _ATOM)}", _POWER

    def _function(self, e: Any) -> str:
        name = type(e).__name__
        if name not in _FUNCTIONS:
            raise UsageError(
                f"{e}: models do not have {name}; they have sqrt, {', '.join(_FUNCTIONS).lower()}"
            )
        return f"{name.lower()}({', '.join(self.text(a) for a in e.args)})"


def constant_text(value: Any, texts: Texts) -> str:
    """Returns a constant of SymPy, such as Rational(1, 3) or pi/12, as a text of a model."""
    if not getattr(value, "is_number", False):
        raise ArgumentTypeError(f"{value} is no constant")
    return _Printer(texts, symbols=()).text(value)


Pose = Union[Mapping[Any, str], Sequence[Any]]


def _pose_units(pose: Pose) -> dict[str, str]:
    pairs = pose.items() if isinstance(pose, Mapping) else ((p, "1") for p in pose)
    return {str(name): unit for name, unit in pairs}


def from_sympy(
    matrix: Any,
    pose: Pose,
    *,
    motions: Mapping[str, Mapping[Any, Range]],
    geometry: Optional[Mapping[Any, Range]] = None,
    row_scale: Optional[Sequence[Any]] = None,
    name: str = "robot",
    source: str = "",
) -> Robot:
    """Makes a robot of its inverse Jacobian.

    SymPy has simplified the entries when they were made, x/x to 1 for every x: the claim is about
    what it made of them. `text` is a model file that can be read and kept.

    Args:
        matrix: m×n, m ≥ n: a row of J⁻¹ for each leg, up to its row scale.
        pose: the pose parameters in the order of the twist, with their units: {x: "m", phi: "rad"}.
            A list of symbols has the unit "1".
        motions: by name, the range or the value of every pose parameter.
        geometry: the values of other symbols; a pair is (value, tolerance), and the symbol is then
            the group of its tolerance.
        row_scale: a positive factor for each row; it matters for a threshold.
        name: of the robot.
        source: who published the numbers.

    Raises:
        UsageError: for a symbol that is not declared or a function that models do not have.
        InputError: if the model has another mistake.
    """
    texts = Texts()
    units = _pose_units(pose)
    constants = {str(symbol): value for symbol, value in (geometry or {}).items()}
    printer = _Printer(texts, [*units, *constants])
    writer = Writer(texts)
    writer.head(name, source)
    writer.table("pose")
    for symbol, unit in units.items():
        writer.text(symbol, unit)
    if constants:
        writer.table("geometry")
        for symbol, value in constants.items():
            writer.quantity(symbol, value)
    writer.table("matrix")
    rows = [[printer.text(entry) for entry in matrix.row(i)] for i in range(matrix.rows)]
    writer.rows("rows", rows)
    if row_scale is not None:
        writer.texts("row_scale", [printer.text(s) for s in row_scale])
    motion_tables(writer, motions)
    return Robot(writer.model(), notes=texts.notes)
