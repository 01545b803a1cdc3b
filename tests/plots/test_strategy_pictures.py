"""The pictures of docs/strategies.md: the data say what the captions say, and the program draws them."""
import collections
import json
import pathlib

import pytest

import strategy_pictures

UNITS = pathlib.Path(__file__).resolve().parents[2] / "docs/strategies/units.json"
WORLDS = json.loads(UNITS.read_text(encoding="utf-8"))


def shared(units):
    """Return the cells that several of these units write to."""
    writers = collections.Counter(cell for unit in units for cell in strategy_pictures.touched(unit))
    return {cell for cell, count in writers.items() if count > 1}


def of_kind(*kinds):
    """Return the names of the pictures of these kinds."""
    return [name for name, words in strategy_pictures.PICTURES.items() if words[0] in kinds]


@pytest.mark.parametrize("name", of_kind("colours", "passes", "tasks", "gather"))
def test_units_of_a_pass_share_no_cell(name):
    passes = WORLDS[name]["passes"]
    assert [shared(units) for units in passes] == [set()] * len(passes)
    if len(passes) > 1:  # run together they would: what is said above can fail
        assert shared([unit for units in passes for unit in units])


@pytest.mark.parametrize("name", of_kind("sample", "copies", "locks", "pieces"))
def test_other_units_do(name):
    assert shared(WORLDS[name]["passes"][0])


def test_what_slabs_share_is_locked():
    units = WORLDS["sliced_locks"]["passes"][0]
    locked = {tuple(cell) for unit in units for cells in unit.get("locks", {}).values() for cell in cells}
    assert shared(units) and shared(units) <= locked


def test_what_pieces_share_is_buffered():
    units = WORLDS["touched_blocks"]["passes"][0]
    rates = collections.Counter(tuple(cell) for unit in units for cell in unit["rates"])
    buffered = {tuple(cell) for unit in units for cell in unit["copy"]}
    assert shared(units) <= buffered
    assert {cell for cell, count in rates.items() if count > 1} <= buffered  # cells cut by a block of particles


def test_every_world_has_a_picture():
    assert set(WORLDS) == set(strategy_pictures.PICTURES)


@pytest.mark.parametrize("name", ["sliced_locks", "task_conflicts", "half_cells_seam"])
def test_one_is_drawn(name, tmp_path):
    assert strategy_pictures.main([str(UNITS), "--out", str(tmp_path), "--only", name]) == 0
    assert (tmp_path / f"{name}.svg").read_text(encoding="utf-8").rstrip().endswith("</svg>")


def test_what_is_not_there_is_refused(tmp_path, capsys):
    data = tmp_path / "units.json"
    data.write_text(json.dumps({"mine": WORLDS["colour18"]}), encoding="utf-8")
    assert strategy_pictures.main([str(data), "--out", str(tmp_path)]) == 2
    assert "no units" in capsys.readouterr().err
    assert strategy_pictures.main([str(data), "--out", str(tmp_path), "--only", "mine"]) == 2
