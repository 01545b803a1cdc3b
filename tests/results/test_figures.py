"""What each figure draws equals the tables; no text lies on another; colours mean the same everywhere."""
import dataclasses
import os
import signal
import struct

import artists
import made
import numpy as np
import pandas as pd
import pytest
import ranked
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

import pairsum_results as pr
from pairsum_results import figures
from pairsum_results.figures import PAPER, Look, bars, cases, density, ladder, over, ranks, ratios, roofline, style, threads
from pairsum_results.figures.sheet import packed

PAGE = Look(titled=False)
NARROW = Look(4.4, 1, titled=False)


@pytest.fixture(scope="module")
def full(tmp_path_factory):
    """A report that fills every figure; not to be changed."""
    return artists.report(tmp_path_factory.mktemp("full"), artists.everything())


@pytest.fixture(scope="module")
def two(tmp_path_factory):
    """A report of one series on one and two threads."""
    points = [point for point in made.talk()] + [(made.point("pair_list"), 0.7)]
    rows = made.study(points, before=[made.environment(), made.peak(1, 1e9, 1e9), made.peak(2, 1.9e9, 1.2e9)])
    return artists.report(tmp_path_factory.mktemp("two"), rows)


@pytest.fixture(scope="module")
def dense(tmp_path_factory):
    """A report over pairs per particle."""
    return artists.report(tmp_path_factory.mktemp("dense"), artists.density())


@pytest.fixture(scope="module")
def scaled(tmp_path_factory):
    """A report of ranks."""
    return artists.report(tmp_path_factory.mktemp("scaled"), ranked.study(ranked.strong() + ranked.weak()[1:]))


def sheets(drawing, report, look=PAGE):
    """The figures of a drawing."""
    return [figures.draw(one, report, look) for one in figures.sheets(report, look) if one.drawing is drawing]


def first(drawing, report, title=""):
    """The axes of the first panel with this in its title."""
    return next(axes for figure in sheets(drawing, report) for name, axes in artists.panels(figure).items() if title in name)


def test_a_figure_is_drawn_where_it_says_something(full, two, dense, scaled):
    assert {one.drawing for report in (full, dense, scaled) for one in figures.sheets(report)} == set(figures.ALL)
    missing = set(figures.ALL) - {one.drawing for one in figures.sheets(two)}
    assert {d.name for d in missing} == {"barrier_wait", "m_comparison", "size_scaling", "granularity", "compilers",
                                         "self_test", "cases", "density", "ranks"}  # talk() has two M and one size
    assert all(d.table in full.tables for d in figures.ALL)


def test_what_is_constant_or_has_two_places_is_no_line(full):
    titles = [panel.title for one in figures.sheets(full) if one.drawing is over.M_COMPARISON for panel in one.panels]
    assert {"16 threads", "candidate tests"} <= set(titles) and "non-empty cells" not in titles  # as many for every M
    fewer = full.m_comparison[full.m_comparison["M"] > 5]
    assert not over.M_COMPARISON.panels(dataclasses.replace(full, m_comparison=fewer))
    sizes = full.points[full.points["n_fluid"] != 20000]
    assert over.SIZE_SCALING.panels(full) and not over.SIZE_SCALING.panels(dataclasses.replace(full, points=sizes))


def test_panels_are_packed_into_sheets_of_a_height(full):
    panels = [panel for one in figures.sheets(full) if one.drawing is bars.PHASE_SPLIT for panel in one.panels]
    assert [len(some) for some in packed(panels[:2] * 3, dataclasses.replace(PAGE, height=1.0))] == [2, 2, 2]
    assert [len(some) for some in packed(panels[:2] * 3, dataclasses.replace(PAGE, height=100.0))] == [6]
    names = [one.name for one in figures.sheets(full)]
    assert len(set(names)) == len(names) and {"ladder", "ladder-2", "cases"} <= set(names)


def test_speedups_on_two_threads_are_rows_with_their_intervals(two):
    axes, table = first(threads.SPEEDUP, two), two.speedup[two.speedup["threads"] == 2]
    table = table.sort_values("ratio", ascending=False)
    drawn = artists.dots(axes)
    assert [x for x, _ in drawn] == pytest.approx(list(table["ratio"]))
    assert [span for _, span in drawn] == [pytest.approx(span) for span in zip(table["low"], table["high"])]
    assert sorted(artists.names(axes)) == sorted(table["backend"] + ", M=6")
    grey = {line.get_label(): line.get_xdata()[0] for line in axes.lines}
    assert grey == {"ideal": 2, "machine's flops": pytest.approx(1.9), "machine's bandwidth": pytest.approx(1.2)}
    assert axes.child_axes[0].get_xlabel() == "efficiency: speedup / threads"


def test_speedups_on_many_threads_are_lines(full):
    table = full.speedup[(full.speedup["series"] == 0) & (full.speedup["M"] == 7)]
    wanted = {backend: [(t, pytest.approx(v)) for t, v in zip(own["threads"], own["ratio"])]
              for backend, own in table.groupby("backend")}
    axes = first(threads.SPEEDUP, full, "hashed_grid M=7")
    drawn = artists.lines(axes)
    assert {name: drawn[name] for name in wanted} == wanted
    assert [x for x, _ in drawn["ideal"]] == list(axes.get_xticks()) == [1, 2, 4, 8, 16]
    assert axes.get_xscale() == "log"
    assert "machine's flops" in drawn and len(axes.containers) == 4  # error bars


def test_algorithm_speedups_name_their_base(two, full):
    table = two.algorithm_speedup[two.algorithm_speedup["threads"] == 1].sort_values("ratio", ascending=False)
    axes = first(threads.ALGORITHM_SPEEDUP, two)
    assert [x for x, _ in artists.dots(axes)] == pytest.approx(list(table["ratio"]))
    assert {"symmetric_omp, M=6 / naive_omp", "symmetric, M=6 / naive, M=7"} <= set(artists.names(axes))
    titles = " ".join(title for figure in sheets(threads.ALGORITHM_SPEEDUP, full) for title in artists.panels(figure))
    assert "base naive_omp, M=7" in titles and "base naive_tbb" in titles


def test_the_ladder_has_each_backend_at_its_best_fastest_first(two):
    axes, own = first(ladder.LADDER, two, "2 threads"), two.standings[two.standings["threads"] == 2]
    best = two.points[two.points["threads"] == 2].sort_values("total_s").drop_duplicates("backend")
    assert [name.split(",")[0] for name in artists.names(axes)] == list(best["backend"]) == list(own["backend"])
    assert [right for _, right in artists.bars(axes, "ratio")] == pytest.approx(list(own["ratio"]))
    assert [text.get_text() for text in axes.texts] == [f"{e.ratio:.2f} ({1e3 * e.time_s:.0f} ms)" if e.time_s < 0.9995 else
                                                        f"{e.ratio:.2f} ({e.time_s:.2f} s)" for e in own.itertuples()]
    kinds = dict(zip(own["backend"], [path.get_facecolor()[k] for path in axes.collections if path.get_label() == "ratio"
                                      for k in range(len(own))]))
    assert tuple(kinds["naive_omp"][:3]) == to_rgb(style.FAMILIES["gather"][0]) != tuple(kinds["symmetric_omp"][:3])


def test_standings_are_against_the_gather_and_the_fastest(two, full):
    own = two.standings[two.standings["threads"] == 2].set_index("backend")
    assert set(own["base_backend"]) == {"naive_omp"} and own["ratio"]["symmetric_omp"] == pytest.approx(2)
    assert own["behind"]["naive_omp"] == pytest.approx(2) and own["tied"].to_dict() == {
        "symmetric_omp": True, "symmetric_tbb": False, "naive_omp": False, "naive_tbb": False}
    assert set(full.standings["threads"]) == {1, 2, 4, 8, 16}
    assert not full.standings["backend"].str.contains("slowed|again").any()
    alone = full.standings.groupby(["series", "threads"]).size()
    assert alone.min() > 1


def test_cases_are_the_times_over_the_fastest_of_each(full):
    axes = first(cases.CASES, full)
    most = full.standings.groupby("series")["threads"].transform("max")
    own = full.standings[full.standings["threads"] == most]
    assert sorted(text.get_text() for text in axes.texts) == sorted(own["behind"].map("{:.2f}".format))
    assert len(artists.names(axes)) == own["backend"].nunique()
    assert [cases.shade(value) for value in (1, 1.04, 1.05, 1.3, 2, 3, 9)] == [0, 0, 1, 2, 3, 4, 5]


def test_phases_add_up(two):
    axes = first(bars.PHASE_SPLIT, two)
    points = two.points[two.points["threads"] == 1].sort_values("total_s")
    assert len(artists.names(axes)) == len(points)
    left = 0.0
    for phase in pr.PHASES[:-1]:
        drawn = np.array(artists.bars(axes, phase))
        assert drawn[:, 0] == pytest.approx(np.full(len(points), left) if np.isscalar(left) else left)
        assert drawn[:, 1] - drawn[:, 0] == pytest.approx(1e3 * points[phase].to_numpy())
        left = drawn[:, 1]
    assert [x for x, _ in artists.lines(axes)["total_s"]] == pytest.approx(list(1e3 * points["total_s"]))


def test_waits_are_stacked_on_the_work_of_each_thread(full):
    axes = first(bars.BARRIER_WAIT, full)
    points = full.points[(full.points["series"] == 0) & (full.points["threads"] == 16)]
    assert set(points["wait_share"].round(9)) == {0.25}
    times, name = pr.thread_times(full.results).set_index("point"), artists.names(axes)[0]
    (point,) = points.index[(points["backend"] == name.split(",")[0]) & (points["M"] == float(name.split("M=")[1][0]))]
    busy, wait = (artists.bars(axes, label)[:16] for label in ("busy", "wait"))
    assert [right for _, right in busy] == pytest.approx(list(1e3 * times.loc[point, "busy_s"]))
    assert [b - a for a, b in wait] == pytest.approx(list(1e3 * times.loc[point, "waiting_s"]))
    assert [a for a, _ in wait] == pytest.approx([right for _, right in busy])
    assert {text.get_text() for text in axes.texts} == {"25 %"}


def test_lines_over_m_are_the_points_and_coincide_once(full):
    table = full.m_comparison[(full.m_comparison["series"] == 0) & (full.m_comparison["threads"] == 16)]
    drawn = artists.lines(first(over.M_COMPARISON, full, "16 threads"))
    for backend, own in table[table["granularity"].isin(["dynamic:32", "auto:32"])].groupby("backend"):
        assert drawn[backend] == [(m, pytest.approx(t)) for m, t in zip(own["M"], own["sum_s"])]
    tests = first(over.M_COMPARISON, full, "candidate tests")
    assert list(artists.lines(tests)) == ["naive_omp, naive_tbb and 2 more"]


def test_the_roofline_has_every_point_and_the_measured_roof(full):
    axes = first(roofline.ROOFLINE, full, "16 threads")
    points = full.points[(full.points["series"] == 0) & (full.points["threads"] == 16)]
    every = [line.get_xydata()[0] for line in axes.lines if line.get_label() != "roof"]
    assert sorted(y for _, y in every) == pytest.approx(sorted(points["achieved_flops_per_s"] / 1e9))
    (x0, y0), (x1, y1), (_, y2) = artists.lines(axes)["roof"]
    assert y1 == y2 == pytest.approx(16**0.95) and y0 / x0 == pytest.approx(y1 / x1) == pytest.approx(2 * 16**0.5)


def test_sizes_and_granularities_are_lines(full):
    axes = first(over.SIZE_SCALING, full, "each at its most threads: time per sum")
    own = full.points[(full.points["threads"] == 16) & (full.points["backend"] == "naive_omp")]
    best = own.groupby("n_fluid")["sum_s"].min()
    assert artists.lines(axes)["naive_omp"] == [(particles, pytest.approx(best[fluid])) for particles, fluid in (
        (40000, 20000), (190000, 100000), (2014966, 1000000))]
    drawn = artists.lines(first(over.GRANULARITY, full))
    assert [x for x, _ in drawn["dynamic"]] == [32, 64] and [x for x, _ in drawn["static"]] == [8, 64]
    assert len({y for _, y in drawn["guided"]}) == 1


def test_costs_per_pair_and_what_symmetry_is_worth_are_lines_over_pairs_per_particle(dense):
    cost = artists.lines(first(density.DENSITY, dense, "perturbed"))
    assert set(cost) == {"gather, scalar", "colours, scalar", "copies, scalar", "serial, scalar", "gather, vector",
                         "colours, vector"}
    ns = 1.5 * made.MEDIAN * 1.25  # of an evaluation; the state is that much slower
    assert cost["gather, scalar"] == [(x, pytest.approx(10 * ns)) for x in (14, 54, 140)]
    assert [y for _, y in cost["colours, vector"]] == pytest.approx([2 * ns / gain for gain in (1.5, 1.2, 1.0)])
    worth = artists.lines(first(density.DENSITY, dense, "symmetric against gather"))
    assert [y for _, y in worth["rest, vector"]] == pytest.approx([1.5, 1.2, 1.0])
    assert [y for _, y in worth["rest, scalar"]] == pytest.approx([2.0] * 3) and "equal" in worth


def test_a_gather_is_one_whatever_runs_it(tmp_path):
    """A serial backend that computes each pair twice never stands for those that compute it once."""
    points = [row for row in artists.density() if row["kind"] != "sample" or row["point"]["backend"] in ("naive", "naive_omp")]
    for row in points:
        if row["kind"] == "round":
            row["rows"] = sum(one["kind"] == "sample" and one["round"] == row["round"] for one in points)
    found = artists.report(tmp_path, points).density
    assert set(found["family"]) == {"gather"} and not found["fastest_symmetric"].any()


def test_builds_are_problems_of_their_own(tmp_path):
    rows = artists.density()
    other = [{**row, "environment": artists.OTHER} if "environment" in row and row["kind"] != "round" else row for row in rows]
    taken = {}
    for row in rows:
        taken.setdefault(row.get("round"), []).append(row)
    both = [made.environment(), made.environment(artists.OTHER, compiler="Clang 14.0.6"),
            *(row for row in rows + other if row["kind"] == "backend")]
    for k in range(1, 7):
        samples = [row for row in rows + other if row["kind"] == "sample" and row["round"] == k]
        both += samples + [made.closing(k, len(samples))]
    found = artists.report(tmp_path, both).density
    assert found.groupby("world")["problem"].nunique().eq(1).all() and found["problem"].nunique() == 4
    panels = density.DENSITY.panels(artists.report(tmp_path / "again", both))
    assert len({panel.title for panel in panels}) == len(panels) == 5


def test_two_densities_are_no_line(tmp_path):
    two = artists.report(tmp_path, artists.density({2.0: 14000, 3.0: 54000}))
    assert two.density.empty and not density.DENSITY.panels(two)


def test_efficiencies_of_ranks_are_lines_over_cores_that_begin_with_one_rank(scaled):
    strong, weak = (first(ranks.RANKS, scaled, f"{kind} scaling") for kind in ("strong", "weak"))
    assert {name: line for name, line in artists.lines(strong).items() if name != "ideal"} == {
        "threads alone": approx((1, 1.0), (2, 0.8), (4, 0.5)),
        "ranks of 1 thread, twice": approx((1, 1.0), (2, 1.0), (4, 0.8)),
        "ranks of 1 thread, once": approx((1, 1.0), (2, 1.25), (4, 1.0)),
        "ranks of 2 threads, twice": approx((2, 0.8), (4, 0.8)),
        "ranks of 2 threads, once": approx((2, 0.8), (4, 0.5))}
    assert strong.get_xscale() == "log" and [text.get_text() for text in strong.get_xticklabels()] == ["1", "2", "4"]
    assert artists.lines(weak)["ranks of 1 thread, twice"] == approx((1, 1.0), (2, 0.8), (4, 0.625))


def approx(*spots):
    return [(x, pytest.approx(y)) for x, y in spots]


@pytest.mark.parametrize("drawing, table", [(ratios.COMPILERS, "compiler_comparison"), (ratios.SELF_TEST, "self_test")])
def test_ratios_are_dots_with_intervals_and_a_word(full, drawing, table):
    axes, rows = first(drawing, full), full.tables[table]
    drawn = artists.dots(axes)
    assert sorted(x for x, _ in drawn) == pytest.approx(sorted(rows["ratio"]))
    assert sorted(span for _, span in drawn) == pytest.approx(sorted(zip(rows["low"], rows["high"])))
    words = rows["verdict"] if table != "self_test" else rows["holds"].map({True: "holds", False: "DOES NOT HOLD"})
    assert sorted(text.get_text() for text in axes.texts) == sorted(words)


@pytest.mark.parametrize("look", [Look(), PAGE, NARROW, PAPER], ids=["file", "page", "narrow", "paper"])
@pytest.mark.parametrize("drawing", figures.ALL, ids=lambda drawing: drawing.name)
def test_no_text_lies_on_another_or_leaves_the_figure(full, two, dense, scaled, drawing, look):
    for figure in (figure for report in (full, two, dense, scaled) for figure in sheets(drawing, report, look)):
        with figures.applied(look):
            assert artists.overlaps(figure) == []
        if look is PAPER:
            assert figure.get_figwidth() == pytest.approx(84 / 25.4)
            assert min(text.get_fontsize() for text in figure.findobj(artists.Text)) > 5.5


def test_texts_on_each_other_and_beyond_the_edge_are_found(two):
    figure = sheets(ladder.LADDER, two)[0]
    for x, text in ((0.5, "one text"), (0.5, "another text"), (0.98, "beyond")):
        figure.text(x, 0.5, text)
    assert {("one text", "another text"), ("beyond", "page")} <= set(artists.overlaps(figure))


def shades(colours):
    """The least difference in lightness of neighbours."""
    light = list(map(artists.lightness, colours))
    return min(abs(a - b) for a, b in zip(light, light[1:]))


def test_neighbours_in_a_bar_differ_in_grey():
    assert shades(style.PHASES.values()) > 15
    assert shades(["#0072B2", "#D55E00"]) < 15  # a pair that would not


def test_a_backend_has_one_colour_and_each_known_one_its_own():
    assert len(set(style.BACKENDS.values())) == len(style.BACKENDS)
    assert style.colour("colour18_tbb") == style.colour("colour18") != style.colour("nobody_knows")
    assert style.colour("nobody_knows") in style.SPARE
    assert style.line("naive_tbb") != style.line("naive_omp")


@pytest.mark.parametrize("drawing", figures.ALL, ids=lambda drawing: drawing.name)
def test_copies_for_the_self_test_are_in_its_figure_alone(full, drawing):
    said = " ".join(text.get_text() for figure in sheets(drawing, full) for text in figure.findobj(artists.Text))
    assert "slowed_20" not in said and "again_" not in said
    assert ("slowed 20 %" in said) == (drawing.name == "self_test")


def test_figures_are_written_whole_and_old_ones_go(two, tmp_path, monkeypatch):
    for name in ("ladder", "ladder-9", "compilers", "my-own"):
        (tmp_path / f"{name}.png").write_text("old")
    drawn = figures.draw_all(two, tmp_path)
    assert {path.stem for path in tmp_path.iterdir()} == {one.name for one, _ in drawn} | {"my-own"}
    paths = [tmp_path / f"{one.name}.png" for one, _ in drawn]
    assert "ladder.png" in {path.name for path in paths}
    for path in paths:
        data = path.read_bytes()
        assert data.startswith(b"\x89PNG") and data.endswith(b"IEND\xaeB`\x82")
    assert all(svg.startswith("<svg") == one.drawing.inline for one, svg in drawn)
    before = {path: path.read_bytes() for path in paths}
    assert figures.draw_all(two, tmp_path) and {path: path.read_bytes() for path in paths} == before
    monkeypatch.setattr(Figure, "savefig", lambda *_, **__: (_ for _ in ()).throw(OSError("disk full")))
    with pytest.raises(OSError):
        figures.draw_all(two, tmp_path)
    assert {path: path.read_bytes() for path in paths} == before


def test_a_png_fits_a_slide_however_high_its_panels_are():
    with figures.applied(Look()):
        figure = Figure(figsize=(10, 30))
    data = figures.rendered(figure, "png")
    assert struct.unpack(">II", data[16:24]) == (400, 1200)


def test_a_folder_that_cannot_be_written_to_is_one_line(two, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(pr.ResultsError, match="cannot write .*file"):
        figures.draw_all(two, tmp_path / "file")


def test_texts_are_drawn_as_they_are(tmp_path):
    rows = made.study(made.talk(), before=[made.environment(cpu="a$b$ \\frac{1} {{ 7 * 7 }}")])
    report = artists.report(tmp_path, rows)
    figure = sheets(ladder.LADDER, report, Look())[0]
    assert "a$b$ \\frac{1}" in " ".join(text.get_text() for text in figure.texts)
    assert figures.rendered(figure, "png")
    assert pd.notna(report.points["sum_s"]).all()


def test_a_process_that_is_killed_is_an_error_of_one_line():
    def killed(k):
        if k == 1:
            os.kill(os.getpid(), signal.SIGKILL)
        return k

    assert figures.on_all_cores(lambda k: k, [3, 1, 2]) == [3, 1, 2]
    with pytest.raises(pr.ResultsError, match="^a process that drew figures was killed, perhaps for want of memory$"):
        figures.on_all_cores(killed, [0, 1, 2])
