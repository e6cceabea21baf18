# SPDX-License-Identifier: GPL-3.0-or-later
"""Robots that are made in Python, and errors."""

import os
import pickle
from pathlib import Path

import pytest
from conftest import COMMAND

import regulus as rg

BASE = [[-9, 9, 0], [9, 9, 0], [12, -3, 0], [3, -13, 0], [-3, -13, 0], [-12, -3, 0]]
PLATFORM = [[-3, 7, 0], [3, 7, 0], [7, -1, 0], [4, -6, 0], [-4, -6, 0], [-7, -1, 0]]
DEXTEROUS = {
    "q1": (-160, 160), "q2": (-45, 0), "q3": (20, 70), "q4": (-110, 170), "q5": (10, 100),
    "q6": (-180, 180),
}  # fmt: skip
ANGLES = {"psi": 0, "theta": ("-5*deg", "5*deg"), "phi": 0}


def test_gough_is_checked_as_its_text_is(tmp_path):
    robot = rg.gough(
        BASE,
        PLATFORM,
        unit="cm",
        motions={"work": {"x": (-5, 5), "y": (-5, 5), "z": (45, 50), **ANGLES}},
        base_tolerance="1/20",
        name='a "quoted" name',
    )
    robot.write(tmp_path / "robot.toml")
    assert robot.name == 'a "quoted" name' and robot.groups["base"]
    assert "base_tolerance = \"1/20\"" in robot.text
    found = robot.check("work")
    assert rg.load(tmp_path / "robot.toml").check("work").boxes == found.boxes
    assert found.verdict in ("no-singularity", "singularity")


def test_angles_may_be_in_degrees():
    motions = {"work": {"x": (-5, 5), "y": (-5, 5), "z": (45, 50), "psi": 0, "theta": (-5, 5), "phi": 0}}
    degrees = rg.gough(BASE, PLATFORM, unit="cm", angle_unit="deg", motions=motions)
    motions["work"]["theta"] = ("-5*deg", "5*deg")
    radians = rg.gough(BASE, PLATFORM, unit="cm", motions=motions)
    assert degrees.check("work").boxes == radians.check("work").boxes
    arm = rg.serial([(1, 90, 0, 0), (1, 0, 0, 0)], angle_unit="deg", motions={"m": {"q1": 0, "q2": (20, 60)}})
    assert 'angle_unit = "deg"' in arm.text and arm.check("m").verdict


def test_a_wrong_name_of_a_model_has_a_hint():
    assert "robot_1" in rg.models() and rg.models() == sorted(rg.models())
    with pytest.raises(rg.FileError, match="did you mean 'robot_1'"):
        rg.load("robot1")
    with pytest.raises(rg.FileError, match=r"regulus.models\(\) names"):
        rg.load("qqqqqqqq")


def test_errors_about_ranges_are_in_words_of_python():
    with pytest.raises(rg.UsageError) as wrong:
        rg.load("robot_1").margin("wide_15")
    assert "LO" not in str(wrong.value) and "(lo, hi)" in str(wrong.value)


def test_a_robot_is_written_whole_or_not_at_all(tmp_path):
    import resource
    import signal

    robot = rg.load("planar_3rpr")
    path = tmp_path / "robot.toml"
    path.write_text("the one before")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (512, limits[1]))
        with pytest.raises(rg.FileError, match="robot.toml cannot be written: File too large"):
            robot.write(path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, handler)
    assert path.read_text() == "the one before"
    robot.write(path)
    assert path.read_text() == robot.text
    assert [file.name for file in tmp_path.iterdir()] == ["robot.toml"]


def test_serial_is_the_robot_of_the_model_file():
    shipped = rg.load("puma_560_serial")
    robot = rg.serial(
        [
            {},
            {"alpha": "-90*deg", "d": "0.2435"},
            {"a": "0.4318", "d": "-0.0934"},
            {"a": "-0.0203", "alpha": "90*deg", "d": "0.4331"},
            {"alpha": "-90*deg"},
            {"alpha": "90*deg"},
        ],
        convention="modified-dh",
        motions={
            "dexterous": {name: f"{lo}*deg" if lo == hi else (f"{lo}*deg", f"{hi}*deg")
                          for name, (lo, hi) in DEXTEROUS.items()},
            "wrist": {"q1": 0, "q2": "-45*deg", "q3": "45*deg", "q4": ("-110*deg", "170*deg"),
                      "q5": ("-90*deg", "100*deg"), "q6": 0},
        },
    )  # fmt: skip
    for motion in ("dexterous", "wrist"):
        expected, found = shipped.check(motion), robot.check(motion)
        assert (found.verdict, found.boxes) == (expected.verdict, expected.boxes)


def test_sympy_gives_the_same_robot(circle):
    sympy = pytest.importorskip("sympy")
    x, y, h = sympy.symbols("x y h", real=True)
    robot = rg.from_sympy(
        sympy.Matrix([[x - h, y], [-y, x + h]]),
        {x: "cm", y: "cm"},
        geometry={h: (1, 0)},
        motions={"outside": {x: (2, 3), y: (2, 3)}, "across": {x: (-3, 3), y: (-3, 3)}},
    )
    assert '["-h + x", "y"]' in robot.text
    for motion in ("outside", "across"):
        assert robot.check(motion).verdict == circle.check(motion).verdict
    critical = 8**0.5 - 1
    assert robot.check("outside", tolerance={"h": critical - 0.001})
    assert robot.check("outside", tolerance={"h": critical + 0.001}).verdict == "singularity"


EXPRESSIONS = [
    "x/y/2", "-x", "-(x + y)", "x - (y - 1)", "2*(x + y)*x", "x**2", "x**-2", "(x + 1)**3", "x**-1",
    "sqrt(x**2 + y**2)", "1/sqrt(x)", "x**Rational(2, 3)", "-x**2", "(-x)**2", "sin(x)*cos(y)",
    "exp(x)*exp(-y)", "exp(1)", "log(x + 3)", "Abs(x - y)", "atan2(y, x)", "pi*x/180", "-x/2",
    "Rational(-1, 3)*x", "x*Rational(3, 2)", "(x + y)/(x - y)", "-(x*y)/(x + 2)", "tan(x)**2",
    "2**x", "x*(y + 1)/3", "-Rational(1, 2)", "x - Rational(1, 2)", "x**Rational(-1, 2)",
    "-3*x**2*y + 2*x - 7", "acos(x/10)", "x*y**-2",
]  # fmt: skip


@pytest.mark.parametrize("text", EXPRESSIONS)
def test_an_expression_keeps_its_value(text):
    sympy = pytest.importorskip("sympy")
    from regulus.sympy_models import _Printer
    from regulus.numbers import Texts

    e = sympy.sympify(text)
    if text == "2**x":
        with pytest.raises(ValueError, match="exponent"):
            _Printer(Texts()).text(e)
        return
    written = _Printer(Texts()).text(e)
    back = sympy.sympify(written.replace("^", "**"))
    at = {"x": sympy.Rational(17, 10), "y": sympy.Rational(-13, 7)}
    assert abs(complex((back - e).subs(at).evalf(30))) < 1e-20, written
    if e.subs(at).is_real:
        read = rg.Robot(
            "regulus = 1\nname = 'e'\n[pose]\nx = '1'\ny = '1'\n[matrix]\n"
            f"rows = [['{written}', 'x'], ['y', '1']]\n[motion.m]\nx = '17/10'\ny = '-13/7'\n"
        )
        value, exact = read.bound("m", written), float(e.subs(at))
        assert value.attained <= exact <= value.proved
        assert value.proved - value.attained <= 0.011 * abs(exact)


def test_sympy_refuses_what_models_do_not_have():
    sympy = pytest.importorskip("sympy")
    x, y = sympy.symbols("x y")
    motions = {"m": {x: (1, 2)}}
    with pytest.raises(ValueError, match="y is not declared"):
        rg.from_sympy(sympy.Matrix([[x + y]]), [x], motions=motions)
    with pytest.raises(ValueError, match="models do not have gamma"):
        rg.from_sympy(sympy.Matrix([[sympy.gamma(x)]]), [x], motions=motions)
    with pytest.raises(ValueError):
        rg.from_sympy(sympy.Matrix([[x * sympy.I]]), [x], motions=motions)


def test_urdf_is_read_with_its_notes(tmp_path):
    joints = "".join(
        f'<link name="l{i}"/><joint name="j{i}" type="revolute"><parent link="l{i}"/>'
        f'<child link="l{i + 1}"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/>'
        f'<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        for i in range(2)
    )
    file = tmp_path / "arm.urdf"
    file.write_text(f'<robot name="arm">{joints}<link name="l2"/></robot>')
    robot = rg.from_urdf(file)
    assert "[serial]" in robot.text and robot.notes
    assert robot.check(range={"j1": ("1/2", 1)}, motion=next(iter(robot.motions)))
    with pytest.raises(rg.FileError):
        rg.from_urdf(tmp_path / "none.urdf")


def test_a_file_keeps_its_bytes(circle, tmp_path):
    file = tmp_path / "circle.toml"
    file.write_bytes(circle.text.replace("\n", "\r\n").encode())
    robot = rg.load(file)
    path = robot.check("outside").certificate.write(tmp_path / "proof")
    assert rg.verify(path, model=file)
    robot.write(tmp_path / "again.toml")
    assert (tmp_path / "again.toml").read_bytes() == file.read_bytes()
    file.write_bytes(b"\xff\xfe")
    with pytest.raises(rg.FileError, match="not UTF-8"):
        rg.load(file)


def test_errors_have_file_and_line(tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text("regulus = 1\nname = 'x'\n[pose]\nx = 'cm'\n[matrix]\nrows = [['x + yy']]\n")
    with pytest.raises(rg.InputError) as caught:
        rg.load(file)
    error = caught.value
    assert error.file == str(file) and error.line == 6 and "yy" in error.problem
    assert error.symbol == "yy" and str(file) in str(error)
    twin = pickle.loads(pickle.dumps(error))
    assert (twin.line, str(twin)) == (error.line, str(error))
    assert isinstance(error, ValueError) and isinstance(error, rg.RegulusError)


def test_errors_name_arguments_of_python(circle):
    with pytest.raises(rg.UsageError, match="^tolerance: .*did you mean 'platform'"):
        circle.check("outside", tolerance={"platfrom": 1})
    with pytest.raises(rg.UsageError, match="no motion 'outsid'"):
        circle.check("outsid")
    with pytest.raises(rg.UsageError, match="method"):
        circle.check("outside", method="magic")
    with pytest.raises(TypeError, match="unknown option 'timelimit'; the options are: .*time_limit"):
        circle.check("outside", timelimit=1)
    with pytest.raises(rg.UsageError, match="give"):
        circle.check("outside", range={"x": (1, 2, 3)})
    with pytest.raises(rg.FileError, match="nowhere"):
        rg.load("/nowhere/robot.toml")


def test_tables_for_notebooks_escape_names():
    robot = rg.Robot(
        'regulus = 1\nname = "<script>"\n[pose]\nx = "cm"\n[matrix]\nrows = [["x"]]\n'
        "[motion.m]\nx = [1, 2]\n"
    )
    for page in (robot._repr_html_(), robot.check()._repr_html_(), robot.locate()._repr_html_()):
        assert "<table>" in page and "<script>" not in page


def test_a_check_has_a_page(circle, robot_1, tmp_path):
    if not os.path.exists(os.path.join(os.path.dirname(COMMAND), "../share/regulus/page.html")):
        pytest.skip("this build has no page")
    found = circle.check("outside", range={"x": (2, 3)})
    text = Path(found.page(tmp_path / "page.html")).read_text(encoding="utf-8")
    assert ">NO SINGULARITY</h1>" in text and "Not checked yet" in text
    assert "regulus-certificate 1" in text
    prepared = robot_1.prepare("wide_15").check(range={"x": (-3, 3)})
    assert "parameter x in -3 : 3" in Path(prepared.page(tmp_path / "q.html")).read_text()
    found_shown = found._repr_html_()
    assert "<svg" not in found_shown and "page.html" in found_shown  # no points are given
    shown = prepared._repr_html_()
    assert "<svg" in shown and f'<a href="{tmp_path}/q.html">' in shown and len(shown) < 10_000
    with pytest.raises(rg.FileError):
        found.page(tmp_path / "no folder" / "page.html")
    found.page(tmp_path / "page.html")
    assert (tmp_path / "page.html.old").read_text(encoding="utf-8") == text


def test_a_page_never_replaces_the_model(tmp_path):
    model = tmp_path / "own.toml"
    text = (
        'regulus = 1\nname = "own"\n[pose]\nx = "cm"\n[matrix]\nrows = [["x"]]\n'
        "[motion.m]\nx = [1, 2]\n"
    )
    model.write_text(text)
    proof = tmp_path / "proof"
    found = rg.load(model).check(certificate=proof)
    kept = proof.read_text()
    for file in (model, proof):
        with pytest.raises(rg.UsageError, match="page"):
            found.page(file)
    assert model.read_text() == text and proof.read_text() == kept


def test_a_paving_is_drawn(circle, robot_1):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    paving = circle.locate("across", resolution="1/16", tolerance={"platform": "0.1"})
    _, ax = pyplot.subplots()
    assert paving.plot(ax) is ax
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x", "y")
    labels = {text.get_text() for text in ax.get_legend().get_texts()}
    assert labels <= set(paving.claims) and {"free", "singular"} <= labels
    drawn = sum(len(c.get_paths()) for c in ax.collections)
    assert drawn == len(paving.boxes), "no box is left out of a picture without a slice"
    sliced = robot_1.locate("wide_15", resolution="1/2").plot(None, axes=("x", "z"), at={"y": 3})
    assert "y = 3" in sliced.get_title()
    for wrong in ({"axes": ("x", "q")}, {"at": {"x": 1}}):
        with pytest.raises(ValueError):
            paving.plot(ax, **wrong)
