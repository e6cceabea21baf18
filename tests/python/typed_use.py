# SPDX-License-Identifier: GPL-3.0-or-later
"""What a program may write: mypy accepts it (python.typed_use), and it runs (test_arguments.py)."""

from __future__ import annotations

import os
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import regulus as rg


def ranges(robot: rg.Robot) -> None:
    pair = np.array([-1.0, 1.0])
    pairs = {"x": (-1, 1), "y": (15.0, 16.0)}
    arrays = {"x": pair, "y": 15 + pair}
    robot.check("regular", range={"x": pair, "y": (15, 16), "phi": ("-1*deg", "1*deg")})
    robot.check("regular", range=pairs)
    robot.check("regular", range=arrays)
    robot.check("regular", range={"x": [0, Fraction(1, 3)], "y": Decimal("15.5")})
    robot.check("regular", range={"x": (np.float64(0), np.int64(1)), "y": np.float32(15.5)})
    for row in np.linspace([14, 15], [15, 16], 2):
        robot.check("regular", range={"x": row[0] - 14, "y": row})
    robot.locate("regular", range=arrays, resolution=np.float64(1), max_boxes=2)


def other_numbers(robot: rg.Robot, folder: Path) -> None:
    robot.check("regular", tolerance={"base": np.float64(0)}, alpha=np.int64(0), tube={"x": np.float64(0)})
    robot.check("regular", certificate=os.fsencode(folder / "proof.txt"))
    robot.margin("regular", tolerance={"base": np.array([0, 0.25])}, gap=np.float64(0.5))
    robot.margin("regular", tolerance={"base": (0, None)}, gap="1/2")
    robot.bound("regular", "determinant", limit=np.float64(0.5), max_boxes=8)
    prepared = robot.prepare("regular", range={"x": np.array([0, 1])})
    prepared.check(range={"x": np.array([0, 0.5]), "y": (15, 16)}, alpha=np.float64(0))


def solutions(robot: rg.Robot) -> None:
    lengths = np.array([14.5, 14.75])
    robot.solve(at={"rho_1": np.float64(14.5), "rho_2": 15, "rho_3": "12"})
    robot.solve_many(at={"rho_1": lengths, "rho_2": [15, 15.5], "rho_3": 12})


def models() -> None:
    turns = np.linspace(0, 2 * np.pi, 6, endpoint=False).round(1)
    anchors = np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=1)
    pose = {"x": np.array([0, 1]), "y": (0, 1), "z": 1.0, "psi": 0, "theta": 0, "phi": np.float64(0)}
    rg.gough(anchors, [tuple(0.5 * p) for p in anchors], motions={"m": pose})
    rg.gough(anchors.tolist(), list(anchors), motions={"m": pose})
    rg.serial(np.array([[0, 0, 1.0, 0], [1, 0, 0, 0]]), motions={"m": {"q1": np.array([0, 1]), "q2": 0}})


def wrong_names(robot: rg.Robot) -> None:
    """Not called: mypy refuses each of these."""
    robot.check("regular", rnge={"x": (0, 1)})  # type: ignore[call-arg]
    robot.bound("regular", "determinant", max_boxs=8)  # type: ignore[call-arg]
    robot.solve(at={"rho_1": 14.5}, time_limit="1 s")  # type: ignore[arg-type]
    robot.prepare("regular", thread=1)  # type: ignore[call-arg]
