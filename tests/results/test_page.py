"""The page in a browser: wide and narrow, light and dark, printed; and what it must not let in."""
import builtins
import importlib
import pathlib
import re
import struct
import sys

import artists
import browser
import made
import pandas as pd
import pytest
from committed import committed
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

import pairsum_results as pr
from pairsum_results import figures, history_report, page, summary
from pairsum_results.history import load_history

WIDTHS = (1280, 390)
EVIL = '<script>window.taken = 1</script><img src=x onerror="window.taken = 2">"\'{{ 7 * 7 }}</title>'
#: What would load something from elsewhere; a link to a file of the report is only followed by a reader.
OUTSIDE = re.compile(r"""(?:(?<!<a)\s(?:src|srcset|href|xlink:href|poster|data|action)=["']?|url\(\s*["']?|@import\s+["']?)"""
                     r"""(?!\#|data:)[^"'\s)>]|<a href="(?:\w+:|/)|<script[^>]*>[^<]*https?://""")
#: Four screens.
HIGHEST = 3200


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    return artists.report(tmp_path_factory.mktemp("rows"), artists.everything())


@pytest.fixture(scope="module")
def other(tmp_path_factory):
    """The report of another machine, with one series."""
    rows = made.study(made.talk(), before=[made.environment(host="bignode", cpu="Another CPU 7702")])
    return artists.report(tmp_path_factory.mktemp("other"), rows)


@pytest.fixture(scope="module")
def one(report, tmp_path_factory):
    return written([report], tmp_path_factory.mktemp("page"))


@pytest.fixture(scope="module")
def both(report, other, tmp_path_factory):
    return written([report, other], tmp_path_factory.mktemp("page"))


@pytest.fixture(scope="module", params=["talk", "field"])
def real(request, tmp_path_factory):
    newest = committed(f"results/{request.param}/*.jsonl")[-1]
    return written([pr.report(pr.load(newest))], tmp_path_factory.mktemp(request.param))


def written(reports, folder):
    """Writes a report's files and page."""
    summary.write(reports[0], folder)
    page.write(reports, folder)
    return folder / "report.html"


@pytest.fixture(scope="module")
def past(tmp_path_factory):
    """The page of a history in which one point got slower and another faster."""
    folder = tmp_path_factory.mktemp("history")
    for day, change in ((1, {}), (2, {"symmetric_omp": 2, "naive": 0.5})):
        e = made.environment(f"{day:016x}", git=f"{day}abcdef", utc=f"2026-11-0{day}T00:00:00Z")
        points = [(place, time * change.get(place["backend"], 1), {"environment": e["environment"]})
                  for place, time in made.talk()]
        made.write(folder / f"{day}.jsonl", made.study(points, before=[e]))
    history_report.write(load_history(folder), folder)
    return folder / "history.html"


@pytest.fixture(scope="module")
def chromium():
    driver = browser.start()
    yield driver
    driver.quit()


@pytest.mark.parametrize("width", WIDTHS)
def test_the_page_is_quiet_loads_nothing_and_fits(chromium, one, both, past, width):
    for path in (one, both, past):
        browser.show(chromium, path, width)
        assert browser.console(chromium) == [] and browser.requests(chromium, path) == []
        browser.open_all(chromium)
        wide, inner = chromium.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
        assert inner == width and wide <= width
        assert not OUTSIDE.search(path.read_text()) and path.stat().st_size < 3e6


@pytest.mark.parametrize("planted", [
    '<img src="https://example.org/a.png">', '<a href="https://example.org/">', '<img src="a.png">', '<img srcset="//example.org/a.png 2x">', '<use href="other.svg#a"/>',
    '<link rel="stylesheet" href="a.css">', "<style>@import 'a.css';</style>", '<p style="background:url(a.png)">',
    '<form action="https://example.org">', "<script>fetch('https://example.org/')</script>"])
def test_what_would_be_loaded_is_found(planted):
    assert OUTSIDE.search(planted)


@pytest.mark.parametrize("width", WIDTHS)
def test_every_figure_is_there_and_can_be_read(chromium, one, width):
    browser.show(chromium, one, width)
    browser.show_all(chromium)
    heads = chromium.find_elements(By.CSS_SELECTOR, "details[id^=figure] > summary")
    there = [drawing.heading for drawing in figures.ALL if drawing.inline and drawing.name not in ("density", "ranks")]
    assert [head.text for head in heads] == there
    drawn = chromium.execute_script("""return [...document.querySelectorAll("svg.figure")].map((svg) => {
      const box = svg.getBoundingClientRect(), room = svg.parentElement;
      return [box.width, box.height, svg.querySelectorAll("text").length, svg.getAttribute("aria-label"),
              room.clientWidth, getComputedStyle(room).overflowX, svg.querySelectorAll("title").length]; })""")
    assert len(drawn) > len(heads)
    for wide, high, texts, label, room, overflow, titles in drawn:
        assert wide > 250 and high > 80 and texts > 3 and len(label) > 40 and titles > 0
        assert wide <= room + 1 or overflow == "auto"
    ids = chromium.execute_script("return [...document.querySelectorAll('[id]')].map((node) => node.id)")
    assert len(ids) == len(set(ids))


def test_the_answer_stands_first(chromium, report, other, both):
    browser.show(chromium, both)
    answer = chromium.find_element(By.ID, "answer").text
    for one in (report, other):
        assert one.answer.text in answer and one.answer.command in answer
        over = one.answer.over_gather or one.answer.over_symmetric
        assert f"{over['ratio']:.2f} times" in answer and f"95 % interval {over['low']:.2f} to {over['high']:.2f}" in answer
    heads = chromium.execute_script("return [...document.querySelectorAll('h2')].map((head) => head.innerText)")
    assert heads == ["All backends", "Case by case", "Questions of the talk", "More figures", "All tables",
                     "Caveats and machines"]
    assert not chromium.find_elements(By.CLASS_NAME, "banner")


def test_a_banner_warns_and_no_number_stands_without_an_interval(chromium, tmp_path):
    rows = made.study(made.talk(), rounds=2)
    rows[-1] |= {"others_share": 0.24}
    browser.show(chromium, written([artists.report(tmp_path, rows)], tmp_path))
    disturbed, open_ = (banner.text for banner in chromium.find_elements(By.CLASS_NAME, "banner"))
    assert "nothing is decided, because" in open_ and disturbed.startswith("1 of 2 rounds was disturbed")
    assert "24 %" in disturbed
    answer = chromium.find_element(By.ID, "answer").text
    assert "Run this next" in answer and not re.search(r"\d\.\d+ times", answer) and " a step" not in answer
    assert not chromium.find_elements(By.CSS_SELECTOR, ".numbers b")


def test_the_command_can_be_copied(chromium, report, one):
    browser.show(chromium, one)
    button = chromium.find_element(By.CSS_SELECTOR, ".command button")
    button.click()
    assert button.text == "Copied" and chromium.execute_script("return getSelection().toString()") == report.answer.command


def rungs(driver):
    """What the ladder shows: backends from above, and the heading."""
    shown = [one for one in driver.find_elements(By.CSS_SELECTOR, "#ladder .rungs") if one.is_displayed()]
    return [[row.text for row in one.find_elements(By.TAG_NAME, "th")] for one in shown], [
        head.text for head in driver.find_elements(By.CSS_SELECTOR, "#ladder h3") if head.is_displayed()]


@pytest.mark.parametrize("width", WIDTHS)
def test_the_switch_shows_one_case_and_number_of_threads(chromium, report, one, width):
    browser.show(chromium, one, width)
    case, threads = (Select(chromium.find_element(By.NAME, name)) for name in ("case", "threads"))
    assert [o.text for o in threads.options] == ["1", "2", "4", "8", "16"] and len(case.options) == 4
    table = report.standings
    p = report.points.loc[report.answer.point]
    assert (case.first_selected_option.text, threads.first_selected_option.text) == (
        table.loc[table["point"] == report.answer.point, "world"].iloc[0], str(p["threads"]))
    for world in (o.text for o in case.options):
        case.select_by_visible_text(world)
        for count in (1, 4):
            threads.select_by_visible_text(str(count))
            own = table[(table["world"] == world) & (table["threads"] == count)]
            shown, heads = rungs(chromium)
            if own.empty:
                assert not shown
                continue
            assert [name.split()[0] for name in shown[0]] == list(own["backend"]) and len(shown) == 1
            assert [head.startswith(f"{world}, {count} thread") for head in heads] == [True]
    cases = {node.get_attribute("data-case") for node in chromium.find_elements(By.CSS_SELECTOR, "main [data-case]")
             if node.is_displayed()}
    assert cases == {world}


def test_without_its_script_everything_is_shown(chromium, one, tmp_path):
    plain = tmp_path / "plain.html"
    plain.write_text(re.sub("<script>.*</script>", "", one.read_text(), flags=re.DOTALL))
    browser.show(chromium, plain)
    assert len(rungs(chromium)[0]) > 5 and not chromium.find_elements(By.TAG_NAME, "select")


def test_bars_are_the_ratios_and_their_intervals(chromium, report, one):
    browser.show(chromium, one)
    own = report.standings.set_index("point")
    own = own[(own["series"] == own.loc[report.answer.point, "series"]) & (
        own["threads"] == own.loc[report.answer.point, "threads"])]
    drawn = chromium.execute_script("""return [...document.querySelectorAll(".rungs svg")].filter((svg) => svg.clientWidth)
      .map((svg) => [svg.querySelector(".length").getBBox().width, ...["x1", "x2"].map((end) =>
        svg.querySelector(".whisker")?.[end].baseVal.value ?? null), svg.querySelector(".one").x1.baseVal.value,
        svg.querySelector("title").textContent])""")
    assert len(drawn) == len(own)
    for (wide, low, high, equal, title), e in zip(drawn, own.itertuples()):
        assert wide / equal == pytest.approx(e.ratio, rel=1e-3) and f"{e.ratio:.2f}" in title
        assert (low is None) == (e.Index == e.base)
        assert low is None or (low / equal, high / equal) == pytest.approx((e.low, e.high), rel=1e-3)


def test_cases_are_times_over_the_fastest_of_each(chromium, report, one):
    browser.show(chromium, one)
    table = chromium.find_element(By.CLASS_NAME, "heat")
    cells = [[cell.text for cell in row.find_elements(By.TAG_NAME, "td")] for row in
             table.find_elements(By.CSS_SELECTOR, "tbody tr")]
    columns = list(zip(*cells))
    assert len(columns) == report.standings["series"].nunique() and all("1.00" in column for column in columns)
    most = report.standings.groupby("series")["threads"].transform("max")
    own = report.standings[report.standings["threads"] == most]
    assert sorted(text for column in columns for text in column if text != "-") == sorted(
        own["behind"].map("{:.2f}".format))
    shades = chromium.execute_script("""return [...document.querySelectorAll(".heat td")].map((cell) =>
        [cell.textContent, getComputedStyle(cell).backgroundColor, cell.title])""")
    assert len({shade for text, shade, _ in shades if text == "1.00"}) == 1 < len({shade for _, shade, _ in shades})
    assert all("a step" in title or title == "not measured" for *_, title in shades)


def test_questions_are_a_line_each_with_the_rest_folded(chromium, report, one):
    browser.show(chromium, one)
    lines = chromium.find_elements(By.CSS_SELECTOR, ".question")[:len(report.questions)]
    for line, q in zip(lines, report.questions):
        assert line.text.split("\n") == [q["verdict"], q["question"], q["number"]] and line.rect["height"] < 40
        line.click()
        assert q["answer"] in line.text


def test_links_lead_to_files_of_the_report(chromium, one, real):
    for path in (one, real):
        browser.show(chromium, path)
        browser.open_all(chromium)
        links = {link.get_attribute("href") for link in chromium.find_elements(By.CSS_SELECTOR, ".links a")}
        assert len(links) > 4 and all(pathlib.Path(link.removeprefix("file://")).is_file() for link in links)
        assert {link[-3:] for link in links} == {"csv", "png"}


@pytest.mark.parametrize("width", WIDTHS)
def test_no_cell_is_clipped(chromium, one, both, real, width):
    for path in (one, both, real):
        browser.show(chromium, path, width)
        browser.show_all(chromium)
        assert browser.clipped(chromium) == []
        assert chromium.execute_script("return document.querySelectorAll('td').length") > 100


@pytest.mark.parametrize("table, why", [
    ('<div style="overflow:hidden;width:100px">TABLE</div>', "cut off"), ("TABLE", "beyond the window"),
    ('<div style="overflow-x:clip">TABLE</div>', "cut off"),
    ('<table style="table-layout:fixed;width:90px"><td style="overflow:hidden;white-space:nowrap">TEXT</td></table>', "wider than its cell"),
    ('<div style="overflow-x:auto"><table style="margin-left:-50px"><td>TEXT</td></table></div>', "out of reach")])
def test_a_clipped_cell_is_found(chromium, tmp_path, table, why):
    text = "a-very-long-word-" * 9
    table = table.replace("TABLE", f'<table><tr><td style="white-space:nowrap">{text}</td></tr></table>')
    (tmp_path / "cut.html").write_text(f"<!DOCTYPE html><body>{table.replace('TEXT', text)}")
    browser.show(chromium, tmp_path / "cut.html", 390)
    assert why in str(browser.clipped(chromium))
    (tmp_path / "whole.html").write_text(f'<!DOCTYPE html><body><div style="overflow-x:auto"><table><td>{text}</td></table>')
    browser.show(chromium, tmp_path / "whole.html", 390)
    assert browser.clipped(chromium) == []


def test_the_first_screens_are_few_and_pngs_fit_a_slide(chromium, real):
    browser.show(chromium, real)
    top = chromium.execute_script("return document.getElementById('tables').getBoundingClientRect().top + scrollY")
    assert 600 < top <= HIGHEST
    pngs = sorted(real.parent.glob("*.png"))
    assert {"ladder", "cases"} <= {path.stem for path in pngs} and not list(real.parent.glob("*.svg"))
    sizes = {path.name: struct.unpack(">II", path.read_bytes()[16:24]) for path in pngs}
    assert {name: size for name, size in sizes.items() if size[0] > 1600 or size[1] > 1200} == {}
    assert min(wide for wide, _ in sizes.values()) > 600


def test_texts_are_people_s_words(chromium, one, real):
    keys = {name for name in (*_columns(pr.load(committed("results/talk/*.jsonl")[-1])), "share_of_bound") if "_" in name}
    assert {"n_fluid", "sum_s", "others_share", "share_of_bound", "bandwidth_bytes_per_s"} <= keys
    for path in (one, real):
        browser.show(chromium, path)
        browser.show_all(chromium)
        said = set(re.findall(r"\w+", chromium.find_element(By.TAG_NAME, "body").text))
        assert "particles" in said and said & keys == set()


def _columns(results):
    return {name for value in vars(results).values() if isinstance(value, pd.DataFrame) for name in value.columns}


def test_tables_sort_by_number_and_by_word(chromium, one, report):
    browser.show(chromium, one)
    browser.open_all(chromium)
    table = chromium.find_element(By.XPATH, "//details[summary='Summation time per step']//table")

    def natural(text):
        return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", text)]

    for head, kind in (("sum ms", float), ("backend", natural)):
        at = [h.text for h in table.find_elements(By.CSS_SELECTOR, "thead th")].index(head)
        for order in (1, -1):
            table.find_elements(By.CSS_SELECTOR, "thead button")[at].click()
            cells = [kind(row.find_elements(By.TAG_NAME, "td")[at].text)
                     for row in table.find_elements(By.CSS_SELECTOR, "tbody tr")]
            assert cells == sorted(cells)[::order] and len(cells) == (report.points["series"] == 0).sum()


@pytest.mark.parametrize("width", WIDTHS)
def test_light_and_dark_both_can_be_read(chromium, one, width):
    seen = {}
    for scheme in ("light", "dark"):
        browser.show(chromium, one, width, scheme)
        browser.open_all(chromium)
        seen[scheme] = browser.contrasts(chromium, "h1, h2, h3, h4, p, b, th, td, button, dt, dd, li, a, "
                                         "small, summary, summary span, code, svg.figure text")
        assert [item for item in seen[scheme] if item[3] < 4.5] == []
    for light, dark in zip(seen["light"], seen["dark"]):
        assert light[0] == dark[0] and light[1] != dark[1] and light[2] != dark[2]


def test_low_contrast_is_found(chromium, tmp_path):
    (tmp_path / "pale.html").write_text('<p style="color:#999;background:#fff">pale</p>')
    browser.show(chromium, tmp_path / "pale.html")
    (_, _, _, contrast), = browser.contrasts(chromium, "p")
    assert 2.8 < contrast < 2.9


def test_print_is_light_and_whole(chromium, one):
    browser.show(chromium, one, 720, "dark", media="print")
    chromium.execute_script("dispatchEvent(new Event('beforeprint'))")
    assert not chromium.find_element(By.ID, "bar").is_displayed()
    assert browser.contrasts(chromium, "h1")[0][1:3] == ("29,33,37,255", "255,255,255,255")
    assert chromium.execute_script("""return [...document.querySelectorAll("main details")].every((one) => one.open)
      && [...document.querySelectorAll("main [data-case]")].every((one) => one.getClientRects().length)
      && [...document.querySelectorAll(".table")].every((one) => one.scrollHeight <= one.clientHeight + 1)
      && [...document.querySelectorAll("svg.figure")].every((svg) => svg.getBoundingClientRect().height < 870)""")


def test_text_of_rows_cannot_become_markup(chromium, one, tmp_path):
    points = [(made.point(name, 6, n, case=EVIL, granularity=EVIL, dx=dx), 1.0)
              for name in ("naive_omp", EVIL) for n in (1, 2) for dx in (0.1, 0.2)]
    rows = made.study(points, before=[made.environment(host=EVIL, cpu=EVIL, libraries={EVIL: EVIL}, flags=EVIL)])
    path = written([artists.report(tmp_path, rows)], tmp_path)
    html = path.read_text()
    assert html.count("<script") == 1 and "<img" not in html and "&lt;script&gt;" in html
    browser.show(chromium, path)
    assert chromium.execute_script("return window.taken === undefined") and browser.console(chromium) == []
    (tmp_path / "planted.html").write_text(one.read_text().replace("<main>", "<main><script>window.taken = 1</script>"))
    browser.show(chromium, tmp_path / "planted.html")
    assert chromium.execute_script("return window.taken === undefined")
    assert any("Content Security Policy" in line for line in browser.console(chromium))


def test_a_study_of_copies_alone_recommends_nothing_and_has_no_strategies(chromium, tmp_path):
    wrong = {"phases": None, "error": "it was wrong"}
    rows = made.study([(made.point("again_naive_omp"), 1.0), (made.point("symmetric_omp"), 1.0, wrong)])
    path = written([artists.report(tmp_path, rows)], tmp_path)
    browser.show(chromium, path)
    text = chromium.find_element(By.TAG_NAME, "body").text
    assert "nothing can be recommended" in text and "No question was answered" in text
    assert "1 point failed the verification: symmetric_omp." in text and "No two backends" in text
    browser.open_all(chromium)
    text += chromium.find_element(By.TAG_NAME, "body").text
    assert "it was wrong" in text and "nan" not in text and "None" not in text


def test_a_page_is_repeatable_and_written_whole(other, tmp_path):
    pages = [page.write([other], tmp_path / name) and (tmp_path / name / "report.html").read_text() for name in "ab"]
    assert pages[0] == pages[1]
    (tmp_path / "file").write_text("")
    with pytest.raises(pr.ResultsError, match="cannot write .*file"):
        page.write([other], tmp_path / "file")


@pytest.mark.parametrize("library, module", [("jinja2", "page"), ("matplotlib", "figures")])
def test_a_missing_library_is_one_line(monkeypatch, library, module):
    real = builtins.__import__
    monkeypatch.setattr(builtins, "__import__", lambda name, *rest: real(
        f"no_{name}" if name.split(".")[0] == library else name, *rest))
    monkeypatch.delitem(sys.modules, library, raising=False)
    with pytest.raises(pr.ResultsError, match=f"{library} for .*python3-{library}"):
        importlib.reload(sys.modules[f"pairsum_results.{module}"])
