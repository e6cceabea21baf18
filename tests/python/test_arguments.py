# SPDX-License-Identifier: GPL-3.0-or-later
"""Wrong arguments are errors of one family, in Python's words; arrays of NumPy are ranges."""

import ast
import math
import pathlib
import re

import numpy
import pytest

import regulus as rg
from regulus.options import Options
import typed_use

PLANAR = rg.load("planar_3rpr")
CABLE = rg.load("cable_8")
NAN = float("nan")

WRONG = {
    "nan in a range": lambda: PLANAR.check("regular", range={"x": (0, NAN)}),
    "an infinite tolerance": lambda: PLANAR.check("regular", tolerance={"base": math.inf}),
    "None in a range": lambda: PLANAR.check("regular", range={"x": (0, None)}),
    "a range that is a list": lambda: PLANAR.check("regular", range=[1, 2]),
    "a range of three": lambda: PLANAR.check("regular", range={"x": (1, 2, 3)}),
    "an array of three": lambda: PLANAR.check("regular", range={"x": numpy.zeros(3)}),
    "a tolerance without its group": lambda: PLANAR.check("regular", tolerance=0.1),
    "a key that is no text": lambda: PLANAR.check("regular", tolerance={1: 0.1}),
    "no motion": lambda: PLANAR.check(None),
    "an unknown motion": lambda: PLANAR.check("regulr"),
    "threads below 0": lambda: PLANAR.check("regular", threads=-1),
    "too many threads": lambda: PLANAR.check("regular", threads=10**30),
    "half a thread": lambda: PLANAR.check("regular", threads=1.5),
    "a time of nan": lambda: PLANAR.check("regular", time_limit=NAN),
    "a time below 0": lambda: PLANAR.check("regular", time_limit=-1),
    "a time that is a text": lambda: PLANAR.check("regular", time_limit="60"),
    "a method that is a number": lambda: PLANAR.check("regular", method=3),
    "an unknown method": lambda: PLANAR.check("regular", method="rohn"),
    "an unknown option": lambda: PLANAR.check("regular", timelimit=3),
    "filters that are a text": lambda: PLANAR.check("regular", filters="f.so"),
    "a cache that is a number": lambda: PLANAR.check("regular", use_cache=1),
    "a certificate that is a number": lambda: PLANAR.check("regular", certificate=3),
    "shards without a certificate": lambda: PLANAR.check("regular", shard_size=4096),
    "shards of 100 bytes": lambda: PLANAR.check("regular", certificate="x", shard_size=100),
    "shards of half a byte": lambda: PLANAR.bound("regular", "x", certificate="x", shard_size=0.5),
    "way-points that are a number": lambda: PLANAR.check("regular", waypoints=3),
    "a file that is a number": lambda: rg.load(3.5),
    "a robot of bytes": lambda: rg.Robot(b"regulus = 1"),
    "verify with -1 threads": lambda: rg.verify("x", threads=-1),
    "import with a text of cuts": lambda: rg.from_urdf("x", cuts="a=b"),
    "a resolution of None": lambda: PLANAR.locate("regular", resolution=None),
    "a resolution of 2": lambda: PLANAR.locate("regular", resolution=2),
    "a leg of None": lambda: PLANAR.bound("regular", "force", leg=None),
    "no quantity": lambda: PLANAR.bound("regular"),
    "an unknown quantity": lambda: PLANAR.bound("regular", "forces"),
    "least that is a text": lambda: PLANAR.bound("regular", "x", least="yes"),
    "a margin of three": lambda: PLANAR.margin("regular", scale=(1, 2, 3)),
    "two sizes": lambda: PLANAR.margin("regular", scale=(1, 2), alpha=(0, 1)),
    "no size": lambda: PLANAR.margin("regular"),
    "a limit without a quantity": lambda: PLANAR.margin("regular", scale=(1, 2), limit=3),
    "an alpha that grows below a limit": lambda: PLANAR.margin(
        "regular", alpha=(0, 1), quantity="x", limit=30
    ),
    "a load that is a number": lambda: CABLE.check_load("hall", 3),
    "a method for a load": lambda: CABLE.check_load("hall", "weight", method="kj"),
    "a precision for a paved load": lambda: CABLE.locate_load("hall", "weight", precision=64),
    "a filter for a load": lambda: CABLE.check_load("hall", "weight", filters=["f.so"]),
    "a prepared check with -1 boxes": lambda: PLANAR.prepare("regular").check(max_boxes=-1),
}


@pytest.mark.parametrize("name", WRONG)
def test_every_wrong_argument_is_a_usage_error_in_words_of_python(name):
    with pytest.raises(rg.UsageError) as raised:
        WRONG[name]()
    message = str(raised.value)
    assert isinstance(raised.value, (rg.RegulusError, ValueError))
    assert not re.search(r"(^|[^\w-])--\w", message), message
    assert "incompatible function arguments" not in message and "_regulus" not in message


NUMBERS = {
    "alpha": lambda: PLANAR.check("regular", alpha=NAN),
    "range: x": lambda: PLANAR.check("regular", range={"x": (0, NAN)}),
    "tolerance: base": lambda: PLANAR.check("regular", tolerance={"base": NAN}),
    "tube: x": lambda: PLANAR.check("regular", tube={"x": NAN}),
    "tube": lambda: PLANAR.check("regular", tube=NAN),
    "resolution": lambda: PLANAR.locate("regular", resolution=NAN),
    "gap": lambda: PLANAR.margin("regular", scale=(0, 1), gap=NAN),
    "scale": lambda: PLANAR.margin("regular", scale=(0, NAN)),
    "tolerance: platform": lambda: PLANAR.margin("regular", tolerance={"platform": (0, NAN)}),
    "limit": lambda: PLANAR.bound("regular", "sigma-min", limit=NAN),
    "base_tolerance": lambda: rg.gough([[0] * 3] * 6, [[0] * 3] * 6, motions={}, base_tolerance=NAN),
    "base": lambda: rg.gough([[NAN] * 3] * 6, [[0] * 3] * 6, motions={}),
}


@pytest.mark.parametrize("name", NUMBERS)
def test_a_number_that_is_none_is_told_with_its_argument(name):
    with pytest.raises(rg.UsageError, match=f"^{name}: nan is not a finite number"):
        NUMBERS[name]()


def test_a_wrong_type_is_a_type_error_too():
    with pytest.raises(TypeError, match="threads: found 1.5; give a whole number"):
        PLANAR.check("regular", threads=1.5)
    assert issubclass(rg.ArgumentTypeError, rg.UsageError)


def test_a_path_may_be_bytes(tmp_path):
    path = tmp_path / "planar.toml"
    PLANAR.write(path)
    assert rg.load(bytes(path)) == rg.load(path)
    with pytest.raises(rg.FileError):
        rg.load(b"/no/such/file")
    with pytest.raises(rg.RegulusError, match="not UTF-8"):
        rg.load(b"/no/such/\xff")


@pytest.mark.parametrize("kind", ["float64", "float32", "int64"])
def test_an_array_is_a_range(kind):
    ends = numpy.array([14, 15], dtype=kind)
    asked = PLANAR.check("regular", range={"y": ends}).json["question"]["ranges_exact"]
    assert asked["y"] == ["14", "15"]
    one = PLANAR.check("regular", range={"y": numpy.array(14, dtype=kind)})
    assert one.verdict == PLANAR.check("regular", range={"y": 14}).verdict


def test_arrays_are_ends_of_a_margin():
    found = PLANAR.margin("regular", scale=numpy.array([1.0, 1.5]), gap="0.5", time_limit=20)
    assert found.bracket


def test_a_motion_along_way_points_is_paved(tmp_path):
    way = tmp_path / "way.csv"
    way.write_text("t,x,y,phi\n0,0,14,0\n1,1,15,0\n2,2,16,0\n")
    paving = PLANAR.locate("regular", waypoints=way)
    assert [s["segments"] for s in paving.stretches] == [[1, 2]]
    assert len(paving.boxes) == 0 and "stretches" in repr(paving)
    with pytest.raises(rg.UsageError, match="no boxes"):
        paving.fractions
    proof = tmp_path / "proof"
    assert PLANAR.locate("regular", waypoints=way, certificate=proof).certificate == str(proof)
    assert rg.verify(proof)


def test_pavings_margins_and_bounds_write_their_proofs(tmp_path):
    proof = tmp_path / "proof"
    paving = PLANAR.locate("regular", resolution="1/2", certificate=proof)
    assert paving.certificate == str(proof) and rg.verify(proof, model=PLANAR.path)
    margin = PLANAR.margin("regular", tolerance="base", gap="0.5", certificate=proof)
    assert margin.certificates == [f"{proof}.safe", f"{proof}.singular"]
    bound = PLANAR.bound("regular", "x*y", gap="0.5", certificate=proof)
    assert bound.certificates == [f"{proof}.safe", f"{proof}.singular"]
    assert all(rg.verify(file) for file in margin.certificates + bound.certificates)


TURN = """regulus = 1
name = "turn"
[pose]
x = "m"
y = "m"
[matrix]
rows = [["cos(x*y)", "sin(x*y)"], ["-sin(x*y)", "cos(x*y)"]]
[motion.box]
x = [0, 1]
y = [0, 1]
"""


def test_a_proof_may_be_in_shards(tmp_path):
    proof = tmp_path / "proof"
    bound = rg.Robot(TURN).bound(
        "box", "condition", norm="2", gap="0.05", certificate=proof, shard_size=4096
    )
    safe = pathlib.Path(bound.certificates[0])
    assert len(list((tmp_path / f"{safe.name}.shards").iterdir())) > 2 and rg.verify(safe)
    (tmp_path / f"{safe.name}.shards" / "2").unlink()
    assert "shard 2: it is missing" in rg.verify(safe).reason


def test_a_proof_of_a_branch_may_be_in_shards(tmp_path):
    proof = tmp_path / "proof"
    bound = rg.load("five_bar_closure").bound(
        "work", "condition", gap="0.05", certificate=proof, shard_size=4096
    )
    safe = pathlib.Path(bound.certificates[0])
    assert len(list((tmp_path / f"{safe.name}.shards").iterdir())) > 2 and rg.verify(safe)
    (tmp_path / f"{safe.name}.shards" / "2").unlink()
    assert "shard 2: it is missing" in rg.verify(safe).reason


def test_what_types_accept_runs(tmp_path):
    typed_use.ranges(PLANAR)
    typed_use.other_numbers(PLANAR, tmp_path)
    typed_use.solutions(rg.load("rpr_6"))
    typed_use.models()
    assert (tmp_path / "proof.txt").exists()


def test_the_type_of_options_has_each_option():
    options = {name for name in dir(rg._regulus.SearchOptions()) if not name.startswith("_")}
    assert set(Options.__annotations__) == options | {"beyond_limits"}


def test_the_stub_says_what_the_module_has():
    """Without mypy, whose stubtest says more: names, and the signatures that pybind11 writes."""
    stub = ast.parse((pathlib.Path(rg.__file__).parent / "_regulus.pyi").read_text())
    names = set()
    for node in stub.body:
        if isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
        if not isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            continue
        names.add(node.name)
        found = getattr(rg._regulus, node.name)
        if isinstance(node, ast.FunctionDef):
            written = found.__doc__.splitlines()[0].replace("regulus._regulus.", "")
            typed = f"{node.name}({ast.unparse(node.args)}) -> {ast.unparse(node.returns)}"
            assert re.sub(r" *= *", "=", written.replace("List[", "list[").replace("Tuple[", "tuple[")) == typed
        else:
            members = {n.target.id if isinstance(n, ast.AnnAssign) else n.name for n in node.body}
            assert {n for n in vars(found) if not n.startswith("_")} == {n for n in members if n[0] != "_"}
    assert names == {name for name in dir(rg._regulus) if not name.startswith("_")}
