"""Roofline, barriers, size, granularity, compilers, self-test: what is drawn is what the summary holds."""
import pytest

import artists
import barrier_wait
import choice
import compilers
import drawing
import granularity
import ladder
import made_summary
import roofline
import self_test
import size_scaling
import speedup
import usual
from summary import NoData

CLANG = 2  # the series of the other compiler in the full summary


def test_barrier_wait_stacks_each_thread_of_each_point(made):
    panels = artists.panels(drawing.of(barrier_wait, made))
    several = len({entry["point"]["state"] for entry in made["points"]}) > 1
    for entry in made["points"]:
        point, passes = entry["point"], entry["passes"]
        if not passes:
            continue
        axes = panels[f"{point['state']}, M={point['M']}" if several else f"M={point['M']}"]
        bars = {bars.get_label(): bars for bars in axes.containers}
        name = f"{point['backend']} t={point['threads']}"
        for thread in range(point["threads"]):
            busy, wait = bars[f"{name} busy"][thread], bars[f"wait of {name}"][thread]
            assert busy.get_width() == pytest.approx(1e3 * sum(some[thread] for some in passes["busy_s"]))
            assert wait.get_width() == pytest.approx(1e3 * sum(some[thread] for some in passes["barrier_wait_s"]))
            assert wait.get_x() == pytest.approx(busy.get_width())
        assert f"{100 * passes['wait_share']:.2g} %" in [text.get_text() for text in axes.texts]


def test_barrier_wait_needs_probed_points(two):
    for entry in two["points"]:
        entry["passes"] = None
    with pytest.raises(NoData, match="passes"):
        barrier_wait.draw(two)


def test_roofline_has_a_marker_per_point_and_the_measured_roofs(made):
    several = len({entry["point"]["state"] for entry in made["points"]}) > 1
    for title, axes in artists.panels(drawing.of(roofline, made)).items():
        threads = int(title.split(", ")[-1].split()[0])
        wanted = sorted((entry["model"]["intensity"], entry["model"]["achieved_flops_per_s"] / 1e9)
                        for entry in made["points"] if entry["point"]["threads"] == threads
                        and (not several or title.startswith(entry["point"]["state"])))
        markers = [line for line in axes.lines if line.get_label() != "roof"]
        assert sorted(line.get_xydata()[0].tolist() for line in markers) == [list(spot) for spot in wanted]
        roof, = [line for line in axes.lines if line.get_label() == "roof"]
        peak, = [row for row in made["peaks"] if row["threads"] == threads and row["precision"] == "double"]
        (x0, y0), (x1, y1), (_, y2) = roof.get_xydata()
        assert y1 == y2 == pytest.approx(peak["flops_per_s"] / 1e9)
        assert y0 / x0 == pytest.approx(peak["bandwidth_bytes_per_s"] / 1e9) == pytest.approx(y1 / x1)


def test_roofline_without_peaks_still_shows_the_points(two):
    two["peaks"] = []
    assert all(line.get_label() != "roof" for axes in roofline.draw(two).axes for line in axes.lines)


def test_size_scaling_takes_the_best_m_of_each_size(full):
    panels = artists.panels(drawing.of(size_scaling, full))
    gnu = [entry for entry in full["points"] if entry["series"] != CLANG]
    for backend in ("naive", "symmetric_omp"):
        for title, value in (("time per sum", lambda entry: choice.sum_time(entry)),
                             ("per pair", lambda entry: entry["ns_per_pair"])):
            wanted = {}
            for entry in gnu:
                point, best = entry["point"], wanted.get(entry["point"]["n_fluid"])
                if point["backend"] == backend and point["threads"] == 1 and (
                        best is None or choice.sum_time(entry) < choice.sum_time(best)):
                    wanted[point["n_fluid"]] = entry
            axes = next(axes for name, axes in panels.items() if name.endswith(f"1 thread: {title}"))
            assert artists.lines(axes)[backend] == [
                (entry["point"]["n_fluid"] + entry["point"]["n_boundary"], value(entry))
                for _, entry in sorted(wanted.items())]


def test_one_size_gives_no_size_scaling(two):
    with pytest.raises(NoData, match="several dx"):
        size_scaling.draw(two)


def test_granularity_draws_a_line_per_schedule(full):
    axes = artists.panels(drawing.of(granularity, full))["symmetric_omp, M=7, 4 thr."]
    times = {entry["point"]["granularity"]: choice.sum_time(entry) for entry in full["points"]
             if entry["series"] == 0 and entry["point"]["backend"] == "symmetric_omp"
             and entry["point"]["M"] == 7 and entry["point"]["threads"] == 4}
    wanted = {}
    for word, time in times.items():
        schedule, chunk = granularity.parts(word)
        wanted.setdefault(schedule, []).append((chunk, time))
    lines = {name: spots for name, spots in artists.lines(axes).items()}
    assert lines == {schedule: sorted(spots) for schedule, spots in wanted.items()}


@pytest.mark.parametrize("word, parts", [("dynamic:32", ("dynamic", 32)), ("auto", ("auto", None)),
                                         ("static:0", ("static", None)), ("none", ("none", None)),
                                         ("simple:x", ("simple", None))])
def test_a_granularity_is_schedule_and_chunk(word, parts):
    assert granularity.parts(word) == parts


def test_other_figures_show_the_usual_granularity_only(full):
    assert usual.of_backends(full, "granularity")["symmetric_omp"] == "dynamic:32"
    assert usual.text(full) == "symmetric_omp dynamic:32, symmetric_tbb auto"
    extra = dict(full["speedup"][-1], granularity="simple:8", speedup=77.0, low=None, high=None)
    changed = {**full, "speedup": [*full["speedup"], extra]}
    drawn = [y for axes in speedup.draw(changed).axes for spots in artists.lines(axes).values()
             for _, y in spots]
    assert 77.0 not in drawn and len(drawn) > 40


def test_of_as_many_points_the_faster_isa_is_the_usual(full):
    tiles = [entry for entry in full["points"] if entry["point"]["backend"] == "tiles_omp"]
    slow = [{**entry, "point": {**entry["point"], "isa": "avx2"},
             "phases": {**entry["phases"], "sum_s": {"median": 9.0, "low": None, "high": None}}} for entry in tiles]
    both = {**full, "points": slow + full["points"]}
    assert usual.of_backends(both, "isa")["tiles_omp"] == "avx512"
    assert "tiles_omp avx512" in usual.text(both)
    keeps = usual.is_usual(both)
    assert keeps(tiles[0]["point"]) and not keeps(slow[0]["point"])


def test_the_ladder_takes_the_best_grid_and_names_it(full):
    (axes,) = [axes for axes in ladder.draw(full).axes[:1]]
    names = [label.get_text() for label in axes.get_yticklabels()]
    assert any(name.startswith("tiles_omp, compact_grid, ") for name in names), names
    assert all(name.count("tiles_omp, ") <= 1 for name in names)


def test_a_grid_without_m_has_panels_of_its_own(full):
    titles = artists.panels(speedup.draw(full))
    assert any("compact_grid" in title and "M=" not in title for title in titles), list(titles)
    assert any("hashed_grid" in title and "M=7" in title for title in titles), list(titles)


def test_a_summary_of_before_there_were_blocks_is_drawn(two):
    for entry in two["points"]:
        entry["point"].pop("block", None)
    assert drawing.of(ladder, two).axes


def test_speedup_shows_how_the_machine_scales(full):
    rows = {row["threads"]: row for row in full["speedup"]}
    for axes in drawing.of(speedup, full).axes:
        lines = {line.get_label(): line.get_xydata().tolist() for line in axes.lines}
        for what in ("flops", "bandwidth"):
            assert lines[f"machine {what}"] == [[threads, rows[threads][f"machine_{what}_scaling"]]
                                                for threads in (1, 2, 4)]


def test_an_unknown_machine_scaling_is_not_drawn(two):
    for row in two["speedup"]:
        row.update(machine_flops_scaling=None, machine_bandwidth_scaling=None)
    for axes in speedup.draw(two).axes:
        assert not any(line.get_label().startswith("machine") for line in axes.lines)


@pytest.mark.parametrize("module, table", [(compilers, "compiler_comparison"), (self_test, "self_test")])
def test_dots_and_intervals_are_the_rows(full, module, table):
    axes, = drawing.of(module, full).axes
    dots = sorted(spots[0][0] for name, spots in artists.lines(axes).items()
                  if not name.startswith(("interval", "expected")))
    assert dots == sorted(row["ratio"] for row in full[table] if row["ratio"] is not None)
    spans = sorted(tuple(x for x, _ in spots) for name, spots in artists.lines(axes).items()
                   if name.startswith("interval"))
    assert spans == sorted((row["low"], row["high"]) for row in full[table] if row["low"] is not None)
    words = [text.get_text() for text in axes.texts]
    assert sorted(words) == sorted(row.get("verdict") or ("holds" if row["holds"] else "DOES NOT HOLD")
                                   for row in full[table])


def test_series_of_two_compilers_are_named_by_them():
    made = made_summary.full()
    titles = " ".join(artists.panels(roofline.draw(made)))
    assert "Clang 14.0.6" in titles and "GNU 12.2.0" in titles and "environment" not in titles
