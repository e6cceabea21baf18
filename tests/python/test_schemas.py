# SPDX-License-Identifier: GPL-3.0-or-later
"""The schemas accept what is shipped and printed, and refuse mistakes."""

import copy
import json
import pathlib
import re
import subprocess
from typing import Literal, Optional, Union, get_args, get_origin, get_type_hints

import pytest
from regulus import reports

import regulus as rg
from conftest import COMMAND

jsonschema = pytest.importorskip("jsonschema")
tomllib = pytest.importorskip("tomllib", reason="Python 3.11 and later read TOML")

ROOT = pathlib.Path(__file__).parents[2]
MODELS = sorted((ROOT / "models").glob("*.toml"))


def schema(path):
    read = json.loads(path.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(read)
    return jsonschema.Draft202012Validator(read)


MODEL = schema(ROOT / "codegen/model/file/model.schema.json")
REPORT = schema(pathlib.Path(COMMAND).parents[1] / "share/regulus/schema/report.schema.json")
HEAD = list(REPORT.schema["$defs"]["check"]["properties"])[: len(get_type_hints(reports.Head)) + 1]


def report_of(kind):
    """The schema of one kind of report."""
    whole = dict(REPORT.schema)
    del whole["anyOf"]
    return jsonschema.Draft202012Validator({**whole, "$ref": f"#/$defs/{kind}"})


def errors(validator, instance):
    return [f"{list(e.absolute_path)}: {e.message}" for e in validator.iter_errors(instance)]


def type_of(kind):
    """The TypedDict of one kind of report."""
    return getattr(reports, kind.title().replace("_", "") + "Report")


def has_type(value, kind):
    """Whether a value of JSON is of a type of regulus.reports: exactly its keys, no others."""
    of, parts = get_origin(kind), get_args(kind)
    if of is Union:
        return any(has_type(value, part) for part in parts)
    if of is Literal:
        return value in parts
    if of is list:
        return isinstance(value, list) and all(has_type(item, parts[0]) for item in value)
    if of is dict:
        return isinstance(value, dict) and all(has_type(v, parts[1]) for v in value.values())
    if hasattr(kind, "__required_keys__"):
        if not isinstance(value, dict) or not kind.__required_keys__ <= value.keys():
            return False
        hints = get_type_hints(kind)
        return all(key in hints and has_type(item, hints[key]) for key, item in value.items())
    if kind is float:
        return isinstance(value, (int, float)) and not isinstance(value, bool)
    return type(value) is kind


def printed(*arguments):
    return json.loads(
        subprocess.run(
            [COMMAND, *arguments, "--json", "--quiet"], capture_output=True, text=True, check=False
        ).stdout
    )


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_every_shipped_model_is_accepted(path):
    assert errors(MODEL, tomllib.loads(path.read_text(encoding="utf-8"))) == []


def models_of_the_manual():
    for page in sorted(ROOT.glob("codegen/**/*.md")) + [ROOT / "README.md"]:
        text = page.read_text(encoding="utf-8")
        for block in re.finditer(r"^```toml file=(\S+)\n(.*?)^```", text, re.M | re.S):
            if block[2].startswith("regulus = 1") or "\nregulus = 1" in block[2]:
                yield pytest.param(block[2], id=f"{page.stem}-{block[1]}")


@pytest.mark.parametrize("text", models_of_the_manual())
def test_models_of_the_manual_are_accepted(text):
    assert errors(MODEL, tomllib.loads(text)) == []


@pytest.mark.parametrize(
    "model, motion",
    [
        ("rpr_6", {"legs": [14.98, 15.38, 12], "error": {"legs": 0.001}}),
        ("rpr_6", {"legs": [14.98, 15.38, 12], "error": {"legs": [0.001, 0, "1/1000"]}}),
        (
            "puma_560_serial",
            {"tool": [0.4, 0, 0.5, 0, 0, 1], "error": {"x": 0.001, "yaw": "0.1*deg"}},
        ),
    ],
)
def test_errors_of_places_are_accepted(model, motion, tmp_path):
    text = (ROOT / "models" / f"{model}.toml").read_text(encoding="utf-8")
    error = ", ".join(f"{name} = {json.dumps(value)}" for name, value in motion["error"].items())
    first = "legs" if "legs" in motion else "tool"
    text += f"[motion.place]\n{first} = {json.dumps(motion[first])}\nerror = {{ {error} }}\n"
    assert errors(MODEL, tomllib.loads(text)) == []
    path = tmp_path / "robot.toml"
    path.write_text(text, encoding="utf-8")
    assert printed("solve", str(path), "place")["verdict"] == "complete"


ROBOT = {
    "regulus": 1,
    "name": "cart",
    "pose": {"x": "m"},
    "matrix": {"rows": [["x"]]},
    "motion": {"m": {"x": [1, 2]}},
}


@pytest.mark.parametrize(
    "change",
    [
        lambda m: m.pop("regulus"),
        lambda m: m.update(regulus=2),
        lambda m: m.pop("matrix"),
        lambda m: m.update(poze={}),
        lambda m: m["pose"].update({"2x": "m"}),
        lambda m: m["matrix"].update(scale=[1]),
        lambda m: m["motion"]["m"].update(x=[1, 2, 3]),
        lambda m: m.update(geometry={"h": {"tolerance": 1}}),
        lambda m: m.update(geometry={"h": {"value": 1, "tolerance": 1, "radius": 1}}),
        lambda m: m["motion"]["m"].update(where="anywhere"),
    ],
)
def test_mistakes_in_models_are_refused(change):
    assert errors(MODEL, ROBOT) == []
    wrong = copy.deepcopy(ROBOT)
    change(wrong)
    assert errors(MODEL, wrong)


@pytest.mark.parametrize(
    "arguments",
    [
        ("robot_1", "wide_15"),
        ("robot_1", "wide_15", "--tolerance", "base,platform=0.05"),
        ("robot_1", "T1_errors"),
        ("planar_3rpr", "crossing"),
        ("planar_3rpr", "regular", "--alpha", "1e6"),
        ("robot_1", "wide_15", "--method", "reg", "--max-boxes", "8"),
    ],
)
def test_reports_are_accepted_and_state_the_question(arguments):
    report = printed("check", *arguments)
    assert errors(report_of("check"), report) == [] and errors(REPORT, report) == []
    assert has_type(report, reports.CheckReport)
    assert list(report)[: len(HEAD)] == HEAD
    question = report["question"]
    assert question["ranges"] and report["options"]["threads"] == report["threads"]
    assert report["options"]["max_boxes"] == (8 if "--max-boxes" in arguments else None)


WAY = "t,x,y,phi\n0,0,14,0\n1,1,15,0.01\n2,2,16,0\n"
WAYS = ("--waypoints", "{way}")
CRANKS = ("--waypoints", "{crank}")
HALL = ("--waypoints", "{hall}")
PROOF = ("--certificate", "{proof}")
LOADED = "[actuators]\nforce = [-2, 2]\n[load.push]\nwrench = [[-1, 3], 2]\n"
LIMIT = ("--quantity", "sigma-max", "--limit", "2")


@pytest.mark.parametrize(
    "kind, arguments",
    [
        ("path", ("check", "planar_3rpr", "regular", "--waypoints", "{way}", "--tube", "x,y=1/90")),
        ("paving", ("locate", "planar_3rpr", "crossing", "--resolution", "1/4")),
        ("margin", ("margin", "planar_3rpr", "regular", "--tolerance", "base=0:", "--gap", "0.5")),
        ("margin", ("margin", "planar_3rpr", "regular", "--scale", "1:2", "--gap", "0.5")),
        ("limit_margin", ("margin", "orthoglide", "factors_2", "--grow", "edge=0.1:", *LIMIT)),
        ("bound", ("bound", "orthoglide", "cube", "force", "--gap", "0.3")),
        ("bound", ("bound", "orthoglide", "cube", "x*y", "--gap", "0.3")),
        ("bound", ("bound", "orthoglide", "cube", "speed", "--limit", "20/3")),
        ("bound", ("bound", "planar_3rpr", "regular", "x*y", "--waypoints", "{way}")),
        ("datasheet", ("datasheet", "orthoglide", "cube", "--gap", "0.5")),
        ("path", ("check", "four_bar", "swing", *CRANKS)),
        ("path_paving", ("locate", "four_bar", "swing", *CRANKS)),
        ("path_margin", ("margin", "four_bar", "swing", "--tube", "theta=0:1", *CRANKS)),
        ("check", ("check", "four_bar", "swing", "--alpha", "0.07")),
        ("path", ("check", "four_bar", "swing", "--alpha", "0.07", *CRANKS)),
        ("paving", ("locate", "four_bar", "swing", "--alpha", "0.07", "--resolution", "1/60")),
        ("path_paving", ("locate", "four_bar", "swing", "--alpha", "0.07", *CRANKS)),
        ("margin", ("margin", "four_bar", "swing", "--alpha", "0:1", "--gap", "0.1")),
        ("path_margin", ("margin", "four_bar", "swing", "--alpha", "0:1", *CRANKS)),
        ("path_paving", ("locate", "planar_3rpr", "regular", "--waypoints", "{way}")),
        ("path_margin", ("margin", "planar_3rpr", "regular", "--tube", "x=0:1", *WAYS)),
        ("bound", ("bound", "planar_3rpr", "regular", "x*y", "--limit", "3", *WAYS, *PROOF)),
        ("bound", ("bound", "planar_3rpr", "regular", "x*y", "--limit", "300", *WAYS, *PROOF)),
        ("bound", ("bound", "orthoglide", "cube", "condition", "--norm", "2", "--gap", "0.3")),
        ("forces", ("check", "cable_8", "hall", "--load", "weight")),
        ("forces", ("locate", "cable_8", "hall", "--load", "weight", "--resolution", "1/2")),
        ("path_forces", ("check", "cable_8", "hall", "--load", "weight", *HALL)),
        ("path_force_paving", ("locate", "cable_8", "hall", "--load", "weight", *HALL)),
        ("path_forces", ("check", "{bars}", "swing", "--load", "push", *CRANKS)),
        ("path_force_paving", ("locate", "{bars}", "swing", "--load", "push", *CRANKS)),
        ("solutions", ("solve", "rpr_6", "legs")),
        ("solutions_at_places", ("solve", "four_bar", "swing", *CRANKS)),
    ],
)
def test_every_report_is_accepted_and_states_the_question(kind, arguments, tmp_path):
    way = tmp_path / "way.csv"
    way.write_text(WAY)
    proof = str(tmp_path / "proof")
    hall = tmp_path / "hall.csv"
    hall.write_text("x,y,z,roll,pitch,yaw\n-1,0,4.5,0,0,0\n1,1,5,0,0,0\n")
    crank = tmp_path / "crank.csv"
    crank.write_text("theta\n0\n1\n-2.4\n")
    bars = tmp_path / "bars.toml"
    bars.write_text((ROOT / "models/four_bar.toml").read_text(encoding="utf-8") + LOADED)
    named = {"{way}": str(way), "{crank}": str(crank), "{hall}": str(hall), "{proof}": proof}
    named["{bars}"] = str(bars)
    report = printed(*(named.get(word, word) for word in arguments))
    assert errors(report_of(kind), report) == [] and errors(REPORT, report) == []
    assert has_type(report, type_of(kind))
    assert list(report)[: len(HEAD)] == HEAD
    # What the head has is told once.
    for part in [report["question"], *report.get("bounds", [])]:
        assert not {"model", "model_file", "model_sha256", "motion", "options", "version"} & set(part)
    assert report["motion"] == arguments[2] and report["options"]["threads"] >= 1


@pytest.mark.parametrize(
    "kind, arguments",
    [
        ("check", ("check", "planar_3rpr", "regular")),
        ("path", ("check", "planar_3rpr", "regular", *WAYS)),
        ("paving", ("locate", "planar_3rpr", "regular", "--resolution", "1/2")),
        ("margin", ("margin", "planar_3rpr", "regular", "--tolerance", "base=0:", "--gap", "0.5")),
        ("limit_margin", ("margin", "orthoglide", "factors_2", "--grow", "edge=0.1:", *LIMIT)),
        ("bound", ("bound", "orthoglide", "cube", "force", "--gap", "0.3")),
        ("bound", ("bound", "orthoglide", "cube", "speed", "--limit", "20/3")),
        ("bound", ("bound", "orthoglide", "cube", "condition", "--norm", "2", "--gap", "0.3")),
        ("bound", ("bound", "planar_3rpr", "regular", "x*y", *WAYS)),
        ("bound", ("bound", "planar_3rpr", "regular", "x*y", "--limit", "3", *WAYS)),
        ("forces", ("check", "cable_8", "hall", "--load", "weight")),
        ("forces", ("locate", "cable_8", "hall", "--load", "weight", "--resolution", "1/2")),
    ],
)
def test_every_report_names_its_proofs_or_says_why_there_is_none(kind, arguments, tmp_path):
    way = tmp_path / "way.csv"
    way.write_text(WAY)
    named = {"{way}": str(way)}
    words = [named.get(word, word) for word in arguments]
    report = printed(*words, "--certificate", str(tmp_path / "proof"))
    assert errors(report_of(kind), report) == [] and errors(REPORT, report) == []
    assert has_type(report, type_of(kind))
    written = {str(p) for p in tmp_path.iterdir()} - {str(way)}
    said = set()
    for part in [report, *report.get("components", [])]:
        if "certificate" in part:
            assert part["certificate"] or part["certificate_obstacle"]
            said.add(part["certificate"])
        for end, file in part.get("certificates", {}).items():
            assert file or part["certificate_obstacles"][end]
            said.add(file)
    assert said - {None} == written
    assert {proof["file"] for proof in report["proof"]} - {None} == written
    assert all(bool(proof["file"]) != bool(proof["reason"]) for proof in report["proof"])


def test_the_types_of_python_are_those_of_the_schema():
    """Each key of the schema, and each key that must be there, is in the TypedDict."""
    kinds = [entry["$ref"].rsplit("/", 1)[1] for entry in REPORT.schema["anyOf"]]
    assert {type_of(k) for k in kinds if k != "error"} == set(get_args(reports.Report))
    for name, kind in REPORT.schema["$defs"].items():
        if kind.get("type") != "object" or name == "error":
            continue
        typed = type_of(name) if name in kinds else getattr(reports, name.title().replace("_", ""))
        assert typed.__required_keys__ == set(kind["required"]), name
        assert typed.__required_keys__ | typed.__optional_keys__ == set(kind["properties"]), name


@pytest.mark.parametrize(
    "change",
    [
        lambda r: r.pop("reason"),
        lambda r: r.update(alpha="0"),
        lambda r: r.update(verdict="closed"),
        lambda r: r.update(threads=True),
        lambda r: r["question"].update(surprise=1),
        lambda r: r["question"]["ranges"]["x"].append("1"),
        lambda r: r["proof"].append(None),
    ],
)
def test_a_report_with_a_wrong_key_or_value_has_not_the_type(change):
    report = rg.load("planar_3rpr").check("regular").json
    assert has_type(report, reports.CheckReport)
    change(report)
    assert not has_type(report, reports.CheckReport)


def test_the_results_of_python_have_the_types_that_they_declare():
    robot, cables = rg.load("planar_3rpr"), rg.load("cable_8")
    floats = {"x": (10.1, 12.2), "y": (14, 15.1)}
    for result in (
        robot.check("regular", range=floats),
        robot.locate("regular", range=floats, resolution="1/2"),
        robot.margin("regular", tolerance={"base": (0, None)}, range=floats, gap=0.5),
        robot.margin("regular", scale=(1, 2.1), quantity="x", limit=100.1, gap=0.5),
        robot.bound("regular", "x*y", range=floats, gap=0.3),
        cables.check_load("hall", load="weight", range={"x": (-0.1, 0.1)}),
        cables.locate_load("hall", load="weight", range={"x": (-0.1, 0.1)}, resolution="1/2"),
    ):
        kind = type(result).__orig_bases__[0].__args__[0]
        assert any("the float" in note for note in result.json["notes"])
        assert has_type(result.json, kind), result


def test_a_report_without_a_proof_says_that_none_was_asked_for():
    proof = {"file": None, "reason": "no certificate was asked for"}
    assert printed("check", "planar_3rpr", "regular")["proof"] == [proof]


def test_the_exact_question_asks_the_same_again():
    """Ranges, tolerances and the threshold of a report are options of the next question."""
    first = ("--range", "phi=-pi/13:1/30", "--tolerance", "base=1/30", "--alpha", "1/7")
    question = printed("check", "planar_3rpr", "crossing", *first)["question"]
    assert question["ranges_exact"]["phi"] == ["-(1/13)*pi", "1/30"]
    assert question["alpha_exact"] == "1/7"
    again = ["--alpha", question["alpha_exact"]]
    for name, ends in question["ranges_exact"].items():
        again += ["--range", f"{name}={':'.join(ends)}"]
    for group, size in {(u["group"], u["tolerance_exact"]) for u in question["uncertain"]}:
        again += ["--tolerance", f"{group}={size}"]
    assert printed("check", "planar_3rpr", "crossing", *again)["question"] == question


def test_a_path_states_its_tube_and_a_bound_its_load(tmp_path):
    way = tmp_path / "way.csv"
    way.write_text(WAY)
    path = printed("check", "planar_3rpr", "regular", "--waypoints", str(way), "--tube", "x,y=1/90")
    errors_of = {u["unit"]: u["tolerance_exact"] for u in path["question"]["uncertain"]}
    assert set(errors_of.values()) == {"1/90"}
    force = printed("bound", "orthoglide", "cube", "force", "--gap", "0.3")
    entries = force["quantity"]["load"]["entries"]
    assert [(e["value_exact"], e["radius_exact"]) for e in entries] == [("0", "1")] * 3


def test_a_report_says_what_is_uncertain_and_by_how_much():
    report = printed("check", "robot_1", "wide_15", "--tolerance", "base=0.05")
    uncertain = report["question"]["uncertain"]
    assert len(uncertain) == 18 and {u["group"] for u in uncertain} == {"base"}
    assert all(0.1 <= u["range"][1] - u["range"][0] < 0.1 + 1e-12 for u in uncertain)
    lines = subprocess.run(
        [COMMAND, "check", "robot_1", "wide_15", "--tolerance", "base=0.05"],
        capture_output=True,
        text=True,
        check=False,
    ).stderr
    assert "uncertain  18 quantities: 18 of base ±0.05 cm\n" in lines


@pytest.mark.parametrize(
    "arguments, kind, code",
    [
        (("check", "/nowhere.toml"), "file", 74),
        (("check", "robot_1", "wide"), "usage", 64),
        (("check", "robot_1", "wide_15", "--no-such-option"), "usage", 64),
        (("check", "{wrong}"), "input", 65),
    ],
)
def test_errors_are_objects_too(arguments, kind, code, tmp_path):
    wrong = tmp_path / "wrong.toml"
    wrong.write_text("regulus = 1\nname = 'x'\n[pose]\nx = 'cm'\n[matrix]\nrows = [['x + yy']]\n")
    arguments = [word.replace("{wrong}", str(wrong)) for word in arguments]
    finished = subprocess.run(
        [COMMAND, *arguments, "--json"], capture_output=True, text=True, check=False
    )
    report = json.loads(finished.stdout)
    assert finished.returncode == code and finished.stderr
    assert errors(REPORT, report) == []
    assert (report["error"]["kind"], report["error"]["exit"]) == (kind, code)
    if kind == "input":
        assert (report["error"]["line"], report["error"]["symbol"]) == (6, "yy")
