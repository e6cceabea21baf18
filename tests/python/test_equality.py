# SPDX-License-Identifier: GPL-3.0-or-later
"""The module answers as the command does: verdicts, boxes, certificates."""

import json
import math
import pathlib

import numpy
import pytest

import regulus as rg

CASES = [
    ("robot_1", "wide_15", {}, []),
    ("robot_1", "wide_15", {"tolerance": {"base": "0.05"}}, ["--tolerance", "base=0.05"]),
    ("robot_1", "wide_15", {"range": {"x": (-10, 10)}}, ["--range", "x=-10:10"]),
    ("robot_2", "table5_40", {}, []),
    ("planar_3rpr", "crossing", {}, []),
    ("planar_3rpr", "regular", {"alpha": "100"}, ["--alpha", "100"]),
    ("orthoglide", "", {}, []),
    ("cable_8", "", {"method": "kj-numeric"}, ["--method", "kj-numeric"]),
]
SAME = ("verdict", "claim", "reason", "boxes", "witness", "blocking_box", "leaves", "motion")


@pytest.mark.parametrize("name, motion, arguments, options", CASES)
def test_check_is_that_of_the_command(name, motion, arguments, options, command):
    robot = rg.load(name)
    motion = motion or next(iter(robot.motions))
    expected = command("check", robot.path, motion, *options)
    found = robot.check(motion, **arguments)
    assert found.verdict == expected["verdict"]
    assert found.boxes == expected["boxes"]
    assert {key: found.json[key] for key in SAME} == {key: expected[key] for key in SAME}


@pytest.mark.parametrize("motion", ["regular", "crossing"])
def test_certificates_are_equal_to_the_byte(motion, planar, command, tmp_path):
    command("check", planar.path, motion, "--certificate", str(tmp_path / "command"))
    during, after = tmp_path / "during", tmp_path / "after"
    found = planar.check(motion, certificate=during)
    assert found.certificate.path == str(during)
    planar.check(motion).certificate.write(after)
    bytes_of_command = (tmp_path / "command").read_bytes()
    assert during.read_bytes() == bytes_of_command == after.read_bytes()
    assert rg.verify(after)
    assert rg.verify(after, model=planar.path).json["differences"] == []


def test_a_damaged_certificate_is_rejected(planar, tmp_path):
    path = pathlib.Path(planar.check("regular").certificate.write(tmp_path / "proof"))
    path.write_bytes(path.read_bytes().replace(b"verdict no", b"verdict si", 1)[:-20])
    found = rg.verify(path)
    assert not found and found.outcome == "rejected" and found.reason


def test_no_certificate_of_nothing(robot_1, tmp_path):
    found = robot_1.check("wide_15", max_boxes=1, method="reg")
    assert found.verdict == "possible-problem"
    with pytest.raises(rg.UsageError, match="nothing that could be proved"):
        found.certificate.write(tmp_path / "proof")
    assert not (tmp_path / "proof").exists()


def test_a_paving_is_that_of_the_command(planar, command):
    expected = command("locate", planar.path, "crossing", "--resolution", "1/32")
    found = planar.locate("crossing", resolution=1 / 32)
    same = ("verdict", "free", "singular", "undecided", "boxes")
    assert {key: found.json[key] for key in same} == {key: expected[key] for key in same}
    for claim in ("free", "singular", "undecided"):
        assert (found.claims == claim).sum() == expected[claim]["boxes"]


def test_the_boxes_of_a_paving_cover_the_motion(circle):
    found = circle.locate("across", resolution="1/64")
    widths = found.boxes["x"][:, 1] - found.boxes["x"][:, 0]
    areas = widths * (found.boxes["y"][:, 1] - found.boxes["y"][:, 0])
    assert areas.sum() == pytest.approx(36, rel=1e-12)
    free = found.boxes[found.claims == "free"]
    lo, hi = found.fractions["free"]
    assert lo <= areas[found.claims == "free"].sum() / 36 * (1 + 1e-12)
    assert areas[found.claims == "free"].sum() / 36 <= hi * (1 + 1e-12)
    corners = numpy.hypot(free["x"], free["y"])
    inside = (corners < 1).all(axis=1)
    assert ((corners > 1).any(axis=1) | inside).all()


def test_a_margin_brackets_the_critical_tolerance(circle):
    found = circle.margin("outside", tolerance={"platform": (0, 4)})
    critical = 8**0.5 - 1
    assert float(found.safe) <= critical <= float(found.singular)
    assert found.closed and found.bracket.startswith("SAFE UP TO")
    open_end = circle.margin("outside", tolerance="platform")
    assert float(open_end.safe) <= critical <= float(open_end.singular)


def test_a_margin_within_a_limit_brackets_the_critical_size(circle):
    """|det| = x² + y² − 1 is above 4 where x and y are above √2.5."""
    found = circle.margin("outside", scale=(0, 4), quantity="determinant", limit=4)
    assert float(found.safe) <= 5 - 2 * 2.5**0.5 <= float(found.exceeded)
    assert found.closed and found.singular is None and found.bracket.startswith("WITHIN UP TO")
    assert found.json["limit_exact"] == "4" and found.json["quantity"]["kind"] == "determinant"
    with pytest.raises(rg.UsageError, match="need each other"):
        circle.margin("outside", scale=(0, 4), limit=4)


DISK = """regulus = 1
name = "slider on a disk"
[pose]
x = "m"
y = "m"
[matrix]
rows = [["2 - x", "y"], ["-y", "1"]]
[motion.disk]
parameters = { R = [0, 3] }
x = [-3, 3]
y = [-3, 3]
constraints = ["x^2 + y^2 - R^2"]
"""


def test_a_margin_of_a_shape_brackets_its_critical_size():
    disk = rg.Robot(DISK)
    found = disk.margin("disk", grow={"R": (0, 3)})
    assert float(found.safe) <= 2 <= float(found.singular) and found.closed
    with pytest.raises(rg.UsageError):
        disk.margin("disk", grow={"R": (0, 3), "x": (0, 1)})


def test_a_bound_is_attained_and_proved(circle):
    found = circle.bound("outside", "x + y")
    assert found.attained <= 6 <= found.proved and found.closed
    assert found.proved - found.attained <= 0.011 * found.proved
    assert circle.bound("outside", "x + y", limit="6.1").verdict == "within"
    assert circle.bound("outside", "x + y", limit="5.9").verdict == "exceeded"


def test_a_motion_along_way_points_is_checked_as_such(circle, tmp_path, command):
    way = tmp_path / "way.csv"
    way.write_text("x,y\n2,2\n3,3\n")
    model = tmp_path / "circle.toml"
    model.write_text(circle.text)
    expected = command("check", str(model), "outside", "--waypoints", str(way))
    found = rg.load(model).check("outside", waypoints=way)
    assert found.verdict == expected["verdict"] == "no-singularity"
    assert found.claim == expected["claim"] and "segment" in found.claim
    way.write_text("x,y\n2,2\n-3,-3\n")
    assert rg.load(model).check("outside", waypoints=way).verdict == "singularity"
    with pytest.raises(rg.UsageError, match="way-points"):
        model.write_text(circle.text + f'[motion.way]\nwaypoints = "{way}"\n')
        rg.load(model).prepare("way")


def test_a_branch_follows_way_points(command, tmp_path):
    way, theirs, ours = tmp_path / "way.csv", tmp_path / "command", tmp_path / "module"
    way.write_text("theta [deg]\n0\n60\n-100.5\n130\n")
    bar = rg.load("four_bar")
    words = [bar.path, "turn", "--waypoints", str(way)]
    expected = command("check", *words, "--certificate", str(theirs))
    found = bar.check("turn", waypoints=way, certificate=ours)
    assert found.verdict == expected["verdict"] == "no-singularity"
    assert found.claim == expected["claim"] and "of the 3 segments" in found.claim
    assert expected["segment"] is None and expected["links"] > 3
    assert ours.read_bytes() == theirs.read_bytes()
    way.write_text("theta [deg]\n0\n60\n140\n")
    expected = command("check", *words)
    assert bar.check("turn", waypoints=way).verdict == expected["verdict"] == "singularity"
    assert expected["segment"]["segment"] == 2 and len(expected["folds"]) == 1
    way.write_text("theta [deg]\n0\n60\n-100.5\n")
    bound = command("bound", bar.path, "turn", "determinant", *words[2:])
    most = bar.bound("turn", "determinant", waypoints=way)
    assert most.closed and bound["waypoints"]["segments"] == 2
    assert (most.attained, most.proved) == (bound["attained"], bound["proved"])
    place = command(
        "bound", bar.path, "turn", "determinant", *words[2:], "--tube", "theta=0.01"
    )["components"][0]["place"]
    assert place["segment"]["segment"] == 2
    commanded = math.radians(60 - 160.5 * place["segment"]["s"][0])
    error = place["uncertain"]["theta_error"][0]
    assert place["pose"]["theta"][0] == pytest.approx(commanded + error, abs=1e-12)


def test_a_threshold_over_a_branch_is_compared_as_by_the_command(command, tmp_path):
    way, theirs, ours = tmp_path / "way.csv", tmp_path / "command", tmp_path / "module"
    way.write_text("theta [deg]\n0\n50\n-50\n")
    bar = rg.load("four_bar")
    for along, words in (({}, []), ({"waypoints": way}, ["--waypoints", str(way)])):
        for alpha, verdict in (("0.06", "no-singularity"), ("0.063", "singularity")):
            asked = ["--alpha", alpha, *words, "--certificate", str(theirs)]
            expected = command("check", bar.path, "swing", *asked)
            found = bar.check("swing", alpha=alpha, certificate=ours, **along)
            assert found.verdict == expected["verdict"] == verdict
            assert found.claim == expected["claim"] and alpha in found.claim
            assert ours.read_bytes() == theirs.read_bytes()
    found = bar.margin("swing", alpha=(0, 1), gap=0.05)
    assert 0.05 < float(found.safe) < 0.0625 < float(found.singular) < 0.066


def test_a_load_is_answered_as_by_the_command(command, tmp_path):
    cable = rg.load("cable_8")
    for ranges, words in (({}, []), ({"z": (4, "7.5")}, ["--range", "z=4:7.5"])):
        theirs, ours = tmp_path / "command", tmp_path / "module"
        expected = command(
            "check", cable.path, "hall", "--load", "weight", *words, "--certificate", str(theirs)
        )
        found = cable.check_load("hall", "weight", range=ranges, certificate=ours)
        assert bool(found) == (not ranges) and found.verdict == expected["verdict"]
        assert found.boxes == expected["boxes"]
        assert found.claim == (expected["claim"] or "") and found.witness == expected["witness"]
        assert found.certificate == str(ours) and ours.read_bytes() == theirs.read_bytes()
    assert found.verdict.upper() in repr(found) and "<table>" in found._repr_html_()
    with pytest.raises(rg.UsageError, match="did you mean 'weight'"):
        cable.check_load("hall", "weigth")


def test_bounds_and_loads_follow_way_points(command, tmp_path):
    way = tmp_path / "way.csv"
    way.write_text("x,y,z,roll,pitch,yaw\n0,0,5,0,0,0\n1,1,5.5,0,0,0\n")
    cable = rg.load("cable_8")
    words = ["hall", "--waypoints", str(way), "--tube", "x=0.01"]
    expected = command("check", cable.path, *words, "--load", "weight")
    found = cable.check_load("hall", "weight", waypoints=way, tube={"x": "0.01"})
    assert found.verdict == expected["verdict"] and found.claim == expected["claim"]
    most = cable.bound("hall", "x + y", waypoints=way, tube={"x": "0.01"})
    assert most.attained <= 2.01 <= most.proved and most.closed


def test_a_paving_of_a_load_covers_the_motion(tmp_path):
    cable = rg.load("cable_8")
    proof = tmp_path / "proof"
    found = cable.locate_load(
        "hall", "weight", range={"z": (4, "7.5")}, resolution="1/16", certificate=proof
    )
    assert found.certificate == str(proof)
    assert not rg.verify(proof, model=cable.path)
    assert rg.verify(proof, model=cable.path, allow_options=True)
    moving = ("x", "y", "z")
    sizes = [found.boxes[name][:, 1] - found.boxes[name][:, 0] for name in moving]
    assert numpy.prod(sizes, axis=0).sum() == pytest.approx(4 * 4 * 3.5)
    held = numpy.prod(sizes, axis=0)[found.claims == "feasible"].sum() / (4 * 4 * 3.5)
    low, high = found.fractions["feasible"]
    assert low - 1e-9 <= held <= high + 1e-9 and 0.3 < low


def test_a_load_on_a_linkage_is_paved_along_way_points(command, tmp_path):
    text = pathlib.Path(rg.load("four_bar").path).read_text(encoding="utf-8")
    loaded = tmp_path / "loaded.toml"
    loaded.write_text(text + "[actuators]\nforce = [-2, 2]\n[load.push]\nwrench = [[-1, 3], 2]\n")
    way = tmp_path / "way.csv"
    way.write_text("theta\n0\n1\n-1.5\n")
    tube = {"theta": "0.01"}
    lines = tmp_path / "lines"
    words = ["swing", "--waypoints", str(way), "--tube", "theta=0.01", "--output", str(lines)]
    expected = command("locate", str(loaded), *words, "--load", "push")
    found = rg.load(loaded).locate_load("swing", "push", waypoints=way, tube=tube)
    assert found.verdict == expected["verdict"] == "infeasible"
    assert found.json["share"] == expected["share"]
    *stretches, _ = map(json.loads, lines.read_text(encoding="utf-8").splitlines())
    assert found.stretches == stretches
    assert {s["kind"] for s in stretches} == {"feasible", "infeasible", "undecided"}
    assert "stretches" in repr(found) and "feasible" in found._repr_html_()
    with pytest.raises(rg.UsageError, match="no boxes"):
        found.fractions
