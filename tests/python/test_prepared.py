# SPDX-License-Identifier: GPL-3.0-or-later
import time

import pytest

import regulus as rg


def test_other_ranges_and_tolerances_have_their_own_verdicts(circle):
    prepared = circle.prepare("outside")
    assert prepared.check().verdict == "no-singularity"
    assert prepared.check(range={"x": (0, 3), "y": (0, 3)}).verdict == "singularity"
    assert prepared.check(tolerance={"platform": "1.8"}).verdict == "no-singularity"
    assert prepared.check(tolerance={"platform": "1.83"}).verdict == "singularity"
    assert prepared.check(alpha=6).verdict == "no-singularity"
    assert prepared.check(alpha=7).verdict == "singularity"
    assert prepared.check(alpha=7, tolerance={"platform": "0.01"}).verdict == "singularity"
    assert prepared.check().verdict == "no-singularity"


@pytest.mark.parametrize("half", [1, 6, 9, 15])
def test_verdicts_are_those_of_fresh_checks(robot_1, half, prepared_robot_1):
    changes = {"range": {"x": (-half, half)}, "tolerance": {"base": f"{half}/100"}}
    assert prepared_robot_1.check(**changes).verdict == robot_1.check("wide_15", **changes).verdict


@pytest.fixture(scope="module")
def prepared_robot_1(robot_1):
    return robot_1.prepare("wide_15")


def test_reports_are_about_the_question_that_was_asked(circle):
    prepared = circle.prepare("outside")
    first = prepared.check(range={"x": (2, "5/2")})
    second = prepared.check(range={"x": (2, 4)}, tolerance={"platform": "1/8"})
    assert "x in [2, 2.5] cm" in first.report
    assert "x in [2, 4] cm" in second.report and "uncertain" in second.report
    assert first.json["boxes"] == first.boxes
    assert first.json["question"]["ranges_exact"]["x"] == ["2", "5/2"]
    assert second.json["question"]["ranges_exact"]["x"] == ["2", "4"]
    assert second.json["question"]["uncertain"][0]["tolerance_exact"] == "1/8"
    assert first.certificate.write is not None


def test_a_certificate_is_about_the_changed_question(circle, tmp_path):
    model = tmp_path / "circle.toml"
    model.write_text(circle.text)
    robot = rg.load(model)
    path = robot.prepare("outside").check(range={"x": (2, 4)}).certificate.write(tmp_path / "proof")
    found = rg.verify(path, model=model, allow_options=True)
    assert found and any(".x[1] is" in difference for difference in found.json["differences"])


def test_limits_are_those_of_the_call(robot_1, prepared_robot_1):
    cramped = prepared_robot_1.check(range={"x": (-40, 40)}, max_boxes=2)
    assert cramped.boxes <= 8 and cramped.verdict != "no-singularity"
    assert cramped.json["options"]["max_boxes"] == 2
    slow = robot_1.prepare("wide_15", method="reg")
    begun = time.monotonic()
    assert slow.check(time_limit=0.2).reason == "the time limit was reached"
    assert time.monotonic() - begun < 5


def test_mistakes_leave_it_usable(circle):
    prepared = circle.prepare("outside")
    for wrong in ({"range": {"z": (0, 1)}}, {"tolerance": {"bas": 1}}, {"range": {"x": (3, 2)}}):
        with pytest.raises(rg.UsageError):
            prepared.check(**wrong)
    with pytest.raises(rg.RegulusError):
        prepared.check(range={"x": ("0*(1/0)", 3)})
    assert prepared.check()


def test_a_study_of_a_thousand_workspaces_is_short(prepared_robot_1):
    prepared_robot_1.check(range={"x": (-1, 1)})
    begun = time.process_time()
    verdicts = {
        prepared_robot_1.check(range={"x": (-i / 128, i / 128)}, threads=1).verdict
        for i in range(1, 1001)
    }
    assert verdicts == {"no-singularity"}
    assert time.process_time() - begun < 2
