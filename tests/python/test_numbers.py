# SPDX-License-Identifier: GPL-3.0-or-later
from decimal import Decimal
from fractions import Fraction

import numpy
import pytest

import regulus as rg
from regulus.numbers import Texts

sympy = pytest.importorskip("sympy")


@pytest.mark.parametrize(
    "value, text",
    [
        (3, "3"),
        (-7, "-7"),
        ("15*deg", "15*deg"),
        (Fraction(1, 3), "1/3"),
        (Fraction(-1, 3), "-1/3"),
        (Decimal("0.1"), "0.1"),
        (Decimal("1E-3"), "0.001"),
        (Decimal("1E+3"), "1e+3"),
        (0.5, "1/2"),
        (numpy.int64(4), "4"),
        (numpy.float32(0.25), "1/4"),
        (sympy.Rational(1, 3), "1/3"),
        (sympy.pi / 12, "pi/12"),
        (sympy.sqrt(2), "sqrt(2)"),
        (-sympy.sqrt(3) / 2, "-sqrt(3)/2"),
    ],
)
def test_exact_numbers_have_exact_texts(value, text):
    texts = Texts()
    assert texts.of(value) == text
    assert texts.notes == []


def test_a_float_is_the_double_that_it_is_and_noted_once(circle):
    texts = Texts()
    assert Fraction(texts.of(0.1)) == Fraction(0.1) != Fraction(1, 10)
    texts.of(0.1)
    assert len(texts.notes) == 1 and '"0.1"' in texts.notes[0]
    found = circle.check("outside", tolerance={"platform": 0.1}, range={"x": (2.1, 2.1)})
    assert found.report.count("note       the float 0.1 ") == 1
    assert sum("the float 0.1 " in note for note in found.json["notes"]) == 1
    assert "note " not in circle.check("outside", tolerance={"platform": "0.1"}).report


@pytest.mark.parametrize("tolerance, verdict", [
    (Fraction(1, 2), "no-singularity"),
    # The distance of the corner from the circle is √8 − 1.
    ("sqrt(8) - 1 - 1/10^30", "no-singularity"),
    (sympy.sqrt(8) - 1, "singularity"),
])
def test_exact_numbers_arrive_exactly(circle, tolerance, verdict):
    changes = {"x": (2, 2), "y": (2, 2)}
    assert circle.check("outside", range=changes, tolerance={"platform": tolerance}).verdict in (
        verdict,
        "possible-problem",
    )


@pytest.mark.parametrize("value", [True, None, [1], {}, 1j])
def test_what_is_no_number_is_refused(circle, value):
    with pytest.raises(TypeError):
        circle.check("outside", tolerance={"platform": value})


@pytest.mark.parametrize("value", [float("nan"), float("inf"), Decimal("NaN"), Decimal("-Infinity")])
def test_what_is_not_finite_is_refused(circle, value):
    with pytest.raises(ValueError, match="finite"):
        circle.check("outside", tolerance={"platform": value})


@pytest.mark.parametrize("value", [sympy.Symbol("x"), sympy.I, sympy.oo, sympy.nan, sympy.zoo])
def test_what_is_no_real_constant_of_sympy_is_refused(circle, value):
    with pytest.raises((TypeError, ValueError)):
        circle.check("outside", tolerance={"platform": value})


def test_a_range_of_doubles_is_exactly_these(circle):
    found = circle.check("across", range={"x": (0.1, 0.2), "y": 0})
    assert found.witness is None
    assert rg.Robot(circle.text).check("outside", range={"x": [2, 3]})
