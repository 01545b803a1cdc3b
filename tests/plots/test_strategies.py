"""The figures of strategies: what is drawn is what the summary holds."""
import json

import pytest
from matplotlib.colors import to_hex

import artists
import drawing
import strategies
import strategy_ladder
import strategy_threads
import strategy_worlds
import style
import summary
from made_worlds import BACKENDS, KINDS
from summary import NoData

AT = {"1 thread": "one_thread", "each at its most threads": "most_threads"}


def ladder_of(made, title):
    """Return the rows that a panel of the ladder shows, fastest first."""
    at = next(word for text, word in AT.items() if f"{text}; base" in title)
    rows = [row for row in made["strategy_ladder"] if row["at"] == at and title.startswith(row["world"] + ":")]
    return sorted(rows, key=lambda row: row["rank"])


def test_the_ladder_shows_each_backend_of_each_world_with_its_interval(field):
    panels = artists.panels(drawing.of(strategy_ladder, field))
    assert len(panels) == 4
    for title, axes in panels.items():
        rows = ladder_of(field, title)
        bars = {bars.get_label(): bars[0] for bars in axes.containers}
        lines = artists.lines(axes)
        assert len(rows) == len(BACKENDS) == len(bars)
        assert [label.get_text().split(",")[0] for label in axes.get_yticklabels()] == [row["backend"] for row in rows]
        for row in rows:
            assert bars[f"ratio of {row['backend']}"].get_width() == row["ratio"]
            assert [x for x, _ in lines[f"interval {row['backend']}"]] == [row["low"], row["high"]]
        assert f"base naive_omp, {rows[0]['base_threads']} thread" in title


def test_colours_say_how_threads_are_kept_apart(field):
    axes = drawing.of(strategy_ladder, field).axes[0]
    for bars in axes.containers:
        kind = KINDS[bars.get_label().split()[-1]] or "unsaid"
        assert to_hex(bars[0].get_facecolor()).upper() == style.KINDS[kind], bars.get_label()
    assert [entry.get_label() for entry in strategies.key(field, BACKENDS)] == list(style.KINDS)
    assert [entry.get_label() for entry in strategies.key(field, ["naive"])] == ["serial"]
    assert len(set(style.KINDS.values())) == len(style.KINDS)


def test_lines_over_threads_are_the_table(field):
    wanted = {}
    for row in field["strategy_threads"]:
        wanted.setdefault(f"over threads {row['backend']} M=6", set()).add((row["world"], row["threads"], row["ratio"]))
    drawn = {}
    for title, axes in artists.panels(drawing.of(strategy_threads, field)).items():
        for name, spots in artists.lines(axes).items():
            drawn.setdefault(name, set()).update((title.split(";")[0], *spot) for spot in spots)
    parallel = {name: spots for name, spots in wanted.items() if KINDS[name.split()[2]] != "serial"}
    assert drawn == parallel and len(drawn) > 15


def test_every_backend_stands_in_every_world(field):
    axes, = drawing.of(strategy_worlds, field).axes
    drawn = {name: spots[0][0] for name, spots in artists.lines(axes).items() if name.startswith("ratio of")}
    assert drawn == {f"ratio of {row['backend']} in {row['world']}": row["ratio"]
                     for row in field["strategy_ladder"] if row["at"] == "most_threads"}
    spans = {name: [x for x, _ in spots] for name, spots in artists.lines(axes).items() if name.startswith("interval")}
    assert spans == {f"interval of {row['backend']} in {row['world']}": [row["low"], row["high"]]
                     for row in field["strategy_ladder"] if row["at"] == "most_threads"}


def test_one_world_is_not_compared_with_others(two):
    with pytest.raises(NoData, match="one world"):
        strategy_worlds.draw(two)


@pytest.mark.parametrize("module", [strategy_ladder, strategy_threads, strategy_worlds])
def test_without_strategies_there_is_nothing_to_draw(two, module):
    two.update(strategies=[], strategy_ladder=[], strategy_threads=[], strategy_shifts=[])
    with pytest.raises(NoData):
        module.draw(two)


def test_a_summary_of_before_there_were_strategies_is_loaded(two, tmp_path):
    for table in ("strategies", "strategy_ladder", "strategy_threads", "strategy_shifts"):
        del two[table]
    path = tmp_path / "summary.json"
    path.write_text(json.dumps(two))
    assert summary.load(path)["strategies"] == []


@pytest.mark.parametrize("table, field_name, wrong", [
    ("strategies", "conflicts", 3), ("strategy_ladder", "ratio", None), ("strategy_ladder", "rank", 0),
    ("strategy_threads", "low", "low"), ("strategy_shifts", "verdict", None)])
def test_a_broken_table_is_refused(field, table, field_name, wrong):
    broken = {**field, table: [{**field[table][0], field_name: wrong}]}
    with pytest.raises(summary.SummaryError, match=table):
        summary.check(broken)
    with pytest.raises(summary.SummaryError, match=table):
        summary.check({**field, table: {}})
