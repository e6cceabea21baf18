# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples of codegen/use/python/PYTHON.md, done. "..." matches any text."""

import doctest
import pathlib
import re

import pytest

PAGE = pathlib.Path(__file__).parents[2] / "codegen/use/python/PYTHON.md"
BLOCK = re.compile(r"^```python\n(.*?)^```", re.MULTILINE | re.DOTALL)


def test_the_page_says_what_happens(tmp_path, monkeypatch):
    pytest.importorskip("sympy")
    monkeypatch.chdir(tmp_path)
    text = PAGE.read_text(encoding="utf-8")
    known = {}
    examples = 0
    for block in BLOCK.finditer(text):
        line = text[: block.start(1)].count("\n")
        if ">>>" not in block[1]:
            compile(block[1], str(PAGE), "exec")
            continue
        test = doctest.DocTestParser().get_doctest(block[1], known, PAGE.name, str(PAGE), line)
        examples += len(test.examples)
        found = []
        runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS, verbose=False)
        runner.run(test, out=found.append, clear_globs=False)
        known = test.globs
        assert not found, "".join(found)
    assert examples > 30
