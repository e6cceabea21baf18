# SPDX-License-Identifier: GPL-3.0-or-later
"""run.py MODULES ARGUMENTS...: runs Python with the arguments, or ends with 77 if a module lacks."""

import importlib.util
import os
import sys

lacking = [name for name in sys.argv[1].split(",") if importlib.util.find_spec(name) is None]
if lacking:
    print("skipped: this Python has no", ", ".join(lacking))
    sys.exit(77)
os.execv(sys.executable, [sys.executable, *sys.argv[2:]])
