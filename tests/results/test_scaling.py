"""What is said of ranks: every metric of rows with known times and counts, and nothing of rows of one rank."""
import json
import pathlib

import artists
import browser
import jsonschema
import made
import pytest
import ranked
from selenium.webdriver.common.by import By

import pairsum_results as pr
from pairsum_results import page, summary, tables
from pairsum_results.scaling import unlike

SCHEMA = jsonschema.Draft7Validator(json.loads(
    (pathlib.Path(pr.__file__).parent / "summary.schema.json").read_text()))


def report(tmp_path, points, **how):
    return artists.report(tmp_path, ranked.study(points, **how))


@pytest.fixture(scope="module")
def full(tmp_path_factory):
    """Strong and weak scaling, and points that were not timed; not to be changed."""
    return report(tmp_path_factory.mktemp("scaling"), ranked.strong() + ranked.weak()[1:])


def line(table, kind, ranks, threads, cut):
    found = table[(table["scaling"] == kind) & (table["ranks"] == ranks) & (table["threads"] == threads)
                  & (table["cut"] == cut)]
    assert len(found) == 1
    return found.iloc[0]


@pytest.mark.parametrize("ranks, threads, cut, sum_s, alone", [
    (2, 1, "twice", 0.5, 0.625), (2, 1, "once", 0.4, 0.625), (4, 1, "twice", 0.3125, 0.5), (4, 1, "once", 0.25, 0.5),
    (2, 2, "twice", 0.3125, 0.5), (2, 2, "once", 0.5, 0.5)])
def test_ratios_of_strong_scaling(full, ranks, threads, cut, sum_s, alone):
    e = line(full.scaling, "strong", ranks, threads, cut)
    cores = ranks * threads
    assert e["cores"] == cores and e["rounds"] == e["paired_rounds"] == e["threads_paired_rounds"] == 6
    assert e["step_s"] == pytest.approx(2 * made.MEDIAN * sum_s) and e["sum_s"] == pytest.approx(made.MEDIAN * sum_s)
    for end in ("", "_low", "_high"):  # all points of a round are disturbed alike
        for of in ("", "sum_"):
            assert e[f"{of}speedup{end}"] == pytest.approx(1 / sum_s)
            assert e[f"{of}efficiency{end}"] == pytest.approx(1 / sum_s / cores)
            assert e[f"{of}over_threads{end}"] == pytest.approx(alone / sum_s)
    assert e["verdict"] == ("not resolved" if sum_s == alone else "faster")


def test_a_step_has_its_messages_and_waits_and_no_integration(tmp_path):
    where, sum_s, in_round = ranked.timed(2, 1, "twice", 0.5)
    waits = {"phases": {**made.phases(0.5), "integrate_s": 0.125, "total_s": 1.375}}
    rows = ranked.study([(ranked.place(), 1.0), (where, sum_s, lambda k: {**in_round(k), **waits})])
    e = line(artists.report(tmp_path, rows).scaling, "strong", 2, 1, "twice")
    assert e["step_s"] == 1.25 and e["sum_s"] == 0.5


def test_scatter_widens_the_interval_and_nothing_is_resolved(tmp_path):
    noise = made.scattered(0.3, -0.3, 0.2, -0.2, 0.4, -0.4)
    where, sum_s, in_round = ranked.timed(2, 1, "twice", 0.6)
    points = [(ranked.place(), 1.0), (ranked.place(threads=2), 0.625),
              (where, sum_s, lambda k: {**in_round(k), **noise(k)})]
    e = line(report(tmp_path, points).scaling, "strong", 2, 1, "twice")
    assert e["speedup_low"] < e["speedup"] < e["speedup_high"] and e["speedup"] == pytest.approx(1 / 0.6)
    assert e["over_threads_low"] < 1 < e["over_threads_high"] and e["verdict"] == "not resolved"


def test_weak_scaling_is_per_particle(full):
    for ranks, time in ((1, 1.0), (2, 1.25), (4, 1.6)):
        e = line(full.scaling, "weak", ranks, 1, "twice" if ranks > 1 else "none")
        assert e["efficiency"] == pytest.approx(1 / time) and e["speedup"] == pytest.approx(ranks / time)
        assert e["computation_scaling"] == pytest.approx(1 / time)
        assert e["particles_per_rank"] == 8000 and "8000 particles a rank" in e["world"]


@pytest.mark.parametrize("off, kind", [(0.04, "weak"), (0.06, "strong")])
def test_particles_a_rank_are_equal_within_5_per_cent(tmp_path, off, kind):
    table = report(tmp_path, ranked.weak(off)).scaling
    several = table[table["ranks"] > 1]
    assert set(several["scaling"]) == {kind}
    known = several["efficiency"].notna()
    assert known.all() if kind == "weak" else not known.any()  # one rank had another number of particles
    if kind == "weak":
        assert list(several["efficiency"]) == pytest.approx([1.04 / 1.25, 1.04 / 1.6])


def test_another_reach_or_kernel_is_no_weak_scaling(tmp_path):
    for k, change in enumerate(({"H": 0.02}, {"smoothing": "cubic"}, {"precision": "single"})):
        points = [ranked.weak()[0], ranked.timed(2, 1, "twice", 1.25, fluid=16000, **{"dx": 0.005, "H": 0.01} | change)]
        table = report(tmp_path / str(k), points).scaling
        assert set(table["scaling"]) == {"strong"} and table["efficiency"].isna().all()


def test_metrics_of_uneven_ranks(tmp_path):
    """Useful times 0.4 and 0.2 of two threads each, in a run of 0.5."""
    ranks = [ranked.rank(5000, 1000, 1500000, 60, 0.4, 0.05), ranked.rank(3000, 600, 500000, 40, 0.2, 0.3)]
    points = [(ranked.place(), 1.0), ranked.timed(2, 2, "once", 0.4, ranks)]
    e = line(report(tmp_path, points).scaling, "strong", 2, 2, "once")
    assert e["load_balance"] == pytest.approx(0.75) and e["communication_efficiency"] == pytest.approx(0.8)
    assert e["parallel_efficiency"] == pytest.approx(0.6)
    for end in ("", "_low", "_high"):
        assert e[f"computation_scaling{end}"] == pytest.approx(1.0 / (0.6 * 2))
    assert e["imbalance"] == pytest.approx(1.5) and e["ghosts_per_particle"] == pytest.approx(0.2)
    assert e["cut_pairs"] == 100 and e["cut_share"] == pytest.approx(100 / 2e6) and e["hosts"] == 1


def test_useful_times_are_added_over_steps_before_ranks_are_compared(tmp_path):
    """Ranks that take turns are balanced, and wait."""
    turns = [[ranked.rank(4000, 0, 1000000, 0, busy, 0.4 - busy) for busy in order] for order in ((0.3, 0.1), (0.1, 0.3))]
    rows = ranked.study([(ranked.place(), 1.0), ranked.timed(2, 1, "once", 0.4)])
    for row in rows:
        if row["kind"] == "sample" and "ranks" in row:
            row["ranks"] = turns[row["step"] - 1]
    e = line(artists.report(tmp_path, rows).scaling, "strong", 2, 1, "once")
    assert e["load_balance"] == pytest.approx(1.0) and e["communication_efficiency"] == pytest.approx(0.5)
    assert e["computation_scaling"] == pytest.approx(made.MEDIAN / 0.4, rel=0.05)


def test_counts_are_of_all_ranks_and_each_cut_pair_counts_once(tmp_path):
    sent = {"halo": (1, 1000), "migrate": (2, 50), "send_back": (3, 70), "partition": (4, 90)}
    for cut, of_rank, extra in (("twice", 80, 40), ("once", 40, 0)):
        ranks = [ranked.rank(4000, 1000, 1000000 + extra, of_rank, 0.4, 0.1, f"node{k}", **sent) for k in range(2)]
        points = [(ranked.place(), 1.0), ranked.timed(2, 1, cut, 0.4, ranks)]
        found = report(tmp_path / cut, points)
        e = line(found.scaling, "strong", 2, 1, cut)
        assert e["cut_pairs"] == 80 and e["cut_share"] == pytest.approx(80 / 2e6) and e["hosts"] == 2
        assert [(e[f"{phase}_messages"], e[f"{phase}_bytes"]) for phase in sent] == [
            (2 * messages, 2 * some) for messages, some in sent.values()]
        assert unlike(found.results) == []


@pytest.mark.parametrize("change, says", [
    ({"own": 4001}, "its ranks hold 8001 fluid particles, not 8000"),
    ({"own": 3999}, "its ranks hold 7999 fluid particles, not 8000"),
    ({"pairs": 1000041}, "its ranks sum 2000001 pairs, each once, not 2000000"),
    ({"cut": 82}, "its ranks sum 1999999 pairs, each once, not 2000000")])
def test_ranks_that_do_not_add_up_are_a_caveat(tmp_path, change, says):
    ranks = [ranked.rank(**{"own": 4000, "ghosts": 1000, "pairs": 1000040, "cut": 80, "busy": 0.4, "waiting": 0.1} | some)
             for some in ({}, change)]
    points = [(ranked.place(), 1.0), ranked.timed(2, 1, "twice", 0.4, ranks)]
    assert f"symmetric_omp M=6 threads=1 ranks=2 twice: {says}" in report(tmp_path, points).caveats


def test_lost_particles_and_several_evaluations_are_no_fault(tmp_path):
    ranks = [ranked.rank(4000, 1000, 1000000, 80, 0.4, 0.1), ranked.rank(3999, 1000, 900000, 80, 0.4, 0.1)]
    where, sum_s, in_round = ranked.timed(2, 1, "once", 0.4, ranks, integrator="symplectic")
    points = [(ranked.place(integrator="symplectic"), 1.0), (where, sum_s, lambda k: {**in_round(k), "lost": 1})]
    assert unlike(report(tmp_path, points).results) == []


def test_what_was_not_timed_has_counts_and_says_why(full):
    e = line(full.scaling, "strong", 8, 1, "twice")
    assert not e["timed"] and e["why_untimed"] == "8 ranks on 2 cores of node" and e["cut_pairs"] == 80
    assert e[["point", "step_s", "speedup", "over_threads", "load_balance", "computation_scaling"]].isna().all()
    text = tables.text(full)
    assert sum("not timed" in row for row in text.splitlines()) == 2 and "NaN" not in text and "nan" not in text


def test_without_one_rank_nothing_is_compared(tmp_path):
    found = report(tmp_path, ranked.strong()[3:])
    assert found.scaling[["base", "efficiency", "over_threads", "verdict"]].isna().all().all()
    assert found.scaling["load_balance"].dropna().eq(1).all()


def test_useless_ranks_have_no_metrics(tmp_path):
    ranks = [ranked.rank(8000, 0, 2000000, 0, 0.0, 0.0), ranked.rank(0, 0, 0, 0, 0.0, 0.0)]
    e = line(report(tmp_path, [(ranked.place(), 1.0), ranked.timed(2, 1, "once", 0.4, ranks)]).scaling, "strong", 2, 1, "once")
    assert e[["load_balance", "communication_efficiency", "computation_scaling"]].isna().all() and e["imbalance"] == 2


def test_the_summary_has_the_table_only_where_there_are_ranks(full, tmp_path):
    said = summary.summary(full)
    assert [e.message for e in SCHEMA.iter_errors(said)] == []
    one = next(e for e in said["scaling"] if (e["scaling"], e["ranks"], e["cut"]) == ("strong", 4, "once"))
    assert one["efficiency"] == pytest.approx(1.0) and said["points"][one["point"]]["threads"] == 1
    assert next(e for e in said["scaling"] if e["ranks"] == 8)["point"] is None
    said["scaling"][0]["scaling"] = "other"
    assert [e.message for e in SCHEMA.iter_errors(said)] != []


def test_rows_of_one_rank_say_nothing_of_ranks(tmp_path):
    found = artists.report(tmp_path, made.study(made.talk()))
    assert found.scaling.empty and unlike(found.results) == [] and "scaling" not in summary.summary(found)
    summary.write(found, tmp_path)
    page.write([found], tmp_path)
    html = (tmp_path / "report.html").read_text()
    assert "ranks" not in tables.text(found).lower().replace("rank of", "") and 'id="ranks"' not in html
    assert "#ranks" not in html and not (tmp_path / "csv/scaling.csv").exists() and not (tmp_path / "ranks.png").exists()


@pytest.mark.parametrize("width", [1280, 390])
def test_the_page_has_a_folded_section(full, tmp_path, width):
    summary.write(full, tmp_path)
    page.write([full], tmp_path)
    driver = browser.start()
    try:
        browser.show(driver, tmp_path / "report.html", width)
        assert browser.console(driver) == []
        assert len(driver.find_elements(By.CSS_SELECTOR, "#bar a[href='#ranks']")) == 1
        section = driver.find_element(By.CSS_SELECTOR, "#ranks details")
        assert section.get_attribute("open") is None
        browser.show_all(driver)
        assert len(section.find_elements(By.CSS_SELECTOR, "svg.figure")) == 1
        assert len(section.find_elements(By.CSS_SELECTOR, "table")) == 4
        assert browser.clipped(driver) == []
        links = [link.get_attribute("href") for link in section.find_elements(By.CSS_SELECTOR, ".links a")]
        assert [link.rsplit("/", 1)[1] for link in links] == ["scaling.csv", "ranks.png"]
        assert all(pathlib.Path(link.removeprefix("file://")).is_file() for link in links)
        wide, inner = driver.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
        assert inner == width and wide <= width
    finally:
        driver.quit()
