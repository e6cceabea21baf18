# SPDX-License-Identifier: GPL-3.0-or-later
"""All solutions: arrays, truth values, many places, and errors in Python's words."""

import functools
import pickle
import re
from pathlib import Path

import numpy
import pytest

import regulus as rg

RPR = rg.load("rpr_6")
LENGTHS = {"rho_1": "14.98", "rho_2": "15.38", "rho_3": 12}


def test_solutions_are_arrays(command):
    found = RPR.solve()
    assert found and found.complete and (found.verdict, found.result) == ("complete", "COMPLETE: 6 poses")
    assert found.unknowns == ["x", "y", "phi"] and found.units == {"x": "1", "y": "1", "phi": "rad"}
    assert found.solutions.shape == (6, 3) and found.enclosures.shape == (6, 3, 2) and len(found) == 6
    assert (found.enclosures[..., 0] <= found.solutions).all()
    assert (found.solutions <= found.enclosures[..., 1]).all()
    assert found.signs.tolist() == [1, -1, -1, 1, 1, -1]
    assert found.limits == ["none"] * 6 and found.obstacle == "" and "search" in found.how
    report = command("solve", "rpr_6")
    assert [s["values"] for s in report["solutions"]] == [
        {n: list(ends) for n, ends in zip(found.unknowns, one)} for one in found.enclosures.tolist()
    ]
    assert found.json["solutions"] == report["solutions"]


def test_the_platform_is_at_its_legs():
    """The lengths at each solution, in floats, are those that were given."""
    base = numpy.array([[0, 0], [15.91, 0], [0, 10]])
    beta = 0.8826031098
    arms = numpy.array([[0, 0], [17.04, 0], [20.84 * numpy.cos(beta), 20.84 * numpy.sin(beta)]])
    for x, y, phi in RPR.solve(at=LENGTHS).solutions:
        turn = numpy.array([[numpy.cos(phi), -numpy.sin(phi)], [numpy.sin(phi), numpy.cos(phi)]])
        legs = arms @ turn.T + [x, y] - base
        assert numpy.allclose(numpy.hypot(*legs.T), [14.98, 15.38, 12])


def test_none_is_complete_and_false():
    found = rg.load("four_bar").solve(at={"theta": "135*deg"})
    assert found.complete and not found and found.verdict == "none" and len(found) == 0
    assert found.solutions.shape == (0, len(found.unknowns))


def test_a_proof_and_a_page(tmp_path):
    bars = rg.load("four_bar")
    found = bars.solve(at={"theta": "0.3"}, certificate=tmp_path / "proof.txt")
    assert found.certificate == str(tmp_path / "proof.txt")
    assert rg.verify(found.certificate).outcome == "verified"
    assert RPR.solve().certificate is None
    text = Path(found.page(tmp_path / "proved.html")).read_text(encoding="utf-8")
    assert "regulus-certificate" in text and str(tmp_path) not in text
    for answer in (found, bars.solve_many(at={"theta": [0.3, 0.4]})):
        page = Path(answer.page(tmp_path / "page.html")).read_text(encoding="utf-8")
        assert answer.result in page and "four-bar linkage" in page


def test_a_limit_leaves_it_incomplete():
    found = RPR.solve(max_boxes=1)
    assert not found and not found.complete and found.verdict == "incomplete" and found.obstacle
    assert found.how == ""


def test_a_tool_and_a_held_joint():
    tool = {"x": "0.4", "y": "0.1", "z": "0.5", "roll": 0, "pitch": "0.2", "yaw": 1}
    arm = rg.load("puma_560_serial").solve(at=tool)
    assert arm and len(arm) == 8 and arm.json["question"]["place"]["yaw"]["unit"] == "rad"


def test_a_tool_with_errors():
    tool = {"x": "0.4", "y": "0.1", "z": "0.5", "roll": 0, "pitch": "0.2", "yaw": 1}
    arm = rg.load("puma_560_serial")
    sharp, wide = arm.solve(at=tool), arm.solve(at=tool, tube={"x,y": "0.001", "yaw": "0.001"})
    assert wide and len(wide) == 8 and numpy.all(wide.signs == sharp.signs)
    assert numpy.all(numpy.abs(wide.solutions - sharp.solutions) < 0.02)
    many = arm.solve_many(at={**tool, "x": numpy.array([0.39, 0.4])}, tube={"x": "0.001"})
    assert many.verdicts.tolist() == ["complete"] * 2
    with pytest.raises(rg.UsageError, match="roll"):
        arm.solve(at=tool, tube={"q1": "0.001"})


def test_arrays_are_many_places():
    lengths = numpy.linspace(14, 15, 3)
    found = RPR.solve_many(at={**LENGTHS, "rho_1": lengths})
    assert len(found) == 3 and found and found.complete
    assert found.verdicts.tolist() == ["complete"] * 3
    assert found.counts.sum() == len(found.solutions) == len(found.indices)
    for i, length in enumerate(lengths):
        one = RPR.solve(at={**LENGTHS, "rho_1": length})
        assert numpy.array_equal(one.enclosures, found[i].enclosures)
        assert numpy.array_equal(one.solutions, found.solutions[found.indices == i])
    assert [len(one) for one in found] == found.counts.tolist()
    assert found.json["places"][1]["place"]["rho_1"]["exact"] == "29/2"


def test_a_table_is_many_places(tmp_path, command):
    table = tmp_path / "lengths.csv"
    table.write_text("t,rho_1,rho_2,rho_3\n0,14.98,15.38,12\n1,100,1,1\n")
    found = RPR.solve_many(waypoints=table)
    assert found.counts.tolist() == [6, 0] and not found and found.complete
    assert found.verdicts.tolist() == ["complete", "none"]
    report = command("solve", "rpr_6", "--waypoints", str(table))
    assert found.json["places"] == report["places"]


def test_a_certificate_of_many_places(tmp_path):
    proof, table = tmp_path / "proof.txt", tmp_path / "lengths.csv"
    table.write_text("rho_1,rho_2,rho_3\n14.98,15.38,12\n14.9,15.4,12.1\n")
    found = RPR.solve_many(waypoints=table, certificate=proof)
    assert found.certificate == str(proof) == found.json["certificate"]
    verify = functools.partial(rg.verify, proof, model=RPR.path)
    assert verify(waypoints=table).outcome == "verified"
    assert verify().outcome == "unfinished"
    rows = "".join(f"14.98,15.{n},12\n" for n in range(30, 50))
    table.write_text("rho_1,rho_2,rho_3\n" + rows)
    RPR.solve_many(waypoints=table, certificate=tmp_path / "cut", shard_size=4096)
    assert len(list((tmp_path / "cut.shards").iterdir())) > 2
    cut = rg.verify(tmp_path / "cut", model=RPR.path, waypoints=table)
    assert cut.outcome == "verified", cut.reason
    table.write_text("rho_1,rho_2,rho_3\n14.9,15.4,12.1\n14.98,15.38,12\n")
    assert verify(waypoints=table).outcome == "rejected"
    arrays = RPR.solve_many(at={**LENGTHS, "rho_1": ["14.98", "14.9"]}, certificate=proof)
    assert arrays.certificate and rg.verify(proof).outcome == "verified"
    assert RPR.solve_many(waypoints=table).certificate is None


def test_waypoints_of_a_motion_are_places(tmp_path):
    (tmp_path / "way.csv").write_text("theta\n0.5\n0.75\n")
    bars = rg.Robot(rg.load("four_bar").text + '[motion.way]\nwaypoints = "way.csv"\n')
    bars.write(tmp_path / "bars.toml")
    robot = rg.load(tmp_path / "bars.toml")
    assert robot.solve_many("way").counts.tolist() == [2, 2]
    with pytest.raises(rg.UsageError, match="ask solve_many"):
        robot.solve("way")


def test_answers_are_plain_data():
    for found in (RPR.solve(), RPR.solve_many(at={**LENGTHS, "rho_1": [14, 15]})):
        copy = pickle.loads(pickle.dumps(found))
        assert copy.json == found.json and numpy.array_equal(copy.solutions, found.solutions)
        assert found.result in repr(found) and "<table>" in found._repr_html_()


def test_floats_are_noted_once():
    notes = RPR.solve_many(at={**LENGTHS, "rho_1": [14.98, 14.99, 15.01]}).json["notes"]
    assert len([note for note in notes if "rho_1" in note]) == 1
    assert any("the float 12.1" in note for note in RPR.solve(at={"rho_3": 12.1}).json["notes"])


WRONG = {
    "several numbers": (lambda: RPR.solve(at={"rho_1": [1, 2]}), "ask solve_many"),
    "an unknown length": (lambda: RPR.solve(at={"rho_9": 1}), "at: .*did you mean 'rho_1'"),
    "no places": (lambda: RPR.solve_many(), "give the places"),
    "two kinds of places": (lambda: RPR.solve_many(at={"rho_1": [1]}, waypoints="x"), "give the places"),
    "lists of two lengths": (
        lambda: RPR.solve_many(at={"rho_1": [1, 2], "rho_2": [1]}),
        "at: the lists have different lengths",
    ),
    "empty lists": (lambda: RPR.solve_many(at={"rho_1": []}), "at: the lists are empty"),
    "a negative length": (
        lambda: RPR.solve_many(at={"rho_1": [1, -2]}),
        "at: place 2: found the negative number",
    ),
    "nan": (lambda: RPR.solve(at={"rho_1": float("nan")}), "at: rho_1: nan is not a finite"),
    "nan in an array": (
        lambda: RPR.solve_many(at={"rho_1": numpy.array([1.0, numpy.nan])}),
        r"at: rho_1\[1\]: nan is not a finite",
    ),
    "no dict": (lambda: RPR.solve(at=[1]), "at: found .*give a dict"),
    "hold that is a text": (lambda: RPR.solve(hold="q1"), "hold: found 'q1'; give a list"),
    "hold of a platform": (lambda: RPR.solve(hold=["q1"]), "only an arm"),
    "a method": (lambda: RPR.solve(method="kj"), "method: "),
    "a range": (lambda: rg.load("robot_1").solve("wide_15"), "give x=VALUE by the option at$"),
}


@pytest.mark.parametrize("name", WRONG)
def test_mistakes_are_usage_errors_in_words_of_python(name):
    ask, why = WRONG[name]
    with pytest.raises(rg.UsageError, match=why) as raised:
        ask()
    assert not re.search(r"(^|[^\w-])--\w", str(raised.value))
