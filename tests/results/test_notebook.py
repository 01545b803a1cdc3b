"""The example notebook runs, draws its figure, and holds no outputs."""
import json

import matplotlib
import pytest
from conftest import ROOT

NOTEBOOK = json.loads((ROOT / "examples/notebook.ipynb").read_text())


def run(cells, folder, monkeypatch):
    """Executes the code cells in one namespace, as Jupyter does; returns it."""
    matplotlib.use("Agg")
    monkeypatch.chdir(folder)
    names = {}
    for number, cell in enumerate(cells):
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"cell {number}", "exec"), names)
    return names


@pytest.mark.parametrize("folder", [ROOT, ROOT / "examples"], ids=lambda path: path.name)
def test_it_runs_and_its_ladder_is_that_of_the_package(folder, monkeypatch):
    names = run(NOTEBOOK["cells"], folder, monkeypatch)
    own, of_package = names["ladder"]["ratio"], names["table"]["ratio"]
    assert len(own) > 20 and own.to_dict() == pytest.approx(of_package.to_dict(), rel=1e-12)
    axes = names["axes"]
    assert sum(len(line.get_xdata()) for line in axes.lines[:-1]) == len(names["whole"]) > 100
    assert len(axes.get_legend().get_texts()) == 5
    names["plt"].close("all")


def test_a_cell_that_fails_is_noticed(monkeypatch):
    broken = [{"cell_type": "code", "source": ["import pairsum_results\n", "pairsum_results.lode"]}]
    with pytest.raises(AttributeError, match="lode"):
        run(broken, ROOT, monkeypatch)


def test_outputs_are_not_stored():
    assert NOTEBOOK["nbformat"] == 4 and {cell["cell_type"] for cell in NOTEBOOK["cells"]} == {"code", "markdown"}
    for cell in NOTEBOOK["cells"]:
        assert cell["cell_type"] == "markdown" or cell["outputs"] == [] and cell["execution_count"] is None
