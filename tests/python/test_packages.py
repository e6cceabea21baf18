# SPDX-License-Identifier: GPL-3.0-or-later
"""What a missing package, and a margin of the control errors, mean for who calls."""

import sys

import pytest

import regulus as rg

QUESTIONS = {
    "locate": lambda robot: robot.locate("regular"),
    "solve": lambda robot: robot.solve("regular"),
    "solve_many": lambda robot: robot.solve_many("regular", at={"x": [1, 2]}),
}


@pytest.mark.parametrize("name", QUESTIONS)
def test_a_missing_numpy_is_an_error_of_the_family_before_the_search(name, planar, monkeypatch):
    monkeypatch.setitem(sys.modules, "numpy", None)
    with pytest.raises(rg.RegulusError) as caught:
        QUESTIONS[name](planar)
    assert isinstance(caught.value, (rg.MissingPackageError, ImportError))
    assert str(caught.value) == f"{name}() needs NumPy, which is not installed: pip install numpy"


def test_a_margin_of_the_tube_is_that_of_the_command(planar, command):
    asked = {"x,y": (0, "1/64")}
    found = planar.margin("regular", tube=asked)
    told = command("margin", "planar_3rpr", "regular", "--tube", "x,y=0:1/64")
    assert (found.safe, found.bracket) == ("1/64", told["bracket"])
