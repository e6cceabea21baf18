# SPDX-License-Identifier: GPL-3.0-or-later
"""Robots of families that need no matrix: platforms on six legs, and serial arms."""

from __future__ import annotations

from typing import Any, Mapping, Optional, Sequence, Union

from .errors import UsageError
from .numbers import Array, Number, Numbers, Range, Texts
from .robot import Robot
from .toml import Writer, motion_tables, quoted

Points = Union[Array, Sequence[Numbers]]


def _points(writer: Writer, name: str, points: Points) -> None:
    lines = [writer.numbers(list(point), name) for point in points]
    writer.line(name, "[\n  " + ",\n  ".join(lines) + ",\n]")


def gough(
    base: Points,
    platform: Points,
    *,
    motions: Mapping[str, Mapping[str, Range]],
    unit: str = "1",
    angle_unit: str = "rad",
    orientation: str = "euler-zxz",
    base_tolerance: Number = 0,
    platform_tolerance: Number = 0,
    tolerance_shape: str = "box",
    name: str = "platform on six legs",
    source: str = "",
) -> Robot:
    """Makes a robot of the anchor points of its six legs.

    Args:
        base: 6×3, the anchors A_i in the frame of the base.
        platform: 6×3, the anchors B_i in the frame of the platform.
        motions: by name, the range or the value of each pose parameter: x y z psi theta phi for
            "euler-zxz", x y z roll pitch yaw for "roll-pitch-yaw"; x y z in `unit`, angles in `angle_unit`.
        unit: of lengths.
        angle_unit: of angles, "rad" or "deg". A number of degrees is exact; a float of radians is
            the double next to what is meant.
        orientation: "euler-zxz", "roll-pitch-yaw" or "quaternion".
        base_tolerance: ± on each coordinate, or the radius of a ball; the group "base".
        platform_tolerance: the same for the group "platform".
        tolerance_shape: "box" or "ball".

    Raises:
        InputError: if the model has a mistake.
    """
    texts = Texts()
    writer = Writer(texts)
    writer.head(name, source)
    writer.table("gough")
    writer.text("unit", unit)
    if angle_unit != "rad":
        writer.text("angle_unit", angle_unit)
    writer.text("orientation", orientation)
    _points(writer, "base", base)
    _points(writer, "platform", platform)
    writer.line("base_tolerance", writer.number(base_tolerance, "base_tolerance"))
    writer.line(
        "platform_tolerance", writer.number(platform_tolerance, "platform_tolerance")
    )
    writer.text("tolerance_shape", tolerance_shape)
    motion_tables(writer, motions)
    return Robot(writer.model(), notes=texts.notes)


def serial(
    joints: Union[Points, Sequence[Mapping[str, Any]]],
    *,
    motions: Mapping[str, Mapping[str, Range]],
    convention: str = "standard-dh",
    unit: str = "m",
    angle_unit: str = "rad",
    geometry: Optional[Mapping[str, Any]] = None,
    name: str = "serial arm",
    source: str = "",
) -> Robot:
    """Makes a robot of the Denavit-Hartenberg parameters of its joints.

    Args:
        joints: a row (a, alpha, d, theta) for each joint, named q1, q2 …: a and d in `unit`, alpha
            and theta in `angle_unit`, or texts such as "90*deg"; or a dict of the keys of a model file:
            name, type, a, alpha, d, theta.
        motions: by name, the range or the value of each joint.
        convention: "standard-dh" or "modified-dh".
        angle_unit: of alpha, theta and the ranges of joints that turn, "rad" or "deg".
        geometry: constants that joints may name; a pair is (value, tolerance).

    Raises:
        UsageError: if the convention is another.
        InputError: if the model has a mistake.
    """
    if convention not in ("standard-dh", "modified-dh"):
        raise UsageError(f'convention {convention!r} is "standard-dh" or "modified-dh"')
    texts = Texts()
    writer = Writer(texts)
    writer.head(name, source)
    if geometry:
        writer.table("geometry")
        for constant, value in geometry.items():
            writer.quantity(constant, value)
    writer.table("serial")
    writer.text("unit", unit)
    if angle_unit != "rad":
        writer.text("angle_unit", angle_unit)
    writer.text("convention", convention)
    lines = [_joint(writer, i, joint) for i, joint in enumerate(joints, start=1)]
    writer.line("joints", "[\n  " + ",\n  ".join(lines) + ",\n]")
    motion_tables(writer, motions)
    return Robot(writer.model(), notes=texts.notes)


def _joint(writer: Writer, number: int, joint: Any) -> str:
    if not isinstance(joint, Mapping):
        if len(joint) != 4:
            raise UsageError(f"joint {number} has {len(joint)} numbers; give (a, alpha, d, theta)")
        joint = dict(zip(("a", "alpha", "d", "theta"), joint))
    entries = {"name": f"q{number}", **joint}
    words = ("name", "type")
    parts = [
        f"{key} = {quoted(str(value)) if key in words else writer.number(value, key)}"
        for key, value in entries.items()
    ]
    return "{ " + ", ".join(parts) + " }"
