# SPDX-License-Identifier: GPL-3.0-or-later
"""The notebooks of codegen/use/python/examples, executed; they check their results themselves."""

import pathlib

import pytest

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("ipykernel")
pytest.importorskip("matplotlib")

NOTEBOOKS = sorted((pathlib.Path(__file__).parents[2] / "codegen/use/python/examples").glob("*.ipynb"))


def test_there_are_notebooks():
    assert {n.stem for n in NOTEBOOKS} >= {"first_check", "study_of_workspaces", "pareto_front"}


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, tmp_path):
    notebook = nbformat.read(path, as_version=4)
    assert all(not cell.get("outputs") for cell in notebook.cells), "kept without outputs"
    nbclient.NotebookClient(
        notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}
    ).execute()
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            if output.output_type == "display_data" or "text/plain" in output.get("data", {}):
                print(output.get("data", {}).get("text/plain"))
            if output.output_type == "stream":
                print(output.text)
