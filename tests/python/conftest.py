# SPDX-License-Identifier: GPL-3.0-or-later
import json
import os
import subprocess

import pytest

import regulus as rg

COMMAND = os.environ["REGULUS_COMMAND"]


@pytest.fixture(scope="session")
def robot_1():
    return rg.load("robot_1")


@pytest.fixture(scope="session")
def planar():
    return rg.load("planar_3rpr")


@pytest.fixture
def command():
    """Runs `regulus` and returns its JSON report."""

    def run(*arguments):
        finished = subprocess.run(
            [COMMAND, *arguments, "--json", "--quiet"], capture_output=True, text=True, check=False
        )
        assert finished.returncode in (0, 1, 2), finished.stderr
        return json.loads(finished.stdout)

    return run


CIRCLE = """regulus = 1
name = "circle"
[pose]
x = "cm"
y = "cm"
[geometry]
h = { value = 1, tolerance = 0, group = "platform" }
[matrix]
rows = [["x - h", "y"], ["-y", "x + h"]]
[motion.outside]
x = [2, 3]
y = [2, 3]
[motion.across]
x = [-3, 3]
y = [-3, 3]
"""


@pytest.fixture(scope="session")
def circle():
    """A robot with det = x² + y² − h²: it is singular on a circle of radius h."""
    return rg.Robot(CIRCLE)


def searched_for_long(robot, **limits):
    """A check that takes minutes, unless it is stopped."""
    return robot.check("wide_15", method="reg", **limits)
