# SPDX-License-Identifier: GPL-3.0-or-later
"""Proves that a robot has no singular pose in a workspace, or shows one.

    import regulus as rg
    robot = rg.load("robot_1")
    print(robot.check("wide_15").claim)

Numbers are exact: "0.1", Fraction(1, 10), Decimal("0.1") and SymPy's Rational(1, 10) are 1/10; a
float is the double that it is.
"""

from ._regulus import VERSION as __version__
from .errors import (
    ArgumentTypeError,
    CompileError,
    FileError,
    InputError,
    InternalError,
    MissingPackageError,
    RegulusError,
    UsageError,
)
from .families import gough, serial
from .sympy_models import from_sympy
from .paving import LoadPaving, Paving
from .results import Bound, Certificate, Check, LoadCheck, Margin, PreparedCheck, Verification
from .robot import Prepared, Robot, from_urdf, load, models, verify
from .solutions import Found, Solved, SolvedPlaces

__all__ = [
    "ArgumentTypeError",
    "Bound",
    "Certificate",
    "Check",
    "CompileError",
    "FileError",
    "Found",
    "InputError",
    "InternalError",
    "LoadCheck",
    "LoadPaving",
    "Margin",
    "MissingPackageError",
    "Paving",
    "Prepared",
    "PreparedCheck",
    "RegulusError",
    "Robot",
    "Solved",
    "SolvedPlaces",
    "UsageError",
    "Verification",
    "__version__",
    "from_sympy",
    "from_urdf",
    "gough",
    "load",
    "models",
    "serial",
    "verify",
]
