"""What each figure draws equals what the summary holds."""
import pytest

import algorithm_speedup
import artists
import drawing
import efficiency
import ladder
import m_comparison
import made_summary
import phase_split
import speedup
import style
import summary

MODULES = (speedup, efficiency, algorithm_speedup, m_comparison, phase_split, ladder)


def title(made, state, rest):
    """Return a panel's title: the state is named where there are several."""
    several = len({entry["point"]["state"] for entry in made["points"]}) > 1
    return f"{state}, {rest}" if several else rest


@pytest.mark.parametrize("module, value", [(speedup, "speedup"), (efficiency, "efficiency")])
def test_speedup_and_efficiency_draw_the_table(made, module, value):
    wanted, bars = {}, {}
    for row in made["speedup"]:
        if style.runtime(row["backend"]) == "serial":
            continue
        panel, label = title(made, row["state"], f"M={row['M']}"), f"{row['backend']} M={row['M']}"
        wanted.setdefault(panel, {}).setdefault(label, []).append((row["threads"], row[value]))
        if row["low"] is not None and module is speedup:
            bars.setdefault(panel, {}).setdefault(label, []).append(
                (row["threads"], pytest.approx(row["low"]), pytest.approx(row["high"])))
    drawn = artists.panels(drawing.of(module, made))
    assert {name: artists.lines(axes) for name, axes in drawn.items()} == wanted
    assert {name: artists.intervals(axes) for name, axes in drawn.items()
            if artists.intervals(axes)} == bars


def test_algorithm_speedup_draws_the_table_and_names_the_base(made):
    wanted = {}
    for row in made["algorithm_speedup"]:
        panel = title(made, row["state"], f"base {row['base_backend']} M={row['base_M']}")
        wanted.setdefault(panel, {}).setdefault(f"{row['backend']} M={row['M']}", []).append(
            (row["threads"], row["speedup"]))
    drawn = artists.panels(drawing.of(algorithm_speedup, made))
    assert {name: artists.lines(axes) for name, axes in drawn.items()} == wanted


def test_m_comparison_draws_the_table(made):
    wanted = {}
    for row in made["m_comparison"]:
        threads = row["threads"]
        fields = {"time_s": f"{threads} thread{'s' * (threads > 1)}"}
        if threads == 1:
            fields.update(pairs_tested="candidate tests", collision_share="collision share",
                          useful_pair_ratio="useful-pair ratio",
                          cells_nonempty="non-empty cells")
        for field, name in fields.items():
            wanted.setdefault(title(made, row["state"], name), {}).setdefault(
                row["backend"], []).append((row["M"], row[field]))
    drawn = artists.panels(drawing.of(m_comparison, made))
    assert {name: artists.lines(axes) for name, axes in drawn.items()} == wanted


def test_phase_split_stacks_the_medians(made):
    drawn = artists.panels(drawing.of(phase_split, made))
    for entry in made["points"]:
        point, phases = entry["point"], entry["phases"]
        axes = drawn[title(made, point["state"], f"M={point['M']}")]
        name, left = f"{point['backend']} t={point['threads']}", 0
        bars = {bars.get_label(): bars[0] for bars in axes.containers}
        for field, phase, _ in style.PHASES:
            bar = bars[f"{name} {phase}"]
            assert bar.get_width() == pytest.approx(1e3 * phases[field]["median"])
            assert bar.get_x() == pytest.approx(left)
            left += bar.get_width()
        assert artists.lines(axes)[f"{name} total"][0][0] == 1e3 * phases["total_s"]["median"]


def test_ladder_shows_each_backend_at_its_best_m_sorted(made):
    figure = drawing.of(ladder, made)
    for name, axes in artists.panels(figure).items():
        state = "collapsed" if "collapsed" in name else "rest"
        rows = [(entry["point"], entry["ns_per_pair_parts"]) for entry in made["points"]
                if entry["point"]["state"] == state]
        threads = (lambda b: 1) if "1 thread" in name else (
            lambda b: max(p["threads"] for p, _ in rows if p["backend"] == b))
        best = [min((ns["all"], backend, p["M"]) for p, ns in rows if p["backend"] == backend
                    and p["threads"] == threads(backend))
                for backend in {p["backend"] for p, _ in rows}]
        by_name = {(p["backend"], p["M"]): ns for p, ns in rows
                   if p["threads"] == threads(p["backend"])}
        bars = [(some.get_label(), some[0].get_x(), some[0].get_width())
                for some in axes.containers]
        wanted = []
        for _, backend, m in sorted(best):
            left = 0
            for part in ("prepare", "zero", "sum", "reduce"):
                label = f"{backend} M={m}" if part == "sum" else f"{part} of {backend} M={m}"
                length = by_name[backend, m][part]
                wanted.append((label, pytest.approx(left), pytest.approx(length)))
                left += length
        assert bars == wanted
        numbers = [[float(number) for number in text.get_text().strip(")").split(" (")]
                   for text in axes.texts]
        assert numbers == [pytest.approx([ns, by_name[backend, m]["sum"]], rel=6e-3)
                           for ns, backend, m in sorted(best)]


def test_ladder_counts_the_list_that_pair_list_prepares(two):
    figure = ladder.draw(two)
    axes = artists.panels(figure)["1 thread"]
    names = [tick.get_text().split(",")[0] for tick in axes.get_yticklabels()]
    best = {backend: min(entry["ns_per_pair"] for entry in two["points"]
                         if entry["point"]["backend"] == backend) for backend in names}
    assert best["pair_list"] < best["naive"]
    assert names.index("pair_list") > names.index("naive")
    assert figure.texts[0].get_text().replace("\n", " ") == (
        "prepare + zero + sum + reduce, ns per interacting pair")
    assert [text.get_text() for text in figure.legends[0].get_texts()] == [
        "prepare", "zero", "sum", "reduce"]


def test_ladder_leaves_out_a_point_whose_parts_are_not_known(two):
    for entry in two["points"]:
        if entry["point"]["backend"] == "pair_list":
            del entry["ns_per_pair_parts"]
        if entry["point"]["backend"] == "ppm_stencil":
            entry["ns_per_pair_parts"].update(reduce=None, all=None)
    for axes in ladder.draw(two).axes:
        names = {tick.get_text().split(",")[0] for tick in axes.get_yticklabels()}
        assert names == {entry["point"]["backend"] for entry in two["points"]} - {"pair_list", "ppm_stencil"}


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.NAME)
def test_figures_say_of_what_and_on_what(made, module):
    text = "\n".join(text.get_text() for text in drawing.of(module, made).texts)
    for part in ("dam_break", "dx = 0.00594 m", "1 000 000 fluid + 1 014 966 boundary", "double",
                 "Example CPU 9000", "GNU 12.2.0", "git abc1234", "Caveat: "):
        assert part in text.replace("\n", " ").replace("\N{NO-BREAK SPACE}", " ")


def test_series_that_differ_in_precision_get_panels_of_their_own():
    made = made_summary.make(states=("rest",), ms=(6,))
    again = made_summary.make(states=("rest",), ms=(6,))
    for table in ("points", "speedup", "algorithm_speedup", "m_comparison"):
        for number, some in enumerate((made, again)):
            for row in some[table]:
                row["series"] = number
        made[table] += again[table]
    for entry in made["points"][len(made["points"]) // 2:]:
        entry["point"]["precision"] = "float"
    made["series"].append({"environment": "fedcba9876543210"})
    assert summary.doubles(made) == []
    for module in MODULES:
        names = list(artists.panels(module.draw(made)))
        assert len(set(names)) == len(names)
        for words in ("double, environment 01234567", "float, environment fedcba98"):
            assert sum(name.startswith(words) for name in names) == len(names) / 2


def test_thread_axes_are_whole_and_logarithmic_from_four_threads(made):
    counts = sorted({row["threads"] for row in made["speedup"]})
    for axes in drawing.of(speedup, made).axes:
        assert list(axes.get_xticks()) == counts
        assert axes.get_xscale() == ("log" if counts[-1] >= 4 else "linear")
