"""The notebook, in a kernel."""

from __future__ import annotations

from pathlib import Path

import nbclient
import nbformat
import pytest

from conftest import REPOSITORY


@pytest.mark.filterwarnings("ignore")
def test_the_notebook_runs(urdds: Path) -> None:
    notebook = nbformat.read(REPOSITORY / "python" / "examples" / "robot.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(urdds)}}).execute()
    html = [
        output["data"]["text/html"]
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if "text/html" in output.get("data", {})
    ]
    assert any(text.startswith("<iframe") for text in html)
